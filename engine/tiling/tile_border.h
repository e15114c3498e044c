// engine/tiling/tile_border.h: the border of a tiling, and the gaps that it leaves open.
#pragma once

#include "engine/tiling/colour_search.h"
#include "engine/tiling/tile_pieces.h"

#include <cstdint>
#include <vector>

namespace sikku {

/// A closed walk along border pieces with tiles on their left and one face of the complement on their right:
/// anticlockwise around tiles, clockwise around a gap. It may pass a point several times, where tiles touch at a
/// corner.
struct TileLoop {
    std::uint32_t begin = 0, end = 0;  ///< range of TileBorder::sides
    double area = 0;                   ///< enclosed, in steps squared; negative around a gap
    bool is_outer = true;              ///< anticlockwise
};

/// A bounded face of the complement of all tiles.
struct TileGap {
    double area = 0;         ///< steps squared; tiles that lie within the gap are not part of it
    glm::dvec2 centre{0.0};  ///< a point of the gap: its centroid where that lies in it
};

struct TileBorder {
    std::vector<std::uint32_t> sides;  ///< of the loops, in order
    std::vector<TileLoop> loops;
    /// Pairs of tiles whose pieces cross, or of which one contains the other; counting ends soon after
    /// TileViolations::most_counted.
    TileViolations overlaps;
    std::uint64_t regions = 0;     ///< groups of tiles that are joined by pieces
    std::uint64_t components = 0;  ///< groups of tiles that are joined by pieces or at corners
    std::vector<TileGap> gaps;     ///< in the order of their loops; empty if tiles overlap
    /// True if each component has one loop around it.
    bool loops_agree = false;
    /// True if the sum of the areas of tiles equals that within the loops: exactly, or to about 1e-9 of it.
    bool areas_agree = false;
};

/// Walks around the faces of the complement of tiles whose vertices check_vertices() found to be valid, and checks
/// that the border does not cross itself and that no tile lies beyond it. Every bounded face is a gap, also where the
/// tiles around it touch at corners only. Cost: linear in the pieces, and border pieces near each loop's level for
/// each loop.
TileBorder find_border(const TilePlane& plane, const TileSet& tiles, const TilePieces& pieces,
                       const TileNeighbours& neighbours, const Monitor& monitor);

}  // namespace sikku
