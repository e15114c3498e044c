// art/kolam/interlaced_states.h: composes kolams on interlaced dots as people draw them.
#pragma once

#include "art/kolam/dot_grid_symmetry.h"

#include <cstddef>
#include <cstdint>

namespace sikku {

/// Maximum number of dots that are composed.
constexpr std::size_t most_composed_dots = 300'000;
/// From here on, many different motifs would hide any figure.
constexpr std::size_t fewest_repeated_dots = 80;

/// Chooses crossed gaps of a triangular lattice: orbits of triangles, whose three gaps cross together and form
/// petals, and around a dot a star, and some single gaps. From a random choice, orbits are changed one at a time as
/// long as that improves the kolam. Long straight runs, parallel lines, separate pieces, rings around single dots,
/// and dots of the rim without a loop cost; stars are rewarded; the share of crossed gaps alternates between rings
/// around the centre. From 80 dots on, where many motifs at once would hide any figure, motifs between the centre and
/// the rim repeat by a step, and those of the rim along it; the first choice is a star that repeats, mostly within a
/// wreath along the rim. The seed determines the step, the star, the density, and the number of rings of densities.
/// Cost: about 20 ms for 169 dots (15-8). Larger grids are improved less, those of over most_composed_dots not at
/// all.
/// @param period  columns after which the gaps of a row repeat, except at its ends; 0: they do not
/// @throws std::runtime_error if the grid does not have the symmetry
GapStates interlaced_states(const DotGrid& grid, GridSymmetry symmetry, std::uint64_t seed, std::uint32_t period = 0);

}  // namespace sikku
