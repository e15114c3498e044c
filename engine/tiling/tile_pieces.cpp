#include "engine/tiling/tile_pieces.h"

#include "engine/base/threads.h"
#include "engine/derivation/derivation.h"
#include "engine/tiling/place_grid.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numbers>

namespace sikku {
namespace {

constexpr std::uint64_t most_compared = 20'000'000'000;

/// A corner inside an edge.
struct Cut {
    std::uint32_t edge = 0;  ///< index of the corner where the edge begins
    std::uint32_t point = 0;
    double along = 0;
};

/// The corners of all tiles, once each.
std::vector<std::uint32_t> corner_points(const TilePlane& plane, const TileSet& tiles) {
    std::vector<char> is_corner(plane.points(), 0);
    for (const std::uint32_t point : tiles.corner) is_corner[point] = 1;
    std::vector<std::uint32_t> points;
    for (std::uint32_t point = 0; point < is_corner.size(); ++point) {
        if (is_corner[point]) points.push_back(point);
    }
    return points;
}

/// Finds all corners that lie on edges between their ends.
std::vector<Cut> find_cuts(const TilePlane& plane, const TileSet& tiles, const Monitor& monitor) {
    const std::vector<std::uint32_t> points = corner_points(plane, tiles);
    std::vector<Cut> cuts;
    if (points.empty()) return cuts;
    Box box;
    for (const std::uint32_t point : points) box.add(plane.at(point));
    const PlaceGrid grid(box, points.size());
    struct Entry {
        glm::dvec2 at;
        std::uint32_t point;
    };
    CellLists<Entry> lists(grid.cells());
    for (const std::uint32_t point : points) lists.count(grid.cell(plane.at(point)));
    lists.start();
    for (const std::uint32_t point : points) {
        lists.add(grid.cell(plane.at(point)), {plane.at(point), point});
    }

    // In a tiling, a corner lies inside at most one edge.
    const std::uint64_t most_cuts = 10'000 + 16 * std::uint64_t{points.size()};
    std::atomic<std::uint64_t> compared = 0, cuts_found = 0;
    // Finds the cuts of the tiles from `first` to before `end`.
    const auto find = [&](std::uint32_t first, std::uint32_t end, std::vector<Cut>& found) {
        Pulse pulse(monitor);
        std::uint64_t visited = 0;
        const auto cut = [&](std::uint32_t edge, std::uint32_t from, std::uint32_t to) {
            const glm::dvec2 start = plane.at(from), side = plane.at(to) - start;
            const double square = scalar_product(side, side);
            const double margin = plane.tolerance();
            const double most = 4 * margin * margin * square;
            grid.along(start, plane.at(to), margin, [&](std::size_t cell) {
                visited += lists.size(cell) + 1;
                lists.visit(cell, [&](const Entry& entry) {
                    const glm::dvec2 offset = entry.at - start;
                    const double height = determinant(side, offset);
                    if (height * height > most) return;
                    const double along = scalar_product(side, offset);
                    if (along <= 0 || along >= square || entry.point == from || entry.point == to) return;
                    if (plane.side(from, to, entry.point) == 0) found.push_back({edge, entry.point, along});
                });
            });
        };
        for (std::uint32_t tile = first; tile < end; ++tile) {
            pulse();
            const std::uint32_t last = tiles.begin[tile + 1];
            for (std::uint32_t i = tiles.begin[tile]; i < last; ++i) {
                cut(i, tiles.corner[i], tiles.corner[i + 1 < last ? i + 1 : tiles.begin[tile]]);
            }
            if (compared + visited > most_compared || cuts_found + found.size() > most_cuts) break;
        }
        compared += visited;
        cuts_found += found.size();
    };
    constexpr std::uint32_t share = 1 << 14;
    std::vector<std::vector<Cut>> found(tiles.tiles() / share + 1);
    for_each_index(found.size(), [&](std::size_t part) {
        const auto i = static_cast<std::uint32_t>(part);
        find(i * share, std::min(tiles.tiles(), (i + 1) * share), found[i]);
    });
    if (cuts_found > most_cuts) {
        throw BudgetError(
            fmt::format("corners lie inside edges in more than {} places: too many tiles overlap", most_cuts));
    }
    if (compared > most_compared) {
        throw BudgetError("too many tiles of very different sizes; use a shorter derivation");
    }
    for (const std::vector<Cut>& part : found) cuts.insert(cuts.end(), part.begin(), part.end());
    std::sort(cuts.begin(), cuts.end(), [](const Cut& a, const Cut& b) {
        return a.edge != b.edge ? a.edge < b.edge : a.along != b.along ? a.along < b.along : a.point < b.point;
    });
    return cuts;
}

/// Lists for each point the sides that begin there, anticlockwise.
void list_sides(TilePieces& pieces, std::size_t points) {
    pieces.out_begin.assign(points + 1, 0);
    for (const std::uint32_t point : pieces.from) ++pieces.out_begin[point + 1];
    for (std::size_t i = 0; i < points; ++i) pieces.out_begin[i + 1] += pieces.out_begin[i];
    pieces.out.resize(pieces.from.size());
    std::vector<std::uint32_t> next(pieces.out_begin.begin(), pieces.out_begin.end() - 1);
    for (std::uint32_t side = 0; side < pieces.sides(); ++side) pieces.out[next[pieces.from[side]]++] = side;
    for (std::size_t i = 0; i < points; ++i) {
        const auto begin = pieces.out.begin() + pieces.out_begin[i],
                   end = pieces.out.begin() + pieces.out_begin[i + 1];
        const auto order = [&](const auto& towards) {
            std::sort(begin, end, [&](std::uint32_t a, std::uint32_t b) {
                return towards[a] != towards[b] ? towards[a] < towards[b] : a < b;
            });
        };
        pieces.heading.empty() ? order(pieces.direction) : order(pieces.heading);
    }
}

/// Computes the heading of each side from its ends, so that the two sides of a piece have exactly opposite ones.
void find_headings(const TilePlane& plane, TilePieces& pieces) {
    pieces.heading.reserve(pieces.sides());
    for (std::uint32_t side = 0; side < pieces.sides(); ++side) {
        const glm::dvec2 way = plane.at(pieces.to(side)) - plane.at(pieces.from[side]);
        pieces.heading.push_back(std::atan2(way.y, way.x));
    }
}

/// Decides for sides around a point of a plane that is not exact whether the sector of a tile reaches into the next.
bool reaches(const TilePlane& plane, const TilePieces& pieces, std::uint32_t side, std::uint32_t before,
             std::uint32_t next) {
    const glm::dvec2 at = plane.at(pieces.from[side]);
    const auto turned = [&](std::uint32_t point) {
        const glm::dvec2 way = plane.at(point) - at;
        const double angle = std::atan2(way.y, way.x) - pieces.heading[side];
        return angle < 0 ? angle + 2 * std::numbers::pi : angle;
    };
    const auto slack = [&](std::uint32_t point) {
        const glm::dvec2 way = plane.at(point) - at;
        return plane.tolerance() / std::sqrt(scalar_product(way, way));
    };
    const std::uint32_t in = pieces.from[before], out = pieces.to(next);
    const double room = turned(out);
    return room == 0 || (in != out && turned(in) > room + slack(in) + slack(out));
}

}  // namespace

TilePieces cut_into_pieces(TilePlane& plane, const TileSet& tiles, const Monitor& monitor) {
    if (plane.is_exact()) plane.sort_directions();
    const std::vector<Cut> cuts = find_cuts(plane, tiles, monitor);
    TilePieces pieces;
    const std::size_t sides = tiles.corner.size() + cuts.size();
    pieces.from.reserve(sides);
    if (plane.is_exact()) pieces.direction.reserve(sides);
    pieces.angle.reserve(sides);
    pieces.tile.reserve(sides);
    pieces.begin.reserve(tiles.begin.size());
    pieces.begin.push_back(0);
    std::size_t next_cut = 0;
    for (std::uint32_t tile = 0; tile < tiles.tiles(); ++tile) {
        const TileClass& in_class = tiles.class_of(tile);
        for (std::uint32_t i = tiles.begin[tile]; i < tiles.begin[tile + 1]; ++i) {
            const std::size_t edge = i - tiles.begin[tile];
            const std::uint32_t direction = plane.is_exact() ? plane.direction(in_class.vectors[edge]) : 0;
            const auto add = [&](std::uint32_t from, std::uint32_t angle) {
                pieces.from.push_back(from);
                if (plane.is_exact()) pieces.direction.push_back(direction);
                pieces.angle.push_back(angle);
                pieces.tile.push_back(tile);
            };
            add(tiles.corner[i], in_class.angles[edge]);
            if (next_cut < cuts.size() && cuts[next_cut].edge == i) ++pieces.edges_cut;
            for (; next_cut < cuts.size() && cuts[next_cut].edge == i; ++next_cut) add(cuts[next_cut].point, 0);
        }
        pieces.begin.push_back(pieces.sides());
    }
    if (!plane.is_exact()) find_headings(plane, pieces);
    list_sides(pieces, plane.points());
    pieces.twin.assign(pieces.from.size(), no_number);
    for (std::uint32_t side = 0; side < pieces.sides(); ++side) {
        if (pieces.twin[side] != no_number) continue;
        for (const std::uint32_t other : pieces.out_of(pieces.to(side))) {
            if (pieces.to(other) != pieces.from[side] || pieces.twin[other] != no_number) continue;
            pieces.twin[side] = other;
            pieces.twin[other] = side;
            break;
        }
    }
    return pieces;
}

TileVertices check_vertices(const TilePlane& plane, const TileSet& tiles, const TilePieces& pieces,
                            const Monitor& monitor) {
    TileVertices result;
    Pulse pulse(monitor);
    const std::uint32_t turn = plane.directions();
    TilePairs pairs;
    for (std::uint32_t point = 0; point < plane.points(); ++point) {
        pulse();
        const auto sides = pieces.out_of(point);
        if (sides.empty()) continue;
        ++result.points;
        std::uint64_t ends = 0;
        for (std::size_t i = 0; i < sides.size(); ++i) {
            const std::uint32_t before = pieces.previous(sides[i]);
            if (pieces.twin[before] == no_number) ++ends;
            if (sides.size() == 1) continue;
            const std::uint32_t next = sides[i + 1 < sides.size() ? i + 1 : 0];
            if (plane.is_exact()) {
                const std::uint32_t begin = pieces.direction[sides[i]];
                const std::uint32_t extent = (pieces.direction[before] + turn / 2 + turn - begin) % turn;
                const std::uint32_t room = (pieces.direction[next] + turn - begin) % turn;
                if (extent <= room && room > 0) continue;
            } else if (!reaches(plane, pieces, sides[i], before, next)) {
                continue;
            }
            const std::uint32_t first = pieces.tile[sides[i]], second = pieces.tile[next];
            if (!pairs.insert(first, second)) continue;
            ++result.overlap_count;
            if (result.overlaps.size() < TileViolations::most) {
                result.overlaps.push_back({TileFault::overlap, tiles.number[std::max(first, second)],
                                           tiles.number[std::min(first, second)], plane.at(point)});
            }
        }
        if (ends == 0) ++result.inner;
    }
    return result;
}

}  // namespace sikku
