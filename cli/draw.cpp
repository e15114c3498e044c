// cli/draw.cpp: `sikku draw`: a print.
#include "cli/draw.h"

#include "art/drawing/growth.h"
#include "art/image/image_file.h"
#include "art/sheet/sheet.h"
#include "art/style/length.h"
#include "engine/base/text.h"
#include "engine/derivation/forecast.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <filesystem>
#include <system_error>
#include <tuple>
#include <utility>

namespace sikku {
namespace {

double length(const char* option, const std::string& text, double dpi) {
    const auto value = parse_length(text, dpi);
    if (!value || !std::isfinite(*value)) {
        throw UsageError(
            fmt::format("{} {}: expected a length such as 5mm, 1.5cm, 2in, 12pt or 300px", option, text));
    }
    return *value;
}

Page sheet_of(const char* option, const std::string& text, double dpi) {
    const auto size = parse_size(text, dpi);
    if (!size) {
        throw UsageError(fmt::format(
            "{} {}: expected A0 to A6, letter, legal, tabloid, or WIDTHxHEIGHT such as 300x300mm", option, text));
    }
    constexpr double most = 10'000;  // millimetres: wider than any press or plotter
    if (!(size->x >= 1 && size->y >= 1 && size->x <= most && size->y <= most)) {
        throw UsageError(fmt::format("{} {}: a page is between 1 mm and 10 m wide and high", option, text));
    }
    return {size->x, size->y, 10.0};
}

Page page_of(const DrawSettings& options) {
    Page page = sheet_of("--size", options.size, options.dpi);
    page.margin = length("--margin", options.margin, options.dpi);
    if (options.landscape && page.height > page.width) std::swap(page.width, page.height);
    if (page.margin < 0) throw UsageError(fmt::format("--margin {}: a margin is 0 or more", options.margin));
    if (!(2 * page.margin < std::min(page.width, page.height))) {
        throw UsageError(fmt::format("--margin {}: the margins leave nothing of a page of {:g} x {:g} mm",
                                     options.margin, page.width, page.height));
    }
    return page;
}

std::string made_with(const DrawSettings& options, const Grammar& grammar) {
    std::string text = fmt::format("sikku {}, -n {}", SIKKU_VERSION, grammar.steps());
    if (options.window) text += " --window " + *options.window;
    if (!options.view.empty()) text += " --view " + options.view;
    if (!options.pattern.variant.empty()) text += " --variant " + options.pattern.variant;
    if (!options.pattern.seed.empty()) text += " --seed " + options.pattern.seed;
    for (const std::string& setting : options.pattern.settings) text += fmt::format(" --set '{}'", setting);
    return text;
}

/// What is wrong with an option is a mistake of the caller.
template <typename Check>
void as_usage(const Check& check) {
    try {
        check();
    } catch (const std::runtime_error& error) {
        throw UsageError(error.what());
    }
}

/// `only`, or `only` and how the dots look.
bool is_only(std::string_view dots) {
    return dots == "only" || dots.starts_with("only ");
}

/// As `dots:` of the pattern would be.
void apply_dots(DrawSettings& options) {
    if (!options.dots && !options.dot_spacing) return;
    std::string text = options.dots.value_or("");
    if (is_only(text)) text.erase(0, std::min<std::size_t>(text.size(), 5));
    // A dot in the colour of the lines, and as large as it seems fit, has no words in the language.
    if (!text.empty()) options.pattern.more.push_back({"--dots", "dots", text});
}

void plan_plot(const DrawSettings& options, PrintFormat format, DrawOptions& drawing) {
    const bool is_plot = options.plotter || format == PrintFormat::hpgl || format == PrintFormat::gcode;
    if (options.plotter && !is_vector(format))
        throw UsageError("--plotter: a plot is .svg, .pdf, .hpgl, .plt, .gcode or .nc");
    if (options.travel && (!is_plot || (format != PrintFormat::svg && format != PrintFormat::pdf))) {
        throw UsageError("--travel: goes with --plotter, and .svg or .pdf");
    }
    if (!options.split.empty() && !is_plot) throw UsageError("--split: goes with --plotter");
    as_usage([&] { plot_seconds({}, options.speeds); });
    if (!is_plot) return;
    drawing.plot.emplace();
    if (!options.split.empty()) {
        drawing.plot->split = length("--split", options.split, options.dpi);
        if (!(drawing.plot->split > 0)) throw UsageError(fmt::format("--split {}: a length above 0", options.split));
    }
    drawing.shows_travel = options.travel;
    const auto profile = gcode_profile(options.profile);
    if (!profile) throw UsageError(fmt::format("--profile {}: expected grbl or z", options.profile));
    drawing.gcode = *profile;
    drawing.gcode.drawing_feed = 60 * options.speeds.drawing;
    drawing.gcode.travel_feed = 60 * options.speeds.travelling;
    if (options.gcode_start) drawing.gcode.start = *options.gcode_start;
    if (options.gcode_end) drawing.gcode.end = *options.gcode_end;
}

std::string time_text(double seconds) {
    if (!(seconds < 1e12)) return "for ever";
    const auto whole = static_cast<long long>(std::llround(seconds));
    if (whole < 60) return fmt::format("{} s", whole);
    if (whole < 3600) return fmt::format("{} min {} s", whole / 60, whole % 60);
    return fmt::format("{} h {} min", whole / 3600, whole % 3600 / 60);
}

void tell_plot(const PlotReport& plot, const PlotSpeeds& speeds, const Telling& telling) {
    const auto told = [&](const PlotTally& tally) {
        return fmt::format("{:.2f} m drawn, {:.2f} m travelled, {}, about {}", tally.drawn / 1000,
                           tally.travelled / 1000, counted(tally.lifts, "lift"),
                           time_text(plot_seconds(tally, speeds)));
    };
    telling.say("before: {}\nplot:   {}\n", told(plot.before), told(plot.after));
    if (plot.duplicates > 0) telling.say("{} drawn twice\n", counted(plot.duplicates, "segment"));
}

/// `A:B`, or `A` alone.
std::pair<std::int64_t, std::int64_t> parse_generations(const std::string& text) {
    const std::size_t colon = text.find(':');
    const auto whole = [&](std::string_view part) -> std::int64_t {
        std::int64_t value = -1;
        const auto [end, error] = std::from_chars(part.data(), part.data() + part.size(), value);
        if (error != std::errc() || end != part.data() + part.size() || value < 0) {
            throw UsageError(fmt::format("--generations {}: expected two derivation lengths such as 0:4", text));
        }
        return value;
    };
    const std::int64_t first = whole(std::string_view(text).substr(0, colon));
    const std::int64_t last = colon == std::string::npos ? first : whole(std::string_view(text).substr(colon + 1));
    if (last > most_steps) {
        throw UsageError(fmt::format("--generations {}: expected derivation lengths up to {}", text, most_steps));
    }
    return {first, last};
}

bool is_gif(const std::string& output) {
    return print_format(output) == PrintFormat::gif;
}

/// Derivation lengths one after the other, as an animation or in files of their own.
void draw_growth(const DrawSettings& options, const Print& print, DrawOptions drawing, const Document& loaded,
                 const Telling& telling) {
    if (drawing.tiles || drawing.window || !options.pattern.steps.empty()) {
        throw UsageError("--generations: frames go without -n, --window and --tile");
    }
    if (is_gif(options.output) && options.frames)
        throw UsageError("--frames: a .gif holds all generations by itself");
    if (is_gif(options.output) && (drawing.border || drawing.colours_strokes || print.style.dots)) {
        throw UsageError("--generations: of a .gif without --dots, --border and --colour-by");
    }
    for (const auto& [name, seconds] : {std::pair("--frame-time", options.frame_time), {"--hold", options.hold}}) {
        if (seconds && !(*seconds >= 0.01 && *seconds <= 600)) {
            throw UsageError(fmt::format("{}: expected 0.01 to 600 seconds", name));
        }
    }
    GrowthOptions growth;
    std::tie(growth.first, growth.last) = parse_generations(options.generations);
    growth.seconds = options.frame_time.value_or(growth.seconds);
    growth.hold = options.hold.value_or(growth.hold);
    growth.fits_each = options.fit_frames;
    if (growth.last < growth.first || growth.last - growth.first >= most_frames) {
        throw UsageError(fmt::format("--generations {}: expected up to {} frames, the lowest derivation length first",
                                     options.generations, most_frames));
    }
    if (is_gif(options.output)) {
        const PixelSize size = pixel_size(print.page, print.dpi);
        if (std::max(size.width, size.height) > 65'535 || std::int64_t{size.width} * size.height > 100'000'000) {
            throw UsageError(
                "a .gif has at most 65,535 pixels a side and 100 million in all: a smaller --size or --dpi");
        }
    } else if (options.frame_time || options.hold) {
        throw UsageError("--frame-time and --hold apply only to a .gif");
    }
    growth.made = [&](const Grammar& generation) { return made_with(options, generation); };
    Progress progress(0, telling.quiet);
    drawing.watch = telling.watch ? telling.watch : progress.watch();
    const DrawReport report = draw_growth(loaded.grammar(), print, drawing, growth, options.output);
    if (report.overflows) {
        telling.say("sikku: warning: the largest generation is larger than the page has room for: it is cut off\n");
    }
}

/// Derivation lengths side by side, as the books show them.
void draw_generations(const DrawSettings& options, const Print& print, const DrawOptions& drawing,
                      const Document& loaded, const Telling& telling) {
    if (drawing.plot || drawing.tiles || drawing.window || drawing.border || drawing.colours_strokes ||
        print.style.dots || options.step || !options.pattern.steps.empty()) {
        throw UsageError(
            "--generations: a sheet of drawings, .svg, .pdf or a picture, goes without -n, --step, --window, --dots, "
            "--border, --colour-by, --tile and what is for plotters");
    }
    const auto [first, last] = parse_generations(options.generations);
    if (last < first || last - first >= 100) {
        throw UsageError(
            fmt::format("--generations {}: up to 100 derivation lengths, the lower one first", options.generations));
    }
    SheetCell cell;
    cell.grammar = std::make_shared<const Grammar>(loaded.grammar());
    cell.style = print.style;
    cell.placement.rotate = options.rotate;
    cell.placement.mirror = options.mirror;
    cell.title = print.title;
    SheetOptions sheet;
    sheet.format = drawing.format;
    sheet.page = print.page;
    sheet.dpi = print.dpi;
    sheet.title = print.title;
    sheet.animation = print.animation;
    // Captions are short, and are to be read from as far as the drawings.
    sheet.letters = std::clamp(std::min(print.page.width, print.page.height) * 0.016, 2.0, 12.0);
    sheet.pattern = print.pattern;
    sheet.made = print.made;
    sheet.threads = drawing.threads;
    sheet.compression = drawing.compression;
    cell.budget = drawing.budget;
    Progress progress(0, telling.quiet);
    sheet.watch = telling.watch ? telling.watch : progress.watch();
    draw_sheet(generations(cell, first, last), sheet, options.output);
}

/// The word as it is read, with its progress.
void watch_drawing(const Grammar& grammar, const Telling& telling, std::optional<Progress>& progress,
                   DrawOptions& drawing) {
    if (telling.watch) {
        drawing.watch = telling.watch;
        return;
    }
    progress.emplace(0, telling.quiet);
    drawing.begin = [&](int passes) { progress.emplace(passes * expected_symbols(grammar, true), telling.quiet); };
    drawing.watch = [&](std::uint64_t symbols) { progress->add(symbols); };
}

void require_straight(const Document& loaded, const Style& style, std::string_view what) {
    const Key* key = loaded.pattern().find("line");
    if (style.line != Line::spline || !key) return;
    Diagnostics diagnostics;
    diagnostics.error(key->value, fmt::format("{} of straight lines, and not of splines", what));
    diagnostics.throw_if_errors();
}

/// What is asked for that only drawings in the plane have.
void check_space(const DrawSettings& options, const Print& print, const DrawOptions& drawing,
                 const Document& loaded) {
    if (!loaded.grammar().is_spatial()) return;
    require_straight(loaded, print.style, "this drawing pitches, rolls or bends: in space drawings are");
    if (drawing.window || drawing.border || drawing.colours_strokes || options.dots || options.dot_spacing ||
        print.animation) {
        throw UsageError(
            "this drawing pitches, rolls or bends: --window, --dots, --border, --colour-by and --animate are for "
            "drawings in the plane");
    }
    if (drawing.tiles && !is_vector(drawing.format)) {
        throw UsageError("--tile: drawings in space are cut into sheets as .svg or .pdf");
    }
    if (!print.press.spots.empty() && !drawing.plot) {
        throw UsageError("--spot: drawings in space are lit, in more shades than there are inks");
    }
}

void draw_model(const DrawSettings& given, PrintFormat format, const Telling& telling) {
    DrawSettings options = given;
    // What a print is asked for, a model is, as far as it goes.
    options.output = "print.svg";
    if (options.window || options.plotter || options.tile || options.dots || options.dot_spacing || options.animate ||
        !options.generations.empty() || options.frames || options.frame_time || options.hold || options.fit_frames ||
        !options.border.empty() || !options.colour_by.empty() || options.marks || !options.spots.empty() ||
        options.bleed != DrawSettings().bleed || !options.view.empty()) {
        throw UsageError(
            "a model has no page: --view, --window, --generations, --frames, --frame-time, --dots, --border, "
            "--colour-by, --animate, --tile, "
            "--plotter, --bleed, --marks and --spot are for prints");
    }
    auto [print, drawing] = plan_print(options);
    const Document loaded = load(options.pattern, telling);
    Diagnostics diagnostics;
    print.style = read_style(loaded.pattern(), options.dpi, diagnostics);
    diagnostics.throw_if_errors();
    require_straight(loaded, print.style, "models are");
    print.title = loaded.pattern().text("title");
    print.made = made_with(options, loaded.grammar());
    std::optional<Progress> progress;
    watch_drawing(loaded.grammar(), telling, progress, drawing);
    const ModelReport report = draw_model(loaded.grammar(), std::move(print), drawing, format, given.output);
    progress.reset();
    telling.say("{}, {}\n", counted(report.triangles, "triangle"), counted(report.materials, "material"));
}

}  // namespace

PlannedPrint plan_print(const DrawSettings& options) {
    const auto format = print_format(options.output);
    if (!format) {
        std::error_code error;
        if (std::filesystem::is_directory(options.output, error)) {
            throw UsageError(fmt::format("-o {}: this is a folder; a print is a file such as {}", options.output,
                                         (std::filesystem::path(options.output) / "print.svg").string()));
        }
        throw UsageError(fmt::format(
            "-o {}: unknown extension; a print is .svg, .pdf, .png, .tif, .jpg, .exr, .hpgl, .plt, .gcode or .nc, a "
            "model .obj or .glb",
            options.output));
    }
    if (!(options.dpi >= 1 && options.dpi <= 10'000)) throw UsageError("--dpi: between 1 and 10000");
    if (!std::isfinite(options.rotate)) throw UsageError("--rotate: expected degrees");
    PlannedPrint planned;
    Print& print = planned.print;
    DrawOptions& drawing = planned.drawing;
    print.page = page_of(options);
    print.dpi = options.dpi;
    const bool pixels = !is_vector(*format);
    if (pixels && std::max(print.page.width, print.page.height) * options.dpi / 25.4 > 200'000) {
        throw UsageError(
            "the picture would be over 200,000 pixels wide or high: a smaller --size or --dpi is needed");
    }
    drawing.format = *format;
    drawing.monitor = stop_monitor();
    drawing.placement.rotate = options.rotate;
    drawing.placement.mirror = options.mirror;
    if (options.step) {
        drawing.placement.step = length("--step", *options.step, options.dpi);
        if (!(*drawing.placement.step >= 1e-9 && *drawing.placement.step <= 10'000)) {
            throw UsageError(
                fmt::format("--step {}: a step is at least 10^-9 mm and at most 10 m long", *options.step));
        }
    }
    if (options.window) {
        drawing.window = parse_window(*options.window);
        if (!drawing.window) {
            throw UsageError(
                fmt::format("--window {}: expected X0,Y0,X1,Y1 in turtle steps, numbers of any length, X0 below X1 "
                            "and Y0 below Y1",
                            *options.window));
        }
    }
    Press& press = print.press;
    press.bleed = length("--bleed", options.bleed, options.dpi);
    press.marks = options.marks;
    press.cmyk = options.cmyk;
    press.bits = options.bits;
    press.icc = options.icc;
    as_usage([&] {
        press.spots = parse_spots(options.spots);
        if (!options.screen.empty()) press.screen = parse_screen(options.screen);
        if (press.screen.kind == Screen::Kind::halftone) Screener(press.screen, 1, options.dpi);
        check_press(press, *format);
    });
    const bool is_trimmed = press.bleed > 0 || press.marks;
    if (is_trimmed && (options.plotter || options.tile)) {
        throw UsageError("--bleed and --marks are for a print that is trimmed: not for a plot, and not for tiles");
    }
    if (!options.generations.empty() &&
        (is_trimmed || !press.spots.empty() || !press.cmyk.empty() || press.bits != 8)) {
        throw UsageError(
            "--generations: a sheet of drawings is made without --bleed, --marks, --spot, --cmyk and --bits");
    }
    drawing.threads = options.threads;
    drawing.budget = options.budget;
    drawing.compression = options.compression;
    drawing.only_dots = is_only(options.dots.value_or(""));
    if (options.dot_spacing) {
        drawing.dot_spacing = length("--dot-spacing", *options.dot_spacing, options.dpi);
        if (!(*drawing.dot_spacing > 0 && *drawing.dot_spacing <= 10'000)) {
            throw UsageError(fmt::format("--dot-spacing {}: above 0, and at most 10 m", *options.dot_spacing));
        }
        if (options.step) throw UsageError("--dot-spacing: says how long a step is; --step does, too");
    }
    if (!options.border.empty() && options.border != "kaavi") {
        throw UsageError(fmt::format("--border {}: expected kaavi", options.border));
    }
    drawing.border = !options.border.empty();
    if (!options.colour_by.empty() && options.colour_by != "strand") {
        throw UsageError(fmt::format("--colour-by {}: expected strand", options.colour_by));
    }
    drawing.colours_strokes = !options.colour_by.empty();
    if (options.animate) {
        if (*format != PrintFormat::svg) throw UsageError("--animate: a print that draws itself is .svg");
        double seconds = 20;
        const std::string& text = *options.animate;
        const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), seconds);
        if ((!text.empty() && (error != std::errc() || end != text.data() + text.size())) ||
            !(seconds > 0 && seconds <= 86'400)) {
            throw UsageError(fmt::format("--animate {}: seconds, above 0 and at most a day", text));
        }
        print.animation = seconds;
    }
    if (options.tile) {
        TileOptions tiles;
        tiles.sheet = sheet_of("--tile", *options.tile, options.dpi);
        tiles.overlap = length("--overlap", options.overlap, options.dpi);
        drawing.tiles = tiles;
        as_usage([&] { tiles_of(print.page, tiles); });
        if (drawing.format == PrintFormat::hpgl || drawing.format == PrintFormat::gcode || options.plotter) {
            throw UsageError("--tile: a plot is not cut into sheets");
        }
    }
    plan_plot(options, *format, drawing);
    return planned;
}

void draw_print(const DrawSettings& given, const Telling& telling) {
    const auto format = print_format(given.output);
    if (format && info(*format).kind == FormatKind::model) return draw_model(given, *format, telling);
    DrawSettings options = given;
    if (is_gif(given.output)) {
        if (given.generations.empty()) {
            throw UsageError("a .gif is an animation of growth: --generations A:B says from where to where");
        }
        options.output = "print.png";
    }
    auto [print, drawing] = plan_print(options);
    options.output = given.output;
    apply_dots(options);
    if (!options.view.empty()) options.pattern.more.push_back({"--view", "view", options.view});
    Document loaded = load(options.pattern, telling);
    Diagnostics diagnostics;
    print.style = read_style(loaded.pattern(), options.dpi, diagnostics);
    diagnostics.throw_if_errors();
    if ((options.dots || options.dot_spacing) && !print.style.dots) print.style.dots.emplace();
    check_space(options, print, drawing, loaded);
    print.title = loaded.pattern().text("title");
    print.pattern = loaded.pattern().source->text();
    print.made = made_with(options, loaded.grammar());
    if (!options.generations.empty()) {
        if (options.frames || is_gif(options.output)) return draw_growth(options, print, drawing, loaded, telling);
        if (options.frame_time || options.hold || options.fit_frames) {
            throw UsageError("--frame-time, --hold and --fit-frames need a .gif or --frames");
        }
        return draw_generations(options, print, drawing, loaded, telling);
    }
    if (options.frames) throw UsageError("--frames: goes with --generations A:B");
    if (options.frame_time || options.hold || options.fit_frames) {
        throw UsageError("--frame-time, --hold and --fit-frames need --generations A:B and a .gif or --frames");
    }
    // Before the drawing, which may take long.
    if (!print.press.cmyk.empty()) check_cmyk_profile(print.press.cmyk);
    // Contexts are resolved before it is known how much there is to draw.
    std::optional<Progress> progress;
    watch_drawing(loaded.grammar(), telling, progress, drawing);
    if (!options.view.empty() && !loaded.grammar().is_spatial()) {
        telling.say("sikku: warning: this drawing lies in the plane, where --view changes nothing\n");
    }
    const bool wants_dots = print.style.dots.has_value();
    const Style style = print.style;
    const double dpi = print.dpi;
    const DrawReport report = draw(loaded.grammar(), std::move(print), drawing, options.output);
    progress.reset();
    if (report.leaves_pattern_out) {
        telling.say(
            "sikku: warning: {} does not hold the text of the pattern, which is over 60,000 bytes: `sikku "
            "show` cannot give it back\n",
            options.output);
    }
    if (wants_dots && report.dots == 0 && report.sheets == 0) {
        telling.say("sikku: warning: there are no dots: the lines enclose none\n");
    }
    if (report.is_empty) {
        telling.say("sikku: warning: the window contains no part of the drawing\n");
    } else if (report.is_blank) {
        telling.say(
            "sikku: warning: the picture looks empty: lines {:.2g} mm wide leave too little ink on pixels of {:.2g} "
            "mm; "
            "use {} or a lower -n\n",
            style.line_width({}, report.step), 25.4 / dpi,
            style.stroke.in_steps ? "a pen in millimetres (--set 'stroke=0.3mm')"
                                  : "a wider pen (--set 'stroke=0.5mm')");
    }
    if (report.plot) tell_plot(*report.plot, options.speeds, telling);
    if (report.sheets > 1) telling.say("{}\n", counted(report.sheets, "sheet"));
    if (report.overflows && report.sheets == 0) {
        telling.say(
            "sikku: warning: the drawing is {:.1f} x {:.1f} mm, the page has room for {:.1f} x {:.1f}: what lies "
            "outside is cut off\n",
            report.size.x, report.size.y, report.room.x, report.room.y);
    }
}

void add_draw(CLI::App& app, bool& quiet) {
    auto* command = app.add_subcommand("draw",
                                       "Draw a print: SVG, PDF, PNG, TIFF, JPEG, EXR, HP-GL or G-code; or a model: "
                                       "OBJ (with a .mtl beside it), glTF");
    auto options = std::make_shared<DrawSettings>();
    constexpr const char* kolams = "Kolams and growth";
    constexpr const char* plotters = "Plotters";
    constexpr const char* press = "Press";
    add_pattern_options(*command, options->pattern);
    command->add_option("-o,--output", options->output, "The file; its extension says which kind")->required();
    command
        ->add_option("--size", options->size, "A0 to A6, letter, legal, tabloid, or WIDTHxHEIGHT such as 300x300mm")
        ->capture_default_str();
    command->add_flag("--landscape", options->landscape, "The page lies on its side");
    command->add_option("--margin", options->margin, "On all four sides")->capture_default_str();
    auto* fit = command->add_flag("--fit", options->fit, "Fill the page within its margins (default)");
    command->add_option("--step", options->step, "Length of one turtle step on paper, instead of --fit")
        ->excludes(fit);
    command
        ->add_option("--window", options->window,
                     "The part X0,Y0,X1,Y1 of the drawing, in turtle steps, fills the page; of lines in one "
                     "pen, at any derivation length")
        ->type_name("X0,Y0,X1,Y1")
        ->excludes(fit);
    command->add_option("--rotate", options->rotate, "Degrees anticlockwise")->capture_default_str();
    command->add_flag("--mirror", options->mirror, "Left and right exchanged, before --rotate");
    command
        ->add_option("--view", options->view,
                     "Of drawings in space: degrees around and up, or front, side or top; and, if you like, "
                     "perspective and from how many radii (4)")
        ->type_name("AZIMUTH,ELEVATION[,perspective[,DISTANCE]]");
    command
        ->add_option("--dots", options->dots,
                     "Draw a kolam's dots: in a size and colour (0.2 step white, 2mm), or only them, to "
                     "practise on (only)")
        ->expected(0, 1)
        ->type_name("[SIZE COLOUR|only]")
        ->group(kolams);
    command->add_option("--dot-spacing", options->dot_spacing, "Length between two dots on paper, instead of --fit")
        ->excludes(fit)
        ->group(kolams);
    command->add_option("--border", options->border, "kaavi: a frame of red earth lines")->group(kolams);
    command->add_option("--colour-by", options->colour_by, "strand: each line in a colour of its own")->group(kolams);
    command
        ->add_option("--generations", options->generations,
                     "Derivation lengths A to B, side by side; one after the other as .gif")
        ->type_name("A:B")
        ->group(kolams);
    command
        ->add_flag("--frames", options->frames,
                   "Of --generations: each a file of its own, all in the same place (growth-07.png)")
        ->group(kolams);
    command
        ->add_option("--frame-time", options->frame_time,
                     "Seconds that each generation is shown (0.5); of --generations A:B -o growth.gif")
        ->group(kolams);
    command->add_option("--hold", options->hold, "Minimum seconds for the last generation of a .gif (2)")
        ->group(kolams);
    command
        ->add_flag(
            "--fit-frames", options->fit_frames,
            "Fit each frame of --generations to the page separately; by default all share one scale and position, "
            "which shows growth")
        ->group(kolams);
    command->add_option("--animate", options->animate, "SVG that draws itself, line by line, in so many seconds (20)")
        ->expected(0, 1)
        ->type_name("[SECONDS]")
        ->group(kolams);
    command
        ->add_option("--tile", options->tile,
                     "Cut the print into sheets of this size, each a file, to be glued together")
        ->type_name("SIZE")
        ->group(kolams);
    command->add_option("--overlap", options->overlap, "Of these sheets")->capture_default_str()->group(kolams);
    command
        ->add_flag("--plotter", options->plotter,
                   "Nothing twice, few lifts of the pen, short ways between; HP-GL and G-code always are so")
        ->group(plotters);
    command->add_option("--split", options->split, "Length of the longest stroke, for controllers that stutter")
        ->group(plotters);
    command->add_flag("--travel", options->travel, "Show the ways of the lifted pen in a layer of their own")
        ->group(plotters);
    command->add_option("--pen-speed", options->speeds.drawing, "Drawing, mm a second; for the estimate and G-code")
        ->capture_default_str()
        ->group(plotters);
    command->add_option("--travel-speed", options->speeds.travelling, "Lifted, mm a second")
        ->capture_default_str()
        ->group(plotters);
    command->add_option("--lift-time", options->speeds.lift, "Seconds for lifting and lowering the pen")
        ->capture_default_str()
        ->group(plotters);
    command->add_option("--profile", options->profile, "Of G-code: grbl (M3 and M5 move the pen) or z")
        ->capture_default_str()
        ->group(plotters);
    command->add_option("--gcode-start", options->gcode_start, "Lines before the first stroke")->group(plotters);
    command->add_option("--gcode-end", options->gcode_end, "Lines after the last")->group(plotters);
    command->add_option("--bleed", options->bleed, "How far the ground goes on beyond the page, up to 100mm")
        ->capture_default_str()
        ->group(press);
    command->add_flag("--marks", options->marks, "Crop marks around the bleed; PDF")->group(press);
    command
        ->add_option("--spot", options->spots,
                     "An ink of its own for a colour of the drawing, such as Kaavi=#b3452c; PDF; may be repeated")
        ->type_name("NAME=COLOUR")
        ->allow_extra_args(false)
        ->group(press);
    command->add_option("--cmyk", options->cmyk, "Inks by this ICC profile instead of RGB; TIFF")
        ->type_name("FILE.icc")
        ->group(press);
    command->add_option("--bits", options->bits, "A channel: 8, or 1 for line art, best at 600 dpi and more; TIFF")
        ->check(CLI::IsMember({1, 8}))
        ->capture_default_str()
        ->group(press);
    command
        ->add_option("--screen", options->screen,
                     "Screening for --bits 1: threshold (default), diffusion, or a halftone of LPI lines per inch "
                     "(default: a twelfth of the dpi) at 45 degrees")
        ->type_name("threshold|diffusion|halftone[,LPI]")
        ->group(press);
    command->add_flag("--icc,!--no-icc", options->icc, "Pictures hold the ICC profile of their colours (default)")
        ->group(press);
    command->add_option("--dpi", options->dpi, "Pixels an inch of pictures, and of px in lengths")
        ->capture_default_str();
    command->add_option("--compression", options->compression, "Of PNG: 1, quick and large, to 9")
        ->check(CLI::Range(1, 9))
        ->capture_default_str();
    add_budget_option(*command, options->budget);
    command->add_option("-j,--jobs", options->threads, "Threads for pictures; 0: one for each core")
        ->check(CLI::Range(0, 1024))
        ->capture_default_str();
    command->footer(
        "Lengths are in mm, cm, in, pt or px. The file appears whole or not at all.\n\n"
        "Examples:\n"
        "  sikku draw snake-kolam -o snake.svg\n"
        "  sikku draw anklets-of-krishna -n 6 --size A1 --landscape -o anklets.pdf\n"
        "  sikku draw hilbert -n 60 --window -40,0,0,58 -o corner.svg\n"
        "  sikku draw snake-kolam --dots --border kaavi --animate -o snake.svg\n"
        "  sikku draw bush-3d --view 30,15,perspective -o bush.png\n"
        "  sikku draw bush-3d -o bush.glb\n"
        "  sikku draw bush-3d --generations 1:7 --size 100x100mm --dpi 100 -o growth.gif\n"
        "  sikku draw spiral-tiling -o spiral.gcode --profile z\n"
        "  sikku draw my.lsys --step 5mm --set 'stroke=0.7mm navy' -o my.png --dpi 600");
    command->callback([options, &quiet] { draw_print(*options, {.quiet = quiet, .listener = {}, .watch = {}}); });
}

}  // namespace sikku
