// art/style/style.h: the style of a drawing, from the keys line, hand, stroke, ground, fill, palette, dots, border,
// view, light.
#pragma once

#include "art/style/camera.h"
#include "art/style/colour.h"
#include "art/style/decoration.h"
#include "art/style/floor.h"
#include "art/style/light.h"
#include "art/style/map_style.h"
#include "engine/geometry/path.h"
#include "engine/language/pattern.h"

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace sikku {

enum class Line { straight, spline };

/// A pen's width, in millimetres or as a fraction of the turtle's step.
struct StrokeWidth {
    double value = 0.4;
    bool in_steps = false;
    double unit = 1.0;  ///< size of a width of 1 set by the turtle: millimetres of the pattern's unit, or 1 step
};

/// Style of the dots of a kolam.
struct DotStyle {
    std::optional<StrokeWidth> size;  ///< diameter; absent: a sixth of the way to the nearest dot
    std::optional<Colour> colour;     ///< absent: colour of the lines
};

/// Frame of a print.
enum class BorderKind : std::uint8_t { kaavi, padi, lotus, rope, diamonds, waves, marigolds, lamps, pattern };
struct BorderStyle {
    BorderKind kind = BorderKind::kaavi;
    std::string pattern{};  ///< for BorderKind::pattern: the pattern whose drawing is repeated, by path or name
    std::string corner{};   ///< the pattern drawn in the corners; empty: a dot in a ring
    bool operator==(const BorderStyle&) const = default;
};

/// Edges of polygons that are drawn: those of each, all of them once, only those that do not lie between two
/// polygons, or none.
enum class TileEdges : std::uint8_t { each, once, border, none };

/// The property that determines the colour of a polygon; `blank`: it is not filled.
enum class TileColours : std::uint8_t { shape, hand, direction, distance, neighbours, generation, worms, blank };

/// The property that determines the colour of a field between lines.
enum class FieldsBy { chessboard, kind, distance, centre, strand, symmetry };

/// Lines drawn as several parallel lines.
struct ParallelStyle {
    int count = 1;
    double spacing = 2.0;    ///< from line to line, in stroke widths
    bool is_spaced = false;  ///< the spacing was requested; otherwise lines move closer where they have to
};

struct Style {
    Line line = Line::straight;
    bool moves_lift = false;  ///< moves lift the pen (`spline with lifts`) and are not control points of splines
    double hand = 0.0;        ///< amount by which lines waver and swell, as if drawn by a hand with powder, 0 to 1
    StrokeWidth stroke;
    std::optional<Colour> stroke_colour;    ///< colour of index 0; absent: the palette's first
    bool stroked = true;                    ///< false for `stroke: none`
    std::optional<Colour> ground;           ///< absent: transparent
    std::optional<Floor> floor;             ///< floor whose mean colour is the ground: see shown_floor()
    std::optional<Colour> fill;             ///< colour of polygons and discs with index 0; absent: the palette's
    std::vector<Colour> palette;            ///< never empty after read_style
    std::map<int, std::string> cut_layers;  ///< names of layers of DXF by colour index, instead of numbers of pens
    std::optional<DotStyle> dots;           ///< absent: none are drawn
    std::optional<BorderStyle> border;      ///< absent: none is drawn
    std::optional<FieldsBy> fields;         ///< absent: fields between lines are not filled
    TileEdges tile_edges = TileEdges::each;
    std::optional<TileColours> tile_colours;  ///< absent: polygons have the colours of their pens
    /// For TileColours::generation: the number of steps back to the tiles that determine colours.
    std::int64_t tile_generation = 1;
    TileDecoration decoration;       ///< lines on polygons
    std::vector<Colour> powders;     ///< colours of fields, transparent for `none`; empty: the first set of powders
    bool powders_are_named = false;  ///< powders are a named set, from which colours of the lines are left out
    std::optional<double> weave;     ///< gap beside upper strands, in stroke widths; absent: no weave
    ParallelStyle parallel;
    MapStyle map;       ///< style of maps
    Camera camera;      ///< camera of drawings in space
    Light light;        ///< light of pictures of drawings in space
    double sway = 0.0;  ///< maximum angle in degrees by which branches in space lean at random

    /// True if undrawn steps are control points of the line.
    bool moves_draw() const { return line == Line::spline && !moves_lift; }
    /// The floor that pictures show: none if the ground was changed to another colour.
    std::optional<Floor> shown_floor() const;
    /// The colour index as a number in [0, palette.size()).
    int index(const Pen& pen) const;
    Colour line_colour(const Pen& pen) const;
    Colour fill_colour(const Pen& pen) const;
    /// For every colour index, the first index with the same colour: they share a layer.
    std::vector<int> line_slots() const;
    std::vector<int> fill_slots() const;
    /// True if a line of the pen leaves a mark on paper.
    bool draws(const Pen& pen) const;
    /// Width of a pen's line in the unit of `stroke`: millimetres or steps.
    double pen_width(const Pen& pen) const;
    /// Width of a pen's line in millimetres when a step is `step` millimetres long.
    double line_width(const Pen& pen, double step) const;
    /// Radius of a disc in millimetres. A `radius` of 0 steps is a dot, twice as wide as the line.
    double disc_radius(double radius, const Pen& pen, double step) const;
};

/// The names of the borders that are not patterns.
std::span<const std::string_view> border_names();
/// Parses the value of `border:`: one of border_names(); or one or two pattern files, separated
/// by a comma: the repeat and the corner. Returns nullopt for anything else. A file ends in `.lsys`; other words are
/// names of bundled patterns.
std::optional<BorderStyle> parse_border(std::string_view text);

/// The powders of a style, for fields and tiles: those of a set without the colours near `others`, the colours of
/// lines and the ground.
std::vector<Colour> fill_powders(const Style& style, std::span<const Colour> others);

/// Eight colours that everyone can distinguish, black first.
std::vector<Colour> default_palette();

/// Reads and checks the keys that KeyOwner::art owns; an absent key keeps its default: straight, 0.4 mm, black on
/// white, a palette of eight colours that colour-blind readers can distinguish. @param dpi  pixels per inch, for px
/// in lengths
Style read_style(const Pattern& pattern, double dpi, Diagnostics& diagnostics);

}  // namespace sikku
