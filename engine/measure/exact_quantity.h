// engine/measure/exact_quantity.h: converts exact numbers of any size to quantities.
#pragma once

#include "engine/base/integer.h"
#include "engine/geometry/lattice.h"
#include "engine/measure/fold.h"

#include <array>

namespace sikku {

Quantity quantity_of(const Integer& whole);
/// Converts a real number of the lattice's ring, given by its coordinates.
Quantity quantity_of(const Lattice& lattice, const std::array<Integer, most_coordinates>& real);

}  // namespace sikku
