// engine/tiling/tile_border.h: the border of a tiling: loops around regions and around gaps.
#pragma once

#include "engine/tiling/tile_pieces.h"

#include <cstdint>
#include <vector>

namespace sikku {

/// A closed loop of border pieces with tiles on their left: anticlockwise around a region, clockwise around a gap.
struct TileLoop {
    std::uint32_t begin = 0, end = 0;  ///< range of TileBorder::sides
    double area = 0;                   ///< enclosed, in steps squared; negative around a gap
    glm::dvec2 centre{0.0};            ///< centroid of that area
};

struct TileBorder {
    std::vector<std::uint32_t> sides;  ///< of the loops, in order
    std::vector<TileLoop> loops;
    std::vector<TileViolation> overlaps;  ///< the first TileViolations::most
    /// Pairs of tiles whose pieces cross, or of which one contains the other; counting ends soon after
    /// TileViolations::most_counted.
    std::uint64_t overlap_count = 0;
    std::uint64_t regions = 0;
    std::uint64_t gaps = 0;
    /// Sum of the areas of tiles equals that within the loops: exactly, or to about 1e-9 of it.
    bool areas_agree = false;
};

/// Follows the border of pieces that check_vertices() found to be valid, and checks that its loops do not cross and
/// that regions and gaps alternate from outside inwards. Cost: linear in the pieces, and border pieces near each
/// loop's level for each loop.
TileBorder find_border(const TilePlane& plane, const TileSet& tiles, const TilePieces& pieces,
                       const Monitor& monitor);

}  // namespace sikku
