// art/kolam/interlaced_states.h: kolams on interlaced dots of any number, as people draw them.
#pragma once

#include "art/kolam/interlaced_composition.h"

#include <cstddef>
#include <cstdint>

namespace sikku {

/// True for triangular lattices with so many dots that the eye would find no figure among the petals: from 70 on, and
/// from 44 on without a third turn, as in squares, whose corners draw the eye away from the middle.
bool is_framed(const DotGrid& grid);

/// Chooses crossed gaps of a triangular lattice as composed_states() does. On framed grids, it composes only a middle
/// of 19 to 61 dots, as far as the grid has one, and crosses calm bands around it (cross_frame()). A middle that is
/// mostly a hexagon, as in a square, is a hexagon with six mirrors, or without mirrors where the kolam is to have
/// none. Larger middles are composed up to four times, until one of their rings stands out.
/// Cost: a few milliseconds, and linear from some thousand dots on.
/// @param period  columns after which the gaps of a row repeat, except at its ends; 0: they do not, else there is no
/// frame
/// @throws std::runtime_error if the grid does not have the symmetry
GapStates interlaced_states(const DotGrid& grid, GridSymmetry symmetry, std::uint64_t seed, std::uint32_t period = 0);

}  // namespace sikku
