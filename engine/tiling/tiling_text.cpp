#include "engine/tiling/tiling_text.h"

#include "engine/base/diagnostic.h"
#include "engine/base/text.h"
#include "engine/geometry/polygon_classes.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <set>
#include <span>
#include <string_view>

namespace sikku {
namespace {

constexpr std::size_t most_listed = 10;  // violations, gaps, figures in a text

/// Formats a number to a millionth.
std::string millionths(double value) {
    const double rounded = std::round(value * 1e6) / 1e6;
    return fmt::format("{}", rounded == 0 ? 0.0 : rounded);  // never -0
}
std::string place(glm::dvec2 at) {
    return millionths(at.x) + ' ' + millionths(at.y);
}
/// Formats degrees to a hundredth.
std::string degrees(double value) {
    return fmt::format("{}", std::round(value * 100) / 100);
}

constexpr double computed = 1e-4;  // equal values that were computed differ by less

bool near(double a, double b, double slack = computed) {
    return std::fabs(a - b) < slack;
}
/// Difference of equal sides.
double side_slack(const TileShape& shape) {
    return std::max(computed, 4 * shape.tolerance);
}
/// Difference of equal angles, in degrees.
double angle_slack(const TileShape& shape) {
    if (shape.sides.empty()) return computed;
    const double shortest = *std::min_element(shape.sides.begin(), shape.sides.end());
    return std::max(computed, angle_error(shape.tolerance, shortest, shortest) * 180 / std::numbers::pi);
}

/// The shortest part whose repetition is the cyclic list.
std::vector<double> period(const std::vector<double>& list, double slack) {
    for (std::size_t length = 1; length < list.size(); ++length) {
        if (list.size() % length != 0) continue;
        bool repeats = true;
        for (std::size_t i = 0; i < list.size(); ++i) repeats = repeats && near(list[i], list[i % length], slack);
        if (repeats) return {list.begin(), list.begin() + static_cast<std::ptrdiff_t>(length)};
    }
    return list;
}

/// The least rotation of a list.
std::vector<double> least(std::vector<double> list, double slack) {
    std::vector<double> best = list;
    const auto less = [slack](double a, double b) { return a < b && !near(a, b, slack); };
    for (std::size_t i = 0; i < list.size(); ++i) {
        std::rotate(list.begin(), list.begin() + 1, list.end());
        if (std::lexicographical_compare(list.begin(), list.end(), best.begin(), best.end(), less)) best = list;
    }
    return best;
}

std::string listed(const std::vector<double>& values, std::string (*format)(double)) {
    constexpr std::size_t most = 24;
    std::string text;
    for (const double value : std::span(values).first(std::min(values.size(), most))) {
        text += (text.empty() ? "" : " ") + format(value);
    }
    return values.size() > most ? text + " …" : text;
}

std::string angles_of(const TileShape& shape) {
    return listed(period(least(shape.angles, angle_slack(shape)), angle_slack(shape)), degrees);
}
std::string sides_of(const TileShape& shape) {
    return listed(period(least(shape.sides, side_slack(shape)), side_slack(shape)), millionths);
}

/// `170 rhombs 36 144`: sides are listed if angles do not distinguish the shape.
std::string shape_text(const TileShape& shape, bool with_sides) {
    const std::string name = shape_name(shape);
    std::string text = fmt::format("{} {}", counted(shape.tiles, name), angles_of(shape));
    if (with_sides) text += ", sides " + sides_of(shape);
    if (shape.is_chiral)
        text += fmt::format(", {} + {} by handedness", shape.tiles - shape.reflected, shape.reflected);
    return text + fmt::format(", in {}", counted(shape.orientations, "orientation"));
}

std::string shapes_text(const TilingExamination& t) {
    std::map<std::string, int> titles;
    const auto title = [](const TileShape& shape) { return shape_name(shape) + angles_of(shape); };
    for (const TileShape& shape : t.shapes) ++titles[title(shape)];
    std::string text = fmt::format("{}: ", t.shapes.size());
    for (std::size_t i = 0; i < std::min(t.shapes.size(), most_listed); ++i) {
        text += (i > 0 ? "; " : "") + shape_text(t.shapes[i], titles[title(t.shapes[i])] > 1);
    }
    return text + (t.shapes.size() > most_listed ? "; …" : "");
}

std::string heading(const std::string& title, std::optional<std::int64_t> n) {
    const std::string name = title.empty() ? "(untitled)" : printable(title);
    return n ? fmt::format("{}, n = {}\n", name, *n) : name + "\n";
}

std::string violation_text(const TileViolation& violation) {
    std::string where = " at " + place(violation.at);
    for (std::size_t i = 0; i < violation.origins.size(); ++i) {
        const TileOrigin& origin = violation.origins[i];
        where += fmt::format("{}{}:{}{}", i == 0 ? ", drawn by " : " and ", origin.line, origin.column,
                             origin.path.empty() ? "" : " (" + origin.path + ")");
    }
    switch (violation.fault) {
        case TileFault::open:
            return fmt::format("polygon {} is open: it does not end where it began; it ends{}", violation.tile,
                               where);
        case TileFault::empty:
            return fmt::format("polygon {} has no area{}", violation.tile, where);
        case TileFault::too_fine:
            return fmt::format(
                "polygon {} loses too many corners that lie almost on a line with their neighbours{}; use a "
                "smaller tolerance",
                violation.tile, where);
        case TileFault::crossing:
            return fmt::format("polygon {} crosses or touches itself{}", violation.tile, where);
        case TileFault::duplicate:
            return fmt::format("tile {} duplicates tile {}{}", violation.tile, violation.other, where);
        case TileFault::overlap:
            break;
    }
    return violation.other == 0 ? fmt::format("tile {} overlaps another one{}", violation.tile, where)
                                : fmt::format("tiles {} and {} overlap{}", violation.other, violation.tile, where);
}

std::string figure_text(const VertexFigure& figure, bool with_shapes) {
    const bool whole = std::all_of(figure.angles.begin(), figure.angles.end(),
                                   [](double angle) { return degrees(angle).find('.') == std::string::npos; });
    std::string text;
    for (const double angle : figure.angles) text += (text.empty() ? "" : whole ? "." : "-") + degrees(angle);
    if (with_shapes) {
        text += " (shapes";
        for (const std::uint32_t shape : figure.shapes) text += fmt::format(" {}", shape + 1);
        text += ")";
    }
    return text;
}

std::string figures_text(const std::vector<VertexFigure>& figures) {
    std::map<std::string, int> titles;
    for (const VertexFigure& figure : figures) ++titles[figure_text(figure, false)];
    std::string text;
    for (std::size_t i = 0; i < std::min(figures.size(), most_listed); ++i) {
        const bool with_shapes = titles[figure_text(figures[i], false)] > 1;
        text += fmt::format("{}{} {}", i > 0 ? ", " : "", figure_text(figures[i], with_shapes), figures[i].count);
    }
    return text + (figures.size() > most_listed ? ", …" : "");
}

std::string colours_text(const TilingExamination& t) {
    if (t.most_colours == 1) return "one colour suffices";
    std::string text = fmt::format("{} colours suffice", t.most_colours);
    if (t.least_colours < t.most_colours) return text + fmt::format(", {} not decided", t.least_colours);
    return text + fmt::format(", {} {} not", t.least_colours - 1, t.least_colours == 2 ? "does" : "do");
}

/// `rhombs 36 144`, with sides if angles do not distinguish the shapes.
std::vector<std::string> kind_names(const std::vector<TileShape>& shapes) {
    std::map<std::string, int> times;
    std::vector<std::string> names;
    for (const TileShape& shape : shapes) {
        names.push_back(fmt::format("{}s {}", shape_name(shape), angles_of(shape)));
        ++times[names.back()];
    }
    for (std::size_t i = 0; i < shapes.size(); ++i) {
        if (times[names[i]] > 1) names[i] += ", sides " + sides_of(shapes[i]);
    }
    return names;
}

std::string with_closed_form(double value, const std::string& unit) {
    const std::string form = closed_form(value);
    const bool is_plain = form.find_first_not_of("0123456789") == std::string::npos;
    return millionths(value) + unit + (form.empty() || is_plain ? "" : ", " + form);
}

/// `0.381966 rhombs 36 144; 0.618034 rhombs 72 108`, with tiles of the other hand, and with colours where shapes
/// do not determine them.
std::string shares_text(const TileGrowth& growth) {
    std::vector<std::string> parts;
    const std::size_t shapes = growth.shapes.size();
    const auto is_none = [](double share) { return share < 1e-9; };
    const auto reflected = [&](std::size_t shape) {
        const bool is_known = shape < growth.reflected.size() && !is_none(growth.reflected[shape]);
        return is_known ? millionths(growth.reflected[shape]) + " reflected" : "";
    };
    if (shapes > 1 && !growth.frequencies.empty()) {
        const std::vector<std::string> names = kind_names(growth.shapes);
        for (std::size_t i = 0; i < shapes; ++i) {
            const std::string hand = reflected(i);
            parts.push_back(millionths(growth.frequencies[i]) + ' ' + names[i] +
                            (hand.empty() ? "" : " (" + hand + ")"));
        }
    } else if (shapes == 1 && !reflected(0).empty()) {
        parts.push_back(reflected(0));
    }
    // Colours that shapes determine add no information.
    std::map<std::uint32_t, std::set<std::optional<int>>> colours;
    for (const TileKindCount& each : growth.counts) {
        if (!each.share || !is_none(*each.share)) colours[each.shape].insert(each.colour);
    }
    const bool says_more =
        std::any_of(colours.begin(), colours.end(), [](const auto& each) { return each.second.size() > 1; });
    for (const auto& [colour, share] : growth.colours) {
        if (says_more && !is_none(share)) parts.push_back(fmt::format("{} colour {}", millionths(share), colour));
    }
    return fmt::format("{}", fmt::join(parts, "; "));
}

std::string growth_text(const TileGrowth& growth) {
    if (!growth.unknown.empty() && growth.counts.empty()) return "unknown: " + growth.unknown;
    if (!growth.tiles) return growth.no_limit;
    std::string text;
    if (growth.length) {
        text = with_closed_form(*growth.length, " a step in length");
        if (std::fabs(growth.turn) > 1e-9) text += ", turned by " + degrees(growth.turn) + " degrees";
    } else {
        text = with_closed_form(*growth.tiles, growth.is_average ? " times as many tiles a step on average"
                                                                 : " times as many tiles a step in the limit");
        text += "; no factor of length: " + growth.no_length;
    }
    if (const std::string shares = shares_text(growth); !shares.empty()) text += "; in the limit " + shares;
    const bool moves = std::any_of(growth.counts.begin(), growth.counts.end(),
                                   [](const TileKindCount& each) { return !each.share.has_value(); });
    if (moves) text += "; shares of kinds do not settle";
    if (growth.period == 1) return text + "; primitive";
    return text +
           (growth.period > 0 ? fmt::format("; irreducible with period {}", growth.period) : "; not primitive");
}

/// `12 violations`.
std::string violations_text(std::uint64_t count) {
    return (count < TileViolations::most_counted ? "" : "at least ") + counted(count, "violation");
}

/// `3 regions joined at corners into 2`.
std::string regions_text(const TilingExamination& t) {
    if (t.regions == 1) return "one region";
    std::string text = counted(t.regions, "region");
    if (t.components == t.regions) return text;
    return text +
           (t.components == 1 ? " joined at corners" : fmt::format(" joined at corners into {}", t.components));
}

std::string verdict(const TilingExamination& t) {
    if (t.polygons == 0) return "no: the word contains no polygon { }";
    if (t.is_tiling()) {
        return fmt::format("yes: {}, {}, no gap, no overlap", counted(t.tiles, "tile"), regions_text(t));
    }
    std::vector<std::string> reasons;
    if (t.violations.count > 0) reasons.push_back(violations_text(t.violations.count));
    if (!t.gaps.empty()) reasons.push_back(counted(t.gaps.size(), "gap"));
    if (reasons.empty()) reasons.emplace_back("the numbers of vertices, edges and tiles, or the areas, do not agree");
    return fmt::format("no: {}; {}", counted(t.tiles, "tile"), fmt::join(reasons, ", "));
}

}  // namespace

std::string shape_name(const TileShape& shape) {
    const double angle = angle_slack(shape), side = side_slack(shape);
    const std::size_t corners = shape.angles.size();
    if (corners == 4) {
        const auto& s = shape.sides;
        const bool right = period(shape.angles, angle).size() == 1;
        if (period(s, side).size() == 1) return right ? "square" : "rhomb";
        if (right) return "rectangle";
        if (near(s[0], s[2], side) && near(s[1], s[3], side)) return "parallelogram";
        if ((near(s[0], s[1], side) && near(s[2], s[3], side)) ||
            (near(s[1], s[2], side) && near(s[3], s[0], side))) {
            return *std::max_element(shape.angles.begin(), shape.angles.end()) > 180 ? "dart" : "kite";
        }
        const auto& a = shape.angles;
        return near(a[0] + a[1], 180, angle) || near(a[1] + a[2], 180, angle) ? "trapezoid" : "quadrilateral";
    }
    constexpr std::array<std::string_view, 13> names = {"",         "",        "",         "triangle", "",
                                                        "pentagon", "hexagon", "heptagon", "octagon",  "enneagon",
                                                        "decagon",  "11-gon",  "dodecagon"};
    return corners < names.size() ? std::string(names[corners]) : fmt::format("{}-gon", corners);
}

std::string tiling_text(const std::string& title, std::optional<std::int64_t> n, const TilingExamination& t,
                        const TileGrowth& growth) {
    std::string text = heading(title, n);
    const auto line = [&](std::string_view name, const std::string& value) {
        text += fmt::format("{:<11}{}\n", name, value);
    };
    line("tiling", verdict(t));
    for (std::size_t i = 0; i < std::min(t.violations.list.size(), most_listed); ++i) {
        line("violation", violation_text(t.violations.list[i]));
    }
    if (t.violations.count > most_listed) line("", fmt::format("… {} in all", violations_text(t.violations.count)));
    for (std::size_t i = 0; i < std::min(t.gaps.size(), most_listed); ++i) {
        line("gap", fmt::format("of area {} around {}", millionths(t.gaps[i].area), place(t.gaps[i].centre)));
    }
    if (t.gaps.size() > most_listed) line("", fmt::format("… {} in all", t.gaps.size()));
    if (t.tiles == 0) return text;
    line("shapes", shapes_text(t));
    line("edges", fmt::format("{}, {}; {} inner, {} on the border{}", t.edges,
                              t.edges_cut == 0 ? "edge-to-edge"
                                               : fmt::format("not edge-to-edge: corners lie inside {}",
                                                             counted(t.edges_cut, "edge")),
                              t.inner_edges, t.border_edges,
                              !t.has_border  ? ""
                              : t.loops == 1 ? ", one loop"
                                             : fmt::format(", {}", counted(t.loops, "loop"))));
    line("vertices", fmt::format("{}; {} inner{}", t.vertices, t.inner_vertices,
                                 t.figures.empty() ? ""
                                                   : fmt::format(" with {}: {}", counted(t.figures.size(), "figure"),
                                                                 figures_text(t.figures))));
    std::string counts;
    for (const auto& [neighbours, tiles] : t.neighbour_counts) {
        counts += counts.empty() ? fmt::format("; {} for {}", neighbours, counted(tiles, "tile"))
                                 : fmt::format(", {} for {}", neighbours, tiles);
    }
    line("neighbours", counted(t.neighbours, "pair") + counts + "; " + colours_text(t));
    line("symmetry", t.symmetry.name() + " about " + place(t.symmetry.centre));
    if (n) line("growth", growth_text(growth));
    line("exact", t.is_exact ? "yes"
                  : !n
                      ? fmt::format("no: corners within {:.3g} of each other count as one, and points within that of "
                                    "an edge count as on it",
                                    t.tolerance)
                      : fmt::format("no: {}{}points within {:.6f} steps of each other count as one", t.inexact,
                                    t.inexact.empty() ? "" : "; ", t.tolerance));
    return text;
}

std::string tile_counts_text(const std::string& title, std::int64_t n, const TileGrowth& growth) {
    std::string text = heading(title, n);
    const auto line = [&](std::string_view name, const std::string& value) {
        text += fmt::format("{:<11}{}\n", name, value);
    };
    if (!growth.unknown.empty()) {
        line("tiles", "unknown without deriving: " + growth.unknown);
        return text;
    }
    Integer sum = 0;
    for (const TileKindCount& each : growth.counts) sum += each.count;
    line("tiles", sum.str());
    const std::vector<std::string> names = kind_names(growth.shapes);
    for (const TileKindCount& each : growth.counts) {
        if (each.count == 0) continue;
        line("", fmt::format("{} {}{}{}, by {}", each.count.str(), names[each.shape],
                             each.is_reflected ? " of the other hand" : "",
                             each.colour ? fmt::format(", colour {}", *each.colour) : "", printable(each.letters)));
    }
    line("growth", growth_text(growth));
    return text;
}

}  // namespace sikku
