#include "engine/base/json.h"

#include "engine/base/diagnostic.h"
#include "engine/base/text.h"

#include <fmt/format.h>
#include <algorithm>
#include <set>
#include <string_view>

namespace sikku {
namespace {

constexpr std::size_t most_depth = 50;
constexpr std::size_t most_values = 100'000;
constexpr std::size_t most_object_keys = 1000;  // lookup in an ordered object is linear

/// Counts brackets and values before memory is spent on them. Returns the places of all keys in order.
std::vector<std::size_t> find_keys(std::string_view text) {
    std::vector<std::size_t> keys;
    std::size_t depth = 0;
    std::size_t values = 0;
    std::size_t last_text = 0;
    bool in_text = false;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char letter = text[i];
        if (in_text && letter == '\\') {
            ++i;
        } else if (letter == '"') {
            in_text = !in_text;
            if (in_text) last_text = i;
        } else if (in_text) {
            continue;
        } else if (letter == '[' || letter == '{') {
            if (++depth > most_depth) throw JsonError("too many brackets in each other", i + 1);
        } else if (letter == ']' || letter == '}') {
            depth -= depth > 0 ? 1 : 0;
        } else if (letter == ',' || letter == ':') {
            if (++values > most_values) throw JsonError("too many values: at most 100000", i + 1);
            if (letter == ':') keys.push_back(last_text);
        }
    }
    return keys;
}

}  // namespace

nlohmann::ordered_json read_json(const std::string& text, std::vector<std::size_t>* key_places) {
    using Json = nlohmann::ordered_json;
    std::vector<std::size_t> places = find_keys(text);
    std::size_t met = 0;                      // keys so far
    std::vector<std::set<std::string>> keys;  // of the objects that are open
    const Json::parser_callback_t look = [&](int, Json::parse_event_t event, Json& value) {
        if (event == Json::parse_event_t::object_start) {
            keys.emplace_back();
        } else if (event == Json::parse_event_t::object_end) {
            keys.pop_back();
        } else if (event == Json::parse_event_t::key) {
            // The parser passes a key before it reads the colon.
            const std::size_t place = met < places.size() ? places[met] : 0;
            ++met;
            const auto key = value.get<std::string>();
            if (!keys.back().insert(key).second) {
                // A key may contain line breaks.
                const std::string quoted = json_string(printable(key, 80));
                throw JsonError(fmt::format("duplicate key '{}'", quoted.substr(1, quoted.size() - 2)), place + 1);
            }
            if (keys.back().size() > most_object_keys) {
                throw JsonError("too many keys: an object has at most 1000", place + 1);
            }
        }
        return true;
    };
    try {
        Json json = Json::parse(text, look);
        if (key_places) *key_places = std::move(places);
        return json;
    } catch (const Json::parse_error& error) {
        throw JsonError("invalid JSON", std::max<std::size_t>(error.byte, 1));
    } catch (const Json::exception&) {
        throw JsonError("this holds a number that is too large", 1);
    }
}

}  // namespace sikku
