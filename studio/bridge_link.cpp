// studio/bridge_link.cpp: writes works as links, and reads links.
#include "art/link/link.h"
#include "art/prints.h"
#include "engine/base/option.h"
#include "studio/bridge_answers.h"

#include <utility>

namespace sikku {

Json answer_link(const Json& request) {
    const std::string shared = member(request, "shared").dump();
    try {
        return {{"link", link_of(read_shared_json(shared))}};
    } catch (const LinkError& error) {
        throw BadRequest(error.what());
    }
}

Json answer_read_link(const Json& request) {
    SharedWork work = read_link(text_of(request, "link"));
    Json withheld = Json::array();
    std::erase_if(work.draw, [&](const OptionValue& value) {
        const OptionInfo* row = find_option(prints().options(), value.name);
        if (!row || !row->moves_machine) return false;
        withheld.push_back(Json::array({value.name, value.text}));
        return true;
    });
    return {{"shared", Json::parse(shared_json(work))}, {"withheld", std::move(withheld)}};
}

}  // namespace sikku
