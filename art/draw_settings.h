// art/draw_settings.h: the options of a print, typed, and the one table that reads them.
#pragma once

#include "art/drawing/draw_options.h"
#include "art/drawing/growth.h"
#include "art/drawing/view.h"
#include "art/plotter/gcode.h"
#include "art/plotter/hpgl.h"
#include "art/plotter/plot.h"
#include "art/print/format.h"
#include "art/print/page.h"
#include "art/print/press.h"
#include "art/print/tiles.h"
#include "art/style/style.h"
#include "engine/base/option.h"
#include "engine/language/document.h"

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace sikku {

/// Settings of a print. Lengths are millimetres, angles degrees, times seconds.
struct DrawSettings {
    std::vector<Setting> keys;  ///< of the language, as options: `stroke`, `fill`, …
    double dpi = 300.0;         ///< pixels per inch of pictures, and of px in lengths; 1 to 10,000
    Page page;                  ///< A4 with margins of 10 mm
    bool landscape = false;
    bool fit = false;                  ///< asked for, which excludes `step` and `window`
    std::optional<double> step;        ///< of one turtle step on paper, instead of fitting
    std::optional<ViewWindow> window;  ///< part of the drawing that fills the page
    std::string window_text;           ///< as given: it may have more digits than a double
    double rotate = 0.0;               ///< anticlockwise
    bool mirror = false;               ///< before the rotation
    std::string view;                  ///< of drawings in space, as `view:`; empty: the pattern's
    std::optional<std::string> dots;   ///< as `dots:`; empty: in default size and colour
    bool only_dots = false;
    std::optional<double> dot_spacing;                                 ///< between the nearest dots
    bool border = false;                                               ///< of red earth
    bool colours_strokes = false;                                      ///< by strand
    std::optional<std::pair<std::int64_t, std::int64_t>> generations;  ///< derivation lengths, first and last
    bool frames = false;                                               ///< each generation is a file
    std::optional<double> frame_time;                                  ///< of each generation in an animation
    std::optional<double> hold;                                        ///< minimum for the last generation
    bool fit_frames = false;                                           ///< each generation fills the page
    std::optional<double> animation;                                   ///< duration of an SVG that draws itself
    std::optional<Page> tile;                                          ///< sheets that the print is cut into
    std::optional<double> overlap;                                     ///< of those sheets; 10 mm
    bool plotter = false;
    double split = 0.0;              ///< longest stroke; 0: any
    std::optional<Hatch> hatch;      ///< of filled shapes
    double pen_width = 0.0;          ///< of the real pen; 0: of each stroke
    int pens = 0;                    ///< maximum number; 0: any
    std::optional<HpglPaper> paper;  ///< of an HP-GL plotter
    bool travel = false;             ///< show pen-up travel
    PlotSpeeds speeds;
    GcodeOptions gcode;
    Press press;
    int compression = 6;    ///< of PNG, 1 to 9
    double budget = 200e6;  ///< maximum number of derivation nodes visited in one pass
    int threads = 0;        ///< for pictures; 0: one for each core
};

/// The table: every option of a print, in the order of help.
std::span<const Option<DrawSettings>> draw_options();

/// Reads options. @throws SettingError for unknown names and values that cannot be read
DrawSettings read_draw_settings(const OptionValues& values);

/// The style of a document, with what the settings change: `dots` and `view`. @throws SettingError, PatternError
Style read_print_style(const Document& document, const DrawSettings& settings);

/// How the drawing looks, on its own page as in the cell of a sheet.
DrawingOptions drawing_options(const DrawSettings& settings);

/// The sheets that the print is cut into; `tile` must be set.
TileOptions tile_options(const DrawSettings& settings);

/// Checks the combination of settings with each other and with a format. @throws SettingError
void check_draw_settings(const DrawSettings& settings, PrintFormat format);

}  // namespace sikku
