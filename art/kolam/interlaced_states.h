// art/kolam/interlaced_states.h: kolams on interlaced dots of any number, as people draw them.
#pragma once

#include "art/kolam/interlaced_composition.h"

#include <cstddef>
#include <cstdint>

namespace sikku {

/// From here on, the eye would find no figure among so many petals.
constexpr std::size_t fewest_framed_dots = 70;

/// Chooses crossed gaps of a triangular lattice as composed_states() does. From fewest_framed_dots on, it composes
/// only a middle of 19 to 61 dots, as far as the grid has one, and crosses calm bands around it (cross_frame()). A
/// middle of 37 dots or more that is mostly a hexagon, as in a square, is a hexagon with six mirrors, or without
/// mirrors where the kolam is to have none. Larger middles are composed up to four times, until one of their rings
/// stands out.
/// Cost: a few milliseconds, and linear from some thousand dots on.
/// @throws std::runtime_error if the grid does not have the symmetry
GapStates interlaced_states(const DotGrid& grid, GridSymmetry symmetry, std::uint64_t seed);

}  // namespace sikku
