#include "art/font/letters.h"

#include "engine/base/diagnostic.h"
#include "engine/base/text.h"
#include "engine/geometry/contours.h"
#include "engine/geometry/lettering.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <stdexcept>

namespace sikku {
namespace {

/// Rounding errors of widths, which are sums.
constexpr double width_slack = 1 + 1e-12;

/// A line of text as code points.
struct CodePoints {
    std::u32string codes;
    std::vector<std::size_t> bytes;  ///< where each begins in the text
};

bool is_control(char32_t code) {
    return code < 0x20 || code == 0x7F || (code >= 0x80 && code < 0xA0) || code == 0x2028 || code == 0x2029;
}

/// Control characters become spaces, invalid bytes U+FFFD. Ends after `most_font_letters`.
CodePoints code_points_of(std::string_view utf8) {
    constexpr char32_t replacement = 0xFFFD;
    CodePoints points;
    for (std::size_t at = 0; at < utf8.size() && points.codes.size() < most_font_letters;) {
        const std::size_t length = utf8_length(utf8.substr(at));
        const char32_t code = length == 0 ? replacement : code_point(utf8.substr(at, length));
        points.codes += is_control(code) ? U' ' : code;
        points.bytes.push_back(at);
        at += std::max<std::size_t>(length, 1);
    }
    return points;
}

/// True if a font shapes only the beginning of a text.
bool is_too_long(std::string_view utf8) {
    std::size_t count = 0;
    for (std::size_t at = 0; at < utf8.size() && count <= most_font_letters; ++count) {
        at += std::max<std::size_t>(utf8_length(utf8.substr(at)), 1);
    }
    return count > most_font_letters;
}

bool has_all(const ShapedText& text) {
    return std::all_of(text.glyphs.begin(), text.glyphs.end(), [](const ShapedGlyph& one) { return one.glyph != 0; });
}

/// The outlines of the glyphs of a line, each read once.
class LineOutlines {
public:
    explicit LineOutlines(const Font& font) : font_(font) {}

    /// @throws std::runtime_error for too many points
    const std::vector<GlyphContour>& of(std::uint32_t glyph) {
        const auto [found, is_new] = outlines_.try_emplace(glyph);
        if (is_new) found->second = font_.outline(glyph);
        for (const GlyphContour& contour : found->second) points_ += contour.size();
        if (points_ > most_line_points) {
            throw std::runtime_error("the outlines of the letters have more than 2,000,000 points");
        }
        return found->second;
    }

private:
    const Font& font_;
    std::map<std::uint32_t, std::vector<GlyphContour>> outlines_;
    std::size_t points_ = 0;
};

}  // namespace

/// Shapes a line, or its first `most_font_letters`. Clusters become bytes of the text.
ShapedText Letters::shape(std::string_view utf8) const {
    const CodePoints points = code_points_of(utf8);
    ShapedText text = font_->shape(points.codes);
    for (ShapedGlyph& placed : text.glyphs) placed.cluster = points.bytes[placed.cluster];
    return text;
}

double Letters::width(std::string_view utf8, double height) const {
    return font_ ? shape(utf8).width * scale(height) : text_width(utf8, height);
}

double Letters::ascent(std::string_view utf8, double height) const {
    return font_ ? reach(utf8, 1) * scale(height) : letter_ascent * height;
}

double Letters::depth(std::string_view utf8, double height) const {
    return font_ ? reach(utf8, -1) * scale(height) : letter_descent * height;
}

/// Extent of a text from its baseline in ems, upwards (1) or downwards (-1).
double Letters::reach(std::string_view utf8, double upwards) const {
    double farthest = 0;
    LineOutlines outlines(*font_);
    for (const ShapedGlyph& placed : shape(utf8).glyphs) {
        for (const GlyphContour& contour : outlines.of(placed.glyph)) {
            for (const glm::dvec2 point : contour) farthest = std::max(farthest, upwards * (placed.at.y + point.y));
        }
    }
    return farthest;
}

/// Number of bytes of the longest beginning that is at most `ems` wide. Ends between clusters, which are not cut.
std::size_t Letters::fitting(std::string_view utf8, double ems) const {
    const ShapedText text = shape(utf8);
    if (text.width <= ems * width_slack && !is_too_long(utf8)) return utf8.size();
    std::map<std::size_t, double> advances;
    for (const ShapedGlyph& placed : text.glyphs) advances[placed.cluster] += placed.advance;
    std::vector<std::size_t> ends;
    double width = 0;
    for (const auto& [cluster, advance] : advances) {
        if (width <= ems * width_slack) ends.push_back(cluster);
        width += advance;
    }
    // Kerning and ligatures at the end may have changed widths.
    while (!ends.empty() && shape(utf8.substr(0, ends.back())).width > ems * width_slack) ends.pop_back();
    return ends.empty() ? 0 : ends.back();
}

std::string Letters::ellipsis() const {
    for (const char* const dots : {"…", "..."}) {
        if (has_all(shape(dots))) return dots;
    }
    return "";
}

std::string Letters::shortened(std::string_view utf8, double height, double width) const {
    if (!font_) return sikku::shortened(utf8, height, width);
    const double ems = width / scale(height);
    if (fitting(utf8, ems) == utf8.size()) return std::string(utf8);
    const std::string dots = ellipsis();
    const double room = ems - shape(dots).width;
    if (room < 0) return "";
    return std::string(trimmed(utf8.substr(0, fitting(utf8, room)))) + dots;
}

std::vector<std::string> Letters::wrapped(std::string_view utf8, double height, double width,
                                          std::size_t most) const {
    if (!font_) return sikku::wrapped(utf8, height, width, most);
    return sikku::wrapped(utf8, most,
                          {[&](std::string_view text) { return fitting(text, width / scale(height)); },
                           [&](std::string_view text) { return shortened(text, height, width); }});
}

void Letters::write(std::string_view utf8, glm::dvec2 start, double height, const Pen& pen, PathSink& sink) const {
    if (!font_) return write_text(utf8, start, height, pen, sink);
    LineOutlines outlines(*font_);
    std::vector<glm::dvec2> outline;
    for (const ShapedGlyph& placed : shape(utf8).glyphs) {
        outline.clear();
        for (const GlyphContour& contour : outlines.of(placed.glyph)) add_contour(contour, outline);
        for (glm::dvec2& point : outline) point = start + scale(height) * (placed.at + point);
        if (!outline.empty()) sink.area(outline, pen);
    }
}

std::string Letters::missing(const std::vector<std::string>& texts) const {
    if (!font_) {
        const std::string list = missing_letters(texts);
        return list.empty() ? "" : letters_warning(list);
    }
    std::vector<std::string_view> characters;
    for (const std::string& text : texts) {
        for (const ShapedGlyph& placed : shape(text).glyphs) {
            if (placed.glyph == 0) characters.push_back(std::string_view(text).substr(placed.cluster));
        }
    }
    if (characters.empty()) return "";
    return fmt::format("the font '{}' lacks {}; its sign for missing characters replaces each",
                       printable(font_->name(), 80), list_of_characters(characters));
}

}  // namespace sikku
