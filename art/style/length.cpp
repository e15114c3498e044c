#include "art/style/length.h"

#include "engine/base/decimal.h"
#include "engine/base/text.h"

#include <cmath>
#include <system_error>

namespace sikku {
namespace {

constexpr double millimetres_of_inch = 25.4;

}  // namespace

std::optional<double> Length::millimetres(double dpi) const {
    double result = number;
    if (unit == "cm") {
        result *= 10.0;
    } else if (unit == "m") {
        result *= 1000.0;
    } else if (unit == "in") {
        result *= millimetres_of_inch;
    } else if (unit == "pt") {
        result = result * millimetres_of_inch / 72.0;
    } else if (unit == "px") {
        result = result * millimetres_of_inch / dpi;
    } else if (!unit.empty() && unit != "mm") {
        return std::nullopt;
    }
    if (!std::isfinite(result)) return std::nullopt;
    return result;
}

std::optional<Length> read_length(std::string_view text) {
    text = trimmed(text);
    if (text.starts_with('+') && !text.starts_with("+-")) text.remove_prefix(1);
    Length length;
    const auto [end, error] = parse_number(text, length.number);
    if (error != std::errc() || !std::isfinite(length.number)) return std::nullopt;
    length.unit = lower_case(trimmed(text.substr(static_cast<std::size_t>(end - text.data()))));
    return length;
}

std::optional<double> parse_length(std::string_view text, double dpi) {
    const auto length = read_length(text);
    return length ? length->millimetres(dpi) : std::nullopt;
}

}  // namespace sikku
