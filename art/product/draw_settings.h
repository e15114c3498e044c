// art/product/draw_settings.h: typed settings of a print, and the table of options that sets them.
#pragma once

#include "art/plotter/gcode.h"
#include "art/plotter/hpgl.h"
#include "art/plotter/plot_options.h"
#include "art/plotter/profile.h"
#include "art/print/format.h"
#include "art/print/print.h"
#include "art/style/style.h"
#include "art/writer/draw_options.h"
#include "art/writer/swatch.h"
#include "engine/base/option.h"
#include "engine/language/document.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace sikku {

/// Whether a print is the repeating part of a tiling, and whether the tiling may be turned to make that smaller.
enum class SwatchChoice : std::uint8_t { none, upright, turned };

// Settings of a print. Lengths are millimetres, angles degrees, times seconds.

/// The paper, and options that writers of files apply.
struct PaperSettings : WriterOptions {
    bool landscape = false;
    bool widens_margin = false;     ///< the margin is the one that the plotter needs
    std::optional<Page> tile;       ///< sheet of a tiled print
    std::optional<double> overlap;  ///< overlap of neighbouring sheets; 10 mm
};

/// Settings that determine the place of the drawing on the page.
struct PlaceSettings {
    bool fit = false;         ///< requested explicitly; excludes `step` and `window`
    bool fills_page = false;  ///< cover the page with a tiling
    SwatchChoice swatch = SwatchChoice::none;
    std::optional<Swatch> swatch_place{};  ///< the part found, set when the print is planned
    glm::dvec2 swatch_stretch{1.0};        ///< scale across and down that gives the swatch whole pixels
};

/// A step of the derivation by which a drawing is coloured.
struct Highlight {
    std::int64_t step = 1;                ///< from 1 to the derivation length
    std::optional<std::uint64_t> symbol;  ///< colours only the parts that come from this symbol, counted from 1
};

/// Contents of the drawing, and values for keys of the pattern. An empty `title_line` stands for the pattern's title.
struct LookSettings : DrawingSettings {
    std::string view;                      ///< value for `view:`; empty: the pattern's
    std::string light;                     ///< value for `light:`; empty: the pattern's
    std::optional<std::string> dots;       ///< value for `dots:`; empty: default size and colour
    std::optional<std::string> border;     ///< value for `border:`
    std::string font_name;                 ///< font of the texts around the drawing; empty: single strokes
    std::optional<Highlight> highlight{};  ///< colours the parts that one step made
};

/// Several derivation lengths, what moves, and productions side by side.
struct TimeSettings {
    bool shows_rule = false;                                           ///< draw each production instead of the word
    std::optional<std::pair<std::int64_t, std::int64_t>> generations;  ///< derivation lengths, first and last
    bool frames = false;                                               ///< write each generation to its own file
    std::optional<double> frame_time;  ///< display time of each generation in an animation
    std::optional<double> hold;        ///< minimum display time of the last generation
    bool fit_frames = false;           ///< fit each generation to the page
    std::optional<double> division;    ///< seconds in which tiles divide from one generation to the next
    std::optional<double> lesson;      ///< seconds for each stroke of a drawing lesson
};

struct PlotSettings : PlotOptions {
    bool plotter = false;
    std::optional<HpglPaper> paper;         ///< sheet or limits of an HP-GL plotter
    bool travel = false;                    ///< show pen-up travel
    std::optional<PlotterProfile> profile;  ///< the plotter, whose speeds and G-code are the defaults
    std::vector<PenRule> pen_rules;         ///< settings of single pens, which replace those of the profile
    GcodeOptions gcode;
};

struct ReliefSettings {
    std::optional<std::vector<double>> heights;  ///< heights of a relief; empty: the default
    std::vector<double> ridges;                  ///< heights of its lines; empty: `heights`
    std::optional<double> base;                  ///< thickness of its base
    std::optional<double> beyond;  ///< how far the base reaches beyond the drawing; absent: it is the page
    std::optional<double> groove;  ///< width between its polygons
};

/// PNG is compressed at level 4 if lines have grain, which compresses slowly.
struct WorkSettings : PictureOptions {
    double budget = 200e6;  ///< maximum number of derivation nodes visited in one pass
};

struct DrawSettings {
    std::vector<const OptionInfo*> given{};  ///< options with a value other than none, in the order of the table
    std::vector<Setting> keys;               ///< keys of the language given as options: `stroke`, `fill`, …
    PaperSettings paper;
    PlaceSettings place;
    LookSettings look;
    TimeSettings time;
    PlotSettings plot;
    ReliefSettings relief;
    WorkSettings work;
};

/// Every option of a print, in the order of help.
std::span<const Option<DrawSettings>> draw_options();

/// Reads options. @throws SettingError for unknown names and values that cannot be read
/// @param folder  folder of the file that describes a plotter, if any; null: that file is not read.
///                @throws PatternError for that file
DrawSettings read_draw_settings(const OptionValues& values, const std::filesystem::path* folder = nullptr);

/// Reads the style of a document, with `dots`, `view` and `light` as the settings override them. @throws
/// SettingError, PatternError
Style read_print_style(const Document& document, const DrawSettings& settings);

/// The options of the drawing, on its own page or in the cell of a sheet. The patterns of a border and the font are
/// not loaded: see load_border() and load_font().
DrawingOptions drawing_options(const DrawSettings& settings, const Document& document);

/// Opens the font of a name that is not empty, for texts around drawings. @param folder  of a file that it names
/// @throws SettingError
std::shared_ptr<const Font> load_font(const std::string& name, const std::filesystem::path& folder);

/// The sheets that the print is cut into; `tile` must be set.
std::shared_ptr<const TileOptions> tile_options(const DrawSettings& settings);

/// True if the print is a relief.
bool is_relief(const DrawSettings& settings, PrintFormat format);
/// True if it is another model.
bool is_model(const DrawSettings& settings, PrintFormat format);
/// The options of a relief. Call if is_relief(). @throws SettingError for depths that do not fit into the base
std::shared_ptr<const ReliefOptions> relief_options(const DrawSettings& settings, PrintFormat format);

/// Combines the settings with those of the plotter's profile. Empty if the print is not for a plotter.
PlotSetup plot_setup(const DrawSettings& settings, PrintFormat format);

/// Checks that the settings can be combined with each other and with the format. @throws SettingError
void check_draw_settings(const DrawSettings& settings, PrintFormat format);
/// The same for a map, and for a drawing in space.
void check_map_settings(const DrawSettings& settings);
void check_space_settings(const DrawSettings& settings, PrintFormat format);

/// Names of the options that these checks would refuse beside the settings, because of the format, of the drawing, or
/// of another setting that they need or exclude.
std::set<std::string_view> refused_options(const DrawSettings& settings, PrintFormat format, bool is_spatial,
                                           bool is_map);

}  // namespace sikku
