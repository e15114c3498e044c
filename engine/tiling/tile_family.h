// engine/tiling/tile_family.h: how the tiles of a generation divide into those of the next one.
#pragma once

#include "engine/base/monitor.h"
#include "engine/tiling/tile_lineage.h"
#include "engine/tiling/tile_plane.h"

#include <glm/mat3x2.hpp>
#include <glm/vec2.hpp>

#include <cstdint>
#include <optional>
#include <vector>

namespace sikku {

/// A division of one generation, the parents, into the next, the parts. Places are in the coordinates of the parts.
struct TileDivision {
    /// Maps the coordinates of the parents to those of the parts, so that both cover the same region: exactly if one
    /// factor multiplies all moves, otherwise as closely as a similarity can.
    glm::dmat3x2 map{1.0};
    /// The mean distance between the middles of symbols' tiles and those of their parts, compared with the mean
    /// distance of these from their common middle: how much the region moves. 0 if it is known not to move.
    double deviation = 0;
    bool is_cut = false;  ///< the parts of each parent fill it
    /// The largest scale at which the parts of each parent fit into it, around their common middle; 1 if they are cut
    /// out of it, and at least least_share.
    double share = 1;
    static constexpr double least_share = 0.3;
    double inside = 1;  ///< share of the area of all parts that lies in their own parents

    /// For each part:
    std::vector<std::uint32_t> parent;      ///< index of a tile; no_number if it lies in none
    std::vector<glm::dvec2> parent_middle;  ///< middle of the parent, or of the family if there is none
    std::vector<glm::dvec2> family_middle;  ///< middle of all parts of the same parent
};

/// Finds the divisions between successive generations. The parts of a symbol that draws no tile, such as half of a
/// tile, belong to the tile that contains most of their area.
/// @param factor  the number that multiplies all moves in a step, if there is one
/// Cost: linear. @throws Stopped
std::vector<TileDivision> tile_divisions(const std::vector<TileGeneration>& generations,
                                         const std::optional<glm::dvec2>& factor, const Monitor& monitor);

}  // namespace sikku
