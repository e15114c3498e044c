#include "art/style/values.h"

#include "engine/base/decimal.h"

#include <fmt/format.h>

#include <cmath>
#include <system_error>

namespace sikku {

std::string quoted_value(std::string_view text) {
    constexpr std::size_t most_quoted = 40;
    if (text.size() <= most_quoted) return fmt::format("'{}'", text);
    std::size_t end = most_quoted;
    while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0) == 0x80) --end;
    return fmt::format("'{}…'", text.substr(0, end));
}

std::optional<double> number_in(std::string_view text, double least, double most) {
    double number = 0.0;
    const auto [end, error] = parse_number(text, number);
    const bool is_number = error == std::errc() && end == text.data() + text.size() && std::isfinite(number);
    return is_number && number >= least && number <= most ? std::optional(number) : std::nullopt;
}

}  // namespace sikku
