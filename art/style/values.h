// art/style/values.h: values of keys as numbers, and quoted in messages.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace sikku {

/// Returns the text in quotation marks, cut off after 40 bytes.
std::string quoted_value(std::string_view text);

/// Parses a finite number from `least` to `most`; nullopt for anything else.
std::optional<double> number_in(std::string_view text, double least, double most);

}  // namespace sikku
