#include "art/product/plot_remarks.h"

#include "art/style/colour.h"
#include "engine/base/text.h"
#include "engine/geometry/lettering.h"

#include <fmt/format.h>

#include <algorithm>

namespace sikku {

namespace {

void warn_of_unused(const PlotReport& plot, std::span<const PenRule> rules, Made& made) {
    for (const PenRule& rule : rules) {
        const bool is_used = std::any_of(plot.pens.begin(), plot.pens.end(), [&](const PenTally& pen) {
            return rule.colour ? pen.colour == *rule.colour : pen.number == rule.number;
        });
        if (is_used) continue;
        made.warn(rule.colour
                      ? fmt::format("'pen' {} has no effect: no pen has this colour", colour_name(*rule.colour))
                      : fmt::format("'pen' {} has no effect: the plot uses {}", rule.number,
                                    counted(plot.pens.size(), "pen")));
    }
}

/// Reports strokes that one pass of a common pen does not cover.
void report_wide_strokes(const std::vector<PenTally>& pens, Made& made) {
    constexpr double usual = 1.0, thin = 0.2;  // millimetres
    double widest = 0;
    for (const PenTally& pen : pens) {
        const StrokeWidths& widths = pen.widths;
        if (widths.most >= usual || widths.most >= std::max(thin, 2 * widths.least))
            widest = std::max(widest, widths.most);
    }
    if (widest == 0) return;
    made.fact(fmt::format(
        "strokes up to {:.1f} mm wide are drawn in one pass; set 'pen-width' to draw them in several", widest));
}

}  // namespace

void warn_of_letters(std::string warning, Made& made) {
    if (!warning.empty()) made.warn(std::move(warning));
}

std::string regions_text(const RegionReport& regions) {
    return regions.count == 1
               ? fmt::format("1 region of {:.0f} mm² to colour", regions.least)
               : fmt::format("{} regions to colour, the smallest of {:.0f} mm²", regions.count, regions.least);
}

std::string faint_text(const FaintInk& ink) {
    const char* const what = ink.kind == FaintInk::Kind::lines   ? "lines"
                             : ink.kind == FaintInk::Kind::discs ? "dots"
                                                                 : "fields";
    const char* const key = ink.kind == FaintInk::Kind::lines   ? "'stroke'"
                            : ink.kind == FaintInk::Kind::discs ? "'dots'"
                                                                : "'powders'";
    const std::string colour = colour_name(ink.ink), ground = colour_name(ink.ground);
    return fmt::format("{} in {} can hardly be seen on {}; set the colour of {}, or 'ground'", what, colour,
                       colour == ground ? "a ground of the same colour" : "a ground in " + ground, key);
}

void warn_of_faint_inks(std::span<const FaintInk> inks, Made& made) {
    std::vector<std::string> texts;
    for (const FaintInk& ink : inks) {
        const std::string text = faint_text(ink);
        if (std::find(texts.begin(), texts.end(), text) == texts.end()) texts.push_back(text);
    }
    for (const std::string& text : texts) made.warn(text);
}

void report_plot(const PlotReport& plot, const PlotSpeeds& speeds, std::span<const PenRule> rules, Made& made) {
    warn_of_unused(plot, rules, made);
    if (plot.tiles > 0) {
        made.fact(
            fmt::format("{} as closed outlines in layers by shape, hand and colour", counted(plot.tiles, "tile")));
    }
    if (plot.tiles > 0 && plot.segments == 0) return;
    const auto line = [&](const PlotTally& tally, double seconds) {
        return fmt::format("{:.2f} m drawn, {:.2f} m pen-up travel{}, {}, about {}", tally.drawn / 1000,
                           tally.travelled / 1000, plot.returns ? ", return included" : "",
                           counted(tally.lifts, "lift"), time_text(seconds));
    };
    made.fact("before: " + line(plot.before, plot_seconds(plot.before, plot.pens_before, speeds)));
    made.fact("plot:   " + line(plot.after, plot_seconds(plot.after, plot.pens, speeds)));
    report_wide_strokes(plot.pens, made);
    if (plot.duplicates > 0) {
        made.fact(fmt::format("{} drawn twice in the pattern, once here", counted(plot.duplicates, "segment")));
    }
    if (!plot.merged.empty()) {
        made.fact(fmt::format("{} in {}:", counted(plot.colours, "colour"),
                              counted(plot.colours - plot.merged.size(), "pen")));
    }
    for (const MergedPen& merged : plot.merged) {
        made.fact(fmt::format("  {} ({:.2f} m) is drawn with pen {}, {}", colour_name(merged.colour),
                              merged.drawn / 1000, merged.number, colour_name(merged.pen)));
    }
}

void warn_of_no_tiles(std::uint64_t tiles, const DrawSettings& settings, Made& made) {
    if (!settings.paper.names_tiles || tiles > 0) return;
    made.warn_of_unused("name-tiles", "this drawing has no filled polygons with straight edges");
}

void report_hpgl(const PlotReport& plot, const DrawSettings& settings, const HpglOptions& options, Made& made) {
    made.fact("HP-GL: " + describe_hpgl(settings.paper.page, options));
    if (settings.paper.widens_margin) {
        made.fact(fmt::format("the margin is {:g} mm, beyond which the plotter does not reach",
                              settings.paper.page.margin));
    }
    constexpr std::size_t most = 8;
    const std::size_t pens = plot.colours - plot.merged.size();
    if (pens <= most) return;
    made.warn(fmt::format(
        "the plot needs {} pens, but HP-GL plotters hold up to {}: the option 'pens' merges colours", pens, most));
}

std::vector<std::string> drawing_warnings(const DrawReport& report, const Style& style, const DrawSettings& settings,
                                          bool is_plot) {
    std::vector<std::string> warnings;
    if (style.dots && report.dots == 0 && report.sheets == 0) {
        warnings.emplace_back("no dots were drawn: the lines enclose none");
    }
    if (style.fields && report.fields == 0 && !settings.look.only_dots) {
        warnings.emplace_back("no fields were filled: the drawing has no closed line");
    }
    if (is_plot && report.fields > 0 && !settings.plot.hatch) {
        warnings.emplace_back("plots fill fields only by hatching: set 'hatch'");
    }
    if (!style.powders.empty() && !style.fields && !style.tile_colours) {
        warnings.emplace_back(
            "'powders' has no effect: powders colour fields and tiles; set 'fields', for example to kind, or 'tile "
            "colours'");
    }
    if (report.cuts_title) {
        warnings.emplace_back(
            "the title line is too long for its place and is shortened; a smaller 'title-size' or a larger page "
            "shows more of it");
    }
    if (report.cuts_edition) {
        warnings.emplace_back(
            "the edition is too long for its place and is shortened; a larger page shows more of it");
    }
    if (report.lacks_worms) {
        warnings.emplace_back("no tiles form worms: only rhombs do, three around a vertex");
    } else if (report.tiles_are_alike) {
        warnings.emplace_back(
            "'tile colours' gives all tiles one colour: all tiles agree in the property that sets the colour");
    }
    if (report.woven && *report.woven == 0) warnings.emplace_back("'weave' has no effect: the lines do not cross");
    // Without a spacing of the pattern they lie as near to each other as they have to.
    const double least = style.parallel.is_spaced ? 0.999 : 0.1;
    if (report.parallel && report.parallel->spacing < least * report.parallel->wanted) {
        warnings.push_back(fmt::format(
            "'parallel': {:.2g} mm from line to line do not fit between the turns and the neighbours of the "
            "lines; they are drawn {:.2g} mm apart and {:.2g} mm wide",
            report.parallel->wanted, report.parallel->spacing, report.parallel->width));
    }
    return warnings;
}

std::vector<std::string> space_warnings(const DrawSettings& settings, bool is_spatial, PrintFormat format) {
    std::vector<std::string> warnings;
    if (!settings.look.view.empty() && !is_spatial) {
        warnings.emplace_back("'view' has no effect: the drawing lies in the plane");
    }
    if (!is_spatial && std::any_of(settings.keys.begin(), settings.keys.end(),
                                   [](const Setting& key) { return key.key == "sway"; })) {
        warnings.emplace_back("'sway' has no effect: the drawing lies in the plane");
    }
    if (!settings.look.light.empty() && !is_spatial) {
        warnings.emplace_back("'light' has no effect: the drawing lies in the plane");
    } else if (!settings.look.light.empty() && is_vector(format)) {
        warnings.emplace_back("'light' has no effect: only pictures have light; vectors have flat facets");
    }
    return warnings;
}

}  // namespace sikku
