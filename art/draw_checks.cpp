// art/draw_checks.cpp: which settings of a print can be combined with each other and with a format.
#include "art/draw_settings.h"
#include "art/raster/raster.h"

#include <fmt/format.h>

#include <algorithm>
#include <initializer_list>

namespace sikku {
namespace {

/// Reason why an option cannot be combined with others.
struct Conflict {
    bool is_given;
    const char* option;
    const char* reason;
};

void refuse_first(std::initializer_list<Conflict> conflicts) {
    for (const Conflict& conflict : conflicts) {
        if (conflict.is_given) refuse_option(conflict.option, "", conflict.reason);
    }
}

void check_relief(const DrawSettings& settings, PrintFormat format) {
    if (!is_relief(settings, format)) {
        constexpr const char* reason = "applies only to reliefs; needs 'relief' or STL";
        return refuse_first({{!settings.ridges.empty(), "ridge", reason},
                             {settings.base.has_value(), "base", reason},
                             {settings.groove.has_value(), "groove", reason}});
    }
    if (info(format).kind != FormatKind::model) refuse_option("relief", "", "a relief is STL, OBJ or glTF");
    constexpr const char* flat = "a relief is made of drawings in the plane, which have neither camera nor light";
    refuse_first({{settings.tile.has_value(), "tile", "a relief can be cut in the program that prints it"},
                  {settings.lesson.has_value(), "lesson", "a lesson has several pages; a relief is one solid"},
                  {settings.generations && !settings.frames, "generations",
                   "a relief is one solid; 'frames' makes one of each generation"},
                  {settings.kerf > 0, "kerf", "a model is not cut along the edges of its tiles"},
                  {!settings.view.empty(), "view", flat},
                  {!settings.light.empty(), "light", flat},
                  {settings.press.bleed > 0, "bleed", "a relief is not trimmed"}});
    const ReliefOptions options = relief_options(settings, format);
    const auto check_depths = [&](const char* option, const std::vector<double>& heights) {
        for (const double height : heights) {
            if (height < 0 && !(options.base + height > 0.0005)) {
                refuse_option(option, fmt::format("{:g}mm", height),
                              fmt::format("this depth does not fit into a base of {:g} mm", options.base));
            }
        }
    };
    check_depths("relief", options.heights);
    check_depths("ridge", options.ridges);
}

void check_model(const DrawSettings& settings) {
    constexpr const char* reason = "a model has no page and no camera; this option applies only to prints";
    refuse_first({{settings.window.has_value(), "window", reason},
                  {!settings.view.empty(), "view", reason},
                  {!settings.light.empty(), "light", reason},
                  {settings.profile.has_value(), "profile", reason},
                  {settings.plotter, "plotter", reason},
                  {settings.hatch.has_value(), "hatch", reason},
                  {settings.pen_width > 0, "pen-width", reason},
                  {settings.pens > 0, "pens", reason},
                  {!settings.pen_rules.empty(), "pen", reason},
                  {settings.refill.has_value(), "refill", reason},
                  {settings.park.has_value(), "park", reason},
                  {settings.resume > 0, "resume", reason},
                  {!settings.gcode.arcs, "arcs", reason},
                  {settings.gcode.least_arc > 0, "min-arc", reason},
                  {settings.paper.has_value(), "hpgl-paper", reason},
                  {settings.tile.has_value(), "tile", reason},
                  {settings.overlap.has_value(), "overlap", reason},
                  {settings.split > 0, "split", reason},
                  {settings.travel, "travel", reason},
                  {settings.dots.has_value(), "dots", reason},
                  {settings.dot_spacing.has_value(), "dot-spacing", reason},
                  {settings.animation.has_value(), "animate", reason},
                  {settings.generations.has_value(), "generations", reason},
                  {settings.frames, "frames", reason},
                  {settings.frame_time.has_value(), "frame-time", reason},
                  {settings.hold.has_value(), "hold", reason},
                  {settings.fit_frames, "fit-frames", reason},
                  {settings.division.has_value(), "divide", reason},
                  {settings.lesson.has_value(), "lesson", reason},
                  {settings.fills_page, "fill-page", reason},
                  {settings.swatch != SwatchChoice::none, "swatch", reason},
                  {settings.names_tiles, "name-tiles",
                   "applies only to SVG, which names its elements, and to PDF and DXF, which have layers"},
                  {settings.kerf > 0, "kerf", "a model is not cut along the edges of its tiles"},
                  {settings.border.has_value(), "border", reason},
                  {settings.title_line.has_value(), "title-line", reason},
                  {settings.repeat.has_value(), "repeat", reason},
                  {settings.composes, "compose", reason},
                  {!settings.edition.empty(), "edition", reason},
                  {settings.colours_strokes, "colour-by", reason},
                  {settings.press.marks, "marks", reason},
                  {settings.press.registration, "registration", reason},
                  {settings.press.overprint != Overprint::none, "overprint", reason},
                  {!settings.press.spots.empty(), "spot", reason},
                  {settings.press.bleed != 0, "bleed", reason},
                  {!settings.press.cmyk.empty(), "cmyk", reason},
                  {settings.press.bits != 8, "bits", reason},
                  {settings.press.screen != Screen{}, "screen", reason},
                  {settings.step.has_value(), "step", "a model has one unit for each turtle step"},
                  {settings.rotate != 0, "rotate", "a model can be rotated in the program that uses it"},
                  {settings.mirror, "mirror", "a model can be mirrored in the program that uses it"}});
}

void check_placement(const DrawSettings& settings) {
    constexpr const char* both = "cannot be combined with 'fit', which also sets the step length";
    refuse_first(
        {{settings.fit && settings.step, "step", both},
         {settings.fit && settings.window, "window", both},
         {settings.fills_page && (settings.fit || settings.window || settings.dot_spacing || settings.repeat ||
                                  settings.composes || settings.generations || settings.rotate != 0),
          "fill-page",
          "sets the place and the size of the drawing, and cannot be combined with 'fit', 'window', 'dot-spacing', "
          "'repeat', 'compose', 'generations' and 'rotate'"},
         {settings.fit && settings.composes, "compose", "cannot be combined with 'fit', which fills the margins"},
         {settings.window && settings.composes, "compose", "a window fills the page"},
         {settings.window && settings.repeat, "repeat", "a window shows a part of one drawing, not of its copies"},
         {settings.fit && settings.dot_spacing, "dot-spacing", both},
         {settings.step && settings.dot_spacing, "dot-spacing",
          "cannot be combined with 'step': both set the step length"}});
}

/// Checks that the format can express the settings of single pens.
void check_pens(const DrawSettings& settings, PrintFormat format) {
    const bool has_codes = settings.profile && settings.profile->layers.full_speed > 0 && format == PrintFormat::svg;
    for (const PenRule& rule : settings.pen_rules) {
        const PenSettings& pen = rule.settings;
        const bool has_height = pen.lift || pen.down || pen.pause;
        refuse_first(
            {{format == PrintFormat::hpgl && has_height, "pen", "HP-GL sets the speed of a pen, but not its height"},
             {has_codes && pen.lift, "pen",
              "the names of AxiDraw's layers do not contain the height of a raised pen"},
             {!is_for_plotters(format) && !has_codes && (has_height || pen.speed), "pen",
              "an SVG describes pens only in layer names for AxiDraw; 'profile' axidraw writes them"}});
    }
}

void check_plot(const DrawSettings& settings, PrintFormat format) {
    constexpr const char* no_plot = "a plot is SVG, PDF, EPS, HP-GL, G-code or DXF";
    const bool is_plot = settings.plotter || is_for_plotters(format);
    const bool is_drawn = info(format).kind == FormatKind::vectors;
    const GcodeOptions defaults = settings.profile ? settings.profile->gcode : GcodeOptions{};
    if (settings.profile) {
        const PlotLanguage language = settings.profile->language;
        const PlotLanguage spoken = format == PrintFormat::hpgl    ? PlotLanguage::hpgl
                                    : format == PrintFormat::gcode ? PlotLanguage::gcode
                                                                   : PlotLanguage::svg;
        if (is_for_plotters(format) && language != spoken) {
            refuse_option(
                "profile", settings.profile->name,
                fmt::format("this plotter reads {}, not {}", language_name(language), language_name(spoken)));
        }
        if (language == PlotLanguage::svg && !is_vector(format)) {
            refuse_option("profile", settings.profile->name, no_plot);
        }
        if (language == PlotLanguage::svg && is_drawn && format != PrintFormat::svg) {
            refuse_option("profile", settings.profile->name,
                          fmt::format("this plotter reads SVG, not {}", info(format).label));
        }
    }
    if (format == PrintFormat::dxf) {
        constexpr const char* no_pen = "a .dxf describes lines, not the pens that draw them";
        refuse_first({{settings.profile.has_value(), "profile", no_pen},
                      {!settings.pen_rules.empty(), "pen", no_pen},
                      {settings.refill.has_value(), "refill", no_pen},
                      {settings.park.has_value(), "park", no_pen}});
    }
    refuse_first(
        {{settings.plotter && !is_vector(format), "plotter", no_plot},
         {settings.travel && !(is_plot && is_drawn), "travel", "needs 'plotter', and SVG, PDF or EPS"},
         {settings.split > 0 && !is_plot, "split", "needs 'plotter'"},
         {settings.hatch && !is_plot, "hatch", "needs 'plotter', HP-GL, G-code or DXF"},
         {settings.pen_width > 0 && !is_plot, "pen-width", "needs 'plotter', HP-GL, G-code or DXF"},
         {settings.pens > 0 && !is_plot, "pens", "needs 'plotter', HP-GL, G-code or DXF"},
         {!settings.pen_rules.empty() && !is_plot, "pen", "needs 'plotter', HP-GL, G-code or DXF"},
         {settings.refill && !is_plot, "refill", "needs 'plotter', HP-GL, G-code or DXF"},
         {settings.resume > 0 && !is_plot, "resume", "needs 'plotter', HP-GL, G-code or DXF"},
         {settings.park && !is_for_plotters(format), "park", "applies only to HP-GL and G-code"},
         {settings.gcode.arcs != defaults.arcs && format != PrintFormat::gcode, "arcs", "applies only to G-code"},
         {settings.gcode.least_arc != defaults.least_arc && format != PrintFormat::gcode, "min-arc",
          "applies only to G-code"},
         {settings.paper && format != PrintFormat::hpgl, "hpgl-paper", "applies only to HP-GL"},
         {settings.tile && is_plot, "tile", "tiles would cut the strokes of a plot"},
         {settings.overlap && !settings.tile, "overlap", "needs 'tile'"},
         {settings.fills_page && is_plot, "fill-page", "the edges of the page would cut the strokes of a plot"},
         {settings.window && is_plot, "window", "a window would cut the strokes of a plot"}});
    check_pens(settings, format);
}

void check_gif(const DrawSettings& settings) {
    constexpr const char* screen = "does not apply to a .gif, which is shown on screens";
    refuse_first({{settings.press.bleed > 0, "bleed", screen}, {settings.tile.has_value(), "tile", screen}});
    const PixelSize size = pixel_size(settings.page, settings.dpi);
    if (std::max(size.width, size.height) > 65'535 || std::int64_t{size.width} * size.height > 100'000'000) {
        refuse_option("dpi", fmt::format("{:g}", settings.dpi),
                      "a .gif has at most 65,535 pixels per side and 100 million in all; use a smaller size or dpi");
    }
}

void check_lesson(const DrawSettings& settings, PrintFormat format) {
    if (!settings.lesson) return;
    constexpr const char* alone = "cannot be combined with 'lesson', which has its own pages and order";
    refuse_first({{settings.plotter || is_for_plotters(format), "lesson",
                   "a lesson has colours, numbers and several steps; a plot is one drawing"},
                  {format == PrintFormat::eps, "lesson", "a lesson has several pages; an EPS has one"},
                  {settings.generations.has_value(), "generations", alone},
                  {settings.tile.has_value(), "tile", alone},
                  {settings.window.has_value(), "window", alone},
                  {settings.animation.has_value(), "animate", alone},
                  {settings.only_dots, "dots", alone},
                  {settings.border && *settings.border != "none", "border",
                   "a lesson teaches the lines of the kolam; a border is not one of them"},
                  {settings.title_line.has_value(), "title-line", alone},
                  {!settings.edition.empty(), "edition", alone},
                  {settings.press.bleed > 0, "bleed", "the pages of a lesson are not trimmed"},
                  {settings.press.marks, "marks", "the pages of a lesson are not trimmed"},
                  {settings.press.registration, "registration", "the pages of a lesson are not trimmed"}});
    if (is_vector(format) || format == PrintFormat::gif) return;
    constexpr const char* filled = "each step of a lesson is scaled to fill its cell of the picture";
    refuse_first(
        {{settings.step.has_value(), "step", filled}, {settings.dot_spacing.has_value(), "dot-spacing", filled}});
}

void check_swatch(const DrawSettings& settings, PrintFormat format) {
    if (settings.swatch == SwatchChoice::none) return;
    constexpr const char* placed = "a swatch has its own place and page";
    constexpr const char* whole = "a swatch is part of an endless tiling, with nothing around it";
    refuse_first(
        {{settings.plotter || is_for_plotters(format), "swatch", "its edges would cut the strokes of a plot"},
         {format == PrintFormat::gif, "swatch", "a swatch is one picture, not an animation"},
         {settings.generations.has_value(), "generations", "a swatch determines its own derivation length"},
         {settings.fit, "fit", placed},
         {settings.window.has_value(), "window", placed},
         {settings.fills_page, "fill-page", placed},
         {settings.repeat.has_value(), "repeat", placed},
         {settings.composes, "compose", placed},
         {settings.dot_spacing.has_value(), "dot-spacing", "the length of a step sets the size of a swatch"},
         {settings.lesson.has_value(), "lesson", placed},
         {settings.animation.has_value(), "animate", "a swatch is one picture, not an animation"},
         {settings.division.has_value(), "divide", "a swatch is one picture, not an animation"},
         {settings.tile.has_value(), "tile", placed},
         {settings.border && *settings.border != "none", "border", whole},
         {settings.title_line.has_value(), "title-line", whole},
         {!settings.edition.empty(), "edition", whole},
         {settings.press.bleed > 0, "bleed", whole},
         {settings.press.marks, "marks", whole},
         {settings.press.registration, "registration", whole}});
}

void check_division(const DrawSettings& settings, PrintFormat format) {
    if (!settings.division) return;
    constexpr const char* moving = "does not apply to tiles that divide";
    refuse_first(
        {{format != PrintFormat::svg && format != PrintFormat::gif, "divide",
          "only a .gif and an animated SVG show how tiles divide"},
         {settings.plotter, "divide", "a plot does not move"},
         {settings.animation.has_value(), "animate", "cannot be combined with 'divide', which has its own times"},
         {settings.lesson.has_value(), "lesson", moving},
         {settings.frames, "frames", "all generations of tiles that divide are in one file"},
         {settings.fit_frames, "fit-frames", "tiles that divide keep their place and their scale"},
         {settings.tile.has_value(), "tile", "an animation cannot be cut into sheets"},
         {settings.fills_page, "fill-page", "sets the derivation length, of which 'divide' needs several"},
         {settings.repeat.has_value(), "repeat", moving},
         {settings.names_tiles, "name-tiles", "tiles that divide have different names in each generation"},
         {settings.kerf > 0, "kerf", "tiles that divide are not cut"},
         {settings.dot_spacing.has_value(), "dot-spacing",
          "does not apply to tiles that divide; 'step' sets their scale"}});
}

void check_growth(const DrawSettings& settings, PrintFormat format) {
    const bool is_gif = format == PrintFormat::gif;
    const bool is_sheet = settings.generations && !is_gif && !settings.frames && !settings.division;
    refuse_first(
        {{is_gif && !settings.generations && !settings.lesson && !settings.division, "generations",
          "required for a .gif; expected A:B, or 'divide'"},
         {settings.frames && !settings.generations, "frames", "needs 'generations'"},
         {settings.frames && is_gif, "frames", "a .gif contains all generations itself"},
         {settings.frame_time && settings.lesson, "frame-time", "a lesson has its own seconds per stroke"},
         {settings.frame_time && !is_gif && !settings.division, "frame-time",
          "applies only to a .gif and to 'divide'"},
         {settings.hold && !is_gif && !settings.division, "hold", "applies only to a .gif and to 'divide'"},
         {settings.fit_frames && (!settings.generations || is_sheet), "fit-frames", "needs a .gif or 'frames'"}});
    if (is_gif) check_gif(settings);
    if (!settings.generations) return;
    const auto [first, last] = *settings.generations;
    const std::int64_t most = is_sheet ? 100 : most_frames;
    if (last < first || last - first >= most) {
        refuse_option("generations", fmt::format("{}:{}", first, last),
                      fmt::format("expected up to {} derivation lengths, the lowest first", most));
    }
    if (is_sheet) {
        constexpr const char* filled = "each drawing of a sheet of generations is scaled to fill its cell";
        refuse_first(
            {{settings.plotter || is_for_plotters(format), "generations",
              "a plot cannot contain the grounds and captions of a sheet of generations; 'frames' makes a plot "
              "of each"},
             {settings.tile.has_value(), "tile",
              "a sheet of generations cannot be cut into tiles; 'frames' cuts each generation"},
             {settings.step.has_value(), "step", filled},
             {settings.dot_spacing.has_value(), "dot-spacing", filled}});
    }
}

}  // namespace

void check_draw_settings(const DrawSettings& settings, PrintFormat format) {
    check_relief(settings, format);
    const bool is_model = info(format).kind == FormatKind::model;
    if (is_model && !is_relief(settings, format)) return check_model(settings);
    check_placement(settings);
    if (!is_vector(format) && !is_model &&
        std::max(settings.page.width, settings.page.height) * settings.dpi / 25.4 > 200'000) {
        refuse_option("dpi", fmt::format("{:g}", settings.dpi),
                      "the picture would be over 200,000 pixels wide or high; use a smaller size or dpi");
    }
    try {
        if (settings.tile) tiling_of(settings.page, tile_options(settings));
    } catch (const std::runtime_error& error) {
        refuse_option("tile", "", error.what());
    }
    check_press(settings.press, format == PrintFormat::gif ? PrintFormat::png : format);
    check_plot(settings, format);
    constexpr const char* trimmed = "applies only to trimmed prints, not to plots and tiles";
    const bool is_untrimmed = settings.plotter || settings.tile;
    refuse_first(
        {{is_untrimmed && settings.press.bleed > 0, "bleed", trimmed},
         {is_untrimmed && settings.press.marks, "marks", trimmed},
         {is_untrimmed && settings.press.registration, "registration", trimmed},
         {settings.window && settings.border && *settings.border != "none", "border",
          "a border frames the whole drawing; a window shows only part of it"},
         {settings.animation && !info(format).is_animated, "animate", "only SVG can draw itself"},
         {settings.names_tiles && format != PrintFormat::svg && format != PrintFormat::pdf &&
              format != PrintFormat::dxf,
          "name-tiles", "applies only to SVG, which names its elements, and to PDF and DXF, which have layers"},
         {settings.names_tiles && settings.plotter && format != PrintFormat::dxf, "name-tiles",
          "a plot has lines only, no tiles"},
         {settings.names_tiles && settings.hatch, "name-tiles",
          "cannot be combined with 'hatch', which draws tiles as lines"},
         {settings.names_tiles && settings.resume > 0 && format == PrintFormat::dxf, "resume",
          "cannot be combined with 'name-tiles', which writes every tile"}});
    check_swatch(settings, format);
    check_division(settings, format);
    check_lesson(settings, format);
    check_growth(settings, format);
}

}  // namespace sikku
