// art/drawing/draw_options.h: options of a drawing, and the report about the result.
#pragma once

#include "art/drawing/view.h"
#include "art/plotter/gcode.h"
#include "art/plotter/hpgl.h"
#include "art/plotter/plot.h"
#include "art/print/format.h"
#include "art/print/print.h"
#include "art/print/repeat.h"
#include "art/print/tiles.h"
#include "art/raster/raster.h"
#include "art/relief/relief_options.h"
#include "engine/base/monitor.h"
#include "engine/language/grammar.h"

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

namespace sikku {

class MapFrames;

/// Bounds of the visible drawing in the orientation of the page: in turtle steps, y up, without the pen's width.
struct DrawnExtent {
    Box box;
    double widest = 0.0;  ///< width of pens and dots, in the unit of the style's stroke
    double around = 0.0;  ///< the same for lines that continue outside a window
};

/// A pattern that is drawn as a part of a border.
struct BorderPattern {
    std::shared_ptr<const Grammar> grammar;
    Style style;
};

/// A parallelogram in the coordinates of a drawing.
struct Cell {
    glm::dvec2 corner{0.0};
    std::array<glm::dvec2, 2> sides{};
};

class LessonMemo;

/// Options of a drawing that apply both to a page of its own and to a cell of a sheet.
struct DrawingOptions {
    PlacementOptions placement;
    std::optional<ViewWindow> window;  ///< the part of the drawing that fills the page within its margins
    bool may_be_empty = false;     ///< a drawing without lines gives an empty page, as for one of several generations
    bool only_dots = false;        ///< draw only the dots of a kolam, to practise on
    bool colours_strokes = false;  ///< draw each stroke in the next colour of the palette
    std::optional<std::size_t> lesson_step;                ///< show this step of a lesson, from 0: see LessonDrawing
    std::size_t most_steps = 40;                           ///< maximum steps of a lesson; more are joined
    std::shared_ptr<LessonMemo> lesson_memo{};             ///< shared by the drawings of all steps; null: none
    std::shared_ptr<const BorderPattern> border_repeat{};  ///< the pattern that the style's border repeats
    std::shared_ptr<const BorderPattern> border_corner{};  ///< the pattern in its corners
    std::optional<Repeat> repeat{};                        ///< copies of the drawing
    std::optional<Cell> cell{};                            ///< draw only this part, and the ground only there
    /// Colours of tiles by their neighbours repeat under these translations, in steps.
    std::optional<std::array<glm::dvec2, 2>> tile_period{};
    bool composes = false;     ///< place it by its shape and mass: see PlacementOptions::balance
    std::string title_line{};  ///< text below the drawing on the left; empty: none
    std::string edition{};     ///< text below the drawing on the right, such as 3/50; empty: none
    double kerf = 0;           ///< millimetres; the border of united edges of tiles moves outwards by half of it
    double budget = 200e6;     ///< maximum number of derivation nodes visited in one pass
};

/// How a drawing or a sheet is arranged for a plotter, and the facts about the machine that its writers need.
struct PlotSetup {
    /// Arranges the lines for a plotter, which HP-GL and G-code always do. The format sets start and home.
    std::optional<PlotOptions> plot;
    bool shows_travel = false;  ///< draw pen-up travel of the plot in a separate layer
    GcodeOptions gcode;
    HpglOptions hpgl;
    LayerCodes layer_codes{};  ///< names of layers for AxiDraw, in SVG
};

struct DrawOptions : DrawingOptions, PlotSetup {
    PrintFormat format = PrintFormat::svg;
    std::shared_ptr<MapFrames> map_frames{};  ///< shared by all generations of a map; absent: made for each drawing
    double map_share = 1;                     ///< progress of a map from the step before, for animations
    std::optional<DrawnExtent> frame;         ///< extent to place on the page instead of the drawing's own
    glm::dvec2 stretch{1.0};  ///< scale of the placed drawing, across and down, about the middle of the page
    std::optional<double> dot_spacing;  ///< millimetres between the nearest dots, instead of the placement's step
    /// Cuts the print into sheets, each in its own file (tile_file()). The page is that of the whole print; with a
    /// fixed step it is as large as the drawing and its margins.
    std::optional<TileOptions> tiles;
    std::optional<ReliefOptions> relief;  ///< makes a relief in its format; `format` is that of the drawing, SVG
    /// Receives the pixels of a picture; the output file stays empty.
    std::function<void(Rendering& rendering, const PixelSize& size)> show_pixels;
    bool lists_contents = false;  ///< find the contents of the drawing for its report
    int threads = 0;              ///< for raster formats; 0: all cores
    int compression = 6;          ///< PNG compression, 1 (fast) to 9 (small)
    Monitor monitor = {};         ///< polled in long stages that read no words
    /// Called once, before the word is read, with the number of passes. `watch` may have been called before.
    std::function<void(int passes)> begin;
    /// Called with the number of symbols read since the last call, and with 0 for each band of pixels; may throw to
    /// stop.
    std::function<void(std::uint64_t symbols)> watch;
};

/// Returns the options with a `watch` that serialises its calls.
inline DrawOptions with_locked_watch(DrawOptions options) {
    if (!options.watch) return options;
    options.watch = [watch = options.watch, mutex = std::make_shared<std::mutex>()](std::uint64_t symbols) {
        const std::scoped_lock lock(*mutex);
        watch(symbols);
    };
    return options;
}

/// Parallel lines as they were drawn, in millimetres.
struct ParallelReport {
    double spacing = 0.0;  ///< from the middle of one to the next
    double wanted = 0.0;   ///< the requested spacing, which is larger where there was no room
    double width = 0.0;    ///< width of each line
};

/// A colour that is hardly visible on its ground.
struct FaintInk {
    enum class Kind : std::uint8_t { lines, discs, areas };
    Kind kind = Kind::lines;
    Colour ink, ground;
};

/// The kinds of shapes in a drawing, and the palette indices they are drawn in.
struct Contents {
    bool has_polygons = false, has_areas = false, has_discs = false;
    std::vector<int> lines, fills;  ///< sorted
    bool has_fills() const { return has_polygons || has_areas || has_discs; }
};

/// Report about a finished drawing.
struct DrawReport {
    double step = 0.0;                       ///< millimetres of one turtle step
    glm::dvec2 size{0.0};                    ///< size of the drawing with its pen, in millimetres
    glm::dvec2 room{0.0};                    ///< room on the page, within margins and border
    std::size_t dots = 0;                    ///< number of kolam dots drawn
    double covered = 0;                      ///< share of a wallpaper that the copies cover, by their convex hulls
    double covered_by_moves = 0;             ///< the same if the copies were only translated (p1)
    std::size_t copies = 0;                  ///< number of copies of a repeated drawing
    std::optional<std::size_t> strokes;      ///< number of lines of all copies, or of a weave before it is cut
    std::size_t fields = 0;                  ///< number of fields between lines, filled or not
    std::optional<std::size_t> woven;        ///< number of crossings of a weave
    std::optional<ParallelReport> parallel;  ///< report of parallel lines
    bool overflows = false;          ///< the drawing is larger than the page within its margins (a step was given)
    int sheets = 0;                  ///< number of sheets of a tiled print
    int sheet_rows = 0;              ///< rows of sheets
    glm::dvec2 left_out{0.0};        ///< margin of the page, in millimetres on each side, that the sheets do not show
    std::optional<PlotReport> plot;  ///< report of a plot
    std::optional<ReliefReport> relief;  ///< report of a relief
    std::uint64_t polygons = 0;          ///< number of filled polygons that can be named (Print::names_tiles)
    bool tiles_are_alike = false;        ///< `tile colours` gave all tiles, more than one, the same colour
    bool lacks_worms = false;            ///< worms were requested, but no tiles form any
    std::uint64_t replaced = 0;          ///< parts too small to be resolved, replaced by their appearance
    std::size_t cells = 0;               ///< number of cells of a map
    std::optional<Contents> contents;    ///< if DrawOptions::lists_contents
    bool has_one_strand_colour =
        false;                        ///< colours by strand are those of the drawing: there is one strand, or orbit
    std::vector<FaintInk> faint;      ///< inks that are hardly visible; not of plots
    bool crosses_itself = false;      ///< the outline of a map crosses itself
    bool is_empty = false;            ///< the window contains no part of the drawing
    bool is_blank = false;            ///< the ink of a picture is too thin to be visible
    bool leaves_pattern_out = false;  ///< the pattern's text is too long for the format
};

}  // namespace sikku
