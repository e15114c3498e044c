// music/score/comments.h: the pattern and the recipe of a score, as comments of line-based formats.
#pragma once

#include "music/score/score.h"

#include <string>
#include <string_view>

namespace sikku {

/// Converts text to a single line. Line and paragraph separators (U+2028, U+2029) and direction marks, which end
/// comments in some languages and hide text in others, become blanks; invalid or unprintable UTF-8 becomes `?`.
std::string single_line(std::string_view text);

/// The recipe of the score, then the pattern, with a comment for each line: `% `, `; ` or `// ` and the line, without
/// carriage returns and with blanks for tabs.
std::string head_comments(const ScoreHead& head, std::string_view sign);

/// False if such comments contain blanks or `?` instead of some characters of the text, other than tabs.
bool comments_keep(std::string_view text);

}  // namespace sikku
