#include "art/product/draw_settings.h"

#include "art/drawing/colouring_drawing.h"
#include "art/font/font.h"
#include "art/print/tiles.h"
#include "art/relief/relief_options.h"
#include "art/style/length.h"
#include "engine/base/diagnostic.h"
#include "engine/base/keys.h"
#include "engine/base/text.h"
#include "engine/derivation/forecast.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <string_view>
#include <system_error>
#include <vector>

namespace sikku {
namespace {

constexpr double longest = 10'000;  // millimetres: wider than any press or plotter
constexpr double above_0 = std::numeric_limits<double>::denorm_min();
constexpr double most_area = 1e6;  // square millimetres
constexpr double any_length = std::numeric_limits<double>::infinity();

int to_int(const std::string& text) {
    return static_cast<int>(to_number(text));
}

bool is_true(const std::string& text) {
    return text == "true";
}

double length(const char* option, const std::string& text, double dpi) {
    const auto value = parse_length(text, dpi);
    if (!value) refuse_option(option, text, "expected a length such as 5mm, 1.5cm, 0.5m, 2in, 12pt or 300px");
    return *value;
}

/// Parses a length between two others, in millimetres.
double length_between(const char* option, const std::string& text, double dpi, double least, double most,
                      const char* expected) {
    const double value = length(option, text, dpi);
    if (!(value >= least && value <= most)) refuse_option(option, text, expected);
    return value;
}

/// Parses seconds, which have a default.
double seconds_between(const char* option, const std::string& text, double seconds, double least, double most,
                       const char* expected) {
    if ((!text.empty() && !read_number(text, seconds)) || !(seconds >= least && seconds <= most)) {
        refuse_option(option, text, expected);
    }
    return seconds;
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

void set_window(DrawSettings& settings, const std::string& text) {
    settings.look.window = parse_window(text);
    if (!settings.look.window) {
        refuse_option(
            "window", text,
            "expected X0,Y0,X1,Y1 in turtle steps, decimal numbers without exponents, X0 below X1 and Y0 below Y1");
    }
}

void set_repeat(DrawSettings& settings, const std::string& text) {
    settings.look.repeat = parse_repeat(text);
    if (settings.look.repeat) return;
    std::string names;
    for (const std::string_view name : repeat_groups()) names += fmt::format("{}{}", names.empty() ? "" : ", ", name);
    refuse_option("repeat", text,
                  fmt::format("expected a group and its cells, such as frieze:5, frieze:fill, p4m:3x4, p4m:fill or "
                              "ring:8, up to {} copies, "
                              "then ,gap=2 in steps or ,gap=5%; groups are {}",
                              most_copies, names));
}

/// Parses `only`, `SIZE COLOUR`, or `only SIZE COLOUR`.
void set_dots(DrawSettings& settings, const std::string& text) {
    settings.look.only_dots = text == "only" || text.starts_with("only ");
    settings.look.dots = settings.look.only_dots ? text.substr(std::min<std::size_t>(text.size(), 5)) : text;
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
    settings.time.generations = {first, last};
}

/// Parses `STEP` or `STEP:N`.
void set_highlight(DrawSettings& settings, const std::string& text) {
    const std::size_t colon = text.find(':');
    const auto whole = [&](std::string_view part) {
        std::uint64_t value = 0;
        const auto [end, error] = std::from_chars(part.data(), part.data() + part.size(), value);
        if (error != std::errc() || end != part.data() + part.size() || value < 1 || value > INT64_MAX) {
            refuse_option("highlight", text,
                          "expected a step such as 2, or a step and a symbol such as 2:5, both counted from 1");
        }
        return value;
    };
    Highlight highlight;
    highlight.step = static_cast<std::int64_t>(whole(std::string_view(text).substr(0, colon)));
    if (colon != std::string::npos) highlight.symbol = whole(std::string_view(text).substr(colon + 1));
    settings.look.highlight = highlight;
}

/// Parses `SPACING`, followed by `ANGLE` and `cross` in either order.
void set_hatch(DrawSettings& settings, const std::string& text) {
    Hatch& hatch = settings.plot.hatch.emplace();
    for (std::size_t begin = 0; begin < text.size();) {
        const std::size_t end = std::min(text.find(',', begin), text.size());
        const std::string part = text.substr(begin, end - begin);
        if (begin == 0) {
            hatch.spacing = length("hatch", part, settings.paper.dpi);
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

/// Parses one or more heights, separated by commas.
std::vector<double> heights(const char* option, const std::string& text, double dpi) {
    constexpr std::size_t most_heights = 64;
    constexpr double highest = 1000;
    std::vector<double> result;
    for (std::size_t begin = 0; begin <= text.size();) {
        const std::size_t end = std::min(text.find(',', begin), text.size());
        result.push_back(length(option, text.substr(begin, end - begin), dpi));
        if (!(std::fabs(result.back()) <= highest)) {
            refuse_option(option, text, "expected heights of at most 1 m above or below the base");
        }
        begin = end + 1;
    }
    if (result.size() > most_heights) {
        refuse_option(option, text, fmt::format("expected at most {} heights", most_heights));
    }
    return result;
}

void set_relief(DrawSettings& settings, const std::string& text) {
    settings.relief.heights.emplace();
    if (!text.empty()) settings.relief.heights = heights("relief", text, settings.paper.dpi);
}

/// Parses the thickness, and how far the base reaches beyond the drawing.
void set_base(DrawSettings& settings, const std::string& text) {
    constexpr double most = 1000;
    const std::size_t comma = text.find(',');
    const auto part = [&](const std::string& of) {
        const double value = length("base", of, settings.paper.dpi);
        if (!(value >= 0 && value <= most)) refuse_option("base", text, "expected lengths from 0 to 1 m");
        return value;
    };
    settings.relief.base = part(text.substr(0, comma));
    settings.relief.beyond.reset();
    if (comma != std::string::npos) settings.relief.beyond = part(text.substr(comma + 1));
}

void set_paper(DrawSettings& settings, const std::string& text) {
    settings.plot.paper = parse_hpgl_paper(text, settings.paper.dpi);
    if (!settings.plot.paper) {
        refuse_option("hpgl-paper", text,
                      "expected A4, A3, letter or tabloid, or the limits of the plotter: 400x276mm[,centre]");
    }
}

/// Parses a sheet size and the margin that the printer cannot reach.
void set_tile(DrawSettings& settings, const std::string& text) {
    const std::size_t comma = text.find(',');
    settings.paper.tile = sheet("tile", text.substr(0, comma), settings.paper.dpi);
    settings.paper.tile->margin = 5.0;
    if (comma == std::string::npos) return;
    settings.paper.tile->margin = length("tile", text.substr(comma + 1), settings.paper.dpi);
    if (settings.paper.tile->margin < 0) refuse_option("tile", text, "expected a margin of 0 or more");
}

/// Parses `thin`, `regular`, `bold` or the width of a stroke.
void set_title_weight(DrawSettings& settings, const std::string& text) {
    TitleLook& look = settings.look.title_look;
    constexpr std::array<std::pair<std::string_view, double>, 3> weights = {
        {{"thin", 0.05}, {"regular", TitleLook{}.weight}, {"bold", 0.14}}};
    for (const auto& [name, weight] : weights) {
        if (text != name) continue;
        look.weight = weight;
        return look.stem.reset();
    }
    const auto stem = parse_length(text, settings.paper.dpi);
    if (!stem || !(*stem >= 0.01 && *stem <= longest)) {
        refuse_option("title-weight", text, "expected thin, regular, bold or a width of at least 0.01mm");
    }
    look.stem = *stem;
}

/// Parses `above` or `below`, and `left`, `centre` or `right`, in either order; each may be missing.
void set_title_place(DrawSettings& settings, const std::string& text) {
    TitleLook& look = settings.look.title_look;
    std::optional<bool> is_above;
    std::optional<TitleLook::Side> side;
    for (std::size_t begin = 0; begin <= text.size();) {
        const std::size_t end = std::min(text.find(',', begin), text.size());
        const std::string word = text.substr(begin, end - begin);
        const bool is_side = word == "left" || word == "centre" || word == "right";
        if ((is_side && side) || (!is_side && (is_above || (word != "above" && word != "below")))) {
            refuse_option("title-place", text,
                          "expected above or below, and left, centre or right, such as above,centre");
        }
        if (is_side) {
            side = word == "left"     ? TitleLook::Side::left
                   : word == "centre" ? TitleLook::Side::centre
                                      : TitleLook::Side::right;
        } else {
            is_above = word == "above";
        }
        begin = end + 1;
    }
    look.is_above = is_above.value_or(false);
    look.side = side.value_or(TitleLook::Side::left);
}

void use_profile(DrawSettings& settings, PlotterProfile profile) {
    settings.plot.speeds = profile.speeds;
    settings.plot.gcode = profile.gcode;
    // A plotter that reads SVG is one only by its profile.
    if (profile.language == PlotLanguage::svg) settings.plot.plotter = true;
    settings.plot.profile = std::move(profile);
}

/// Takes a bundled profile. Files are read by read_draw_settings().
void set_profile(DrawSettings& settings, const std::string& text) {
    if (is_profile_file(text)) return;
    auto profile = bundled_profile(text);
    if (!profile) {
        std::vector<std::string_view> names;
        names.reserve(bundled_profiles().size());
        for (const BundledProfile& known : bundled_profiles()) names.push_back(known.name);
        const std::string_view near = nearest(text, names);
        refuse_option("profile", text,
                      near.empty()
                          ? fmt::format("expected {}, or a file path with a dot or a slash", alternatives(names))
                          : "unknown plotter" + did_you_mean(near));
    }
    use_profile(settings, std::move(*profile));
}

/// Runs a parser and reports its errors as errors of the option.
template <typename Parse>
void read_as(const char* option, const std::string& text, const Parse& parse) {
    try {
        parse();
    } catch (const SettingError&) {
        throw;
    } catch (const PatternError&) {
        throw;
    } catch (const std::runtime_error& error) {
        refuse_option(option, text, error.what());
    }
}

void set_lines(const char* option, const std::string& text, std::string& lines) {
    const std::string_view word = unreachable_word(text);
    if (!word.empty()) refuse_option(option, std::string(word), "expected a place within 10 m of the origin");
    lines = text;
}

void set_word(const char* option, std::string_view word, const std::string& text, bool& value) {
    if (text != word) refuse_option(option, text, fmt::format("expected {}", word));
    value = true;
}

void set_overprint(DrawSettings& settings, const std::string& text) {
    if (text == "black") {
        settings.paper.press.overprint = Overprint::black;
    } else if (text == "spots") {
        settings.paper.press.overprint = Overprint::spots;
    } else if (text == "all") {
        settings.paper.press.overprint = Overprint::all;
    } else {
        refuse_option("overprint", text, "expected black, spots or all");
    }
}

using S = DrawSettings;
using Text = const std::string&;
using enum OptionKind;

constexpr const char* kolams = "Kolams and growth";
constexpr const char* reliefs = "Reliefs";
constexpr const char* plotters = "Plotters";
constexpr const char* presses = "Press";
constexpr const char* pictures = "Pictures";

const std::array own_rows = {
    Option<S>{
        {.name = "size",
         .help = "page size: A0 to A10, B0 to B10, SRA0 to SRA4, letter, legal, tabloid, ANSI-A to ANSI-E, Arch-A to "
                 "Arch-E, or WIDTHxHEIGHT such as 50x70cm (default unit: mm); also C, JIS-B and RA sizes (A4)",
         .value = "SIZE",
         .scope = Scope::page},
        [](S& s, Text t) {
            const Page page = sheet("size", t, s.paper.dpi);
            s.paper.page.width = page.width;
            s.paper.page.height = page.height;
        }},
    Option<S>{{.name = "landscape", .help = "landscape page", .scope = Scope::page, .kind = flag},
              [](S& s, Text t) { s.paper.landscape = is_true(t); }},
    Option<S>{{.name = "margin", .help = "margin on all four sides (10mm)", .value = "LENGTH", .scope = Scope::page},
              [](S& s, Text t) {
                  s.paper.page.margin = length_between("margin", t, s.paper.dpi, 0, any_length, "expected 0 or more");
              }},
    Option<S>{{.name = "fit",
               .help = "fill the page within its margins (default)",
               .scope = Scope::framing,
               .kind = flag,
               .sets_scale = true},
              [](S& s, Text t) { s.place.fit = is_true(t); }},
    Option<S>{{.name = "compose",
               .help = "place the drawing by its shape and mass around the optical centre, with room to breathe, "
                       "instead of filling the margins",
               .scope = Scope::place,
               .kind = flag},
              [](S& s, Text t) { s.look.composes = is_true(t); }},
    Option<S>{{.name = "step",
               .help = "length of one turtle step on paper, instead of fitting the page",
               .value = "LENGTH",
               .scope = Scope::scale,
               .sets_scale = true},
              [](S& s, Text t) {
                  s.look.placement.step = length_between("step", t, s.paper.dpi, 1e-9, longest,
                                                         "expected a step of at least 10^-9 mm and at most 10 m");
              }},
    Option<S>{{.name = "fill-page",
               .help = "cover the whole page with a tiling, at the length of a step that 'step' sets (a 40th of the "
                       "page's shorter side); finds a place and the derivation length it needs",
               .scope = Scope::tiling,
               .kind = flag},
              [](S& s, Text t) { s.place.fills_page = is_true(t); }},
    Option<S>{
        {.name = "swatch",
         .help = "draw only the smallest rectangle of a periodic tiling whose copies join without a seam, on a page "
                 "of its size; 'step' sets the length of a step (a 40th of the page's shorter side); 'turn' also "
                 "turns the tiling where that makes the rectangle smaller",
         .value = "[turn]",
         .scope = Scope::tiling},
        [](S& s, Text t) {
            if (!t.empty() && t != "turn") refuse_option("swatch", t, "expected turn, or no value");
            s.place.swatch = t.empty() ? SwatchChoice::upright : SwatchChoice::turned;
        }},
    Option<S>{{.name = "window",
               .help = "part of the drawing that fills the page, in turtle steps; for lines in one pen, at any "
                       "derivation length",
               .value = "X0,Y0,X1,Y1",
               .scope = Scope::framing},
              set_window},
    Option<S>{{.name = "rotate",
               .help = "rotation in degrees anticlockwise (0)",
               .value = "DEGREES",
               .scope = Scope::turn,
               .unit = "deg",
               .kind = number,
               .neutral = "0"},
              [](S& s, Text t) { s.look.placement.rotate = to_number(t); }},
    Option<S>{
        {.name = "mirror", .help = "mirror left and right, before rotating", .scope = Scope::turn, .kind = flag},
        [](S& s, Text t) { s.look.placement.mirror = is_true(t); }},
    Option<S>{{.name = "view",
               .help = "camera of drawings in space: degrees around and up, or front, side or top; then, for a "
                       "perspective, its distance in radii of the drawing (4)",
               .value = "AZIMUTH,ELEVATION[,perspective[,DISTANCE]]",
               .scope = Scope::space,
               .sets_more = true,
               .is_key = true},
              [](S& s, Text t) { s.look.view = t; }},
    Option<S>{
        {.name = "light",
         .help = "light of pictures of drawings in space: flat, sun or sky; or the sun's degrees to the right of "
                 "the eye and up, and its share of the light, 0 to 1 (0.6)",
         .value = "flat|sun|sky|AZIMUTH,ELEVATION[,SUN]",
         .scope = Scope::space,
         .sets_more = true,
         .is_key = true},
        [](S& s, Text t) { s.look.light = t; }},
    Option<S>{{.name = "dots",
               .help = "draw the dots of a kolam, in a size and colour such as 2mm white; or only the dots, for "
                       "practising",
               .value = "[SIZE COLOUR|only]",
               .group = kolams,
               .scope = Scope::kolam,
               .sets_more = true,
               .is_key = true},
              set_dots},
    Option<S>{{.name = "dot-spacing",
               .help = "distance between neighbouring dots of a kolam on paper, instead of fitting the page",
               .value = "LENGTH",
               .group = kolams,
               .scope = Scope::kolam,
               .sets_scale = true},
              [](S& s, Text t) {
                  s.look.dot_spacing = length_between("dot-spacing", t, s.paper.dpi, above_0, longest,
                                                      "expected a length above 0 and at most 10 m");
              }},
    Option<S>{{.name = "border",
               .help = "draw a frame: kaavi, padi, lotus, rope, diamonds, waves, marigolds, lamps, or a pattern file "
                       "to repeat along the "
                       "sides, optionally with another for the corners",
               .value = "NAME|FILE[,CORNER]",
               .group = kolams,
               .scope = Scope::extras,
               .neutral = "none",
               .is_key = true},
              [](S& s, Text t) { s.look.border = t; }},
    Option<S>{{.name = "repeat",
               .help = "repeat the drawing: frieze:5 for a doorstep (also -p11g, -p1m1, -p11m, -p2, -p2mg, -p2mm), a "
                       "wallpaper group p1 to p6m with its cells such as p4m:3x4 (p4m:fill and p4m:5xfill cover the "
                       "page), packed:3x4 or packed:fill for translated copies, closely packed, or ring:8; gap in "
                       "steps or percent (8%)",
               .value = "GROUP[:COUNT][,gap=GAP]",
               .group = kolams,
               .scope = Scope::copies},
              set_repeat},
    Option<S>{{.name = "title-line",
               .help = "write a line below the drawing, on the left (the pattern's title)",
               .value = "[TEXT]",
               .group = kolams,
               .scope = Scope::extras},
              [](S& s, Text t) { s.look.title_line = t; }},
    Option<S>{{.name = "edition",
               .help = "write the number of the print below the drawing, on the right, such as 3/50",
               .value = "TEXT",
               .group = kolams,
               .scope = Scope::extras},
              [](S& s, Text t) { s.look.edition = t; }},
    Option<S>{
        {.name = "font",
         .help = "write title line and edition, and on sheets headings and captions, in the outlines of an installed "
                 "font, such as 'Noto Serif:bold', or of a .ttf or .otf file (single strokes)",
         .value = "NAME|FILE",
         .group = kolams,
         .scope = Scope::extras,
         .names_file = is_font_file},
        [](S& s, Text t) {
            if (t.empty()) refuse_option("font", t, "expected the name of an installed font, or a file");
            s.look.font_name = t;
        }},
    Option<S>{{.name = "title-size",
               .help = "height of the capitals of the title line (1.25 % of the page's shorter side)",
               .value = "LENGTH",
               .group = kolams,
               .scope = Scope::extras},
              [](S& s, Text t) {
                  s.look.title_look.size = length_between("title-size", t, s.paper.dpi, 0.5, longest,
                                                          "expected a height of at least 0.5mm and at most 10 m");
              }},
    Option<S>{{.name = "title-weight",
               .help = "width of the single strokes of the title line (regular, which is 8.5 % of its height)",
               .value = "LENGTH|thin|regular|bold",
               .group = kolams,
               .scope = Scope::extras,
               .neutral = "regular"},
              set_title_weight},
    Option<S>{{.name = "title-place",
               .help = "place of the title line: above or below the drawing, left, centre or right (below,left)",
               .value = "PLACE[,PLACE]",
               .group = kolams,
               .scope = Scope::extras,
               .neutral = "below,left"},
              set_title_place},
    Option<S>{{.name = "colour-by",
               .help = "draw each line in its own colour",
               .value = "strand",
               .group = kolams,
               .scope = Scope::kolam},
              [](S& s, Text t) { set_word("colour-by", "strand", t, s.look.colours_strokes); }},
    Option<S>{
        {.name = "highlight",
         .help =
             "colour the parts that come from each symbol that step STEP replaced, in six colours in turn, or only "
             "those of the Nth symbol; the rest is pale; not for maps",
         .value = "STEP[:N]",
         .group = kolams,
         .scope = Scope::look},
        set_highlight},
    Option<S>{{.name = "rule",
               .help = "draw each production instead of the word: predecessor, arrow and successor; a letter that "
                       "draws nothing is a tile; not for maps and models",
               .group = kolams,
               .scope = Scope::time,
               .kind = flag,
               .is_alone = true},
              [](S& s, Text t) { s.time.shows_rule = is_true(t); }},
    Option<S>{{.name = "generations",
               .help = "derivation lengths A to B: side by side on one sheet, or one after the other in a .gif",
               .value = "A:B",
               .group = kolams,
               .scope = Scope::time,
               .is_alone = true},
              set_generations},
    Option<S>{{.name = "frames",
               .help = "write each generation to its own file, such as growth-07.png",
               .group = kolams,
               .scope = Scope::time,
               .kind = flag,
               .is_alone = true},
              [](S& s, Text t) { s.time.frames = is_true(t); }},
    Option<S>{
        {.name = "frame-time",
         .help = "seconds per generation of a .gif, 0.01 to 600 (0.5); with 'divide', the pause after each division "
                 "(0.6)",
         .value = "SECONDS",
         .group = kolams,
         .scope = Scope::time,
         .unit = "s",
         .kind = number,
         .least = 0.01,
         .most = 600},
        [](S& s, Text t) { s.time.frame_time = to_number(t); }},
    Option<S>{{.name = "hold",
               .help = "minimum seconds for the last generation of a .gif, or with 'divide', 0.01 to 600 (2)",
               .value = "SECONDS",
               .group = kolams,
               .scope = Scope::time,
               .unit = "s",
               .kind = number,
               .least = 0.01,
               .most = 600},
              [](S& s, Text t) { s.time.hold = to_number(t); }},
    Option<S>{{.name = "fit-frames",
               .help = "fit each generation to the page separately; by default all share one scale and position, "
                       "which shows growth",
               .group = kolams,
               .scope = Scope::time,
               .kind = flag,
               .is_alone = true},
              [](S& s, Text t) { s.time.fit_frames = is_true(t); }},
    Option<S>{{.name = "animate",
               .help = "SVG that draws itself, line by line, in this many seconds (20)",
               .value = "[SECONDS]",
               .group = kolams,
               .scope = Scope::file,
               .unit = "s"},
              [](S& s, Text t) {
                  s.paper.animation = seconds_between("animate", t, 20, above_0, 86'400,
                                                      "expected seconds, above 0 and at most a day");
              }},
    Option<S>{{.name = "divide",
               .help = "animation in which each tile divides into its parts, from generation to generation: .gif or "
                       "SVG, with this many seconds per division (1.4); 'generations' selects a range (0 to n)",
               .value = "[SECONDS]",
               .group = kolams,
               .scope = Scope::time,
               .unit = "s"},
              [](S& s, Text t) {
                  s.time.division =
                      seconds_between("divide", t, 1.4, 0.1, 600, "expected seconds for each division, 0.1 to 600");
              }},
    Option<S>{{.name = "name-tiles",
               .help = "SVG in which each tile is an element with an identifier, and classes for its shape, hand, "
                       "direction and colour; PDF and DXF with a layer for each shape, hand and colour of tiles",
               .group = kolams,
               .scope = Scope::file,
               .kind = flag},
              [](S& s, Text t) { s.paper.names_tiles = is_true(t); }},
    Option<S>{
        {.name = "kerf",
         .help = "width of the cut of a laser or knife, up to 10mm, for edges of tiles that are drawn once: the "
                 "border moves outwards by half of it (0mm)",
         .value = "LENGTH",
         .group = kolams,
         .scope = Scope::tiling,
         .neutral = "0mm"},
        [](S& s, Text t) {
            s.look.kerf = length_between("kerf", t, s.paper.dpi, 0, 10, "expected a length from 0 to 10mm");
        }},
    Option<S>{{.name = "colouring",
               .help = "colouring page: the outlines of fields and tiles on white paper, in lines of at least 3pt; "
                       "refused if a "
                       "closed region has less than this area (200mm2)",
               .value = "[AREA]",
               .group = kolams,
               .scope = Scope::look,
               .unit = "mm2"},
              [](S& s, Text t) {
                  double area = 200;
                  if ((!t.empty() && !read_number(t, area)) || !(area >= 0 && area <= most_area)) {
                      refuse_option("colouring", t, "expected an area in mm2 from 0 to 1000000");
                  }
                  s.look.colouring = area;
              }},
    Option<S>{
        {.name = "lesson",
         .help = "drawing lesson: the dots, then stroke after stroke as a hand draws them, with numbers and "
                 "arrows; pages of a PDF, an animated SVG or .gif with this many seconds per stroke (3), or the "
                 "cells of a picture",
         .value = "[SECONDS]",
         .group = kolams,
         .scope = Scope::lesson,
         .unit = "s"},
        [](S& s, Text t) {
            s.time.lesson = seconds_between("lesson", t, 3, 0.1, 600, "expected seconds for each stroke, 0.1 to 600");
        }},
    Option<S>{{.name = "tile",
               .help = "cut the print into sheets of this size, to be glued together: pages of a PDF after an "
                       "overview, or files; MARGIN is the area the printer cannot reach (5mm)",
               .value = "SIZE[,MARGIN]",
               .group = kolams,
               .scope = Scope::sheets},
              set_tile},
    Option<S>{{.name = "overlap",
               .help = "overlap of neighbouring sheets (10mm)",
               .value = "LENGTH",
               .group = kolams,
               .scope = Scope::sheets},
              [](S& s, Text t) { s.paper.overlap = length("overlap", t, s.paper.dpi); }},
    Option<S>{
        {.name = "relief",
         .help = "a solid for 3-D printers, as STL, OBJ or glTF: heights of the colours above the base, in the order "
                 "of the palette, such as 2mm,3mm; negative ones are depths (2mm)",
         .value = "[HEIGHT[,HEIGHT]...]",
         .group = reliefs,
         .scope = Scope::solid},
        set_relief},
    Option<S>{{.name = "ridge",
               .help = "heights of lines by colour (as 'relief')",
               .value = "HEIGHT[,HEIGHT]...",
               .group = reliefs,
               .scope = Scope::solid},
              [](S& s, Text t) { s.relief.ridges = heights("ridge", t, s.paper.dpi); }},
    Option<S>{{.name = "base",
               .help = "thickness of the base (1.2mm; 0: no base), which is as large as the page, or reaches the "
                       "length BEYOND past the drawing",
               .value = "THICKNESS[,BEYOND]",
               .group = reliefs,
               .scope = Scope::solid},
              set_base},
    Option<S>{{.name = "groove",
               .help = "width of the grooves between the polygons of a relief (0.4mm)",
               .value = "WIDTH",
               .group = reliefs,
               .scope = Scope::solid},
              [](S& s, Text t) {
                  s.relief.groove =
                      length_between("groove", t, s.paper.dpi, 0, longest, "expected a width from 0 to 10 m");
              }},
    Option<S>{
        {.name = "plotter",
         .help = "draw nothing twice, with few pen lifts and little pen-up travel; HP-GL, G-code and DXF always do",
         .group = plotters,
         .scope = Scope::plot,
         .kind = flag},
        [](S& s, Text t) { s.plot.plotter = is_true(t); }},
    // Stands before the options that override its settings.
    Option<S>{
        {.name = "profile",
         .help =
             "plotter: axidraw, grbl, grbl-laser, hp7475a, marlin, marlin-z, z, or a file that describes one (grbl)",
         .value = "NAME|FILE",
         .group = plotters,
         .scope = Scope::pens,
         .moves_machine = true,
         .names_file = is_profile_file},
        set_profile},
    Option<S>{{.name = "split",
               .help = "maximum length of a stroke, for controllers that stutter",
               .value = "LENGTH",
               .group = plotters,
               .scope = Scope::strokes},
              [](S& s, Text t) {
                  s.plot.split =
                      length_between("split", t, s.paper.dpi, above_0, any_length, "expected a length above 0");
              }},
    Option<S>{{.name = "pen-width",
               .help = "width of the plotter's pen; wider strokes take several passes (one pass per stroke)",
               .value = "WIDTH",
               .group = plotters,
               .scope = Scope::plot},
              [](S& s, Text t) {
                  s.plot.pen_width = length_between("pen-width", t, s.paper.dpi, 0.05, 100,
                                                    "expected a width between 0.05mm and 100mm");
              }},
    Option<S>{{.name = "hatch",
               .help = "hatch filled shapes: spacing (one pen), angle (45) or both directions, such as 0.5mm,30 or "
                       "0.5mm,cross",
               .value = "[SPACING[,ANGLE|cross]]",
               .group = plotters,
               .scope = Scope::strokes},
              set_hatch},
    Option<S>{{.name = "pens",
               .help = "number of pens the plotter holds, 1 to 256; more colours are merged into the most similar "
                       "(one per colour)",
               .value = "N",
               .group = plotters,
               .scope = Scope::plot,
               .kind = whole,
               .least = 1,
               .most = 256},
              [](S& s, Text t) { s.plot.pens = to_int(t); }},
    Option<S>{
        {.name = "pen",
         .help = "settings of a pen, by number or colour: speed, lift and down (heights, or power), pause, "
                 "refill, such as '2 speed=20mm/s pause=0.5s'; may be repeated",
         .value = "PEN SETTINGS",
         .group = plotters,
         .scope = Scope::pens,
         .is_list = true,
         .moves_machine = true},
        [](S& s, Text t) { read_as("pen", t, [&] { s.plot.pen_rules.push_back(parse_pen_rule(t, s.paper.dpi)); }); }},
    Option<S>{{.name = "park",
               .help = "place of the pen while it is changed, from the bottom left corner of the page; HP-GL, G-code",
               .value = "X,Y",
               .group = plotters,
               .scope = Scope::pens,
               .moves_machine = true},
              [](S& s, Text t) { read_as("park", t, [&] { s.plot.park = parse_place(t, s.paper.dpi); }); }},
    Option<S>{{.name = "refill",
               .help = "dip the pen at a place before it draws, and again after each LENGTH, such as 5m@10,10",
               .value = "LENGTH@X,Y",
               .group = plotters,
               .scope = Scope::pens,
               .moves_machine = true},
              [](S& s, Text t) { read_as("refill", t, [&] { s.plot.refill = parse_refill(t, s.paper.dpi); }); }},
    Option<S>{{.name = "resume",
               .help = "begin where an interrupted plot had drawn this length, such as 12.5m",
               .value = "LENGTH",
               .group = plotters,
               .scope = Scope::plot,
               .moves_machine = true},
              [](S& s, Text t) {
                  s.plot.resume =
                      length_between("resume", t, s.paper.dpi, above_0, any_length, "expected a length above 0");
              }},
    Option<S>{{.name = "arcs",
               .help = "follow curves by arcs where they fit (default); G-code",
               .group = plotters,
               .scope = Scope::gcode,
               .kind = flag,
               .is_on = true},
              [](S& s, Text t) { s.plot.gcode.arcs = is_true(t); }},
    Option<S>{{.name = "min-arc",
               .help = "minimum length of an arc; shorter ones become lines; G-code (0mm)",
               .value = "LENGTH",
               .group = plotters,
               .scope = Scope::gcode,
               .neutral = "0mm"},
              [](S& s, Text t) {
                  s.plot.gcode.least_arc =
                      length_between("min-arc", t, s.paper.dpi, 0, any_length, "expected a length of 0 or more");
              }},
    Option<S>{{.name = "hpgl-paper",
               .help = "sheet in an HP 7475A (A4, A3, letter, tabloid), or the limits of another plotter, with "
                       ",centre if its origin is in the middle (the page, with the origin in its corner)",
               .value = "SIZE[,centre]",
               .group = plotters,
               .scope = Scope::hpgl,
               .moves_machine = true},
              set_paper},
    Option<S>{{.name = "travel",
               .help = "show pen-up travel in a separate layer",
               .group = plotters,
               .scope = Scope::plot,
               .kind = flag},
              [](S& s, Text t) { s.plot.travel = is_true(t); }},
    Option<S>{{.name = "pen-speed",
               .help = "drawing speed in mm/s, for the time estimate and G-code (40)",
               .value = "SPEED",
               .group = plotters,
               .scope = Scope::machine,
               .unit = "mm/s",
               .kind = number,
               .least = 1e-3,
               .most = 1e6,
               .moves_machine = true},
              [](S& s, Text t) { s.plot.speeds.drawing = to_number(t); }},
    Option<S>{{.name = "travel-speed",
               .help = "pen-up speed in mm/s (80)",
               .value = "SPEED",
               .group = plotters,
               .scope = Scope::machine,
               .unit = "mm/s",
               .kind = number,
               .least = 1e-3,
               .most = 1e6,
               .moves_machine = true},
              [](S& s, Text t) { s.plot.speeds.travelling = to_number(t); }},
    Option<S>{{.name = "lift-time",
               .help = "seconds for lifting and lowering the pen (0.3)",
               .value = "SECONDS",
               .group = plotters,
               .scope = Scope::machine,
               .unit = "s",
               .kind = number,
               .least = 0,
               .most = 3600,
               .moves_machine = true},
              [](S& s, Text t) { s.plot.speeds.lift = to_number(t); }},
    Option<S>{{.name = "gcode-start",
               .help = "G-code lines before the first stroke",
               .value = "LINES",
               .group = plotters,
               .scope = Scope::machine,
               .moves_machine = true},
              [](S& s, Text t) { set_lines("gcode-start", t, s.plot.gcode.start); }},
    Option<S>{{.name = "gcode-end",
               .help = "G-code lines after the last stroke",
               .value = "LINES",
               .group = plotters,
               .scope = Scope::machine,
               .moves_machine = true},
              [](S& s, Text t) { set_lines("gcode-end", t, s.plot.gcode.end); }},
    Option<S>{{.name = "bleed",
               .help = "extension of the ground beyond the page, up to 100mm (0mm)",
               .value = "LENGTH",
               .group = presses,
               .scope = Scope::trim,
               .neutral = "0mm"},
              [](S& s, Text t) { s.paper.press.bleed = length("bleed", t, s.paper.dpi); }},
    Option<S>{{.name = "marks",
               .help = "crop marks outside the bleed; PDF",
               .group = presses,
               .scope = Scope::trim,
               .kind = flag},
              [](S& s, Text t) { s.paper.press.marks = is_true(t); }},
    Option<S>{{.name = "spot",
               .help = "separate ink for a colour of the drawing, such as Kaavi=#b3452c; PDF; may be repeated",
               .value = "NAME=COLOUR",
               .group = presses,
               .scope = Scope::press,
               .is_list = true},
              [](S& s, Text t) { read_as("spot", t, [&] { add_spot(s.paper.press.spots, parse_spot(t)); }); }},
    Option<S>{{.name = "registration",
               .help = "registration marks outside the bleed; PDF",
               .group = presses,
               .scope = Scope::trim,
               .kind = flag},
              [](S& s, Text t) { s.paper.press.registration = is_true(t); }},
    Option<S>{{.name = "overprint",
               .help = "print black lines, areas in spot colours, or both, over the inks beneath them; PDF",
               .value = "black|spots|all",
               .group = presses,
               .scope = Scope::press},
              set_overprint},
    Option<S>{{.name = "cmyk",
               .help = "convert colours to the inks of this ICC profile; TIFF, and PDF, which becomes PDF/X-4",
               .value = "FILE.icc",
               .group = presses,
               .scope = Scope::press,
               .names_file = [](std::string_view file) { return !file.empty(); }},
              [](S& s, Text t) { s.paper.press.cmyk = t; }},
    Option<S>{{.name = "bits",
               .help = "bits per channel: 8, or 1 for line art, best at 600 dpi and more; TIFF (8)",
               .value = "1|8",
               .group = presses,
               .scope = Scope::press,
               .kind = whole,
               .neutral = "8"},
              [](S& s, Text t) {
                  s.paper.press.bits = to_int(t);
                  if (s.paper.press.bits != 1 && s.paper.press.bits != 8) refuse_option("bits", t, "expected 1 or 8");
              }},
    Option<S>{
        {.name = "screen",
         .help = "screening of 1-bit pictures: threshold (default), diffusion, or a halftone with LPI lines per "
                 "inch (a twelfth of the dpi) at 45 degrees",
         .value = "threshold|diffusion|halftone[,LPI]",
         .group = presses,
         .scope = Scope::press,
         .neutral = "threshold"},
        [](S& s, Text t) {
            read_as("screen", t, [&] {
                s.paper.press.screen = parse_screen(t);
                if (s.paper.press.screen.kind == Screen::Kind::halftone)
                    Screener(s.paper.press.screen, 1, s.paper.dpi);
            });
        }},
    Option<S>{{.name = "icc",
               .help = "embed the ICC profile of the colours in pictures (default)",
               .group = presses,
               .scope = Scope::pixels,
               .kind = flag,
               .is_on = true},
              [](S& s, Text t) { s.paper.press.icc = is_true(t); }},
    Option<S>{{.name = "dpi",
               .help = "pixels per inch of pictures, and of px in lengths, 1 to 10,000 (300, or 640 pixels along the "
                       "longer side of a .gif)",
               .value = "DPI",
               .group = pictures,
               .scope = Scope::pixels,
               .unit = "dpi",
               .kind = number,
               .least = 1,
               .most = 10'000},
              [](S& s, Text t) { s.paper.dpi = to_number(t); }},
    Option<S>{{.name = "compression",
               .help = "PNG compression, 1 (fast) to 9 (small) (6; 4 for hand-drawn lines, 3 for floors)",
               .value = "LEVEL",
               .group = pictures,
               .scope = Scope::pixels,
               .kind = whole,
               .least = 1,
               .most = 9},
              [](S& s, Text t) { s.work.compression = to_int(t); }},
    Option<S>{{.name = "jobs",
               .help = "threads for pictures; 0: one per core (0)",
               .value = "N",
               .group = pictures,
               .scope = Scope::threads,
               .kind = whole,
               .most = 1024,
               .is_alone = true,
               .letter = 'j'},
              [](S& s, Text t) { s.work.threads = to_int(t); }},
    Option<S>{budget_option, [](S& s, Text t) { s.work.budget = read_budget(t); }},
};

void set_key(S& settings, std::string_view name, Text text) {
    std::string key(name);
    std::replace(key.begin(), key.end(), '-', ' ');
    settings.keys.push_back({std::string(name), std::move(key), text});
}

/// The rows above, and one for each further key of the language that art reads.
std::vector<Option<S>> make_table() {
    std::vector<Option<S>> table(own_rows.begin(), own_rows.end());
    for (Option<S>& row : table) {
        std::string key(row.info.name);
        std::replace(key.begin(), key.end(), '-', ' ');
        if (row.info.is_key) row.info.names_file = find_language_key(key)->names_file;
    }
    for (const std::string_view name : keys_of(KeyOwner::art)) {
        const auto has_name = [&](const Option<S>& row) { return row.info.name == name; };
        if (std::any_of(table.begin(), table.end(), has_name)) continue;
        // Galleries have the keys themselves.
        table.push_back({key_option(name, "Style", true), nullptr, set_key});
        table.back().info.scope = Scope::look;
    }
    return table;
}

}  // namespace

std::span<const Option<DrawSettings>> draw_options() {
    static const std::vector<Option<S>> table = make_table();
    return table;
}

namespace {

/// The paper in an HP-GL plotter, as its unit makes it.
std::optional<HpglPaper> plotter_paper(const DrawSettings& settings) {
    const std::optional<PlotterProfile>& profile = settings.plot.profile;
    std::optional<HpglPaper> paper = settings.plot.paper;
    if (!paper && profile && profile->paper) paper = paper_for(*profile->paper, settings.paper.page);
    if (paper && profile) paper = with_unit(*paper, profile->unit);
    return paper;
}

/// Widens the margin until the plotter reaches everything within it, if the page leaves room for that.
void widen_margin(DrawSettings& settings) {
    const std::optional<HpglPaper> paper = plotter_paper(settings);
    if (!paper) return;
    Page& page = settings.paper.page;
    const double margin = hpgl_margin(*paper, page);
    if (margin <= page.margin || 2 * margin >= std::min(page.width, page.height)) return;
    page.margin = margin;
    settings.paper.widens_margin = true;
}

/// The options that are given with another value than none, in the order of the table.
std::vector<const OptionInfo*> effective_options(const OptionValues& values) {
    std::vector<const OptionInfo*> given;
    for (const Option<S>& row : draw_options()) {
        if (std::any_of(values.begin(), values.end(), [&](const OptionValue& value) {
                return value.name == row.info.name && !row.info.is_neutral(value.text);
            })) {
            given.push_back(&row.info);
        }
    }
    return given;
}

/// Depths within the base.
void check_depths(const ReliefOptions& options) {
    const auto check = [&](const char* option, const std::vector<double>& heights) {
        for (const double height : heights) {
            if (height < 0 && !(options.base + height > 0.0005)) {
                refuse_option(option, fmt::format("{:g}mm", height),
                              fmt::format("this depth does not fit into a base of {:g} mm", options.base));
            }
        }
    };
    check("relief", options.heights);
    check("ridge", options.ridges);
}

}  // namespace

DrawSettings read_draw_settings(const OptionValues& values, const std::filesystem::path* folder) {
    DrawSettings settings;
    settings.given = effective_options(values);
    for (const OptionValue& value : values) {
        if (folder && value.name == "profile" && is_profile_file(value.text)) {
            read_as("profile", value.text, [&] { use_profile(settings, read_profile(*folder / value.text)); });
        }
    }
    // The resolution comes first: lengths in px and halftone screens depend on it.
    for (const OptionValue& value : values) {
        if (value.name == "dpi") apply_options(draw_options(), {value}, settings);
    }
    apply_options(draw_options(), values, settings);
    settings.plot.gcode.drawing_feed = 60 * settings.plot.speeds.drawing;
    settings.plot.gcode.travel_feed = 60 * settings.plot.speeds.travelling;
    Page& page = settings.paper.page;
    if (settings.paper.landscape && page.height > page.width) std::swap(page.width, page.height);
    const bool has_margin =
        std::any_of(values.begin(), values.end(), [](const OptionValue& value) { return value.name == "margin"; });
    if (!has_margin) widen_margin(settings);
    if (!(2 * page.margin < std::min(page.width, page.height))) {
        refuse_option("margin", fmt::format("{:g}mm", page.margin),
                      fmt::format("the margins leave nothing of a page of {:g} x {:g} mm", page.width, page.height));
    }
    return settings;
}

std::shared_ptr<const TileOptions> tile_options(const DrawSettings& settings) {
    TileOptions options{.sheet = *settings.paper.tile};
    options.overlap = settings.paper.overlap.value_or(options.overlap);
    return std::make_shared<const TileOptions>(options);
}

DrawingOptions drawing_options(const DrawSettings& settings, const Document& document) {
    DrawingOptions options;
    static_cast<DrawingSettings&>(options) = settings.look;
    std::optional<std::string>& title = options.title_line;
    if (title && title->empty()) title = document.text("title");
    if (title && title->empty()) title = std::filesystem::path(document.source().name()).stem().string();
    if (title && title->empty()) title.reset();
    return options;
}

std::shared_ptr<const Font> load_font(const std::string& name, const std::filesystem::path& folder) {
    if (name.empty()) return nullptr;
    try {
        return open_font(name, folder);
    } catch (const std::runtime_error& error) {
        refuse_option("font", name, error.what());
    }
}

bool is_relief(const DrawSettings& settings, PrintFormat format) {
    return settings.relief.heights || format == PrintFormat::stl;
}

bool is_model(const DrawSettings& settings, PrintFormat format) {
    return info(format).kind == FormatKind::model && !is_relief(settings, format);
}

std::shared_ptr<const ReliefOptions> relief_options(const DrawSettings& settings, PrintFormat format) {
    ReliefOptions options;
    if (settings.relief.heights && !settings.relief.heights->empty()) options.heights = *settings.relief.heights;
    options.ridges = settings.relief.ridges;
    options.base = settings.relief.base.value_or(options.base);
    options.beyond = settings.relief.beyond;
    options.groove = settings.relief.groove.value_or(options.groove);
    options.format = format;
    check_depths(options);
    return std::make_shared<const ReliefOptions>(options);
}

PlotSetup plot_setup(const DrawSettings& settings, PrintFormat format) {
    PlotSetup setup;
    if (!settings.plot.plotter && !is_for_plotters(format)) return setup;
    const std::optional<PlotterProfile>& profile = settings.plot.profile;
    PlotOptions& plot = setup.plot.emplace(settings.plot);
    plot.leaves_tiles = settings.paper.names_tiles && format == PrintFormat::dxf;
    if (plot.pens == 0 && profile) plot.pens = profile->pens;
    if (profile) plot.rules = profile->rules;
    plot.rules.insert(plot.rules.end(), settings.plot.pen_rules.begin(), settings.plot.pen_rules.end());
    if (!plot.park && profile && is_for_plotters(format)) plot.park = profile->park;
    setup.shows_travel = settings.plot.travel;
    setup.gcode = settings.plot.gcode;
    setup.gcode.rules = plot.rules;
    setup.gcode.park = plot.park;
    setup.hpgl = {plotter_paper(settings), plot.park, plot.rules, settings.plot.speeds.drawing};
    if (!profile) return setup;
    setup.hpgl.unit = profile->unit;
    setup.layer_codes = profile->layers;
    return setup;
}

namespace {

/// Converts a style to that of a colouring page: black, unless the user sets a stroke.
void make_colouring(const DrawSettings& settings, const Grammar& grammar, Style& style) {
    const auto stroke = std::find_if(settings.keys.begin(), settings.keys.end(),
                                     [](const Setting& setting) { return setting.key == "stroke"; });
    Colour ink{0, 0, 0, 255};
    double width = colouring_line;
    if (stroke != settings.keys.end()) {
        if (!style.stroked || style.stroke.in_steps || style.stroke.value < colouring_line) {
            refuse_option("stroke", stroke->value,
                          fmt::format("expected a width of at least {:g}mm for a colouring page", colouring_line));
        }
        width = style.stroke.value;
        if (style.stroke_colour) ink = *style.stroke_colour;
    }
    prepare_colouring(style, grammar, ink, width);
}

}  // namespace

Style read_print_style(const Document& document, const DrawSettings& settings) {
    Document drawn = document;
    const auto set = [&](const char* key, const std::string& value) {
        try {
            drawn = drawn.with({{key, value}});
        } catch (const PatternError& error) {
            throw SettingError(key, value, error.diagnostics().front().message);
        }
    };
    // Dots of the default size and colour cannot be written as a value of the key.
    if (settings.look.dots && !settings.look.dots->empty()) set("dots", *settings.look.dots);
    if (settings.look.border) set("border", *settings.look.border);
    if (!settings.look.view.empty()) set("view", settings.look.view);
    if (!settings.look.light.empty()) set("light", settings.look.light);
    Diagnostics diagnostics;
    Style style = read_style(drawn.pattern(), settings.paper.dpi, diagnostics);
    diagnostics.throw_if_errors();
    if (settings.look.colouring) make_colouring(settings, document.grammar(), style);
    if ((settings.look.dots || settings.look.dot_spacing || settings.time.lesson) && !style.dots)
        style.dots.emplace();
    return style;
}

}  // namespace sikku
