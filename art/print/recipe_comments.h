// art/print/recipe_comments.h: the pattern of a print and its recipe in plain letters, for formats whose only texts
// are comments: G-code, HP-GL, OBJ, glTF, GIF.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace sikku {

/// Larger patterns are left out.
constexpr std::size_t most_commented_bytes = std::size_t{1} << 20;

/// Pieces of at most 60 characters, `sikku:` and base64 (RFC 4648), which no plotter, controller or parser takes for
/// anything else. Empty if pattern and recipe are larger than most_commented_bytes.
std::vector<std::string> recipe_comments(std::string_view pattern, std::string_view made);

/// Pattern and recipe from all pieces in a text, in their order; nullopt if there are none or they are damaged.
/// Cost: linear.
std::optional<std::pair<std::string, std::string>> read_recipe_comments(std::string_view text);

}  // namespace sikku
