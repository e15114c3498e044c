// art/font/letters.h: the letters of titles and captions: single strokes, or the outlines of a font.
#pragma once

#include "art/font/font.h"
#include "engine/geometry/path.h"

#include <glm/vec2.hpp>

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace sikku {

/// Writes lines of text. Lengths are in the unit of the sink; `height` is that of a capital letter. Text is UTF-8;
/// line breaks and other control characters are spaces in a font, which takes only the first `most_font_letters`
/// characters of a text; shortened() and wrapped() cut longer ones. The functions throw std::runtime_error as
/// Font::shape() and Font::outline(), and for outlines of over `most_line_points` points in a line.
class Letters {
public:
    /// Single strokes: see engine/geometry/lettering.h.
    Letters() = default;
    /// The outlines of a font. @param font  null: single strokes
    explicit Letters(std::shared_ptr<const Font> font) : font_(std::move(font)) {}

    /// True if letters are filled, so that a pen sets their colour and not their weight.
    bool are_filled() const { return font_ != nullptr; }
    /// Width from the beginning of a text to that of the next.
    double width(std::string_view utf8, double height) const;
    /// Height of a text above the baseline and its depth below it, at least 0; for single strokes those of accented
    /// capitals and of descenders.
    double ascent(std::string_view utf8, double height) const;
    double depth(std::string_view utf8, double height) const;
    /// As the functions of engine/geometry/lettering.h with these names. A font without `…` has full stops instead.
    std::string shortened(std::string_view utf8, double height, double width) const;
    std::vector<std::string> wrapped(std::string_view utf8, double height, double width, std::size_t most) const;
    /// Writes text from `start` on the baseline to the right, with y up.
    void write(std::string_view utf8, glm::dvec2 start, double height, const Pen& pen, PathSink& sink) const;
    /// Warns of characters that the font lacks; empty if it has all.
    std::string missing(const std::vector<std::string>& texts) const;

private:
    double scale(double height) const { return height / font_->capital_height(); }
    ShapedText shape(std::string_view utf8) const;
    double reach(std::string_view utf8, double upwards) const;
    std::size_t fitting(std::string_view utf8, double ems) const;
    std::string ellipsis() const;

    std::shared_ptr<const Font> font_;
};

}  // namespace sikku
