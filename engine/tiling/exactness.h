// engine/tiling/exactness.h: why positions of a turtle are rounded.
#pragma once

#include "engine/geometry/lattice.h"
#include "engine/language/grammar.h"

#include <string>

namespace sikku {

/// Why positions are doubles: the first angle or length that keeps them off a lattice. Empty if they are exact.
/// @param lattice  make_lattice() of the grammar
std::string inexact_reason(const Grammar& grammar, const Lattice& lattice);

}  // namespace sikku
