// art/reading/dot_symmetry.h: dots that the symmetry of the others suggests.
#pragma once

#include "art/kolam/dot_grid.h"

#include <vector>

namespace sikku {

/// Returns the places without a dot to which a rotation or mirror of the lattice maps a dot, if it maps all other
/// dots, except at most one in twelve, to dots. They run from the top, each row from the left. Empty for fewer than 8
/// dots. Cost: about 64 steps a dot and symmetry.
std::vector<GridDot> places_by_symmetry(const DotGrid& grid);

}  // namespace sikku
