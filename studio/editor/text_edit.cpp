#include "studio/editor/text_edit.h"

#include "engine/base/characters.h"

#include <algorithm>

namespace sikku {
namespace {

/// The end of the character at an offset.
std::size_t next_character(std::string_view text, std::size_t at) {
    do ++at;
    while (at < text.size() && is_continuation(text[at]));
    return at;
}

/// UTF-16 code units of a character of UTF-8: two beyond U+FFFF, which take four bytes.
std::size_t units(std::size_t bytes) {
    return bytes == 4 ? 2 : 1;
}

}  // namespace

std::string with_edits(std::string_view text, const std::vector<TextEdit>& edits) {
    std::string result;
    std::size_t at = 0;
    for (const TextEdit& edit : edits) {
        result.append(text.substr(at, edit.begin - at)).append(edit.text);
        at = edit.end;
    }
    return result.append(text.substr(at));
}

TextPositions::TextPositions(std::string_view text) : text_(text), lines_{0} {
    for (std::size_t at = 0; at < text.size(); ++at) {
        const bool is_end = text[at] == '\n' || (text[at] == '\r' && text.substr(at + 1, 1) != "\n");
        if (is_end) lines_.push_back(at + 1);
    }
}

std::size_t TextPositions::end_of_line(std::size_t line) const {
    std::size_t end = line + 1 < lines_.size() ? lines_[line + 1] : text_.size();
    const std::size_t begin = lines_[line];
    if (line + 1 < lines_.size()) --end;
    if (end > begin && text_[end - 1] == '\r' && end < text_.size() && text_[end] == '\n') --end;
    return end;
}

std::size_t TextPositions::offset(EditorPosition position) const {
    if (position.line >= lines_.size()) return text_.size();
    const std::size_t end = end_of_line(position.line);
    std::size_t at = lines_[position.line];
    for (std::size_t left = position.character; at < end;) {
        const std::size_t next = next_character(text_, at);
        const std::size_t width = units(next - at);
        if (left < width) break;
        left -= width;
        at = next;
    }
    return at;
}

EditorPosition TextPositions::position(std::size_t offset) const {
    offset = std::min(offset, text_.size());
    const auto after = std::upper_bound(lines_.begin(), lines_.end(), offset);
    const auto line = static_cast<std::size_t>(after - lines_.begin()) - 1;
    EditorPosition position{line, 0};
    for (std::size_t at = lines_[line]; at < offset;) {
        const std::size_t next = next_character(text_, at);
        if (next > offset) break;
        position.character += units(next - at);
        at = next;
    }
    return position;
}

std::size_t TextPositions::offset(const Place& place) const {
    std::size_t at = 0;
    for (int line = 1; line < place.line; ++line) {
        at = text_.find('\n', at);
        if (at == std::string_view::npos) return text_.size();
        ++at;
    }
    for (int column = 1; column < place.column && at < text_.size() && text_[at] != '\n'; ++column) {
        at = next_character(text_, at);
    }
    return at;
}

}  // namespace sikku
