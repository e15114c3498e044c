// art/kolam/interlaced_composition.h: composes small kolams on interlaced dots.
#pragma once

#include "art/kolam/dot_grid_symmetry.h"

#include <cstddef>
#include <cstdint>

namespace sikku {

/// Maximum number of dots that are composed.
constexpr std::size_t most_composed_dots = 300'000;

/// Chooses crossed gaps of a triangular lattice: orbits of triangles, whose three gaps cross together and form
/// petals, and around a dot a star, and some single gaps. From a random choice, orbits are changed one at a time as
/// long as that improves the kolam. Long straight runs, parallel lines, separate pieces, rings around single dots,
/// and dots of the rim without a loop cost; stars are rewarded; the share of crossed gaps alternates between rings
/// around the centre. The seed determines the density, and the number of rings of densities.
/// Cost: about 4 ms for 61 dots (9-5). Grids of over 200 dots are improved less, those of over most_composed_dots not
/// at all.
/// @param tries  number of times that each orbit is changed on average, up to 1500 changes in all
/// @param period  columns after which the gaps of a row repeat, except at its ends; 0: they do not
/// @throws std::runtime_error if the grid does not have the symmetry
GapStates composed_states(const DotGrid& grid, GridSymmetry symmetry, std::uint64_t seed, std::size_t tries = 1500,
                          std::uint32_t period = 0);

}  // namespace sikku
