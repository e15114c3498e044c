// studio/editor/text_edit.h: edits of a text, and positions in it as editors count them.
#pragma once

#include "engine/base/diagnostic.h"

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace sikku {

/// Replaces the bytes from `begin` to `end`.
struct TextEdit {
    std::size_t begin = 0;
    std::size_t end = 0;
    std::string text;
};

/// Applies edits that are sorted and do not overlap.
std::string with_edits(std::string_view text, const std::vector<TextEdit>& edits);

/// A position as the language server protocol counts it: lines from 0, and UTF-16 code units in the line from 0.
struct EditorPosition {
    std::size_t line = 0;
    std::size_t character = 0;
};

/// Converts places in a valid UTF-8 text, which must outlive the object.
class TextPositions {
public:
    /// Cost: linear.
    explicit TextPositions(std::string_view text);

    /// The byte at a position. Positions beyond a line are its end, positions beyond the text are its end, and
    /// positions within a character are its beginning. Cost: linear in the line.
    std::size_t offset(EditorPosition position) const;
    /// The position of a byte; beyond the text, of its end.
    EditorPosition position(std::size_t offset) const;
    /// The byte at a place of a diagnostic, whose lines end only at line feeds.
    std::size_t offset(const Place& place) const;

private:
    std::size_t end_of_line(std::size_t line) const;
    std::string_view text_;
    std::vector<std::size_t> lines_;  // where lines begin; they end at a line feed, a carriage return, or both
};

}  // namespace sikku
