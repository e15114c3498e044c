#include "engine/base/decimal.h"

#include <cmath>
#include <numeric>

// libc++ 13 reads and writes only whole numbers.
#if defined(__cpp_lib_to_chars)
#include <array>
#else
#include <fast_float/fast_float.h>
#include <fmt/format.h>
#endif

namespace sikku {

#if defined(__cpp_lib_to_chars)

std::from_chars_result parse_number(std::string_view text, double& value) {
    return std::from_chars(text.data(), text.data() + text.size(), value);
}

std::string shortest_decimal(double value) {
    std::array<char, 32> buffer{};
    char* const end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value).ptr;
    return {buffer.data(), end};
}

#else

std::from_chars_result parse_number(std::string_view text, double& value) {
    double number = 0;
    const auto [end, error] = fast_float::from_chars(text.data(), text.data() + text.size(), number);
    if (error != std::errc()) return {end, error};
    // Older versions of fast_float give infinity and 0 instead of an error.
    const std::string_view read = text.substr(0, static_cast<std::size_t>(end - text.data()));
    const bool is_zero =
        read.substr(0, read.find_first_of("eE")).find_first_of("123456789") == std::string_view::npos;
    if (!is_zero && (number == 0 || std::isinf(number))) return {end, std::errc::result_out_of_range};
    value = number;
    return {end, error};
}

std::string shortest_decimal(double value) {
    return fmt::format("{}", value);
}

#endif

std::int64_t decimal_denominator(double value) {
    if (!(std::fabs(value) < 0x1p40)) return 0;
    for (std::int64_t denominator = 1; denominator <= largest_denominator; denominator *= 10) {
        const double scaled = value * static_cast<double>(denominator);
        if (std::fabs(scaled) > 0x1p40) return 0;
        const std::int64_t numerator = std::llround(scaled);
        if (static_cast<double>(numerator) / static_cast<double>(denominator) == value) {
            return denominator / std::gcd(denominator, numerator);
        }
    }
    return 0;
}

}  // namespace sikku
