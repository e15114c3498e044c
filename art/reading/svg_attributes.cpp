#include "art/reading/svg_attributes.h"

#include "engine/base/diagnostic.h"
#include "engine/base/text.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

namespace sikku {

std::string_view local_name(std::string_view name) {
    return name.substr(name.find(':') + 1);  // npos + 1 is 0
}

std::vector<double> numbers_of(std::string_view text) {
    std::vector<double> numbers;
    for (std::size_t at = 0; at < text.size();) {
        at = text.find_first_not_of(" \t\r\n,", at);
        if (at == std::string_view::npos) break;
        // A sign begins the next number, too.
        std::size_t end = at + 1;
        while (end < text.size() && std::string_view(" \t\r\n,").find(text[end]) == std::string_view::npos &&
               ((text[end] != '-' && text[end] != '+') || text[end - 1] == 'e' || text[end - 1] == 'E')) {
            ++end;
        }
        double number = 0;
        if (!read_number(text.substr(at, end - at), number) || !(std::fabs(number) < 1e12)) {
            throw std::runtime_error(fmt::format("'{}' is not a number", printable(text.substr(at, end - at), 40)));
        }
        numbers.push_back(number);
        at = end;
    }
    return numbers;
}

Transform parse_transform(std::string_view text) {
    Transform all;
    for (std::size_t at = text.find_first_not_of(" \t\r\n,"); at < text.size();) {
        const std::size_t open = text.find('(', at);
        const std::size_t close = text.find(')', at);
        if (open == std::string_view::npos || close == std::string_view::npos || close < open) {
            throw std::runtime_error(fmt::format("'{}': damaged transform", printable(text, 80)));
        }
        const std::string_view name = trimmed(text.substr(at, open - at));
        const auto n = numbers_of(text.substr(open + 1, close - open - 1));
        const auto radians = [&] { return n[0] * std::numbers::pi / 180; };
        Transform one;
        if (name == "matrix" && n.size() == 6) {
            one = {n[0], n[1], n[2], n[3], n[4], n[5]};
        } else if (name == "translate" && (n.size() == 1 || n.size() == 2)) {
            one = {1, 0, 0, 1, n[0], n.size() == 2 ? n[1] : 0};
        } else if (name == "scale" && (n.size() == 1 || n.size() == 2)) {
            one = {n[0], 0, 0, n.size() == 2 ? n[1] : n[0], 0, 0};
        } else if (name == "rotate" && (n.size() == 1 || n.size() == 3)) {
            one = {std::cos(radians()), std::sin(radians()), -std::sin(radians()), std::cos(radians()), 0, 0};
            if (n.size() == 3) one = Transform{1, 0, 0, 1, n[1], n[2]} * one * Transform{1, 0, 0, 1, -n[1], -n[2]};
        } else if (name == "skewX" && n.size() == 1) {
            one.c = std::tan(radians());
        } else if (name == "skewY" && n.size() == 1) {
            one.b = std::tan(radians());
        } else {
            throw std::runtime_error(fmt::format("'{}': unknown transform", printable(text, 80)));
        }
        all = all * one;
        at = text.find_first_not_of(" \t\r\n,", close + 1);
    }
    return all;
}

}  // namespace sikku
