// art/print/recipe_comments.h: stores the pattern and the recipe of a print in the comments of formats without other
// texts: G-code, HP-GL, DXF, EPS, OBJ, glTF, GIF.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace sikku {

/// Maximum size in bytes of a pattern with its recipe; larger ones are not stored.
constexpr std::size_t most_commented_bytes = std::size_t{1} << 20;

/// Returns pieces of at most 60 characters, `sikku:` and base64 (RFC 4648), which no plotter, controller or parser
/// interprets. Empty if pattern and recipe are larger than most_commented_bytes.
std::vector<std::string> recipe_comments(std::string_view pattern, std::string_view made);

/// Reads pattern and recipe from all pieces in a text, in order; nullopt if they are absent or damaged.
/// Cost: linear.
std::optional<std::pair<std::string, std::string>> read_recipe_comments(std::string_view text);

}  // namespace sikku
