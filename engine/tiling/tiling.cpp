#include "engine/tiling/tiling.h"

#include "engine/base/decimal.h"
#include "engine/base/threads.h"
#include "engine/derivation/forecast.h"

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <stdexcept>

namespace sikku {
namespace {

std::vector<TileShape> shapes_of(const TilePlane& plane, const TileSet& tiles) {
    std::vector<TileShape> shapes(tiles.shapes);
    std::vector<std::uint64_t> counts(tiles.classes.size(), 0);
    for (const std::uint32_t in_class : tiles.in_class) ++counts[in_class];
    for (std::size_t i = 0; i < tiles.classes.size(); ++i) {
        const TileClass& each = tiles.classes[i];
        TileShape& shape = shapes[each.shape];
        if (shape.tiles == 0) {
            for (const std::uint32_t angle : each.angles) shape.angles.push_back(tiles.angles[angle]);
            for (const std::uint32_t vector : each.vectors) {
                const glm::dvec2 side = plane.vector_at(vector);
                shape.sides.push_back(std::sqrt(scalar_product(side, side)));
            }
            shape.area = each.area;
            if (plane.is_exact()) {
                const auto rank = static_cast<std::ptrdiff_t>(plane.numbers().rank());
                shape.area_4i.assign(each.area_4i.begin(), each.area_4i.begin() + rank);
            }
            if (plane.is_rough()) shape.tolerance = plane.tolerance();
        }
        shape.tiles += counts[i];
        if (each.is_reflected) shape.reflected += counts[i];
        ++shape.orientations;
    }
    for (TileShape& shape : shapes) shape.is_chiral = shape.reflected > 0;
    return shapes;
}

void count_neighbours(const TileNeighbours& neighbours, TilingExamination& result) {
    std::map<std::uint64_t, std::uint64_t, std::greater<>> counts;
    for (std::uint32_t tile = 0; tile < neighbours.tiles(); ++tile) {
        const std::uint64_t count = neighbours.of(tile).size();
        ++counts[count];
        result.neighbours += count;
    }
    result.neighbours /= 2;
    result.neighbour_counts.assign(counts.begin(), counts.end());
}

void examine_neighbours(TilingPatch& patch, const TilingOptions& options, TilingExamination& result) {
    count_neighbours(patch.neighbours, result);
    TileColouring colouring = find_colours(patch.neighbours, options.colours, options.monitor);
    result.least_colours = colouring.at_least;
    result.most_colours = colouring.at_most;
    patch.colours = std::move(colouring.colours);
}

/// Finds the border of tiles whose vertices do not overlap.
void examine_border(TilingPatch& patch, const TileVertices& vertices, const Monitor& monitor,
                    TilingExamination& result) {
    patch.border = find_border(patch.plane, patch.tiles, patch.pieces, patch.neighbours, monitor);
    const TileBorder& border = patch.border;
    result.violations.add(border.overlaps);
    result.has_border = border.overlaps.count == 0;
    result.regions = border.regions;
    result.components = border.components;
    result.loops = border.loops.size();
    result.gaps = border.gaps;
    result.areas_agree = border.areas_agree;
    const auto whole = [](std::uint64_t number) { return static_cast<std::int64_t>(number); };
    result.euler_agrees = border.loops_agree && whole(vertices.points) - whole(result.edges) + whole(result.tiles) ==
                                                    whole(border.components) - whole(border.gaps.size());
    result.figures = find_figures(patch.plane, patch.tiles, patch.pieces, patch.figure_of, monitor);
}

void examine_vertices(TilingPatch& patch, const Monitor& monitor, TilingExamination& result) {
    const TileVertices vertices = check_vertices(patch.plane, patch.tiles, patch.pieces, monitor);
    result.violations.add(vertices.overlaps);
    result.vertices = vertices.points;
    result.inner_vertices = vertices.inner;
    if (vertices.overlaps.count == 0) examine_border(patch, vertices, monitor, result);
}

void examine_pieces(TilingPatch& patch, CutSearch search, const TilingOptions& options, TilingExamination& result) {
    patch.pieces = {};
    patch.pieces = cut_into_pieces(patch.plane, patch.tiles, search, options.monitor);
    const TilePieces& pieces = patch.pieces;
    for (std::uint32_t side = 0; side < pieces.sides(); ++side) {
        if (pieces.twin[side] == no_number) ++result.border_edges;
    }
    result.inner_edges = (pieces.sides() - result.border_edges) / 2;
    result.edges = result.inner_edges + result.border_edges;
    result.edges_cut = pieces.edges_cut;
    patch.neighbours = TileNeighbours(patch.pieces);
    run_both([&] { examine_vertices(patch, options.monitor, result); },
             [&] { examine_neighbours(patch, options, result); });
    // Tiles that do not overlap are countries of a map (Appel & Haken 1977).
    if (result.has_border) result.most_colours = std::min(result.most_colours, 4);
}

/// If tiles do not overlap, it suffices to look for corners in few edges. The pieces of these edges
/// show whether they overlap: the number of tiles around a point is the sum of the winding numbers of their outlines,
/// and thus that of the border, in which paired sides cancel each other whether or not corners of other tiles lie on
/// them.
void examine_pieces(TilingPatch& patch, const TilingOptions& options, TilingExamination& result) {
    if (patch.plane.is_exact()) {
        TilingExamination found = result;
        try {
            examine_pieces(patch, CutSearch::unpaired, options, found);
            if (found.has_border) {
                result = std::move(found);
                return;
            }
        } catch (const BudgetError&) {
        }
    }
    examine_pieces(patch, CutSearch::all, options, result);
}

/// Returns a result for a plane in which tiles are then collected; examine() finds the facts.
TilingResult result_in(TilePlane plane) {
    return {{}, {std::move(plane), {}, {}, {}, TileNeighbours(0, {}), {}, {}}};
}

void examine(TilingResult& both, const TilingOptions& options) {
    TilingExamination& result = both.examination;
    TilingPatch& patch = both.patch;
    const TileSet& tiles = patch.tiles;
    result.is_exact = patch.plane.is_exact();
    result.tolerance = result.is_exact ? 0 : patch.plane.tolerance();
    result.polygons = tiles.polygons;
    result.tiles = tiles.tiles();
    result.violations = tiles.violations;
    if (tiles.tiles() == 0) return;
    options.monitor.check();
    result.shapes = shapes_of(patch.plane, tiles);
    for (const std::uint32_t in_class : tiles.in_class) result.area += tiles.classes[in_class].area;

    // Both only read the points and tiles.
    on_threads(0, [&] {
        TileSymmetry symmetry;
        run_both([&] { examine_pieces(patch, options, result); },
                 [&] { symmetry = find_symmetry(patch.plane, tiles, options.monitor); });
        result.symmetry = symmetry;
    });
}

TilingResult examine(const Grammar& grammar, const Lattice& lattice, bool exact, const TilingOptions& options) {
    TileScale scale;
    const auto collect = [&](TilePlane plane) {
        TilingResult both = result_in(std::move(plane));
        both.patch.tiles = collect_tiles(grammar, both.patch.plane, options.limits, scale, options.monitor);
        return both;
    };
    TilingResult both = collect(TilePlane(lattice, exact));
    if (!both.patch.plane.is_exact() && both.patch.tiles.polygons > 0) {
        const double tolerance = scale.tolerance();
        if (tolerance != both.patch.plane.tolerance()) both = collect(TilePlane(tolerance));
    }
    examine(both, options);
    return both;
}

/// Returns the first angle or length that keeps the positions of a turtle off a lattice; empty if they are exact.
/// @param lattice  make_lattice() of the grammar
std::string inexact_reason(const Grammar& grammar, const Lattice& lattice) {
    if (lattice.rank > 0) return {};
    const std::vector<char> reached = grammar.reachable();
    const auto first = [&](auto&& is_meant) -> const SymbolInfo* {
        for (std::size_t i = 0; i < reached.size(); ++i) {
            if (reached[i] && is_meant(grammar.symbols()[i])) return &grammar.symbols()[i];
        }
        return nullptr;
    };
    const auto name = [](const SymbolInfo& symbol) { return printable(symbol_text(symbol)); };
    if (const SymbolInfo* computed = first([](const SymbolInfo& symbol) {
            const Command& command = symbol.command;
            return command.takes_argument && (command.is_step() || command.action == Action::turn);
        })) {
        return fmt::format("the parameters of '{}' are computed", name(*computed));
    }
    if (lattice.headings == 0) {
        const SymbolInfo* turn = first([](const SymbolInfo& symbol) {
            return symbol.command.action == Action::turn && !symbol.command.angle.exact;
        });
        return turn ? fmt::format("'{}' does not turn by a simple fraction of 360 degrees", name(*turn))
                    : "the turns have no common fraction of 360 degrees";
    }
    if (lattice_rank(lattice.headings) == 0) {
        return fmt::format("turns by 360/{} degrees lead to places with more than 8 coordinates", lattice.headings);
    }
    const SymbolInfo* step = first([](const SymbolInfo& symbol) {
        return symbol.command.is_step() && symbol.command.edge == 0 && decimal_denominator(symbol.command.value) == 0;
    });
    return step ? fmt::format("the length of '{}' is not a short decimal; 'edge SYMBOL:' states lengths exactly",
                              name(*step))
                : "the lengths have no common unit";
}

}  // namespace

TilingResult examine_tiling(const Grammar& given, const TilingOptions& options) {
    if (given.is_spatial()) {
        throw std::runtime_error("a tiling lies in the plane: this drawing pitches, rolls, bends or has surfaces");
    }
    const auto watch = [&options](std::uint64_t symbols) { options.monitor.advance(symbols); };
    const Grammar grammar = resolve_contexts(shorten(given), DerivationOptions::within(options.limits.nodes, watch));
    const Lattice lattice = make_lattice(grammar);
    TilingResult result = [&] {
        try {
            return examine(grammar, lattice, options.exact, options);
        } catch (const TilePlane::OutOfRange&) {
            TilingResult rounded = examine(grammar, lattice, false, options);
            rounded.examination.inexact = "coordinates are too large for 64 bits";
            return rounded;
        }
    }();
    TilingExamination& found = result.examination;
    if (!found.is_exact && found.inexact.empty()) found.inexact = inexact_reason(grammar, lattice);
    return result;
}

namespace {

constexpr double largest_tolerance = 1e-3;  // as a share of the size of all polygons

/// The longer side of the box of all polygons.
double size_of(const PolygonList& polygons) {
    return polygons.corners.empty() ? 0 : box_of(polygons.corners).longest();
}

}  // namespace

double usual_tolerance(const PolygonList& polygons) {
    std::vector<double> lengths;
    for (std::size_t i = 0; i < polygons.size(); ++i) {
        const auto corners = polygons.polygon(i);
        for (std::size_t j = 0; j < corners.size(); ++j) {
            const double length = glm::distance(corners[j], corners[(j + 1) % corners.size()]);
            if (length > 0) lengths.push_back(length);
        }
    }
    if (lengths.empty()) throw std::runtime_error("the polygons have no edges with a length");
    const auto middle = lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() / 2);
    std::nth_element(lengths.begin(), middle, lengths.end());
    return std::min(*middle / 500, largest_tolerance * size_of(polygons));
}

namespace {

/// Replaces each angle, that of the first corner which has it, by the mean of all.
void average_angles(const TilePlane& plane, TileSet& tiles) {
    std::vector<double> sum(tiles.angles.size(), 0), count(tiles.angles.size(), 0);
    for (std::uint32_t tile = 0; tile < tiles.tiles(); ++tile) {
        const auto corners = tiles.corners(tile);
        const auto& angles = tiles.class_of(tile).angles;
        for (std::size_t i = 0; i < corners.size(); ++i) {
            const glm::dvec2 at = plane.at(corners[i]);
            const glm::dvec2 before = plane.at(corners[(i + corners.size() - 1) % corners.size()]) - at;
            const glm::dvec2 after = plane.at(corners[(i + 1) % corners.size()]) - at;
            const double angle =
                std::atan2(determinant(after, before), scalar_product(after, before)) * 180 / std::numbers::pi;
            sum[angles[i]] += angle < 0 ? angle + 360 : angle;
            ++count[angles[i]];
        }
    }
    for (std::size_t i = 0; i < sum.size(); ++i) {
        if (count[i] > 0) tiles.angles[i] = sum[i] / count[i];
    }
}

}  // namespace

TilingResult examine_polygons(const PolygonList& polygons, double tolerance, const TilingOptions& options) {
    if (static_cast<double>(polygons.size()) > options.limits.tiles) {
        throw BudgetError(
            fmt::format("there are {} polygons; at most {:.0f} are examined", polygons.size(), options.limits.tiles));
    }
    const double size = size_of(polygons);
    double farthest = 0;
    for (const glm::dvec2 at : polygons.corners) {
        farthest = std::max({farthest, std::fabs(at.x), std::fabs(at.y)});
    }
    if (tolerance < farthest * 0x1p-50) {
        throw std::runtime_error(fmt::format("coordinates of up to {:g} have larger errors than a tolerance of {:g}",
                                             farthest, tolerance));
    }
    if (!(tolerance >= 1e-12 && tolerance <= largest_tolerance * size && tolerance >= size * 1e-13)) {
        throw std::runtime_error(fmt::format(
            "a tolerance of {:g} does not suit polygons that extend over {:g}; expected 1e-12 or more, and a 10^13th "
            "to a thousandth of their size",
            tolerance, size));
    }
    TilingResult both = result_in(TilePlane(tolerance));
    TilingPatch& patch = both.patch;
    TileCollector collector(patch.plane, patch.tiles, most_corners(options.limits), options.monitor);
    std::vector<std::uint32_t> points;
    for (std::size_t i = 0; i < polygons.size(); ++i) {
        options.monitor.advance(1);
        points.clear();
        for (const glm::dvec2 corner : polygons.polygon(i)) points.push_back(patch.plane.point({}, corner));
        if (!points.empty()) collector.add(points, polygons.colour[i], true);
    }
    average_angles(patch.plane, patch.tiles);
    examine(both, options);
    return both;
}

}  // namespace sikku
