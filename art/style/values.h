// art/style/values.h: values of keys as numbers, and quoted in messages.
#pragma once

#include "engine/language/pattern.h"

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace sikku {

/// Returns the text in quotation marks, cut off after 40 bytes.
std::string quoted_value(std::string_view text);

/// Up to `most` words in lower case, separated by blanks or commas.
std::vector<std::string> words_of(std::string_view text, std::size_t most);

/// Reports that a word, or the whole value, is not what is expected.
void refuse(const Span& word, std::string_view expected, Diagnostics& diagnostics);
/// The same for the value of a key, which may be empty.
void refuse(const Key& key, std::string_view expected, Diagnostics& diagnostics);

/// Parses a finite number from `least` to `most`; nullopt for anything else.
std::optional<double> number_in(std::string_view text, double least, double most);

}  // namespace sikku
