// studio/bridge_link.cpp: writes works as links, and reads links.
#include "art/link/link.h"
#include "studio/bridge_answers.h"

#include <utility>

namespace sikku {
namespace {

OptionValues values_of(const Json& object, const std::string& name) {
    OptionValues values;
    for (auto& [key, text] : pairs_of(object, name)) values.push_back({key, text});
    return values;
}

}  // namespace

Json answer_link(const Json& request) {
    const Json& shared = member(request, "shared");
    const Json& pattern = member(shared, "pattern");
    SharedWork work;
    work.name = text_of(pattern, "name");
    work.text = text_of(pattern, "text");
    work.variant = text_of(pattern, "variant", "");
    work.settings = values_of(pattern, "settings");
    work.draw = values_of(shared, "draw");
    work.play = values_of(shared, "play");
    if (shared.contains("page")) {
        if (!shared["page"].is_object()) throw BadRequest("'page' must be an object");
        for (const auto& [name, value] : shared["page"].items()) {
            if (!value.is_string()) throw BadRequest("'page' must be an object of strings");
            work.page[name] = value.get<std::string>();
        }
    }
    return {{"link", link_of(work)}};
}

Json answer_read_link(const Json& request) {
    return {{"shared", Json::parse(shared_json(read_link(text_of(request, "link"))))}};
}

}  // namespace sikku
