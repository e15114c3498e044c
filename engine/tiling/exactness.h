// engine/tiling/exactness.h: explains why positions of a turtle are rounded.
#pragma once

#include "engine/geometry/lattice.h"
#include "engine/language/grammar.h"

#include <string>

namespace sikku {

/// Returns the first angle or length that keeps positions off a lattice; empty if they are exact.
/// @param lattice  make_lattice() of the grammar
std::string inexact_reason(const Grammar& grammar, const Lattice& lattice);

}  // namespace sikku
