// art/kolam/interlaced_frame.h: bands of crossed gaps along the rim of an interlaced grid.
#pragma once

#include "art/kolam/dot_grid_symmetry.h"
#include "engine/base/chance.h"

#include <cstdint>
#include <vector>

namespace sikku {

/// Returns the layer of each dot: 0 at the rim, otherwise one more than the least layer of its neighbours.
/// Cost: linear.
std::vector<std::uint32_t> dot_layers(const DotGrid& grid);

/// True if lines turn back in all gaps of a dot, so that they form a ring around it.
bool is_lonely(const DotGrid& grid, std::uint32_t dot, const GapStates& states);

/// Crosses gaps of the outermost layers, so that they form bands that follow the rim: wreaths one layer wide, in
/// which each dot is linked to the next, and between them bands of one other kind: zigzags of two rows, scallops, or
/// stars between two wreaths. No gap between two bands is crossed. Around 40 dots or more, the innermost band has an
/// even line on its inner side.
/// @param layers  of all dots, as dot_layers() returns them
/// @param width  number of layers that the frame takes, from the rim; at least 1
/// @throws std::runtime_error if the grid does not have the symmetry
void cross_frame(const DotGrid& grid, GridSymmetry symmetry, const std::vector<std::uint32_t>& layers,
                 std::uint32_t width, SplitMix& chance, GapStates& states);

}  // namespace sikku
