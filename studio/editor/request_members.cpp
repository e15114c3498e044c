#include "studio/editor/request_members.h"

#include <charconv>
#include <cmath>
#include <system_error>

namespace sikku {

const Json& member(const Json& request, const std::string& name) {
    const auto found = request.find(name);
    if (found == request.end()) throw BadRequest("'" + name + "' is missing");
    return *found;
}

std::string text_of(const Json& request, const std::string& name) {
    const Json& value = member(request, name);
    if (!value.is_string()) throw BadRequest("'" + name + "' must be a string");
    return value.get<std::string>();
}

std::string text_of(const Json& request, const std::string& name, const std::string& otherwise) {
    return request.contains(name) ? text_of(request, name) : otherwise;
}

double number_of(const Json& request, const std::string& name, double otherwise) {
    if (!request.contains(name)) return otherwise;
    const Json& value = request[name];
    if (!value.is_number()) throw BadRequest("'" + name + "' must be a number");
    const auto number = value.get<double>();
    if (!(std::fabs(number) < 1e9)) throw BadRequest("'" + name + "' is too large");
    return number;
}

std::uint64_t whole_of(const Json& value, const std::string& name) {
    const std::string text = value.is_string() ? value.get<std::string>() : std::string();
    std::uint64_t number = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (text.empty() || error != std::errc() || end != text.data() + text.size()) {
        throw BadRequest("'" + name + "': expected a whole number as a string");
    }
    return number;
}

bool flag_of(const Json& request, const std::string& name) {
    return request.contains(name) && request[name].is_boolean() && request[name].get<bool>();
}

std::vector<std::pair<std::string, std::string>> pairs_of(const Json& request, const std::string& name) {
    std::vector<std::pair<std::string, std::string>> pairs;
    if (!request.contains(name)) return pairs;
    if (!request[name].is_array()) throw BadRequest("'" + name + "' must be a list of pairs of strings");
    for (const Json& pair : request[name]) {
        if (!pair.is_array() || pair.size() != 2 || !pair[0].is_string() || !pair[1].is_string()) {
            throw BadRequest("'" + name + "' must be a list of pairs of strings");
        }
        pairs.emplace_back(pair[0].get<std::string>(), pair[1].get<std::string>());
    }
    return pairs;
}

std::size_t position_of(const Json& request, const std::string& name) {
    const Json& value = member(request, name);
    if (!value.is_number_unsigned()) throw BadRequest("'" + name + "' must be a whole number, 0 or more");
    return value.get<std::size_t>();
}

EditorPosition place_of(const Json& position) {
    return {position_of(position, "line"), position_of(position, "character")};
}

}  // namespace sikku
