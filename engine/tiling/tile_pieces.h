// engine/tiling/tile_pieces.h: the edges of tiles, cut at every corner that lies on them, and how they meet.
#pragma once

#include "engine/tiling/tile_set.h"

#include <cstdint>
#include <set>
#include <utility>
#include <vector>

namespace sikku {

/// The parts of edges between corners, each as one side of its tile, which lies on the left. Sides of a tile follow
/// each other anticlockwise. Memory: 24 bytes a side, 28 if the plane is not exact.
struct TilePieces {
    /// Index of each tile's first side, and the number of sides at the end.
    std::vector<std::uint32_t> begin;
    /// For each side:
    std::vector<std::uint32_t> from;       ///< the point where it begins
    std::vector<std::uint32_t> direction;  ///< of TilePlane::directions(), if the plane is exact
    std::vector<double> heading;           ///< else: radians, -π to π
    std::vector<std::uint32_t> angle;      ///< of the tile where the side begins, as index into TileSet::angles
    std::vector<std::uint32_t> tile;
    std::vector<std::uint32_t> twin;  ///< the same piece in the opposite direction, or no_number
    /// Sides that begin at a point, anticlockwise: those of point p are in `out` from out_begin[p] on.
    std::vector<std::uint32_t> out_begin;
    std::vector<std::uint32_t> out;

    std::uint64_t edges_cut = 0;  ///< edges of tiles with a corner inside

    std::uint32_t sides() const { return static_cast<std::uint32_t>(from.size()); }
    std::uint32_t next(std::uint32_t side) const {
        const std::uint32_t owner = tile[side];
        return side + 1 < begin[owner + 1] ? side + 1 : begin[owner];
    }
    std::uint32_t previous(std::uint32_t side) const {
        const std::uint32_t owner = tile[side];
        return side > begin[owner] ? side - 1 : begin[owner + 1] - 1;
    }
    std::uint32_t to(std::uint32_t side) const { return from[next(side)]; }
    std::span<const std::uint32_t> out_of(std::uint32_t point) const {
        return std::span(out).subspan(out_begin[point], out_begin[point + 1] - out_begin[point]);
    }
};

/// Cuts the edges of tiles and finds the sides of each piece. Sorts the directions of an exact plane. Cost: linear
/// for tiles of similar sizes; on the threads of the caller's arena. @throws BudgetError if the sizes of the tiles
/// differ so much that it would take minutes
TilePieces cut_into_pieces(TilePlane& plane, const TileSet& tiles, const Monitor& monitor);

/// Overlaps of pairs of tiles, each pair once as far as the first 100,000.
class TileOverlaps {
public:
    explicit TileOverlaps(const TileSet& tiles) : tiles_(tiles) {}
    void add(std::uint32_t a, std::uint32_t b, glm::dvec2 at) {
        const auto [first, second] = std::minmax(a, b);
        const bool is_new =
            pairs_.size() >= 100'000 ? !pairs_.contains({first, second}) : pairs_.emplace(first, second).second;
        if (is_new) found.add({TileFault::overlap, tiles_.number[second], tiles_.number[first], at});
    }
    TileViolations found;

private:
    const TileSet& tiles_;
    std::set<std::pair<std::uint32_t, std::uint32_t>> pairs_;
};

/// Facts about the points where pieces meet, and places where tiles overlap.
struct TileVertices {
    TileViolations overlaps;  ///< pairs of tiles that overlap around a point
    std::uint64_t points = 0;
    std::uint64_t inner = 0;  ///< points with tiles all around
};

/// Checks that no piece is used twice in one direction, and that the sectors of tiles around each vertex do not
/// overlap.
TileVertices check_vertices(const TilePlane& plane, const TileSet& tiles, const TilePieces& pieces,
                            const Monitor& monitor);

}  // namespace sikku
