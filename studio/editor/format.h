// studio/editor/format.h: the canonical spacing of patterns.
#pragma once

#include "engine/language/pattern.h"
#include "studio/editor/text_edit.h"

#include <vector>

namespace sikku {

/// The changes that give a pattern its canonical spacing, sorted by place: `key: value`, `define a = 1`,
/// `left < predecessor > right : condition --> successor : weight`, `variant x: a = 1, b = 2`, no blanks at the ends
/// of lines, and a line feed at the end. Words, comments, indentation, and lines that are continued or contain
/// comments between two parts stay as they are. Formatting is idempotent and keeps the meaning; if it would change
/// the meaning, the list is empty. Cost: linear; the pattern is read twice.
/// @param pattern  without settings from outside; lines with errors stay as they are
std::vector<TextEdit> formatting(const Pattern& pattern);

}  // namespace sikku
