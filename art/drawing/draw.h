// art/drawing/draw.h: from a grammar and its style to a finished print in a file.
#pragma once

#include "art/drawing/view.h"
#include "art/plotter/gcode.h"
#include "art/plotter/hpgl.h"
#include "art/plotter/plot.h"
#include "art/print/format.h"
#include "art/print/print.h"
#include "art/print/tiles.h"
#include "art/raster/raster.h"
#include "art/space/model.h"
#include "art/space/scene.h"
#include "engine/base/monitor.h"
#include "engine/base/output.h"
#include "engine/geometry/path.h"
#include "engine/language/grammar.h"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace sikku {

/// What of a drawing is seen, as it will lie on the page: in turtle steps, y up, without the width of its pen.
struct DrawnExtent {
    Box box;
    double widest = 0.0;  ///< of pens and dots, in the measure of the style's stroke
};

struct DrawOptions {
    PrintFormat format = PrintFormat::svg;
    PlacementOptions placement;
    std::optional<DrawnExtent> frame;   ///< what is placed on the page instead of what is seen
    std::optional<ViewWindow> window;   ///< of lines in one pen: what fills the page within its margins
    bool only_dots = false;             ///< of a kolam: a sheet to practise on
    std::optional<double> dot_spacing;  ///< millimetres between the nearest dots, instead of the placement's step
    bool colours_strokes = false;       ///< each stroke in the next colour of the palette
    bool border = false;                ///< of red earth, within the margins: see draw_border()
    /// Lines are arranged for a plotter, as those of HP-GL and G-code always are. Start and home are set by the
    /// format.
    std::optional<PlotOptions> plot;
    bool shows_travel = false;          ///< then, the ways of the lifted pen are drawn, too, in a layer of their own
    GcodeOptions gcode;
    HpglOptions hpgl;
    /// The print is cut into sheets, each a file (tile_file()). The page is then that of the whole; with a step
    /// given, as large as the drawing within its margins.
    std::optional<TileOptions> tiles;
    int threads = 0;        ///< for raster formats; 0: all cores
    int compression = 6;    ///< of PNG: 1, quick and large, to 9
    double budget = 200e6;  ///< most nodes of the derivation that are visited in one pass
    Monitor monitor = {};   ///< polled wherever drawing takes long without reading words
    /// Called once, before the word is read, with how many times it will be. `watch` may have been called before.
    std::function<void(int passes)> begin;
    /// Called with the number of symbols read since the last call, and with 0 for each band of pixels; may throw to
    /// stop.
    std::function<void(std::uint64_t symbols)> watch;
};

/// What became of it.
struct DrawReport {
    double step = 0.0;                ///< millimetres of one turtle step
    glm::dvec2 size{0.0};             ///< of the drawing with its pen, in millimetres
    glm::dvec2 room{0.0};             ///< for it on the page, within margins and border
    std::size_t dots = 0;             ///< of a kolam that were drawn
    bool overflows = false;           ///< it is larger than the page within its margins (a step was given)
    int sheets = 0;                   ///< of a print that is cut into tiles
    std::optional<PlotReport> plot;   ///< of an arranged drawing
    std::uint64_t replaced = 0;       ///< parts too small to be told apart that were drawn as what they look like
    bool is_empty = false;            ///< the window contains no part of the drawing
    bool is_blank = false;            ///< the ink of a picture is too thin to be visible
    bool leaves_pattern_out = false;  ///< its text is too long for the format
};

/// Works out the placement of `print` on its page, with the pen around what is seen; `stroke` tells its measure.
/// @throws std::runtime_error if the margins leave no room
DrawReport place_print(Print& print, const DrawnExtent& seen, const StrokeWidth& stroke,
                       const PlacementOptions& placement);

/// A drawing that is placed and then read, any number of times, always into the same strokes: what draw() does
/// before there is a file.
class Drawing {
public:
    /// Resolves contexts and asks what the drawing costs; of `style` what is seen and how lines are drawn. Of
    /// `options` the format and the threads do not count.
    /// @throws BudgetError, WordError
    Drawing(const Grammar& grammar, const Style& style, const DrawOptions& options);

    /// Worked out when it is first asked for: from the fold where only straight lines are drawn and all are seen,
    /// else from one pass over the word. @throws std::runtime_error if nothing is drawn
    const DrawnExtent& extent();
    /// The same; its box is empty if nothing is drawn.
    const DrawnExtent& seen();
    /// In space, once it was read: of all points, without the width of pens.
    std::optional<SpaceBounds> bounds() const;
    /// Works out the placement of `print` on its page. @throws as extent() but with a frame, and if the margins leave
    /// no room
    DrawReport place(Print& print);
    /// One pass over the word into `sink`; of drawings in space, which are kept, what is behind comes first.
    /// @param print  placed, in style(); of drawings in the plane its style and placement do not count
    /// To be called after extent() or place().
    void read(const Print& print, PathSink& sink) const;
    /// Drawings in space are pictures of their own; null for those in the plane. `print` is placed, and both must
    /// outlive it.
    std::unique_ptr<Rendering> rendering(const Print& print) const;
    /// The style in which read() draws: that of the constructor, with shades for drawings in space.
    const Style& style() const { return drawn_style_; }

    /// Does it pitch, roll or bend?
    bool is_spatial() const { return grammar_.is_spatial(); }
    /// Fraction of the page that a fitted drawing fills.
    double scale() const { return options_.placement.scale * grammar_.scale_percent() / 100; }

private:
    void read_straight(PathSink& sink) const;
    bool is_plot() const;
    bool all_lines_are_seen() const;

    Grammar grammar_;
    Style style_;
    Style drawn_style_;
    DrawOptions options_;
    bool spline_;
    bool has_brackets_ = false;
    bool has_areas_ = false;
    bool has_widths_ = false;
    bool has_colours_ = false;
    std::vector<bool> closed_;  ///< of a spline's strokes, in their order
    std::optional<DrawnExtent> extent_;
    std::optional<Scene> scene_;  ///< of a drawing in space, once it was read
};

/// Draws into `file`, which appears whole or not at all. `print` comes with page, style, dpi and texts; its placement
/// is worked out here: from the fold where only straight lines are drawn and all are seen, else from one pass over
/// the word. What leaves nothing on paper (`stroke: none`, transparent colours) does not count. Drawings in space
/// (Grammar::is_spatial()) are seen as the style's camera sees them.
/// @throws BudgetError, WordError; std::runtime_error if nothing is drawn or the file cannot be written
DrawReport draw(const Grammar& grammar, Print print, const DrawOptions& options, const std::filesystem::path& file,
                Destination& destination = file_system());

/// A model of what is drawn: see write_model(). Widths in millimetres are those that a print would have; of `options`
/// placement, budget, begin and watch count.
/// @throws as draw()
ModelReport draw_model(const Grammar& grammar, Print print, const DrawOptions& options, PrintFormat format,
                       const std::filesystem::path& file, Destination& destination = file_system());

}  // namespace sikku
