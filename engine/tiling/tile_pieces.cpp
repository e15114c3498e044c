#include "engine/tiling/tile_pieces.h"

#include "engine/base/memory.h"
#include "engine/base/threads.h"
#include "engine/derivation/derivation.h"
#include "engine/tiling/place_grid.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <numbers>
#include <utility>

namespace sikku {
namespace {

constexpr std::uint64_t most_compared = 20'000'000'000;
/// Number of tiles or points that one thread works on.
constexpr std::uint32_t part_size = 1 << 14;

/// A corner inside an edge.
struct Cut {
    std::uint32_t edge = 0;  ///< index of the corner where the edge begins
    std::uint32_t point = 0;
    double along = 0;
};

/// Pairs sides in opposite directions: each with the first that is free, after those paired within parts that recur.
/// The order matters only where tiles overlap, which the vertices show. Cost: linear, if few sides meet at each
/// point. Memory: 4 bytes a point, 12 for each side that is free at a time.
class SidePairing {
public:
    /// @param twin  receives the pairs
    SidePairing(std::size_t points, std::vector<std::uint32_t>& twin) : first_(points, no_number), twin_(twin) {}
    void add(std::uint32_t side, std::uint32_t from, std::uint32_t to) {
        std::uint32_t* found = nullptr;
        for (std::uint32_t* link = &first_[to]; *link != no_number; link = &free_[*link].next) {
            if (free_[*link].to == from) found = link;
        }
        if (found) {
            const std::uint32_t place = *found;
            *found = free_[place].next;
            twin_[free_[place].side] = side;
            twin_[side] = free_[place].side;
            free_[place].next = std::exchange(unused_, place);
            return;
        }
        std::uint32_t place = unused_;
        if (place == no_number) {
            place = static_cast<std::uint32_t>(free_.size());
            free_.emplace_back();
        } else {
            unused_ = free_[place].next;
        }
        free_[place] = {side, to, std::exchange(first_[from], place)};
    }

private:
    struct Side {
        std::uint32_t side = 0, to = 0;
        std::uint32_t next = no_number;  // free side that begins at the same point
    };
    std::vector<std::uint32_t> first_;  // of points: the free side added last
    std::vector<Side> free_;
    std::uint32_t unused_ = no_number;  // the first of the unused places in `free_`
    std::vector<std::uint32_t>& twin_;
};

/// Pairs the sides that have no twin yet.
void pair_rest(TilePieces& pieces, std::size_t points) {
    SidePairing pairing(points, pieces.twin);
    for (std::size_t tile = 0; tile + 1 < pieces.begin.size(); ++tile) {
        const std::uint32_t begin = pieces.begin[tile], end = pieces.begin[tile + 1];
        for (std::uint32_t side = begin; side < end; ++side) {
            if (pieces.twin[side] != no_number) continue;
            pairing.add(side, pieces.from[side], pieces.from[side + 1 < end ? side + 1 : begin]);
        }
    }
}

/// The twins of edges, or no_number. Within recurring parts they are known.
std::vector<std::uint32_t> pair_edges(const TileSet& tiles, std::size_t points) {
    std::vector<std::uint32_t> twin;
    resize_in_large_pages(twin, tiles.corner.size(), no_number);
    for (const auto& [begin, part] : tiles.placed) {
        const std::vector<std::uint32_t>& partner = tiles.parts[part].partner;
        for (std::size_t i = 0; i < partner.size(); ++i) {
            if (partner[i] != no_number) twin[begin + i] = begin + partner[i];
        }
    }
    SidePairing pairing(points, twin);
    for (std::uint32_t tile = 0; tile < tiles.tiles(); ++tile) {
        const std::uint32_t begin = tiles.begin[tile], end = tiles.begin[tile + 1];
        for (std::uint32_t edge = begin; edge < end; ++edge) {
            if (twin[edge] != no_number) continue;
            pairing.add(edge, tiles.corner[edge], tiles.corner[edge + 1 < end ? edge + 1 : begin]);
        }
    }
    return twin;
}

/// Copies the twins of edges to their sides. Edges with a twin are not cut.
void take_twins(TilePieces& pieces, const std::vector<std::uint32_t>& of_edges, const std::vector<Cut>& cuts) {
    constexpr std::uint32_t share = 32;
    std::vector<std::uint32_t> first;  // index of the first cut at or after the beginning of each share
    first.reserve(of_edges.size() / share + 1);
    std::uint32_t next = 0;
    for (std::size_t edge = 0; edge < of_edges.size(); edge += share) {
        while (next < cuts.size() && cuts[next].edge < edge) ++next;
        first.push_back(next);
    }
    // The side that an edge begins with.
    const auto side_of = [&](std::uint32_t edge) {
        std::uint32_t cut = first[edge / share];
        while (cut < cuts.size() && cuts[cut].edge < edge) ++cut;
        return edge + cut;
    };
    for (std::uint32_t edge = 0; edge < of_edges.size(); ++edge) {
        const std::uint32_t other = of_edges[edge];
        if (other == no_number || other < edge) continue;
        const std::uint32_t side = side_of(edge), twin = side_of(other);
        pieces.twin[side] = twin;
        pieces.twin[twin] = side;
    }
}

/// Makes sides of the edges of tiles, and of their parts. @param cuts  sorted
TilePieces make_pieces(const TilePlane& plane, const TileSet& tiles, const std::vector<Cut>& cuts) {
    TilePieces pieces;
    pieces.reserve(tiles.tiles(), tiles.corner.size() + cuts.size());
    std::vector<std::vector<std::uint32_t>> forms;  // of the edges of classes
    for (const TileClass& each : tiles.classes) {
        std::vector<std::uint32_t>& of_class = forms.emplace_back();
        for (std::size_t i = 0; i < each.vectors.size(); ++i) {
            const std::uint32_t direction = plane.is_exact() ? plane.direction(each.vectors[i]) : 0;
            of_class.push_back(pieces.form(direction, each.angles[i]));
        }
    }
    auto cut = cuts.begin();
    for (std::uint32_t tile = 0; tile < tiles.tiles(); ++tile) {
        const std::uint32_t first = tiles.begin[tile];
        for (std::uint32_t i = first; i < tiles.begin[tile + 1]; ++i) {
            const std::uint32_t form = forms[tiles.in_class[tile]][i - first];
            pieces.add(tiles.corner[i], form);
            if (cut == cuts.end() || cut->edge != i) continue;
            ++pieces.edges_cut;
            const std::uint32_t straight = pieces.form(pieces.direction(pieces.sides() - 1), 0);
            for (; cut != cuts.end() && cut->edge == i; ++cut) pieces.add(cut->point, straight);
        }
        pieces.finish_tile();
    }
    return pieces;
}

/// Finds corners that lie on edges between their ends. @param twin  of edges; only those without one are searched.
/// Empty: all edges are searched.
std::vector<Cut> find_cuts(const TilePlane& plane, const TileSet& tiles, const std::vector<std::uint32_t>& twin,
                           const Monitor& monitor) {
    // Visits the edges of a tile that are searched.
    const auto each_edge = [&](std::uint32_t tile, auto&& visit) {
        const std::uint32_t begin = tiles.begin[tile], end = tiles.begin[tile + 1];
        for (std::uint32_t edge = begin; edge < end; ++edge) {
            if (!twin.empty() && twin[edge] != no_number) continue;
            visit(edge, tiles.corner[edge], tiles.corner[edge + 1 < end ? edge + 1 : begin]);
        }
    };
    std::vector<std::uint32_t> points;
    {
        std::vector<char> is_candidate(plane.points(), 0);
        for (std::uint32_t tile = 0; tile < tiles.tiles(); ++tile) {
            each_edge(tile, [&](std::uint32_t, std::uint32_t from, std::uint32_t to) {
                is_candidate[from] = is_candidate[to] = 1;
            });
        }
        for (std::uint32_t point = 0; point < is_candidate.size(); ++point) {
            if (is_candidate[point]) points.push_back(point);
        }
    }
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
            each_edge(tile, cut);
            if (compared + visited > most_compared || cuts_found + found.size() > most_cuts) break;
        }
        compared += visited;
        cuts_found += found.size();
    };
    std::vector<std::vector<Cut>> found(tiles.tiles() / part_size + 1);
    for_each_index(found.size(), [&](std::size_t part) {
        const auto i = static_cast<std::uint32_t>(part);
        find(i * part_size, std::min(tiles.tiles(), (i + 1) * part_size), found[i]);
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
    for (const std::uint32_t point : pieces.from) ++pieces.out_begin[point];
    // The ends of the lists, which are filled from there.
    for (std::size_t i = 1; i <= points; ++i) pieces.out_begin[i] += pieces.out_begin[i - 1];
    resize_in_large_pages(pieces.out, pieces.from.size());
    for (std::uint32_t side = pieces.sides(); side-- > 0;) pieces.out[--pieces.out_begin[pieces.from[side]]] = side;
    for_each_index(points / part_size + 1, [&](std::size_t part) {
        for (std::size_t i = part * part_size; i < std::min(points, (part + 1) * part_size); ++i) {
            const auto begin = pieces.out.begin() + pieces.out_begin[i],
                       end = pieces.out.begin() + pieces.out_begin[i + 1];
            constexpr std::ptrdiff_t few = 16;
            if (pieces.heading.empty() && end - begin <= few) {
                std::array<std::uint64_t, few> keys;
                auto last = keys.begin();
                for (auto side = begin; side != end; ++side) {
                    *last++ = std::uint64_t{pieces.direction(*side)} << 32U | *side;
                }
                std::sort(keys.begin(), last);
                std::transform(keys.begin(), last, begin,
                               [](std::uint64_t key) { return static_cast<std::uint32_t>(key); });
                continue;
            }
            const auto order = [&](const auto& towards) {
                std::sort(begin, end, [&](std::uint32_t a, std::uint32_t b) {
                    return towards(a) != towards(b) ? towards(a) < towards(b) : a < b;
                });
            };
            if (pieces.heading.empty()) {
                order([&](std::uint32_t side) { return pieces.direction(side); });
            } else {
                order([&](std::uint32_t side) { return pieces.heading[side]; });
            }
        }
    });
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

void TilePieces::reserve(std::size_t tiles, std::size_t sides) {
    begin.reserve(tiles + 1);
    from.reserve(sides);
    use_large_pages(from);
    form_.reserve(sides);
    tile_of_share_.reserve(sides / share + 1);
}

std::uint32_t TilePieces::form(std::uint32_t direction, std::uint32_t angle) {
    const auto fresh = static_cast<std::uint32_t>(forms_.size());
    const auto [found, is_new] = form_numbers_.try_emplace(std::uint64_t{direction} << 32U | angle, fresh);
    if (is_new) forms_.push_back({direction, angle});
    return found->second;
}

TilePieces cut_into_pieces(TilePlane& plane, const TileSet& tiles, CutSearch search, const Monitor& monitor) {
    if (plane.is_exact()) plane.sort_directions();
    std::vector<std::uint32_t> twin;
    if (search == CutSearch::unpaired) twin = pair_edges(tiles, plane.points());
    const std::vector<Cut> cuts = find_cuts(plane, tiles, twin, monitor);
    TilePieces pieces = make_pieces(plane, tiles, cuts);
    if (search == CutSearch::unpaired && cuts.empty()) {
        pieces.twin = std::move(twin);
    } else {
        resize_in_large_pages(pieces.twin, pieces.sides(), no_number);
        if (search == CutSearch::unpaired) take_twins(pieces, twin, cuts);
        std::vector<std::uint32_t>().swap(twin);  // frees the memory
        pair_rest(pieces, plane.points());
    }
    if (!plane.is_exact()) find_headings(plane, pieces);
    list_sides(pieces, plane.points());
    return pieces;
}

TileVertices check_vertices(const TilePlane& plane, const TileSet& tiles, const TilePieces& pieces,
                            const Monitor& monitor) {
    struct Overlap {
        std::uint32_t a, b, point;
    };
    struct Part {
        std::uint64_t points = 0, inner = 0;
        std::vector<Overlap> overlaps;
    };
    const std::uint32_t turn = plane.directions();
    const auto opposite = [&](std::uint32_t to) { return to < turn / 2 ? to + turn / 2 : to - turn / 2; };
    const auto check = [&](std::uint32_t first, std::uint32_t last) {
        Part part;
        Pulse pulse(monitor);
        for (std::uint32_t point = first; point < last; ++point) {
            pulse();
            const auto sides = pieces.out_of(point);
            if (sides.empty()) continue;
            ++part.points;
            std::uint64_t ends = 0;
            std::uint32_t begin = plane.is_exact() ? pieces.direction(sides.front()) : 0;
            for (std::size_t i = 0; i < sides.size(); ++i) {
                const std::uint32_t before = pieces.previous(sides[i]);
                if (pieces.twin[before] == no_number) ++ends;
                if (sides.size() == 1) continue;
                const std::uint32_t next = sides[i + 1 < sides.size() ? i + 1 : 0];
                if (plane.is_exact()) {
                    const std::uint32_t end = pieces.direction(next);
                    const auto from_begin = [&](std::uint32_t to) {
                        return to < begin ? to + turn - begin : to - begin;
                    };
                    const std::uint32_t extent = from_begin(opposite(pieces.direction(before)));
                    const std::uint32_t room = from_begin(end);
                    begin = end;
                    if (extent <= room && room > 0) continue;
                } else if (!reaches(plane, pieces, sides[i], before, next)) {
                    continue;
                }
                part.overlaps.push_back({pieces.tile(sides[i]), pieces.tile(next), point});
            }
            if (ends == 0) ++part.inner;
        }
        return part;
    };
    TileVertices result;
    TileOverlaps overlaps(tiles);
    const auto points = static_cast<std::uint32_t>(plane.points());
    std::vector<Part> parts(4 * static_cast<std::size_t>(available_threads()));
    in_order(
        points / part_size + 1, parts.size(),
        [&](std::size_t i, std::size_t place) {
            const auto first = static_cast<std::uint32_t>(i) * part_size;
            parts[place] = check(first, std::min(points, first + part_size));
        },
        [&](std::size_t, std::size_t place) {
            result.points += parts[place].points;
            result.inner += parts[place].inner;
            for (const Overlap& each : parts[place].overlaps) overlaps.add(each.a, each.b, plane.at(each.point));
        });
    result.overlaps = std::move(overlaps.found);
    return result;
}

}  // namespace sikku
