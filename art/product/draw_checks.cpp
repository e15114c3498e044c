// art/product/draw_checks.cpp: which settings of a print can be combined with each other and with a format.
#include "art/motion/growth.h"
#include "art/print/tiles.h"
#include "art/product/draw_settings.h"
#include "art/product/print_kinds.h"
#include "art/raster/raster.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <span>
#include <string_view>

namespace sikku {
namespace {

using S = DrawSettings;
using Format = PrintFormat;

/// A scope, or a single option.
struct Options {
    std::optional<Scope> scope{};
    std::string_view name{};

    constexpr Options() = default;
    constexpr Options(Scope of) : scope(of) {}               // NOLINT(google-explicit-constructor)
    constexpr Options(const char* option) : name(option) {}  // NOLINT(google-explicit-constructor)
    bool have(const OptionInfo& option) const { return option.scope == scope || option.name == name; }
};

/// A kind of print has none of these options.
struct Rule {
    PrintKind kind;
    std::array<Options, 18> refused;
    const char* reason;  ///< may name the `{format}`
};

constexpr const char* no_names =
    "applies only to SVG, which names its elements, and to PDF and DXF, which have layers";
constexpr const char* uncut = "a model is not cut along the edges of its tiles";

using enum Scope;
constexpr Rule model_rules[] = {
    {when::model, {{"name-tiles"}}, no_names},
    {when::model, {{"kerf"}}, uncut},
    {when::model, {{"rotate"}}, "a model can be rotated in the program that uses it"},
    {when::model, {{"mirror"}}, "a model can be mirrored in the program that uses it"},
    {when::model,
     {{framing, place, tiling, space, kolam, extras, copies, time, file, lesson, sheets, plot, strokes, pens, gcode,
       hpgl, press, trim}},
     "a model has no page and no camera; this option applies only to prints"},
    {when::model, {{scale}}, "a model has one unit for each turtle step"},
};
constexpr Rule relief_rules[] = {
    {when::solid_colouring, {{"colouring"}}, "a colouring page is printed; a model has no page"},
    {when::no_relief, {{solid}}, "applies only to reliefs; needs 'relief' or STL"},
    {when::flat_relief, {{solid}}, "a relief is STL, OBJ or glTF"},
    {when::relief, {{sheets}}, "a relief can be cut in the program that prints it"},
    {when::relief, {{"rule"}}, "a relief is one solid, not a sheet of productions"},
    {when::relief, {{lesson}}, "a lesson has several pages; a relief is one solid"},
    {when::relief_row, {{"generations"}}, "a relief is one solid; 'frames' makes one of each generation"},
    {when::relief, {{"kerf"}}, uncut},
    {when::relief, {{space}}, "a relief is made of drawings in the plane, which have neither camera nor light"},
    {when::relief, {{"bleed"}}, "a relief is not trimmed"},
};
constexpr Rule place_rules[] = {
    {when::fitted,
     {{scale, "window", "dot-spacing"}},
     "cannot be combined with 'fit', which also sets the step length"},
    {when::fitted, {{"compose"}}, "cannot be combined with 'fit', which fills the margins"},
    {when::placed,
     {{"fill-page"}},
     "sets the place and the size of the drawing, and cannot be combined with 'fit', 'window', 'dot-spacing', "
     "'repeat', 'compose', 'generations' and 'rotate'"},
    {when::windowed, {{"compose"}}, "a window fills the page"},
    {when::windowed, {{copies}}, "a window shows a part of one drawing, not of its copies"},
    {when::stepped, {{"dot-spacing"}}, "cannot be combined with 'step': both set the step length"},
};
constexpr Rule plot_rules[] = {
    {when::dxf, {{pens}}, "a .dxf describes lines, not the pens that draw them"},
    {when::pixels, {{"plotter"}}, plot_formats},
    {when::without_travel, {{"travel"}}, "needs 'plotter', and SVG, PDF or EPS"},
    {when::no_plot, {{"split"}}, "needs 'plotter'"},
    {when::no_plot, {{plot, strokes, "pen", "refill"}}, "needs 'plotter', HP-GL, G-code or DXF"},
    {when::without_parking, {{"park"}}, "applies only to HP-GL and G-code"},
    {when::no_gcode, {{gcode}}, "applies only to G-code"},
    {when::no_hpgl, {{hpgl}}, "applies only to HP-GL"},
    {when::untiled, {{"overlap"}}, "needs 'tile'"},
    {when::plot, {{sheets}}, "tiles would cut the strokes of a plot"},
    {when::plot, {{"fill-page"}}, "the edges of the page would cut the strokes of a plot"},
    {when::plot, {{"window"}}, "a window would cut the strokes of a plot"},
};
constexpr Rule product_rules[] = {
    {when::untrimmed, {{trim}}, "applies only to trimmed prints, not to plots and tiles"},
    {when::windowed, {{"border"}}, "a border frames the whole drawing; a window shows only part of it"},
    {when::page_filled, {{"border"}}, "a border frames the whole drawing; a filled page shows only part of it"},
    {when::without_text, {{"font"}}, "needs 'title-line' or 'edition'"},
    {when::untitled, {{"title-size", "title-weight", "title-place"}}, "needs 'title-line'"},
    {when::in_font,
     {{"title-weight"}},
     "sets the width of single strokes; the weight of a font is part of its name, such as 'Noto Serif:bold'"},
    {when::part, {{extras}}, "the drawing fills the page, and would cross the text"},
    {when::still,
     {{"animate"}},
     "only an SVG can draw itself; use 'generations' for a GIF of several derivation lengths"},
    {when::without_names, {{"name-tiles"}}, no_names},
    {when::drawn_plot, {{"name-tiles"}}, "a plot has lines only, no tiles"},
    {when::hatched, {{"name-tiles"}}, "cannot be combined with 'hatch', which draws tiles as lines"},
    {when::named_dxf, {{"resume"}}, "cannot be combined with 'name-tiles', which writes every tile"},

    {when::plot, {{"swatch"}}, "its edges would cut the strokes of a plot"},
    {when::gif, {{"swatch"}}, "a swatch is one picture, not an animation"},
    {when::swatch, {{"generations"}}, "a swatch determines its own derivation length"},
    {when::swatch, {{framing, place, "fill-page", copies, lesson, sheets}}, "a swatch has its own place and page"},
    {when::swatch, {{"dot-spacing"}}, "the length of a step sets the size of a swatch"},
    {when::swatch, {{"animate", "divide"}}, "a swatch is one picture, not an animation"},
    {when::swatch, {{extras, trim}}, "a swatch is part of an endless tiling, with nothing around it"},

    {when::undivided, {{"divide"}}, "only a .gif and an animated SVG show how tiles divide"},
    {when::plot, {{"divide"}}, "a plot does not move"},
    {when::division, {{"animate"}}, "cannot be combined with 'divide', which has its own times"},
    {when::division, {{lesson, copies}}, "does not apply to tiles that divide"},
    {when::division, {{"frames"}}, "all generations of tiles that divide are in one file"},
    {when::division, {{"fit-frames"}}, "tiles that divide keep their place and their scale"},
    {when::division, {{sheets}}, "an animation cannot be cut into sheets"},
    {when::division, {{"fill-page"}}, "sets the derivation length, of which 'divide' needs several"},
    {when::division, {{"name-tiles"}}, "tiles that divide have different names in each generation"},
    {when::division, {{"kerf"}}, "tiles that divide are not cut"},
    {when::division, {{"dot-spacing"}}, "does not apply to tiles that divide; 'step' sets their scale"},

    {when::colouring,
     {{"dots", "border", "colour-by", "fields", "powders", "weave", "parallel", "hand", "fill", "palette", "ground",
       "tile-colours", "tile-edges", "tissue"}},
     "cannot be combined with 'colouring', which draws outlines alone, in one ink on white paper"},
    {when::colouring, {{lesson, "divide"}}, "a colouring page shows the whole drawing at once"},
    {when::animated_colouring, {{"colouring"}}, "a colouring page is printed; a .gif is shown on screens"},

    {when::gif, {{"rule"}}, "the productions are one picture, not an animation"},
    {when::rule,
     {{"highlight", "generations", "divide", lesson}},
     "cannot be combined with 'rule', which draws productions instead of words"},
    {when::rule,
     {{framing, place, scale, tiling, copies, sheets, "dot-spacing"}},
     "each side of a production is scaled to fill its place on the page"},
    {when::rule, {{kolam, extras, file}}, "productions are drawn plainly, without additions"},
    {when::rule,
     {{"line", "hand", "dots", "weave", "parallel", "fields", "powders", "tile-colours", "tile-edges", "decorate"}},
     "productions are drawn plainly, as straight lines and single tiles"},
    {when::rule, {{"travel", "resume"}}, "does not apply to the plot of a sheet of drawings"},

    {when::highlighted,
     {{"generations", "divide", lesson, "fill-page", "swatch"}},
     "cannot be combined with 'highlight', which colours a step of one derivation length"},
    {when::highlighted,
     {{"colouring", "colour-by", "palette", "fill", "fields", "powders", "tile-colours", "decorate"}},
     "cannot be combined with 'highlight', which has its own colours"},

    {when::plot, {{lesson}}, "a lesson has colours, numbers and several steps; a plot is one drawing"},
    {when::one_page, {{lesson}}, "a lesson has several pages; an {format} has one"},
    {when::lesson, {{"border"}}, "a lesson teaches the lines of the kolam; a border is not one of them"},
    {when::lesson,
     {{"generations", sheets, "window", "animate", extras}},
     "cannot be combined with 'lesson', which has its own pages and order"},
    {when::lesson_of_dots, {{"dots"}}, "cannot be combined with 'lesson', which has its own pages and order"},
    {when::lesson, {{trim}}, "the pages of a lesson are not trimmed"},
    {when::lesson_cells, {{scale, "dot-spacing"}}, "each step of a lesson is scaled to fill its cell of the picture"},
};
constexpr Rule map_rules[] = {
    {when::always, {{kolam, lesson}}, "applies to the lines of a turtle, and a map has none"},
    {when::always, {{"rule", "highlight"}}, "applies to words, and a map has none"},
    {when::always, {{"divide"}}, "a .gif of a map always shows how cells divide"},
};
constexpr const char* no_plane =
    "applies only to drawings in the plane; this one pitches, rolls, bends or has surfaces";
constexpr Rule space_rules[] = {
    {when::always, {{solid, "window", kolam, extras, copies, lesson, "animate", "divide", "colouring"}}, no_plane},
    {when::pixels, {{sheets}}, "drawings in space can be cut into sheets only as SVG, PDF or EPS"},
    {when::no_plot, {{"spot"}}, "drawings in space have more shades of light than there are inks"},
};
constexpr Rule growth_rules[] = {
    {when::one_generation, {{"frames"}}, "needs 'generations'"},
    {when::gif, {{"frames"}}, "a .gif contains all generations itself"},
    {when::lesson, {{"frame-time"}}, "a lesson has its own seconds per stroke"},
    {when::untimed, {{"frame-time", "hold"}}, "applies only to a .gif and to 'divide'"},
    {when::unframed, {{"fit-frames"}}, "needs a .gif or 'frames'"},
    {when::gif, {{"bleed", sheets}}, "does not apply to a .gif, which is shown on screens"},
    {when::plotted_row,
     {{"generations"}},
     "a plot cannot contain the grounds and captions of a sheet of generations; 'frames' makes a plot of each"},
    {when::row, {{sheets}}, "a sheet of generations cannot be cut into tiles; 'frames' cuts each generation"},
    {when::row, {{scale, "dot-spacing"}}, "each drawing of a sheet of generations is scaled to fill its cell"},
};

void apply(std::span<const Rule> rules, const S& settings, Format format) {
    for (const Rule& rule : rules) {
        if (!rule.kind(settings, format)) continue;
        for (const OptionInfo* given : settings.given) {
            const auto has = [&](const Options& options) { return options.have(*given); };
            if (std::none_of(rule.refused.begin(), rule.refused.end(), has)) continue;
            refuse_option(given->name, "",
                          fmt::format(fmt::runtime(rule.reason), fmt::arg("format", info(format).label)));
        }
    }
}

/// The settings with an option in addition, if it is a flag or needs no value: such an option may be what the rules
/// ask for, as `plotter` is.
S with_option(const S& settings, const Option<S>& row) {
    const bool is_flag = row.info.kind == OptionKind::flag;
    if (!is_flag && !row.info.value.starts_with('[')) return settings;
    S more = settings;
    try {
        row.set(more, is_flag ? "true" : "");
    } catch (const SettingError&) {
        return settings;
    }
    return more;
}

/// True if one of the rules refuses an option.
bool is_refused(std::span<const Rule> rules, const OptionInfo& option, const S& settings, Format format) {
    return std::any_of(rules.begin(), rules.end(), [&](const Rule& rule) {
        const auto has = [&](const Options& options) { return options.have(option); };
        return std::any_of(rule.refused.begin(), rule.refused.end(), has) && rule.kind(settings, format);
    });
}

void check_sizes(const S& settings, Format format) {
    const auto refuse = [&](const char* why) { refuse_option("dpi", fmt::format("{:g}", settings.paper.dpi), why); };
    const Page& page = settings.paper.page;
    if (!is_vector(format) && when::flat(settings, format) &&
        std::max(page.width, page.height) * settings.paper.dpi / 25.4 > 2e5) {
        refuse("the picture would be over 200,000 pixels wide or high; use a smaller size or dpi");
    }
    const PixelSize size = format == Format::gif ? pixel_size(page, settings.paper.dpi) : PixelSize{};
    if (std::max(size.width, size.height) > 65'535 || std::int64_t{size.width} * size.height > 100'000'000) {
        refuse("a .gif has at most 65,535 pixels per side and 100 million in all; use a smaller size or dpi");
    }
    try {
        if (settings.paper.tile) tiling_of(page, *tile_options(settings));
    } catch (const std::runtime_error& error) {
        refuse_option("tile", "", error.what());
    }
}

void check_generations(const S& settings, Format format) {
    const auto [first, last] = *settings.time.generations;
    const std::int64_t most = when::row(settings, format) ? 100 : most_frames;
    if (last < first || last - first >= most) {
        refuse_option("generations", fmt::format("{}:{}", first, last),
                      fmt::format("expected up to {} derivation lengths, the lowest first", most));
    }
}

}  // namespace

void check_draw_settings(const DrawSettings& settings, PrintFormat format) {
    apply(relief_rules, settings, format);
    if (is_relief(settings, format)) relief_options(settings, format);  // checks depths
    if (when::model(settings, format)) return apply(model_rules, settings, format);
    apply(place_rules, settings, format);
    check_sizes(settings, format);
    check_press(settings.paper.press, format == PrintFormat::gif ? PrintFormat::png : format);
    const std::optional<PlotterProfile>& profile = settings.plot.profile;
    if (profile) check_profile(*profile, format);
    apply(plot_rules, settings, format);
    check_pen_rules(settings.plot.pen_rules, profile ? profile->layers : LayerCodes{}, format);
    apply(product_rules, settings, format);
    if (format == PrintFormat::gif && !settings.time.generations && !settings.time.lesson &&
        !settings.time.division) {
        refuse_option("generations", "", "required for a .gif: A:B; or give 'divide' or 'lesson'");
    }
    apply(growth_rules, settings, format);
    if (settings.time.generations) check_generations(settings, format);
}

std::set<std::string_view> refused_options(const DrawSettings& settings, PrintFormat format, bool is_spatial,
                                           bool is_map) {
    std::set<std::string_view> names;
    for (const Option<S>& row : draw_options()) {
        const S with = with_option(settings, row);
        const auto refused = [&](std::span<const Rule> rules) { return is_refused(rules, row.info, with, format); };
        const bool is_excluded = when::model(with, format) ? refused(model_rules)
                                                           : refused(place_rules) || refused(plot_rules) ||
                                                                 refused(product_rules) || refused(growth_rules);
        if (is_excluded || refused(relief_rules) || (is_map && refused(map_rules)) ||
            (is_spatial && (refused(space_rules) || row.info.name == "relief"))) {
            names.insert(row.info.name);
        }
    }
    return names;
}

void check_map_settings(const DrawSettings& settings) {
    apply(map_rules, settings, PrintFormat::svg);
}

void check_space_settings(const DrawSettings& settings, PrintFormat format) {
    if (is_relief(settings, format)) refuse_option("relief", "", no_plane);
    apply(space_rules, settings, format);
}

}  // namespace sikku
