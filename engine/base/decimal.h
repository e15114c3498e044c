// engine/base/decimal.h: doubles as decimal numbers, the same in any locale and with any standard library.
#pragma once

#include <charconv>
#include <cstdint>
#include <string>
#include <string_view>

namespace sikku {

/// Reads the number that `text` begins with, as std::from_chars does: no sign `+`; `inf` and `nan` are numbers; what
/// is too large or too small for a double is std::errc::result_out_of_range. `value` stays as it is on errors.
std::from_chars_result parse_number(std::string_view text, double& value);

/// The fewest digits that read back as `value`, with an exponent perhaps.
std::string shortest_decimal(double value);

/// The largest denominator of decimals on a lattice.
constexpr std::int64_t largest_denominator = 1'000'000;

/// The denominator of a decimal in lowest terms: of 2.5 it is 2, of 0.2 it is 5; 0 if it is larger than
/// largest_denominator, or `value` not below 2^40.
std::int64_t decimal_denominator(double value);

}  // namespace sikku
