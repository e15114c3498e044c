// engine/base/decimal.h: doubles as decimal numbers, the same in any locale and with any standard library.
#pragma once

#include <charconv>
#include <cstdint>
#include <string>
#include <string_view>

namespace sikku {

/// Reads the number at the beginning of `text` like std::from_chars: `+` is not a sign, `inf` and `nan` are numbers,
/// and numbers too large or too small for a double are std::errc::result_out_of_range. Errors keep `value`.
std::from_chars_result parse_number(std::string_view text, double& value);

/// Returns the fewest digits that read back as `value`, possibly with an exponent.
std::string shortest_decimal(double value);

/// The largest denominator of decimals on a lattice.
constexpr std::int64_t largest_denominator = 1'000'000;

/// The denominator of a decimal in lowest terms, such as 2 for 2.5 and 5 for 0.2; 0 if it is larger than
/// largest_denominator, or if `value` is not below 2^40.
std::int64_t decimal_denominator(double value);

}  // namespace sikku
