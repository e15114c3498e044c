// art/tiles/tile_worms.h: Conway worms: rows of hexagons of three rhombs that can be flipped.
#pragma once

#include "art/tiles/tile_outlines.h"
#include "engine/base/monitor.h"

#include <array>
#include <cstdint>
#include <vector>

namespace sikku {

/// Three rhombs around a vertex, two of which are congruent: a hexagon that has a mirror image with the same outline.
/// Its centre line crosses the congruent rhombs, between the two sides that are parallel to their common one.
/// Hexagons that share such a side are links of one worm, and their centre lines are parts of one line. Source:
/// Grünbaum & Shephard 1987, section 10.5, for kites and darts.
struct WormLink {
    glm::dvec2 from{0.0}, to{0.0};
    std::array<std::uint32_t, 3> tiles{};
    std::uint32_t length = 0;  ///< number of links of the worm
};

/// All links, in the order in which their vertices are first drawn. Tiles other than rhombs have none. Cost: n log n.
/// @throws Stopped
std::vector<WormLink> find_worms(const TileOutlines& tiles, const Monitor& monitor);

/// For each tile, the rank of its longest worm among the lengths that occur, from 1 for the shortest; 0 for tiles
/// without a worm.
std::vector<std::uint32_t> ranks_of_worms(std::size_t tiles, const std::vector<WormLink>& links);

}  // namespace sikku
