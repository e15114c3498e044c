#include "engine/base/json_text.h"
#include "engine/tiling/tiling_text.h"

#include <array>
#include <cmath>
#include <span>
#include <vector>

namespace sikku {
namespace {

/// A number to a billionth, never -0.
double rounded(double value) {
    const double result = std::round(value * 1e9) / 1e9;
    return result == 0 ? 0.0 : result;
}
JsonText json(glm::dvec2 at) {
    return std::array{rounded(at.x), rounded(at.y)};
}
JsonText json(const std::vector<double>& values) {
    return JsonText::list(values, rounded);
}
JsonText json(const std::optional<double>& value) {
    return value ? JsonText(rounded(*value)) : nullptr;
}
/// A number of any size: digits in a string where doubles do not hold it.
JsonText json(const Integer& value) {
    return value < (Integer(1) << 53) ? JsonText::raw(value.str()) : value.str();
}

std::string_view fault_name(TileFault fault) {
    constexpr std::array<std::string_view, 6> names = {"open",     "empty",     "too fine",
                                                       "crossing", "duplicate", "overlap"};
    return names[static_cast<std::size_t>(fault)];
}

JsonText shape_json(const TileShape& shape) {
    return JsonText::object("name", shape_name(shape), "tiles", shape.tiles, "reflected", shape.reflected,
                            "orientations", shape.orientations, "angles", json(shape.angles), "sides",
                            json(shape.sides), "area", rounded(shape.area), "area_4i",
                            shape.area_4i.empty() ? nullptr : JsonText(shape.area_4i));
}

JsonText growth_json(const TileGrowth& growth) {
    const auto shape = [](const TileShape& each) {
        return JsonText::object("name", shape_name(each), "angles", json(each.angles), "sides", json(each.sides),
                                "area", rounded(each.area));
    };
    const auto count = [](const TileKindCount& each) {
        return JsonText::object("shape", each.shape, "reflected", each.is_reflected, "colour", each.colour, "letters",
                                each.letters, "count", json(each.count), "share", json(each.share));
    };
    const auto colour = [](const auto& each) {
        return JsonText::object("colour", each.first, "share", rounded(each.second));
    };
    return JsonText::object(
        "unknown", JsonText::unless_empty(growth.unknown), "shapes", JsonText::list(growth.shapes, shape), "counts",
        JsonText::list(growth.counts, count), "tiles", json(growth.tiles), "average", growth.is_average,
        "frequencies", json(growth.frequencies), "reflected", json(growth.reflected), "colours",
        JsonText::list(growth.colours, colour), "primitive", growth.period == 1, "period", growth.period, "no_limit",
        JsonText::unless_empty(growth.no_limit), "length", json(growth.length), "closed_form",
        JsonText::unless_empty(growth.length ? closed_form(*growth.length) : ""), "turn", rounded(growth.turn),
        "no_length", JsonText::unless_empty(growth.no_length));
}

JsonText lattice_json(const TilePlane& plane) {
    if (!plane.is_exact()) return nullptr;
    const Lattice& lattice = plane.lattice();
    std::vector<JsonText> basis;
    for (int i = 0; i < lattice.rank; ++i) basis.push_back(json(lattice.unit * lattice.basis(i)));
    return JsonText::object("k", lattice.headings, "rank", lattice.rank, "basis", basis);
}

JsonText violation_json(const TileViolation& violation) {
    const auto origin = [](const TileOrigin& each) {
        return JsonText::object("line", each.line, "column", each.column, "path", JsonText::unless_empty(each.path));
    };
    return JsonText::object("fault", fault_name(violation.fault), "tile", violation.tile, "other",
                            violation.other == 0 ? nullptr : JsonText(violation.other), "at", json(violation.at),
                            "origins", JsonText::list(violation.origins, origin));
}

/// All facts but those of single loops and tiles.
JsonText facts_json(const std::string& title, std::optional<std::int64_t> n, const TilingResult& result,
                    const TileGrowth& growth) {
    const TilingExamination& t = result.examination;
    const auto gap = [](const TileGap& each) {
        return JsonText::object("area", rounded(each.area), "centre", json(each.centre));
    };
    const auto figure = [](const VertexFigure& each) {
        return JsonText::object("angles", json(each.angles), "shapes", each.shapes, "count", each.count);
    };
    const auto known = [&](JsonText value) { return t.has_border ? std::move(value) : nullptr; };
    return JsonText::object(
        "title", title, "n", n ? JsonText::whole(*n) : nullptr, "tiling", t.is_tiling(), "exact", t.is_exact,
        "inexact", JsonText::unless_empty(t.inexact), "tolerance", t.tolerance, "lattice",
        lattice_json(result.patch.plane), "polygons", t.polygons, "tiles", t.tiles, "violations", t.violations.count,
        "violation_list", JsonText::list(t.violations.list, violation_json), "regions", known(t.regions),
        "components", known(t.components), "gaps", known(JsonText::list(t.gaps, gap)), "area", rounded(t.area),
        "euler", t.euler_agrees, "areas_agree", t.areas_agree, "shapes", JsonText::list(t.shapes, shape_json),
        "edges", t.edges, "inner_edges", t.inner_edges, "border_edges", t.border_edges, "edges_cut", t.edges_cut,
        "vertices", t.vertices, "inner_vertices", t.inner_vertices, "figures", JsonText::list(t.figures, figure),
        "neighbours", t.neighbours, "neighbour_counts", t.neighbour_counts, "least_colours", t.least_colours,
        "most_colours", t.most_colours, "symmetry", t.symmetry.name(), "rotations", t.symmetry.rotations, "mirrors",
        t.symmetry.mirrors, "centre", json(t.symmetry.centre), "growth", growth_json(growth));
}

JsonText tile_json(const TilingPatch& patch, std::uint32_t tile, const std::string& path) {
    const TileSet& tiles = patch.tiles;
    const TileClass& in_class = tiles.class_of(tile);
    const auto place = [&](std::uint32_t point) { return json(patch.plane.at(point)); };
    const auto exact = [&](std::uint32_t point) {
        const Cyclotomic::Number at = patch.plane.coordinates(point);
        return JsonText(std::span(at).first(patch.plane.numbers().rank()));
    };
    const auto number = [&](std::uint32_t other) { return tiles.number[other]; };
    return JsonText::object(
        "tile", tiles.number[tile], "shape", in_class.shape, "reflected", in_class.is_reflected, "orientation",
        tiles.in_class[tile], "colour", tiles.colour[tile], "corners", JsonText::list(tiles.corners(tile), place),
        "exact", patch.plane.is_exact() ? JsonText::list(tiles.corners(tile), exact) : nullptr, "neighbours",
        JsonText::list(patch.neighbours.of(tile), number), "neighbour_colour",
        patch.colours.empty() ? nullptr : JsonText(patch.colours[tile]), "path", JsonText::unless_empty(path));
}

JsonText loop_json(const TilingPatch& patch, const TileLoop& loop) {
    const auto start = [&](std::uint32_t side) { return json(patch.plane.at(patch.pieces.from[side])); };
    return JsonText::list(std::span(patch.border.sides).subspan(loop.begin, loop.end - loop.begin), start);
}

}  // namespace

std::string tiling_json(const std::string& title, std::optional<std::int64_t> n, const TilingResult& result,
                        const TileGrowth& growth) {
    return facts_json(title, n, result, growth).line();
}

void write_tiling_json(const std::string& title, std::optional<std::int64_t> n, const TilingResult& result,
                       const TileGrowth& growth, const std::function<std::string(std::uint32_t)>& path,
                       const std::function<void(std::string_view)>& write) {
    std::string facts = facts_json(title, n, result, growth).text;
    facts.pop_back();
    const TilingPatch& patch = result.patch;
    write(facts + ", \"border\": [");
    for (std::size_t i = 0; i < patch.border.loops.size(); ++i) {
        write((i > 0 ? ", " : "") + loop_json(patch, patch.border.loops[i]).text);
    }
    write("], \"list\": [");
    for (std::uint32_t tile = 0; tile < patch.tiles.tiles(); ++tile) {
        write((tile > 0 ? ", " : "") + tile_json(patch, tile, path ? path(patch.tiles.number[tile]) : "").text);
    }
    write("]}\n");
}

std::string tile_counts_json(const std::string& title, std::int64_t n, const TileGrowth& growth) {
    return JsonText::object("title", title, "n", JsonText::whole(n), "growth", growth_json(growth)).line();
}

}  // namespace sikku
