// engine/tiling/tile_symmetry.h: the motions that map a tiling onto itself.
#pragma once

#include "engine/tiling/tile_set.h"

#include <cstdint>
#include <glm/vec2.hpp>
#include <string>

namespace sikku {

struct TileSymmetry {
    std::uint32_t rotations = 1;  ///< about the centre, identity included
    std::uint32_t mirrors = 0;    ///< lines through the centre: 0 or as many as rotations
    glm::dvec2 centre{0.0};

    /// C5 or D5: with that many rotations, without or with mirrors.
    std::string name() const;
};

/// Finds the rotations and mirrors that map each tile onto a tile, whatever their colours. Cost: linear for each
/// symmetry, and small for each motion that is not a symmetry.
TileSymmetry find_symmetry(const TilePlane& plane, const TileSet& tiles, const Monitor& monitor);

}  // namespace sikku
