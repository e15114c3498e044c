#include "engine/language/label.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace sikku {
namespace {

std::string number_text(double value) {
    const bool is_whole = std::fabs(value) <= 1e15 && value == std::round(value);
    const std::string text =
        is_whole ? fmt::format("{:.0f}", std::fabs(value)) : fmt::format("{:.6g}", std::fabs(value));
    // The minus of typography is as wide as a digit.
    return value < 0 ? "\u2212" + text : text;
}

}  // namespace

std::uint32_t LabelText::parameters() const {
    std::uint32_t highest = 0;
    for (const Part& part : parts) highest = std::max(highest, part.parameter);
    return highest;
}

std::string LabelText::text(std::span<const double> arguments) const {
    std::string result;
    for (const Part& part : parts) {
        result += part.text;
        if (part.parameter > 0) result += number_text(arguments[part.parameter - 1]);
    }
    return result;
}

}  // namespace sikku
