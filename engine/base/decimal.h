// engine/base/decimal.h: doubles as decimal numbers, the same in any locale and with any standard library.
#pragma once

#include <charconv>
#include <string>
#include <string_view>

namespace sikku {

/// Reads the number that `text` begins with, as std::from_chars does: no sign `+`; `inf` and `nan` are numbers; what
/// is too large or too small for a double is std::errc::result_out_of_range. `value` stays as it is on errors.
std::from_chars_result parse_number(std::string_view text, double& value);

/// The fewest digits that read back as `value`, with an exponent perhaps.
std::string shortest_decimal(double value);

}  // namespace sikku
