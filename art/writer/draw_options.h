// art/writer/draw_options.h: options of a print, and the report about the result.
#pragma once

#include "art/drawing/drawing_options.h"
#include "art/drawing/drawing_report.h"
#include "art/drawing/reading.h"
#include "art/plotter/gcode.h"
#include "art/plotter/hpgl.h"
#include "art/plotter/plot_options.h"
#include "art/print/format.h"
#include "art/raster/raster.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

namespace sikku {

class Rendering;
struct PixelSize;
struct ReliefOptions;
struct ReliefReport;
struct TileOptions;

/// Arrangement of a drawing or a sheet for a plotter, and the facts about the machine that its writers need.
struct PlotSetup {
    /// Arranges the lines for a plotter, which HP-GL and G-code always do. The format sets start and home.
    std::optional<PlotOptions> plot;
    bool shows_travel = false;  ///< draw pen-up travel of the plot in a separate layer
    GcodeOptions gcode;
    HpglOptions hpgl;
    LayerCodes layer_codes{};  ///< names of layers for AxiDraw, in SVG
};

/// Options for writing pictures.
struct PictureOptions {
    int threads = 0;                 ///< 0: all cores
    std::optional<int> compression;  ///< PNG compression, 1 (fast) to 9 (small); absent: 6
};

struct DrawOptions : DrawingOptions, ReadingLimits, PictureOptions, PlotSetup {
    PrintFormat format = PrintFormat::svg;
    /// Cuts the print into sheets, each in its own file (tile_file()). The page is that of the whole print; with a
    /// fixed step it is as large as the drawing and its margins. Null: one sheet.
    std::shared_ptr<const TileOptions> tiles;
    /// Makes a relief in its format; `format` is that of the drawing, SVG. Null: none.
    std::shared_ptr<const ReliefOptions> relief;
    /// Receives the pixels of a picture; the output file stays empty.
    std::function<void(Rendering& rendering, const PixelSize& size)> show_pixels;
    bool lists_contents = false;  ///< find the contents of the drawing for its report

    /// Options for reading the drawing for this print.
    Reading reading() const;
};

/// Returns the options with a `watch` that serialises its calls.
DrawOptions with_locked_watch(DrawOptions options);

/// Report about a finished print.
struct DrawReport : DrawingReport {
    DrawReport() = default;
    DrawReport(const DrawingReport& drawing) : DrawingReport(drawing) {}

    int sheets = 0;                              ///< number of sheets of a tiled print
    int sheet_rows = 0;                          ///< rows of sheets
    glm::dvec2 left_out{0.0};                    ///< margin in millimetres on each side that the sheets do not show
    std::optional<PlotReport> plot;              ///< report of a plot
    std::shared_ptr<const ReliefReport> relief;  ///< report of a relief
    bool lacks_ridges = false;                   ///< no line of a relief is higher than the rest
    std::uint64_t polygons = 0;        ///< number of filled polygons that can be named (WriterOptions::names_tiles)
    std::optional<Contents> contents;  ///< if DrawOptions::lists_contents
    std::vector<FaintInk> faint;       ///< inks that are hardly visible; not of plots
    bool is_blank = false;             ///< the ink of a picture is too thin to be visible
    bool leaves_pattern_out = false;   ///< the pattern's text is too long for the format
};

}  // namespace sikku
