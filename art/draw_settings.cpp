#include "art/draw_settings.h"

#include "art/raster/raster.h"
#include "art/style/length.h"
#include "engine/base/diagnostic.h"
#include "engine/base/keys.h"
#include "engine/derivation/forecast.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <initializer_list>
#include <string_view>
#include <system_error>
#include <vector>

namespace sikku {
namespace {

constexpr double longest = 10'000;  // millimetres: wider than any press or plotter

int to_int(const std::string& text) {
    return static_cast<int>(to_number(text));
}

bool is_true(const std::string& text) {
    return text == "true";
}

double length(const char* option, const std::string& text, double dpi) {
    const auto value = parse_length(text, dpi);
    if (!value) refuse_option(option, text, "expected a length such as 5mm, 1.5cm, 2in, 12pt or 300px");
    return *value;
}

Page sheet(const char* option, const std::string& text, double dpi) {
    const auto size = parse_size(text, dpi);
    if (!size) {
        refuse_option(
            option, text,
            "expected A0 to A10, B0 to B10, C0 to C10, JIS-B0 to JIS-B10, RA0 to RA4, SRA0 to SRA4, letter, legal, "
            "tabloid, executive, ANSI-A to ANSI-E, Arch-A to Arch-E, or WIDTHxHEIGHT such as 50x70cm");
    }
    if (!(size->x >= 1 && size->y >= 1 && size->x <= longest && size->y <= longest)) {
        refuse_option(option, text, "expected a page between 1 mm and 10 m wide and high");
    }
    return {size->x, size->y, 10.0};
}

void set_step(DrawSettings& settings, const std::string& text) {
    settings.step = length("step", text, settings.dpi);
    if (!(*settings.step >= 1e-9 && *settings.step <= longest)) {
        refuse_option("step", text, "expected a step of at least 10^-9 mm and at most 10 m");
    }
}

void set_window(DrawSettings& settings, const std::string& text) {
    settings.window = parse_window(text);
    settings.window_text = text;
    if (!settings.window) {
        refuse_option("window", text,
                      "expected X0,Y0,X1,Y1 in turtle steps, numbers of any length, X0 below X1 and Y0 below Y1");
    }
}

void set_repeat(DrawSettings& settings, const std::string& text) {
    settings.repeat = parse_repeat(text);
    if (settings.repeat) return;
    std::string names;
    for (const std::string_view name : repeat_groups()) names += fmt::format("{}{}", names.empty() ? "" : ", ", name);
    refuse_option("repeat", text,
                  fmt::format("expected a group and its cells, such as frieze:5, p4m:3x4 or ring:8, up to {} copies, "
                              "then ,gap=2 in steps or ,gap=5%; groups are {}",
                              most_copies, names));
}

/// Parses `only`, `SIZE COLOUR`, or `only SIZE COLOUR`.
void set_dots(DrawSettings& settings, const std::string& text) {
    settings.only_dots = text == "only" || text.starts_with("only ");
    settings.dots = settings.only_dots ? text.substr(std::min<std::size_t>(text.size(), 5)) : text;
}

void set_dot_spacing(DrawSettings& settings, const std::string& text) {
    settings.dot_spacing = length("dot-spacing", text, settings.dpi);
    if (!(*settings.dot_spacing > 0 && *settings.dot_spacing <= longest)) {
        refuse_option("dot-spacing", text, "expected a length above 0 and at most 10 m");
    }
}

/// Parses `A:B` or `A`.
void set_generations(DrawSettings& settings, const std::string& text) {
    const std::size_t colon = text.find(':');
    const auto whole = [&](std::string_view part) -> std::int64_t {
        std::int64_t value = -1;
        const auto [end, error] = std::from_chars(part.data(), part.data() + part.size(), value);
        if (error != std::errc() || end != part.data() + part.size() || value < 0) {
            refuse_option("generations", text, "expected two derivation lengths such as 0:4");
        }
        return value;
    };
    const std::int64_t first = whole(std::string_view(text).substr(0, colon));
    const std::int64_t last = colon == std::string::npos ? first : whole(std::string_view(text).substr(colon + 1));
    if (last > most_steps) {
        refuse_option("generations", text, fmt::format("expected derivation lengths up to {}", most_steps));
    }
    settings.generations = {first, last};
}

void set_animation(DrawSettings& settings, const std::string& text) {
    double seconds = 20;
    if ((!text.empty() && !read_number(text, seconds)) || !(seconds > 0 && seconds <= 86'400)) {
        refuse_option("animate", text, "expected seconds, above 0 and at most a day");
    }
    settings.animation = seconds;
}

void set_lesson(DrawSettings& settings, const std::string& text) {
    double seconds = 3;
    if ((!text.empty() && !read_number(text, seconds)) || !(seconds >= 0.1 && seconds <= 600)) {
        refuse_option("lesson", text, "expected seconds for each stroke, 0.1 to 600");
    }
    settings.lesson = seconds;
}

/// Parses `SPACING`, followed by `ANGLE` and `cross` in either order.
void set_hatch(DrawSettings& settings, const std::string& text) {
    Hatch& hatch = settings.hatch.emplace();
    for (std::size_t begin = 0; begin < text.size();) {
        const std::size_t end = std::min(text.find(',', begin), text.size());
        const std::string part = text.substr(begin, end - begin);
        if (begin == 0) {
            hatch.spacing = length("hatch", part, settings.dpi);
            if (!(hatch.spacing >= 0.05 && hatch.spacing <= longest)) {
                refuse_option("hatch", text, "expected a spacing of at least 0.05mm and at most 10 m");
            }
        } else if (part == "cross") {
            hatch.is_crossed = true;
        } else if (!read_number(part, hatch.angle) || !(std::fabs(hatch.angle) <= 360)) {
            refuse_option("hatch", text,
                          "expected a spacing, then an angle in degrees or 'cross': 0.5mm,30 or 0.5mm,cross");
        }
        begin = end + 1;
    }
}

void set_pen_width(DrawSettings& settings, const std::string& text) {
    settings.pen_width = length("pen-width", text, settings.dpi);
    if (!(settings.pen_width >= 0.05 && settings.pen_width <= 100)) {
        refuse_option("pen-width", text, "expected a width between 0.05mm and 100mm");
    }
}

void set_paper(DrawSettings& settings, const std::string& text) {
    settings.paper = parse_hpgl_paper(text, settings.dpi);
    if (!settings.paper) {
        refuse_option("hpgl-paper", text,
                      "expected A4, A3, letter or tabloid, or the limits of the plotter: 400x276mm[,centre]");
    }
}

/// Parses a sheet size and the margin that the printer cannot reach.
void set_tile(DrawSettings& settings, const std::string& text) {
    const std::size_t comma = text.find(',');
    settings.tile = sheet("tile", text.substr(0, comma), settings.dpi);
    settings.tile->margin = 5.0;
    if (comma == std::string::npos) return;
    settings.tile->margin = length("tile", text.substr(comma + 1), settings.dpi);
    if (settings.tile->margin < 0) refuse_option("tile", text, "expected a margin of 0 or more");
}

void set_profile(DrawSettings& settings, const std::string& text) {
    const auto profile = gcode_profile(text);
    if (!profile) refuse_option("profile", text, "expected grbl or z");
    settings.gcode = *profile;
}

/// Runs a parser and reports its errors as errors of the option.
template <typename Parse>
void parse_press(const char* option, const std::string& text, const Parse& parse) {
    try {
        parse();
    } catch (const SettingError&) {
        throw;
    } catch (const std::runtime_error& error) {
        refuse_option(option, text, error.what());
    }
}

void set_word(const char* option, std::string_view word, const std::string& text, bool& value) {
    if (text != word) refuse_option(option, text, fmt::format("expected {}", word));
    value = true;
}

using S = DrawSettings;
using Text = const std::string&;
using enum OptionKind;

constexpr const char* kolams = "Kolams and growth";
constexpr const char* plotters = "Plotters";
constexpr const char* presses = "Press";
constexpr const char* pictures = "Pictures";

const std::array own_rows = {
    Option<S>{
        {.name = "size",
         .help = "page size: A0 to A10, B0 to B6, SRA0 to SRA4, letter, legal, tabloid, ANSI-A to ANSI-E, Arch-A to "
                 "Arch-E, or WIDTHxHEIGHT such as 50x70cm; also C, JIS-B and RA sizes (A4)",
         .value = "SIZE"},
        [](S& s, Text t) {
            const Page page = sheet("size", t, s.dpi);
            s.page.width = page.width;
            s.page.height = page.height;
        }},
    Option<S>{{.name = "landscape", .help = "landscape page", .kind = flag},
              [](S& s, Text t) { s.landscape = is_true(t); }},
    Option<S>{{.name = "margin", .help = "margin on all four sides (10mm)", .value = "LENGTH"},
              [](S& s, Text t) {
                  s.page.margin = length("margin", t, s.dpi);
                  if (s.page.margin < 0) refuse_option("margin", t, "expected 0 or more");
              }},
    Option<S>{{.name = "fit", .help = "fill the page within its margins (default)", .kind = flag},
              [](S& s, Text t) { s.fit = is_true(t); }},
    Option<S>{{.name = "compose",
               .help = "place the drawing by its shape and mass around the optical centre, with room to breathe, "
                       "instead of filling the margins",
               .kind = flag},
              [](S& s, Text t) { s.composes = is_true(t); }},
    Option<S>{{.name = "step",
               .help = "length of one turtle step on paper, instead of fitting the page",
               .value = "LENGTH"},
              set_step},
    Option<S>{{.name = "window",
               .help = "part of the drawing that fills the page, in turtle steps; for lines in one pen, at any "
                       "derivation length",
               .value = "X0,Y0,X1,Y1"},
              set_window},
    Option<S>{{.name = "rotate",
               .help = "rotation in degrees anticlockwise (0)",
               .value = "DEGREES",
               .unit = "deg",
               .kind = number},
              [](S& s, Text t) { s.rotate = to_number(t); }},
    Option<S>{{.name = "mirror", .help = "mirror left and right, before rotating", .kind = flag},
              [](S& s, Text t) { s.mirror = is_true(t); }},
    Option<S>{{.name = "view",
               .help = "camera of drawings in space: degrees around and up, or front, side or top; then, for a "
                       "perspective, its distance in radii of the drawing (4)",
               .value = "AZIMUTH,ELEVATION[,perspective[,DISTANCE]]",
               .sets_more = true,
               .is_key = true},
              [](S& s, Text t) { s.view = t; }},
    Option<S>{{.name = "dots",
               .help = "draw the dots of a kolam, in a size and colour such as 2mm white; or only the dots, for "
                       "practising",
               .value = "[SIZE COLOUR|only]",
               .group = kolams,
               .sets_more = true,
               .is_key = true},
              set_dots},
    Option<S>{{.name = "dot-spacing",
               .help = "distance between neighbouring dots of a kolam on paper, instead of fitting the page",
               .value = "LENGTH",
               .group = kolams},
              set_dot_spacing},
    Option<S>{{.name = "border",
               .help = "draw a frame: kaavi, padi, lotus, rope, diamonds, waves, or a pattern file, whose drawing is "
                       "repeated, with another for the corners",
               .value = "NAME|FILE[,CORNER]",
               .group = kolams,
               .is_key = true},
              [](S& s, Text t) { s.border = t; }},
    Option<S>{{.name = "repeat",
               .help = "repeat the drawing: frieze:5 for a doorstep (also -p11g, -p1m1, -p11m, -p2, -p2mg, -p2mm), a "
                       "wallpaper group p1 to p6m with its cells such as p4m:3x4, or ring:8; gap in steps or percent "
                       "(8%)",
               .value = "GROUP[:COUNT][,gap=GAP]",
               .group = kolams},
              set_repeat},
    Option<S>{{.name = "title-line",
               .help = "write a line below the drawing, on the left (the pattern's title)",
               .value = "[TEXT]",
               .group = kolams},
              [](S& s, Text t) { s.title_line = t; }},
    Option<S>{{.name = "edition",
               .help = "write the number of the print below the drawing, on the right, such as 3/50",
               .value = "TEXT",
               .group = kolams},
              [](S& s, Text t) { s.edition = t; }},
    Option<S>{{.name = "colour-by", .help = "draw each line in its own colour", .value = "strand", .group = kolams},
              [](S& s, Text t) { set_word("colour-by", "strand", t, s.colours_strokes); }},
    Option<S>{{.name = "generations",
               .help = "derivation lengths A to B: side by side on one sheet, or one after the other in a .gif",
               .value = "A:B",
               .group = kolams,
               .is_alone = true},
              set_generations},
    Option<S>{{.name = "frames",
               .help = "write each generation to its own file, such as growth-07.png",
               .group = kolams,
               .kind = flag,
               .is_alone = true},
              [](S& s, Text t) { s.frames = is_true(t); }},
    Option<S>{{.name = "frame-time",
               .help = "seconds per generation of a .gif, 0.01 to 600 (0.5)",
               .value = "SECONDS",
               .group = kolams,
               .unit = "s",
               .kind = number,
               .least = 0.01,
               .most = 600,
               .is_alone = true},
              [](S& s, Text t) { s.frame_time = to_number(t); }},
    Option<S>{{.name = "hold",
               .help = "minimum seconds for the last generation of a .gif, 0.01 to 600 (2)",
               .value = "SECONDS",
               .group = kolams,
               .unit = "s",
               .kind = number,
               .least = 0.01,
               .most = 600,
               .is_alone = true},
              [](S& s, Text t) { s.hold = to_number(t); }},
    Option<S>{{.name = "fit-frames",
               .help = "fit each generation to the page separately; by default all share one scale and position, "
                       "which shows growth",
               .group = kolams,
               .kind = flag,
               .is_alone = true},
              [](S& s, Text t) { s.fit_frames = is_true(t); }},
    Option<S>{{.name = "animate",
               .help = "SVG that draws itself, line by line, in this many seconds (20)",
               .value = "[SECONDS]",
               .group = kolams,
               .unit = "s"},
              set_animation},
    Option<S>{{.name = "lesson",
               .help = "drawing lesson: the dots, then stroke after stroke as a hand draws them, with numbers and "
                       "arrows; pages of a PDF, an animated SVG or .gif with so many seconds per stroke (3), or the "
                       "cells of a picture",
               .value = "[SECONDS]",
               .group = kolams,
               .unit = "s",
               .is_alone = true},
              set_lesson},
    Option<S>{{.name = "tile",
               .help = "cut the print into sheets of this size, to be glued together: pages of a PDF after an "
                       "overview, or files; MARGIN is the area the printer cannot reach (5mm)",
               .value = "SIZE[,MARGIN]",
               .group = kolams,
               .is_alone = true},
              set_tile},
    Option<S>{{.name = "overlap",
               .help = "overlap of neighbouring sheets (10mm)",
               .value = "LENGTH",
               .group = kolams,
               .is_alone = true},
              [](S& s, Text t) { s.overlap = length("overlap", t, s.dpi); }},
    Option<S>{{.name = "plotter",
               .help = "draw nothing twice, with few pen lifts and little pen-up travel; HP-GL and G-code always do",
               .group = plotters,
               .kind = flag},
              [](S& s, Text t) { s.plotter = is_true(t); }},
    Option<S>{{.name = "split",
               .help = "maximum length of a stroke, for controllers that stutter",
               .value = "LENGTH",
               .group = plotters},
              [](S& s, Text t) {
                  s.split = length("split", t, s.dpi);
                  if (!(s.split > 0)) refuse_option("split", t, "expected a length above 0");
              }},
    Option<S>{{.name = "pen-width",
               .help = "width of the plotter's pen; wider strokes take several passes (each stroke's own width)",
               .value = "WIDTH",
               .group = plotters},
              set_pen_width},
    Option<S>{{.name = "hatch",
               .help = "hatch filled shapes: spacing (one pen), angle (45) or both directions, such as 0.5mm,30 or "
                       "0.5mm,cross",
               .value = "[SPACING[,ANGLE|cross]]",
               .group = plotters},
              set_hatch},
    Option<S>{{.name = "pens",
               .help = "number of pens the plotter holds, 1 to 256; more colours are merged into the most similar "
                       "(one per colour)",
               .value = "N",
               .group = plotters,
               .kind = whole,
               .least = 1,
               .most = 256},
              [](S& s, Text t) { s.pens = to_int(t); }},
    Option<S>{{.name = "hpgl-paper",
               .help = "sheet in an HP 7475A (A4, A3, letter, tabloid), or the limits of another plotter, with "
                       ",centre if its origin is in the middle (the page from its corner)",
               .value = "SIZE[,centre]",
               .group = plotters},
              set_paper},
    Option<S>{{.name = "travel", .help = "show pen-up travel in a separate layer", .group = plotters, .kind = flag},
              [](S& s, Text t) { s.travel = is_true(t); }},
    Option<S>{{.name = "pen-speed",
               .help = "drawing speed in mm/s, for the time estimate and G-code (40)",
               .value = "SPEED",
               .group = plotters,
               .unit = "mm/s",
               .kind = number,
               .least = 1e-3,
               .most = 1e6},
              [](S& s, Text t) { s.speeds.drawing = to_number(t); }},
    Option<S>{{.name = "travel-speed",
               .help = "pen-up speed in mm/s (80)",
               .value = "SPEED",
               .group = plotters,
               .unit = "mm/s",
               .kind = number,
               .least = 1e-3,
               .most = 1e6},
              [](S& s, Text t) { s.speeds.travelling = to_number(t); }},
    Option<S>{{.name = "lift-time",
               .help = "seconds for lifting and lowering the pen (0.3)",
               .value = "SECONDS",
               .group = plotters,
               .unit = "s",
               .kind = number,
               .least = 0,
               .most = 3600},
              [](S& s, Text t) { s.speeds.lift = to_number(t); }},
    Option<S>{{.name = "profile",
               .help = "kind of G-code machine: grbl (M3 and M5 move the pen) or z (grbl)",
               .value = "grbl|z",
               .group = plotters},
              set_profile},
    Option<S>{
        {.name = "gcode-start", .help = "G-code lines before the first stroke", .value = "LINES", .group = plotters},
        [](S& s, Text t) { s.gcode.start = t; }},
    Option<S>{
        {.name = "gcode-end", .help = "G-code lines after the last stroke", .value = "LINES", .group = plotters},
        [](S& s, Text t) { s.gcode.end = t; }},
    Option<S>{{.name = "bleed",
               .help = "extension of the ground beyond the page, up to 100mm (0mm)",
               .value = "LENGTH",
               .group = presses},
              [](S& s, Text t) { s.press.bleed = length("bleed", t, s.dpi); }},
    Option<S>{{.name = "marks", .help = "crop marks outside the bleed; PDF", .group = presses, .kind = flag},
              [](S& s, Text t) { s.press.marks = is_true(t); }},
    Option<S>{{.name = "spot",
               .help = "separate ink for a colour of the drawing, such as Kaavi=#b3452c; PDF; may be repeated",
               .value = "NAME=COLOUR",
               .group = presses,
               .is_list = true},
              [](S& s, Text t) { parse_press("spot", t, [&] { add_spot(s.press.spots, parse_spot(t)); }); }},
    Option<S>{{.name = "cmyk",
               .help = "convert pixels to the inks of this ICC profile; TIFF",
               .value = "FILE.icc",
               .group = presses},
              [](S& s, Text t) { s.press.cmyk = t; }},
    Option<S>{{.name = "bits",
               .help = "bits per channel: 8, or 1 for line art, best at 600 dpi and more; TIFF (8)",
               .value = "1|8",
               .group = presses,
               .kind = whole},
              [](S& s, Text t) {
                  s.press.bits = to_int(t);
                  if (s.press.bits != 1 && s.press.bits != 8) refuse_option("bits", t, "expected 1 or 8");
              }},
    Option<S>{
        {.name = "screen",
         .help = "screening of 1-bit pictures: threshold (default), diffusion, or a halftone with LPI lines per "
                 "inch (a twelfth of the dpi) at 45 degrees",
         .value = "threshold|diffusion|halftone[,LPI]",
         .group = presses},
        [](S& s, Text t) {
            parse_press("screen", t, [&] {
                s.press.screen = parse_screen(t);
                if (s.press.screen.kind == Screen::Kind::halftone) Screener(s.press.screen, 1, s.dpi);
            });
        }},
    Option<S>{{.name = "icc",
               .help = "embed the ICC profile of the colours in pictures (default)",
               .group = presses,
               .kind = flag,
               .is_on = true},
              [](S& s, Text t) { s.press.icc = is_true(t); }},
    Option<S>{{.name = "dpi",
               .help = "pixels per inch of pictures, and of px in lengths, 1 to 10,000 (300)",
               .value = "DPI",
               .group = pictures,
               .unit = "dpi",
               .kind = number,
               .least = 1,
               .most = 10'000},
              [](S& s, Text t) { s.dpi = to_number(t); }},
    Option<S>{{.name = "compression",
               .help = "PNG compression, 1 (fast) to 9 (small) (6, or 4 for lines drawn by hand)",
               .value = "LEVEL",
               .group = pictures,
               .kind = whole,
               .least = 1,
               .most = 9},
              [](S& s, Text t) { s.compression = to_int(t); }},
    Option<S>{{.name = "jobs",
               .help = "threads for pictures; 0: one per core (0)",
               .value = "N",
               .group = pictures,
               .kind = whole,
               .most = 1024,
               .is_alone = true,
               .letter = 'j'},
              [](S& s, Text t) { s.threads = to_int(t); }},
    Option<S>{budget_option, [](S& s, Text t) { s.budget = read_budget(t); }},
};

}  // namespace

namespace {

void set_key(S& settings, std::string_view name, Text text) {
    settings.keys.push_back({std::string(name), std::string(name), text});
}

/// The rows above, and one for each further key of the language that art reads.
std::vector<Option<S>> make_table() {
    std::vector<Option<S>> table(own_rows.begin(), own_rows.end());
    for (const std::string_view name : keys_of(KeyOwner::art)) {
        const auto has_name = [&](const Option<S>& row) { return row.info.name == name; };
        if (std::any_of(table.begin(), table.end(), has_name)) continue;
        // Galleries have the keys themselves.
        table.push_back({key_option(name, "Style", true), nullptr, set_key});
    }
    return table;
}

}  // namespace

std::span<const Option<DrawSettings>> draw_options() {
    static const std::vector<Option<S>> table = make_table();
    return table;
}

DrawSettings read_draw_settings(const OptionValues& values) {
    DrawSettings settings;
    // The resolution comes first: lengths in px and halftone screens depend on it.
    for (const OptionValue& value : values) {
        if (value.name == "dpi") apply_options(draw_options(), {value}, settings);
    }
    apply_options(draw_options(), values, settings);
    settings.gcode.drawing_feed = 60 * settings.speeds.drawing;
    settings.gcode.travel_feed = 60 * settings.speeds.travelling;
    Page& page = settings.page;
    if (settings.landscape && page.height > page.width) std::swap(page.width, page.height);
    if (!(2 * page.margin < std::min(page.width, page.height))) {
        refuse_option("margin", fmt::format("{:g}mm", page.margin),
                      fmt::format("the margins leave nothing of a page of {:g} x {:g} mm", page.width, page.height));
    }
    return settings;
}

TileOptions tile_options(const DrawSettings& settings) {
    TileOptions options{.sheet = *settings.tile};
    options.overlap = settings.overlap.value_or(options.overlap);
    return options;
}

DrawingOptions drawing_options(const DrawSettings& settings, const Document& document) {
    DrawingOptions options;
    options.placement.rotate = settings.rotate;
    options.placement.mirror = settings.mirror;
    options.placement.step = settings.step;
    options.window = settings.window;
    options.only_dots = settings.only_dots;
    options.colours_strokes = settings.colours_strokes;
    if (settings.title_line) {
        options.title_line = settings.title_line->empty() ? document.text("title") : *settings.title_line;
        if (options.title_line.empty()) {
            options.title_line = std::filesystem::path(document.source().name()).stem().string();
        }
    }
    options.edition = settings.edition;
    options.repeat = settings.repeat;
    options.composes = settings.composes;
    options.budget = settings.budget;
    return options;
}

Style read_print_style(const Document& document, const DrawSettings& settings) {
    Document drawn = document;
    const auto set = [&](const char* key, const std::string& value) {
        try {
            drawn = drawn.with({{key, key, value}});
        } catch (const PatternError& error) {
            throw SettingError(key, value, error.diagnostics().front().message);
        }
    };
    // Dots of the default size and colour cannot be written as a value of the key.
    if (settings.dots && !settings.dots->empty()) set("dots", *settings.dots);
    if (settings.border) set("border", *settings.border);
    if (!settings.view.empty()) set("view", settings.view);
    Diagnostics diagnostics;
    Style style = read_style(drawn.pattern(), settings.dpi, diagnostics);
    diagnostics.throw_if_errors();
    if ((settings.dots || settings.dot_spacing || settings.lesson) && !style.dots) style.dots.emplace();
    return style;
}

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

void check_model(const DrawSettings& settings) {
    constexpr const char* reason = "a model has no page and no camera; this option is for prints";
    refuse_first({{settings.window.has_value(), "window", reason},
                  {!settings.view.empty(), "view", reason},
                  {settings.plotter, "plotter", reason},
                  {settings.hatch.has_value(), "hatch", reason},
                  {settings.pen_width > 0, "pen-width", reason},
                  {settings.pens > 0, "pens", reason},
                  {settings.paper.has_value(), "hpgl-paper", reason},
                  {settings.tile.has_value(), "tile", reason},
                  {settings.dots.has_value(), "dots", reason},
                  {settings.dot_spacing.has_value(), "dot-spacing", reason},
                  {settings.animation.has_value(), "animate", reason},
                  {settings.generations.has_value(), "generations", reason},
                  {settings.frames, "frames", reason},
                  {settings.frame_time.has_value(), "frame-time", reason},
                  {settings.hold.has_value(), "hold", reason},
                  {settings.fit_frames, "fit-frames", reason},
                  {settings.lesson.has_value(), "lesson", reason},
                  {settings.border.has_value(), "border", reason},
                  {settings.title_line.has_value(), "title-line", reason},
                  {settings.repeat.has_value(), "repeat", reason},
                  {settings.composes, "compose", reason},
                  {!settings.edition.empty(), "edition", reason},
                  {settings.colours_strokes, "colour-by", reason},
                  {settings.press.marks, "marks", reason},
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
         {settings.fit && settings.composes, "compose", "cannot be combined with 'fit', which fills the margins"},
         {settings.window && settings.composes, "compose", "a window fills the page"},
         {settings.window && settings.repeat, "repeat", "a window shows a part of one drawing, not of its copies"},
         {settings.fit && settings.dot_spacing, "dot-spacing", both},
         {settings.step && settings.dot_spacing, "dot-spacing",
          "cannot be combined with 'step': both set the step length"}});
}

void check_plot(const DrawSettings& settings, PrintFormat format) {
    const bool is_plot = settings.plotter || is_for_plotters(format);
    const bool is_drawn = format == PrintFormat::svg || format == PrintFormat::pdf;
    refuse_first({{settings.plotter && !is_vector(format), "plotter", "a plot is SVG, PDF, HP-GL or G-code"},
                  {settings.travel && !(is_plot && is_drawn), "travel", "needs 'plotter', and SVG or PDF"},
                  {settings.split > 0 && !is_plot, "split", "needs 'plotter'"},
                  {settings.hatch && !is_plot, "hatch", "needs 'plotter', HP-GL or G-code"},
                  {settings.pen_width > 0 && !is_plot, "pen-width", "needs 'plotter', HP-GL or G-code"},
                  {settings.pens > 0 && !is_plot, "pens", "needs 'plotter', HP-GL or G-code"},
                  {settings.paper && format != PrintFormat::hpgl, "hpgl-paper", "applies only to HP-GL"},
                  {settings.tile && is_plot, "tile", "tiles would cut the strokes of a plot"},
                  {settings.overlap && !settings.tile, "overlap", "needs 'tile'"},
                  {settings.window && is_plot, "window", "a window would cut the strokes of a plot"}});
}

void check_gif(const DrawSettings& settings) {
    constexpr const char* screen = "does not apply to a .gif, which is shown on screens";
    refuse_first({{settings.press.bleed > 0, "bleed", screen}, {settings.tile.has_value(), "tile", screen}});
    const PixelSize size = pixel_size(settings.page, settings.dpi);
    if (std::max(size.width, size.height) > 65'535 || std::int64_t{size.width} * size.height > 100'000'000) {
        refuse_option(
            "dpi", fmt::format("{:g}", settings.dpi),
            "a .gif has at most 65,535 pixels per side and 100 million in all; a smaller size or dpi is needed");
    }
}

void check_lesson(const DrawSettings& settings, PrintFormat format) {
    if (!settings.lesson) return;
    constexpr const char* alone = "cannot be combined with 'lesson', which has its own pages and order";
    refuse_first({{settings.plotter || is_for_plotters(format), "lesson",
                   "a lesson has colours, numbers and several steps; a plot is one drawing"},
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
                  {settings.press.marks, "marks", "the pages of a lesson are not trimmed"}});
    if (is_vector(format) || format == PrintFormat::gif) return;
    constexpr const char* filled = "each step of a lesson is scaled to fill its cell of the picture";
    refuse_first(
        {{settings.step.has_value(), "step", filled}, {settings.dot_spacing.has_value(), "dot-spacing", filled}});
}

void check_growth(const DrawSettings& settings, PrintFormat format) {
    const bool is_gif = format == PrintFormat::gif;
    const bool is_sheet = settings.generations && !is_gif && !settings.frames;
    refuse_first(
        {{is_gif && !settings.generations && !settings.lesson, "generations",
          "needed for a .gif, an animation of growth: A:B"},
         {settings.frames && !settings.generations, "frames", "needs 'generations'"},
         {settings.frames && is_gif, "frames", "a .gif contains all generations itself"},
         {settings.frame_time && settings.lesson, "frame-time", "a lesson has its own seconds per stroke"},
         {settings.frame_time && !is_gif, "frame-time", "applies only to a .gif"},
         {settings.hold && !is_gif, "hold", "applies only to a .gif"},
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
    if (info(format).kind == FormatKind::model) return check_model(settings);
    check_placement(settings);
    if (!is_vector(format) && std::max(settings.page.width, settings.page.height) * settings.dpi / 25.4 > 200'000) {
        refuse_option("dpi", fmt::format("{:g}", settings.dpi),
                      "the picture would be over 200,000 pixels wide or high; a smaller size or dpi is needed");
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
    refuse_first({{is_untrimmed && settings.press.bleed > 0, "bleed", trimmed},
                  {is_untrimmed && settings.press.marks, "marks", trimmed},
                  {settings.window && settings.border && *settings.border != "none", "border",
                   "a border frames the whole drawing; a window shows only part of it"},
                  {settings.animation && !info(format).is_animated, "animate", "only SVG can draw itself"}});
    check_lesson(settings, format);
    check_growth(settings, format);
}

}  // namespace sikku
