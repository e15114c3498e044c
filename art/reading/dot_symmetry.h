// art/reading/dot_symmetry.h: dots that the symmetry of the others suggests.
#pragma once

#include "art/kolam/dot_grid.h"

#include <vector>

namespace sikku {

/// Places without a dot that a rotation or mirror of the lattice takes a dot to, if it takes all other dots, but one
/// in twelve at most, to dots. From the top, each row from the left. Empty for fewer than 8 dots. Cost: about 64
/// steps a dot and symmetry.
std::vector<GridDot> places_by_symmetry(const DotGrid& grid);

}  // namespace sikku
