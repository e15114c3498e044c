// art/kolam/interlaced_states.h: composes kolams on interlaced dots as people draw them.
#pragma once

#include "art/kolam/dot_grid_symmetry.h"

#include <cstdint>

namespace sikku {

/// Chooses crossed gaps of a triangular lattice: orbits of triangles, whose three gaps cross together and form
/// petals, and around a dot a star, and some single gaps. From a random choice, orbits are changed one at a time as
/// long as that improves the kolam: long straight runs, meshes of parallel lines, pieces that do not hang together,
/// rings around lonely dots, and closed rims cost; stars are rewarded; the share of crossed gaps alternates between
/// rings around the centre. The seed also determines how dense it is, and how many such rings there are. Cost: about
/// 50 ms for 169 dots (15-8); grids of several thousand dots are not improved.
/// @throws std::runtime_error if the grid does not have the symmetry
GapStates interlaced_states(const DotGrid& grid, GridSymmetry symmetry, std::uint64_t seed);

}  // namespace sikku
