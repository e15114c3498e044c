// studio/bridge_link.cpp: writes works as links, and reads links.
#include "art/link/link.h"
#include "studio/bridge_answers.h"

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
    return {{"shared", Json::parse(shared_json(read_link(text_of(request, "link"))))}};
}

}  // namespace sikku
