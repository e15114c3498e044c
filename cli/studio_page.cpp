#include "cli/studio_page.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <string_view>

namespace sikku {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::string_view begin_mark = R"(<script type="application/json" id="sikku-patterns">)";
constexpr std::string_view end_mark = "</script>";

/// Escapes `<`, which occurs only in strings of JSON, so that the JSON cannot close the script element.
std::string without_tags(const std::string& json) {
    std::string text;
    text.reserve(json.size());
    for (const char letter : json) {
        if (letter == '<') {
            text += "\\u003c";
        } else {
            text += letter;
        }
    }
    return text;
}

}  // namespace

std::string page_with(const std::string& page, const std::vector<SharedWork>& patterns) {
    const std::size_t begin = page.find(begin_mark);
    const std::size_t from = begin == std::string::npos ? begin : begin + begin_mark.size();
    const std::size_t end = from == std::string::npos ? from : page.find(end_mark, from);
    if (end == std::string::npos) throw PageError("not a studio page that can contain patterns");
    Json list = Json::array();
    for (const SharedWork& work : patterns) {
        Json shared = Json::parse(shared_json(work));
        Json pattern = std::move(shared["pattern"]);
        if (!work.draw.empty()) pattern["draw"] = std::move(shared["draw"]);
        if (!work.play.empty()) pattern["play"] = std::move(shared["play"]);
        list.push_back(std::move(pattern));
    }
    return page.substr(0, from) + without_tags(list.dump()) + page.substr(end);
}

std::string file_address(const std::string& path) {
    constexpr std::string_view plain = "-._~/";
    std::string address = "file://";
    for (const char letter : path) {
        const bool is_alphanumeric =
            (letter >= 'a' && letter <= 'z') || (letter >= 'A' && letter <= 'Z') || (letter >= '0' && letter <= '9');
        if (is_alphanumeric || plain.find(letter) != std::string_view::npos) {
            address += letter;
        } else {
            address += fmt::format("%{:02X}", static_cast<unsigned char>(letter));
        }
    }
    return address;
}

}  // namespace sikku
