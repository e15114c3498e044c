#include "art/product/unused_options.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>

namespace sikku {
namespace {

/// An option that has no effect, and why.
struct Unused {
    std::string_view option;
    bool is_unused;
    std::string reason;
};

bool depends_on_ground(const DrawSettings& settings, const Style& style) {
    return style.border || style.fields || style.dots || settings.look.colours_strokes || settings.look.title_line ||
           !settings.look.edition.empty();
}

/// True if no shape of the drawing has a colour of the palette.
bool hides_palette(const Contents& contents, const Style& style) {
    const auto is_first = [](const std::vector<int>& indices) {
        return std::all_of(indices.begin(), indices.end(), [](int index) { return index == 0; });
    };
    const bool has_own = style.tile_colours || style.fields || style.decoration.is_set() || style.border;
    return !has_own && is_first(contents.lines) && is_first(contents.fills) &&
           (contents.lines.empty() || style.stroke_colour) && (!contents.has_fills() || style.fill);
}

/// True if no pen of a plot has the colour that fills.
bool has_no_pen(const PlotReport& plot, const Style& style) {
    return style.fill && std::none_of(plot.pens.begin(), plot.pens.end(),
                                      [&](const PenTally& pen) { return pen.colour == *style.fill; });
}

std::vector<Unused> by_format(const GivenOptions& given, const DrawSettings& settings, const Style& style,
                              PrintFormat format, bool is_spatial) {
    const FormatKind kind = info(format).kind;
    const bool is_plot = settings.plot.plotter || is_for_plotters(format);
    const bool is_model = kind == FormatKind::model;
    const bool is_flat_model = is_model && is_relief(settings, format);
    const bool is_picture = kind == FormatKind::pixels || kind == FormatKind::animation;
    const std::string label(info(format).label);
    const char* const no_plot = "it applies only to plots";
    const bool has_shadow = is_spatial && !is_vector(format) && !is_model && !style.light.is_flat;
    return {{"pen-speed", !is_plot, no_plot},
            {"travel-speed", !is_plot, no_plot},
            {"lift-time", !is_plot, no_plot},
            {"gcode-start", format != PrintFormat::gcode, "it applies only to G-code"},
            {"gcode-end", format != PrintFormat::gcode, "it applies only to G-code"},
            {"icc", !is_picture, "only pictures contain a colour profile"},
            {"dpi", !is_picture && !given.has_pixels, label + " has no pixels, and no length is in px"},
            {"compression", format != PrintFormat::png, "it applies only to PNG"},
            {"ground", is_model || (is_for_plotters(format) && !depends_on_ground(settings, style)),
             label + " has no ground"},
            {"size", is_model && !is_flat_model && style.stroke.in_steps, "a model has no page"},
            {"landscape", is_model && !is_flat_model && style.stroke.in_steps, "a model has no page"},
            {"margin", is_model && !is_flat_model && style.stroke.in_steps, "a model has no page"},
            {"powders", is_model && !style.fields && !style.tile_colours, "powders colour fields and tiles"},
            {"tile-edges", is_flat_model, "the polygons of a relief have grooves between them instead of edges"},
            {"ground-plane", !has_shadow,
             is_spatial ? "only pictures with a light show the ground" : "the drawing lies in the plane"}};
}

std::vector<Unused> by_drawing(const DrawSettings& settings, const Style& style, PrintFormat format,
                               const DrawReport& report) {
    std::vector<Unused> list;
    list.push_back({"colour-by", report.has_one_strand_colour,
                    "the drawing has one line, or all its lines are images of each other"});
    for (const char* lines : {"colour-by", "weave", "parallel", "fields"}) {
        list.push_back({lines, settings.look.only_dots, "only the dots are drawn"});
    }
    if (report.plot) {
        const PlotReport& plot = *report.plot;
        const auto colours = static_cast<int>(plot.colours);
        list.push_back(
            {"pens", settings.plot.pens >= colours,
             fmt::format("the drawing has only {}", colours == 1 ? "1 colour" : fmt::format("{} colours", colours))});
        list.push_back({"park", plot.pens.size() < 2, "the plot has one pen, which is not changed"});
        for (const char* arcs : {"arcs", "min-arc"}) {
            list.push_back({arcs, format == PrintFormat::gcode && plot.curves == 0, "the drawing has no curves"});
        }
        list.push_back({"resume", plot.skipped <= 0, "the first line of the plot is longer"});
    }
    list.push_back({"ridge", report.lacks_ridges, "no line is higher than the rest"});
    if (!report.contents) return list;
    const Contents& contents = *report.contents;
    const bool has_fills = contents.has_fills();
    const bool is_bare_plot = report.plot && !settings.plot.hatch && !settings.paper.names_tiles;
    const std::string unhatched = "plots fill shapes only by hatching: set 'hatch'";
    list.push_back({"fill", !has_fills, "the drawing has no filled shapes"});
    list.push_back({"fill", has_fills && is_bare_plot && has_no_pen(*report.plot, style), unhatched});
    list.push_back({"palette", hides_palette(contents, style),
                    has_fills ? "all lines have the colour of 'stroke', and all shapes that of 'fill'"
                              : "all lines have the colour of 'stroke'"});
    for (const char* tiles : {"tile-colours", "tile-edges", "decorate", "groove"}) {
        list.push_back({tiles, !contents.has_polygons, "the drawing has no polygons"});
    }
    list.push_back(
        {"tile-colours", contents.has_polygons && is_bare_plot && style.tile_edges != TileEdges::none, unhatched});
    return list;
}

}  // namespace

GivenOptions given_options(const OptionValues& values, const std::vector<Setting>& keys, const std::string& pattern) {
    GivenOptions given;
    given.recipe = recipe_options(draw_options(), without_keys(values, keys));
    given.has_pixels = pattern.find("px") != std::string::npos;
    for (const OptionValue& value : values) {
        given.names.insert(value.name);
        given.has_pixels = given.has_pixels || value.text.find("px") != std::string::npos;
    }
    return given;
}

bool needs_contents(const GivenOptions& given) {
    constexpr std::array<std::string_view, 6> names = {"fill",       "palette",  "tile-colours",
                                                       "tile-edges", "decorate", "groove"};
    return std::any_of(names.begin(), names.end(), [&](std::string_view name) { return given.has(name); });
}

Contents contents_in_space(const Grammar& grammar) {
    Contents contents;
    bool has_colours = false;
    const std::vector<char> reached = grammar.reachable();
    for (std::size_t symbol = 0; symbol < reached.size(); ++symbol) {
        if (!reached[symbol]) continue;
        switch (grammar.symbols()[symbol].command.action) {
            case Action::polygon_begin:
                contents.has_polygons = true;
                break;
            case Action::surface:
                contents.has_areas = true;
                break;
            case Action::disc:
                contents.has_discs = true;
                break;
            case Action::colour_step:
            case Action::colour_set:
                has_colours = true;
                break;
            default:
                break;
        }
    }
    contents.lines = has_colours ? std::vector{0, 1} : std::vector{0};
    if (contents.has_fills()) contents.fills = contents.lines;
    return contents;
}

void warn_of_unused(const GivenOptions& given, const DrawSettings& settings, const Style& style, PrintFormat format,
                    bool is_spatial, const DrawReport& report, Made& made) {
    std::vector<Unused> all = by_format(given, settings, style, format, is_spatial);
    for (Unused& one : by_drawing(settings, style, format, report)) all.push_back(std::move(one));
    for (const Unused& one : all) {
        if (one.is_unused && given.has(one.option)) made.warn_of_unused(std::string(one.option), one.reason);
    }
}

std::set<std::string> options_without_effect(const Document& document, const DrawSettings& settings,
                                             PrintFormat format) {
    const Grammar& grammar = document.grammar();
    const bool is_spatial = grammar.is_spatial();
    std::set<std::string> names;
    for (const Unused& one : by_format({}, settings, read_print_style(document, settings), format, is_spatial)) {
        if (one.is_unused) names.emplace(one.option);
    }
    if (!is_spatial) {
        for (const Option<DrawSettings>& row : draw_options()) {
            if (row.info.scope == Scope::space) names.emplace(row.info.name);
        }
    }
    const auto makes_polygon = [](Action action) {
        return action == Action::polygon_begin || action == Action::edge_begin;
    };
    if (!document.map() && !grammar.leads_to(makes_polygon)) {
        names.insert({"fill-page", "swatch", "tile-colours", "tile-edges", "decorate", "groove", "name-tiles", "kerf",
                      "divide"});
    }
    return names;
}

}  // namespace sikku
