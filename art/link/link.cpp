#include "art/link/link.h"

#include "engine/base/base64.h"
#include "engine/base/deflate.h"
#include "engine/base/diagnostic.h"
#include "engine/base/json.h"
#include "engine/base/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <initializer_list>
#include <stdexcept>
#include <utility>

namespace sikku {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::string_view link_word = "sikku";
constexpr std::string_view prefix = "sikku1.";  // includes the version of the format
constexpr std::size_t longest_name = 255;       // bytes in a file name
constexpr std::size_t most_pairs = 1000;        // settings, or options of one command

[[noreturn]] void refuse_damaged() {
    throw LinkError("the link is damaged or incomplete");
}

std::string from_base64url(std::string_view text) {
    if (text.find_first_not_of(base64_letters(Base64::url)) != std::string_view::npos) {
        throw LinkError("the link is damaged: it contains an invalid character");
    }
    auto bytes = from_base64(text, Base64::url);
    if (!bytes) refuse_damaged();
    return std::move(*bytes);
}

/// Decodes percent-encoding such as `%2D`, which other programs may add to addresses.
std::string percent_decoded(std::string_view text) {
    const auto value = [](char letter) {
        if (letter >= '0' && letter <= '9') return letter - '0';
        const char small = static_cast<char>(letter | 0x20);
        return small >= 'a' && small <= 'f' ? small - 'a' + 10 : -1;
    };
    std::string decoded;
    decoded.reserve(text.size());
    for (std::size_t at = 0; at < text.size(); ++at) {
        if (text[at] != '%') {
            decoded += text[at];
            continue;
        }
        const int high = at + 2 < text.size() ? value(text[at + 1]) : -1;
        const int low = at + 2 < text.size() ? value(text[at + 2]) : -1;
        if (high < 0 || low < 0) throw LinkError("the link is damaged: '%' without two hexadecimal digits");
        decoded += static_cast<char>(high * 16 + low);
        at += 2;
    }
    return decoded;
}

std::string decompressed(std::string_view packed) {
    try {
        return inflated(packed, Deflate::raw, most_link_bytes);
    } catch (const std::length_error&) {
        throw LinkError("the link contains more than 64 MB");
    } catch (const std::runtime_error&) {
        refuse_damaged();
    }
}

// --- JSON -------------------------------------------------------------------------------------------------------

[[noreturn]] void refuse(const std::string& what) {
    throw LinkError("the link is damaged: " + what);
}

/// True for file names without folders, control characters and direction overrides, because messages and outputs
/// quote them.
bool is_file_name(std::string_view name) {
    return !name.empty() && name.size() <= longest_name && name != "." && name != ".." && name[0] != '-' &&
           name.find('/') == std::string_view::npos && printable(name, longest_name) == name;
}

Json json_of(const OptionValues& values) {
    Json list = Json::array();
    for (const OptionValue& value : values) list.push_back(Json::array({value.name, value.text}));
    return list;
}

Json json_of(const SharedWork& work, bool is_complete) {
    Json pattern = {{"name", work.name}, {"text", work.text}};
    if (is_complete || !work.variant.empty()) pattern["variant"] = work.variant;
    if (is_complete || !work.settings.empty()) pattern["settings"] = json_of(work.settings);
    Json shared = {{"pattern", std::move(pattern)}};
    if (is_complete || !work.draw.empty()) shared["draw"] = json_of(work.draw);
    if (is_complete || !work.play.empty()) shared["play"] = json_of(work.play);
    if (is_complete || !work.page.empty()) {
        Json page = Json::object();
        for (const auto& [name, text] : work.page) page[name] = text;
        shared["page"] = std::move(page);
    }
    return shared;
}

std::string text_of_json(const Json& json) {
    try {
        return json.dump();
    } catch (const Json::exception&) {
        throw LinkError("a link cannot contain invalid UTF-8");
    }
}

/// @throws LinkError if the value is not an object or has unknown members
void require_object(const Json& value, const char* name, std::initializer_list<std::string_view> known) {
    if (!value.is_object()) refuse(fmt::format("'{}' must be an object", name));
    for (const auto& [key, member] : value.items()) {
        if (std::find(known.begin(), known.end(), key) == known.end()) {
            refuse(fmt::format("'{}' has an unknown member", name));
        }
    }
}

std::string text_of(const Json& value, const char* name) {
    if (!value.is_string()) refuse(fmt::format("'{}' must be a string", name));
    return value.get<std::string>();
}

OptionValues pairs_of(const Json& object, const char* name) {
    OptionValues values;
    const auto found = object.find(name);
    if (found == object.end()) return values;
    if (!found->is_array() || found->size() > most_pairs) {
        refuse(fmt::format("'{}' must be a list of at most {} pairs", name, most_pairs));
    }
    for (const Json& pair : *found) {
        if (!pair.is_array() || pair.size() != 2)
            refuse(fmt::format("'{}' must be a list of pairs of strings", name));
        values.push_back({text_of(pair[0], name), text_of(pair[1], name)});
    }
    return values;
}

SharedWork work_of(const Json& json) {
    require_object(json, "link", {"pattern", "draw", "play", "page"});
    const auto pattern = json.find("pattern");
    if (pattern == json.end()) refuse("'pattern' is missing");
    require_object(*pattern, "pattern", {"name", "text", "variant", "settings"});
    if (!pattern->contains("name") || !pattern->contains("text")) refuse("'pattern' needs 'name' and 'text'");
    SharedWork work;
    work.name = text_of(pattern->at("name"), "name");
    if (!is_file_name(work.name)) refuse("'name' must be a file name");
    work.text = text_of(pattern->at("text"), "text");
    if (pattern->contains("variant")) work.variant = text_of(pattern->at("variant"), "variant");
    work.settings = pairs_of(*pattern, "settings");
    work.draw = pairs_of(json, "draw");
    work.play = pairs_of(json, "play");
    if (const auto page = json.find("page"); page != json.end()) {
        if (!page->is_object()) refuse("'page' must be an object");
        for (const auto& [name, value] : page->items()) work.page[name] = text_of(value, "page");
    }
    return work;
}

// --- addresses --------------------------------------------------------------------------------------------------

bool is_address(std::string_view text) {
    const std::string start = lower_case(text.substr(0, 8));
    return start.starts_with("https://") || start.starts_with("http://") || start.starts_with("file://");
}

std::string_view without_space(std::string_view text) {
    constexpr std::string_view space = " \t\r\n";
    const std::size_t first = text.find_first_not_of(space);
    if (first == std::string_view::npos) return {};
    return text.substr(first, text.find_last_not_of(space) - first + 1);
}

/// The part after the first `#`, or the whole text if it contains none.
std::string_view fragment_of(std::string_view text) {
    const std::size_t at = text.find('#');
    return at == std::string_view::npos ? text : text.substr(at + 1);
}

/// True if the fragment begins with `sikku`, a number and a dot.
bool has_version(std::string_view fragment) {
    if (!fragment.starts_with(link_word)) return false;
    const std::size_t end = fragment.find_first_not_of("0123456789", link_word.size());
    return end != std::string_view::npos && end > link_word.size() && fragment[end] == '.';
}

}  // namespace

std::string shared_json(const SharedWork& work) {
    return text_of_json(json_of(work, true));
}

std::string link_of(const SharedWork& work) {
    if (!is_file_name(work.name)) {
        throw LinkError("a link needs a file name without folders or control characters");
    }
    for (const OptionValues* values : {&work.settings, &work.draw, &work.play}) {
        if (values->size() > most_pairs) {
            throw LinkError(fmt::format("a link contains at most {} values or options", most_pairs));
        }
    }
    const std::string json = text_of_json(json_of(work, false));
    if (json.size() > most_link_bytes) throw LinkError("the work is too large for a link: at most 64 MB of JSON");
    return std::string(prefix) + to_base64(deflated(json, Deflate::raw), Base64::url);
}

SharedWork read_shared_json(const std::string& json) {
    try {
        return work_of(read_json(json));
    } catch (const JsonError& error) {
        refuse(printable(error.what()));
    }
}

bool is_link(std::string_view text) {
    text = without_space(text);
    if (is_address(text)) return true;
    const bool is_file = text.find('#') == std::string_view::npos && text.ends_with(".lsys");
    return !is_file && has_version(fragment_of(text));
}

SharedWork read_link(std::string_view link) {
    if (link.size() > most_link_bytes) throw LinkError("the link is too long: at most 64 MB");
    link = without_space(link);
    if (is_address(link) && link.find('#') == std::string_view::npos) {
        throw LinkError("this address contains no pattern: expected a part after '#'");
    }
    const std::string fragment = percent_decoded(fragment_of(link));
    if (!fragment.starts_with(prefix)) {
        throw LinkError(has_version(fragment)
                            ? "this link was made by a newer version of Sikku"
                            : fmt::format("this link contains no pattern: expected '#{}…'", prefix));
    }
    return read_shared_json(decompressed(from_base64url(std::string_view(fragment).substr(prefix.size()))));
}

}  // namespace sikku
