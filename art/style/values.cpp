#include "art/style/values.h"

#include "engine/base/characters.h"
#include "engine/base/decimal.h"
#include "engine/base/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <system_error>

namespace sikku {

std::string quoted_value(std::string_view text) {
    constexpr std::size_t most_quoted = 40;
    if (text.size() <= most_quoted) return fmt::format("'{}'", text);
    std::size_t end = most_quoted;
    while (end > 0 && is_continuation(text[end])) --end;
    return fmt::format("'{}…'", text.substr(0, end));
}

std::vector<std::string> words_of(std::string_view text, std::size_t most) {
    constexpr std::string_view separators = " \t,";
    std::vector<std::string> words;
    while (words.size() < most) {
        text.remove_prefix(std::min(text.find_first_not_of(separators), text.size()));
        if (text.empty()) break;
        const std::string_view word = text.substr(0, text.find_first_of(separators));
        text.remove_prefix(word.size());
        words.push_back(lower_case(word));
    }
    return words;
}

void refuse(const Span& word, std::string_view expected, Diagnostics& diagnostics) {
    diagnostics.error(word, fmt::format("{}: expected {}", quoted_value(word.view()), expected));
}

void refuse(const Key& key, std::string_view expected, Diagnostics& diagnostics) {
    if (!key.value.empty()) return refuse(key.value, expected, diagnostics);
    diagnostics.error(key.name_at, fmt::format("'{}:' is empty: expected {}", key.name, expected));
}

std::optional<double> number_in(std::string_view text, double least, double most) {
    double number = 0.0;
    const auto [end, error] = parse_number(text, number);
    const bool is_number = error == std::errc() && end == text.data() + text.size() && std::isfinite(number);
    return is_number && number >= least && number <= most ? std::optional(number) : std::nullopt;
}

}  // namespace sikku
