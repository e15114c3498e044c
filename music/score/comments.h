// music/score/comments.h: the pattern and what made the score, as comments of formats that consist of lines.
#pragma once

#include "music/score/score.h"

#include <string>
#include <string_view>

namespace sikku {

/// Converts text to a single line. Line and paragraph separators (U+2028, U+2029) and direction marks, which end
/// comments in some languages and hide text in others, become blanks; invalid or unprintable UTF-8 becomes `?`.
std::string single_line(std::string_view text);

/// What made the score, then the pattern, a comment for each line: `% `, `; ` or `// ` and the line, without carriage
/// returns and with blanks for tabs.
std::string head_comments(const ScoreHead& head, std::string_view sign);

/// False if such comments contain blanks or `?` instead of some characters of the text, other than tabs.
bool comments_keep(std::string_view text);

}  // namespace sikku
