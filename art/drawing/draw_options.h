// art/drawing/draw_options.h: what is asked of a drawing, and what became of it.
#pragma once

#include "art/drawing/view.h"
#include "art/plotter/gcode.h"
#include "art/plotter/hpgl.h"
#include "art/plotter/plot.h"
#include "art/print/format.h"
#include "art/print/print.h"
#include "art/print/tiles.h"
#include "engine/base/monitor.h"

#include <cstdint>
#include <functional>
#include <optional>

namespace sikku {

/// What of a drawing is seen, as it will lie on the page: in turtle steps, y up, without the width of its pen.
struct DrawnExtent {
    Box box;
    double widest = 0.0;  ///< of pens and dots, in the measure of the style's stroke
    double around = 0.0;  ///< the same, of what goes on around a window
};

/// How a drawing looks, on a page of its own and in the cell of a sheet.
struct DrawingOptions {
    PlacementOptions placement;
    std::optional<ViewWindow> window;  ///< the part of the drawing that fills the page within its margins
    bool may_be_empty = false;         ///< one of several generations: if it draws nothing, its page is empty
    bool only_dots = false;            ///< of a kolam: a sheet to practise on
    bool colours_strokes = false;      ///< each stroke in the next colour of the palette
    bool border = false;               ///< of red earth, within the margins: see draw_border()
    double budget = 200e6;             ///< most nodes of the derivation that are visited in one pass
};

struct DrawOptions : DrawingOptions {
    PrintFormat format = PrintFormat::svg;
    std::optional<DrawnExtent> frame;   ///< what is placed on the page instead of what is seen
    std::optional<double> dot_spacing;  ///< millimetres between the nearest dots, instead of the placement's step
    /// Lines are arranged for a plotter, as those of HP-GL and G-code always are. Start and home are set by the
    /// format.
    std::optional<PlotOptions> plot;
    bool shows_travel = false;  ///< then, the ways of the lifted pen are drawn, too, in a layer of their own
    GcodeOptions gcode;
    HpglOptions hpgl;
    /// The print is cut into sheets, each a file (tile_file()). The page is then that of the whole; with a step
    /// given, as large as the drawing within its margins.
    std::optional<TileOptions> tiles;
    int threads = 0;       ///< for raster formats; 0: all cores
    int compression = 6;   ///< of PNG: 1, quick and large, to 9
    Monitor monitor = {};  ///< polled wherever drawing takes long without reading words
    /// Called once, before the word is read, with how many times it will be. `watch` may have been called before.
    std::function<void(int passes)> begin;
    /// Called with the number of symbols read since the last call, and with 0 for each band of pixels; may throw to
    /// stop.
    std::function<void(std::uint64_t symbols)> watch;
};

/// What became of it.
struct DrawReport {
    double step = 0.0;       ///< millimetres of one turtle step
    glm::dvec2 size{0.0};    ///< of the drawing with its pen, in millimetres
    glm::dvec2 room{0.0};    ///< for it on the page, within margins and border
    std::size_t dots = 0;    ///< of a kolam that were drawn
    bool overflows = false;  ///< it is larger than the page within its margins (a step was given)
    int sheets = 0;          ///< of a print that is cut into tiles
    int sheet_rows = 0;
    glm::dvec2 left_out{0.0};         ///< millimetres of the page's margin, on each side, that the sheets do not show
    std::optional<PlotReport> plot;   ///< of an arranged drawing
    std::uint64_t replaced = 0;       ///< parts too small to be told apart that were drawn as what they look like
    bool is_empty = false;            ///< the window contains no part of the drawing
    bool is_blank = false;            ///< the ink of a picture is too thin to be visible
    bool leaves_pattern_out = false;  ///< its text is too long for the format
};

}  // namespace sikku
