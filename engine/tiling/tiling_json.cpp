#include "engine/base/text.h"
#include "engine/tiling/tiling_text.h"

#include <fmt/format.h>

#include <cmath>
#include <span>

namespace sikku {
namespace {

/// Formats a number to a billionth.
std::string number(double value) {
    const double rounded = std::round(value * 1e9) / 1e9;
    return fmt::format("{}", rounded == 0 ? 0.0 : rounded);  // never -0
}
std::string json(glm::dvec2 at) {
    return fmt::format("[{}, {}]", number(at.x), number(at.y));
}
std::string json(const std::vector<double>& values) {
    std::string text = "[";
    for (const double value : values) text += (text.size() > 1 ? ", " : "") + number(value);
    return text + "]";
}
std::string json(bool value) {
    return value ? "true" : "false";
}
std::string json(const std::optional<double>& value) {
    return value ? number(*value) : "null";
}
/// A number of any size: digits in a string where doubles do not hold it.
std::string json(const Integer& value) {
    return value < (Integer(1) << 53) ? value.str() : "\"" + value.str() + "\"";
}
/// Joins the results of `format` for all elements.
template <class List, class Format>
std::string array(const List& list, Format&& format) {
    std::string text = "[";
    for (const auto& each : list) text += (text.size() > 1 ? ", " : "") + format(each);
    return text + "]";
}

std::string fault_name(TileFault fault) {
    switch (fault) {
        case TileFault::open:
            return "open";
        case TileFault::empty:
            return "empty";
        case TileFault::too_fine:
            return "too fine";
        case TileFault::crossing:
            return "crossing";
        case TileFault::duplicate:
            return "duplicate";
        case TileFault::overlap:
            break;
    }
    return "overlap";
}

std::string whole_json(std::span<const std::int64_t> numbers) {
    return array(numbers, [](std::int64_t each) { return fmt::format("{}", each); });
}

std::string shape_json(const TileShape& shape) {
    return fmt::format(
        "{{\"name\": \"{}\", \"tiles\": {}, \"reflected\": {}, \"orientations\": {}, \"angles\": {}, "
        "\"sides\": {}, \"area\": {}, \"area_4i\": {}}}",
        shape_name(shape), shape.tiles, shape.reflected, shape.orientations, json(shape.angles), json(shape.sides),
        number(shape.area), shape.area_4i.empty() ? "null" : whole_json(shape.area_4i));
}

std::string growth_json(const TileGrowth& growth) {
    const auto reason = [](const std::string& text) { return text.empty() ? "null" : json_string(text); };
    return fmt::format(
        "{{\"unknown\": {}, \"shapes\": {}, \"counts\": {}, \"tiles\": {}, \"average\": {}, \"frequencies\": {}, "
        "\"reflected\": {}, \"colours\": {}, \"primitive\": {}, "
        "\"period\": {}, \"no_limit\": {}, \"length\": {}, \"closed_form\": {}, \"turn\": {}, \"no_length\": {}}}",
        reason(growth.unknown),
        array(growth.shapes,
              [](const TileShape& shape) {
                  return fmt::format("{{\"name\": \"{}\", \"angles\": {}, \"sides\": {}, \"area\": {}}}",
                                     shape_name(shape), json(shape.angles), json(shape.sides), number(shape.area));
              }),
        array(growth.counts,
              [](const TileKindCount& each) {
                  return fmt::format(
                      "{{\"shape\": {}, \"reflected\": {}, \"colour\": {}, \"letters\": {}, \"count\": {}, "
                      "\"share\": {}}}",
                      each.shape, json(each.is_reflected), each.colour ? fmt::format("{}", *each.colour) : "null",
                      json_string(each.letters), json(each.count), json(each.share));
              }),
        json(growth.tiles), json(growth.is_average), json(growth.frequencies), json(growth.reflected),
        array(growth.colours,
              [](const auto& each) {
                  return fmt::format("{{\"colour\": {}, \"share\": {}}}", each.first, number(each.second));
              }),
        json(growth.period == 1), growth.period, reason(growth.no_limit), json(growth.length),
        growth.length ? reason(closed_form(*growth.length)) : "null", number(growth.turn), reason(growth.no_length));
}

std::string lattice_json(const TilePlane& plane) {
    if (!plane.is_exact()) return "null";
    const Lattice& lattice = plane.lattice();
    std::string basis = "[";
    for (int i = 0; i < lattice.rank; ++i) basis += (i > 0 ? ", " : "") + json(lattice.unit * lattice.basis(i));
    return fmt::format("{{\"k\": {}, \"rank\": {}, \"basis\": {}]}}", lattice.headings, lattice.rank, basis);
}

std::string origin_json(const TileOrigin& origin) {
    return fmt::format("{{\"line\": {}, \"column\": {}, \"path\": {}}}", origin.line, origin.column,
                       origin.path.empty() ? "null" : json_string(origin.path));
}

std::string facts_json(const TilingResult& result, const TileGrowth& growth) {
    const TilingExamination& t = result.examination;
    std::string text = fmt::format(
        "\"tiling\": {}, \"exact\": {}, \"inexact\": {}, \"tolerance\": {}, \"lattice\": {}, \"polygons\": {}, "
        "\"tiles\": {}, ",
        json(t.is_tiling()), json(t.is_exact), t.inexact.empty() ? "null" : json_string(t.inexact),
        fmt::format("{}", t.tolerance), lattice_json(result.patch.plane), t.polygons, t.tiles);
    text += fmt::format("\"violations\": {}, \"violation_list\": {}, ", t.violations.count,
                        array(t.violations.list, [](const TileViolation& violation) {
                            return fmt::format(
                                "{{\"fault\": \"{}\", \"tile\": {}, \"other\": {}, \"at\": {}, \"origins\": {}}}",
                                fault_name(violation.fault), violation.tile,
                                violation.other == 0 ? "null" : fmt::format("{}", violation.other),
                                json(violation.at), array(violation.origins, origin_json));
                        }));
    const auto known = [&](std::string value) { return t.has_border ? std::move(value) : "null"; };
    text += fmt::format(
        "\"regions\": {}, \"components\": {}, \"gaps\": {}, \"area\": {}, \"euler\": {}, \"areas_agree\": {}, ",
        known(std::to_string(t.regions)), known(std::to_string(t.components)),
        known(array(t.gaps,
                    [](const TileGap& gap) {
                        return fmt::format("{{\"area\": {}, \"centre\": {}}}", number(gap.area), json(gap.centre));
                    })),
        number(t.area), json(t.euler_agrees), json(t.areas_agree));
    text += fmt::format("\"shapes\": {}, ", array(t.shapes, shape_json));
    text += fmt::format("\"edges\": {}, \"inner_edges\": {}, \"border_edges\": {}, \"edges_cut\": {}, ", t.edges,
                        t.inner_edges, t.border_edges, t.edges_cut);
    text +=
        fmt::format("\"vertices\": {}, \"inner_vertices\": {}, \"figures\": {}, ", t.vertices, t.inner_vertices,
                    array(t.figures, [](const VertexFigure& figure) {
                        return fmt::format("{{\"angles\": {}, \"shapes\": {}, \"count\": {}}}", json(figure.angles),
                                           array(figure.shapes, [](std::uint32_t i) { return fmt::format("{}", i); }),
                                           figure.count);
                    }));
    text += fmt::format(
        "\"neighbours\": {}, \"neighbour_counts\": {}, \"least_colours\": {}, \"most_colours\": {}, ", t.neighbours,
        array(t.neighbour_counts, [](const auto& each) { return fmt::format("[{}, {}]", each.first, each.second); }),
        t.least_colours, t.most_colours);
    text += fmt::format("\"symmetry\": \"{}\", \"rotations\": {}, \"mirrors\": {}, \"centre\": {}, ",
                        t.symmetry.name(), t.symmetry.rotations, t.symmetry.mirrors, json(t.symmetry.centre));
    return text + "\"growth\": " + growth_json(growth);
}

std::string tile_json(const TilingPatch& patch, std::uint32_t tile, const std::string& path) {
    const TileSet& tiles = patch.tiles;
    const TileClass& in_class = tiles.class_of(tile);
    std::string corners, exact, neighbours;
    for (const std::uint32_t point : tiles.corners(tile)) {
        corners += (corners.empty() ? "" : ", ") + json(patch.plane.at(point));
        if (!patch.plane.is_exact()) continue;
        const Cyclotomic::Number at = patch.plane.coordinates(point);
        exact += (exact.empty() ? "" : ", ") + whole_json(std::span(at).first(patch.plane.numbers().rank()));
    }
    for (const std::uint32_t other : patch.neighbours.of(tile)) {
        neighbours += fmt::format("{}{}", neighbours.empty() ? "" : ", ", tiles.number[other]);
    }
    return fmt::format(
        "{{\"tile\": {}, \"shape\": {}, \"reflected\": {}, \"orientation\": {}, \"colour\": {}, \"corners\": [{}], "
        "\"exact\": {}, \"neighbours\": [{}], \"neighbour_colour\": {}, \"path\": {}}}",
        tiles.number[tile], in_class.shape, json(in_class.is_reflected), tiles.in_class[tile], tiles.colour[tile],
        corners, patch.plane.is_exact() ? "[" + exact + "]" : "null", neighbours,
        patch.colours.empty() ? "null" : fmt::format("{}", patch.colours[tile]),
        path.empty() ? "null" : json_string(path));
}

std::string loop_json(const TilingPatch& patch, const TileLoop& loop) {
    std::string text = "[";
    for (std::uint32_t i = loop.begin; i < loop.end; ++i) {
        const std::uint32_t side = patch.border.sides[i];
        text += (i > loop.begin ? ", " : "") + json(patch.plane.at(patch.pieces.from[side]));
    }
    return text + "]";
}

std::string head(const std::string& title, std::optional<std::int64_t> n) {
    return fmt::format("{{\"title\": {}, \"n\": {}, ", json_string(title),
                       !n                             ? "null"
                       : *n < (std::int64_t{1} << 53) ? fmt::format("{}", *n)
                                                      : fmt::format("\"{}\"", *n));
}

}  // namespace

void write_tiling_json(const std::string& title, std::optional<std::int64_t> n, const TilingResult& result,
                       const TileGrowth& growth, const std::function<std::string(std::uint32_t)>& path,
                       const std::function<void(std::string_view)>& write) {
    write(head(title, n) + facts_json(result, growth));
    const TilingPatch& patch = result.patch;
    write(", \"border\": [");
    for (std::size_t i = 0; i < patch.border.loops.size(); ++i) {
        write((i > 0 ? ", " : "") + loop_json(patch, patch.border.loops[i]));
    }
    write("], \"list\": [");
    for (std::uint32_t tile = 0; tile < patch.tiles.tiles(); ++tile) {
        write((tile > 0 ? ", " : "") + tile_json(patch, tile, path ? path(patch.tiles.number[tile]) : ""));
    }
    write("]}\n");
}

std::string tile_counts_json(const std::string& title, std::int64_t n, const TileGrowth& growth) {
    return head(title, n) + "\"growth\": " + growth_json(growth) + "}\n";
}

}  // namespace sikku
