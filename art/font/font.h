// art/font/font.h: the outlines of an installed font, read by a module that is loaded on demand.
#pragma once

#include <glm/vec2.hpp>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace sikku {

/// A closed contour of a glyph: its start, then three control points for each Bézier, of which the last ends at the
/// start. In ems, y up.
using GlyphContour = std::vector<glm::dvec2>;

/// A glyph of a shaped text. Lengths in ems, the height for which the font is designed.
struct ShapedGlyph {
    std::uint32_t glyph = 0;  ///< number in the font; 0 replaces characters that the font lacks
    glm::dvec2 at{0.0};       ///< origin of the glyph, from the beginning of the text on the baseline, y up
    double advance = 0;       ///< to the next glyph
    std::size_t cluster = 0;  ///< place in the text at which its characters begin
};

/// A line of text with its glyphs, from left to right.
struct ShapedText {
    std::vector<ShapedGlyph> glyphs;
    double width = 0;  ///< in ems
};

/// A typeface in one style. Its functions may be called by several threads.
class Font {
public:
    virtual ~Font() = default;
    /// Family and style, such as `Noto Serif Bold`.
    virtual const std::string& name() const = 0;
    /// Height of a capital letter in ems.
    virtual double capital_height() const = 0;
    /// Chooses and places the glyphs of a line: ligatures, marks and the order of syllables follow the rules of
    /// the script and of the font (HarfBuzz), text from right to left the Unicode bidirectional algorithm (FriBidi).
    /// Takes no hints, so that the result does not depend on a size.
    /// @throws std::runtime_error for more than `most_font_letters` characters, and for damaged fonts
    virtual ShapedText shape(std::u32string_view line) const = 0;
    /// The outline of a glyph, filled by the non-zero winding rule; empty for blanks.
    /// @throws std::runtime_error for more than `most_glyph_points` points, and for damaged fonts
    virtual std::vector<GlyphContour> outline(std::uint32_t glyph) const = 0;
};

/// Maximum number of characters in a line.
constexpr std::size_t most_font_letters = 10'000;
/// Maximum number of points in the outline of a glyph, and in those of a line.
constexpr std::size_t most_glyph_points = 100'000;
constexpr std::size_t most_line_points = 2'000'000;

/// True if the name of a font is that of a file: it ends in .ttf, .otf, .ttc or .otc.
bool is_font_file(std::string_view name);

/// Opens a font.
/// @param name    a file in `folder`, or a pattern of fontconfig such as `Noto Serif:bold`: one family, and at
///                most its style, weight, slant and width
/// @throws std::runtime_error if the module cannot be loaded, the pattern has other parts, no font of that name and
/// style is installed, or the file is not a font with outlines; a font that fontconfig would use instead is only
/// named
std::shared_ptr<const Font> open_font(const std::string& name, const std::filesystem::path& folder);

}  // namespace sikku
