#include "cli/json.h"

#include <fmt/format.h>
#include <algorithm>
#include <set>
#include <vector>

namespace sikku {
namespace {

constexpr std::size_t most_depth = 50;

void require_shallow(const std::string& text) {
    std::size_t depth = 0;
    bool in_text = false;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char letter = text[i];
        if (in_text && letter == '\\') {
            ++i;
        } else if (letter == '"') {
            in_text = !in_text;
        } else if (!in_text && (letter == '[' || letter == '{')) {
            if (++depth > most_depth) throw JsonError("too many brackets in each other", i + 1);
        } else if (!in_text && (letter == ']' || letter == '}')) {
            depth -= depth > 0 ? 1 : 0;
        }
    }
}

}  // namespace

nlohmann::ordered_json read_json(const std::string& text) {
    using Json = nlohmann::ordered_json;
    require_shallow(text);
    std::vector<std::set<std::string>> keys;  // of the objects that are open
    const Json::parser_callback_t look = [&](int, Json::parse_event_t event, Json& value) {
        if (event == Json::parse_event_t::object_start) {
            keys.emplace_back();
        } else if (event == Json::parse_event_t::object_end) {
            keys.pop_back();
        } else if (event == Json::parse_event_t::key) {
            const auto key = value.get<std::string>();
            if (!keys.back().insert(key).second) {
                const std::string written = '"' + key + '"';
                const std::size_t at = text.find(written, text.find(written) + 1);
                throw JsonError(fmt::format("the key '{}' stands twice", key), std::min(at, text.size()) + 1);
            }
        }
        return true;
    };
    try {
        return Json::parse(text, look);
    } catch (const Json::parse_error& error) {
        throw JsonError("this is no JSON", std::max<std::size_t>(error.byte, 1));
    } catch (const Json::exception&) {
        throw JsonError("this holds a number that is too large", 1);
    }
}

}  // namespace sikku
