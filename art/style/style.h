// art/style/style.h: the style of a drawing, from the keys line, hand, stroke, ground, fill, palette, dots, border,
// view.
#pragma once

#include "art/style/camera.h"
#include "art/style/colour.h"
#include "engine/geometry/path.h"
#include "engine/language/pattern.h"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace sikku {

enum class Line { straight, spline };

/// A pen's width, in millimetres or as a fraction of the turtle's step.
struct StrokeWidth {
    double value = 0.4;
    bool in_steps = false;
    double unit = 1.0;  ///< what a width of 1 is that the turtle sets: millimetres of the pattern's unit, or 1 step
};

/// How the dots of a kolam are drawn.
struct DotStyle {
    std::optional<StrokeWidth> size;  ///< diameter; absent: a sixth of the way to the nearest dot
    std::optional<Colour> colour;     ///< absent: of the lines
};

/// How a print is framed.
enum class BorderKind : std::uint8_t { kaavi, padi, lotus, rope, diamonds, waves, pattern };
struct BorderStyle {
    BorderKind kind = BorderKind::kaavi;
    std::string pattern{};  ///< of BorderKind::pattern: the pattern whose drawing is repeated, by path or name
    std::string corner{};   ///< the pattern drawn in the corners; empty: a dot in a ring
    bool operator==(const BorderStyle&) const = default;
};

struct Style {
    Line line = Line::straight;
    bool moves_lift = false;  ///< moves lift the pen (`spline with lifts`) and are not control points of splines
    double hand = 0.0;        ///< how much lines waver and swell, as drawn by a hand with powder: 0, not at all, to 1
    StrokeWidth stroke;
    std::optional<Colour> stroke_colour;  ///< of colour index 0; absent: the palette's first
    bool stroked = true;                  ///< false for `stroke: none`
    std::optional<Colour> ground;         ///< absent: transparent
    std::optional<Colour> fill;           ///< of polygons and discs with colour index 0; absent: the palette's
    std::vector<Colour> palette;          ///< never empty after read_style
    std::optional<DotStyle> dots;         ///< absent: none are drawn
    std::optional<BorderStyle> border;    ///< absent: none is drawn
    Camera camera;                        ///< of drawings in space

    /// True if undrawn steps are control points of the line.
    bool moves_draw() const { return line == Line::spline && !moves_lift; }
    /// The colour index as a number in [0, palette.size()).
    int index(const Pen& pen) const;
    Colour line_colour(const Pen& pen) const;
    Colour fill_colour(const Pen& pen) const;
    /// For every colour index the first one of the same colour: they share a layer.
    std::vector<int> line_slots() const;
    std::vector<int> fill_slots() const;
    /// Does a line of that pen leave anything on paper?
    bool draws(const Pen& pen) const;
    /// Width of a pen's line in the measure of `stroke`: millimetres or steps.
    double pen_width(const Pen& pen) const;
    /// Width of a pen's line in millimetres when a step is `step` millimetres long.
    double line_width(const Pen& pen, double step) const;
    /// Radius of a disc in millimetres. A `radius` of 0 steps is a dot, twice as wide as the line.
    double disc_radius(double radius, const Pen& pen, double step) const;
};

/// The value of `border:`: kaavi, padi, lotus, rope, diamonds, waves; or one or two pattern files, separated by a
/// comma: the repeat and the corner. Nullopt for anything else. A file ends in `.lsys`; other words are names of
/// bundled patterns.
std::optional<BorderStyle> parse_border(std::string_view text);

/// Eight colours that are told apart by everyone, black first.
std::vector<Colour> default_palette();

/// Reads and checks the keys that KeyOwner::art owns; an absent key keeps its default: straight, 0.4 mm, black on
/// white, a palette of eight colours that colour-blind readers can distinguish. @param dpi  pixels per inch, for px
/// in lengths
Style read_style(const Pattern& pattern, double dpi, Diagnostics& diagnostics);

}  // namespace sikku
