// engine/tiling/tile_lineage.h: generations of tiles, and the symbol of the generation before that each tile comes
// from.
#pragma once

#include "engine/base/monitor.h"
#include "engine/language/grammar.h"
#include "engine/tiling/polygon_list.h"

#include <cstdint>
#include <stdexcept>
#include <vector>

namespace sikku {

/// The polygons between braces after some steps, in drawing order, in turtle steps.
struct TileGeneration {
    std::int64_t steps = 0;
    PolygonList polygons;
    /// For each polygon:
    std::vector<std::uint32_t> symbol;  ///< index of the symbol that draws it, in the word before `interpret:`
    std::vector<std::uint32_t> parent;  ///< index of the symbol one step earlier that this symbol was made of; empty
                                        ///< in the first generation
};

/// The tiles of a generation do not come from those of the generation before; the message gives the reason.
class LineageError : public std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// Limits of generations, checked before memory and time are spent on the next one.
struct LineageLimits {
    double nodes = 200e6;         ///< limit for each derivation
    double tiles = 1e6;           ///< limit for all generations together
    std::int64_t steps = 10'000;  ///< limit for the derivation length
};

/// Derives all generations from `first` to `last`, each from the one before. Memory: the words of two generations, 40
/// bytes a corner. @throws BudgetError, which names the largest derivation length that fits; WordError, also for
/// maps; Stopped; LineageError for drawings in space, and where a longer derivation does not continue a shorter one
std::vector<TileGeneration> tile_generations(const Grammar& grammar, std::int64_t first, std::int64_t last,
                                             const LineageLimits& limits, const Monitor& monitor);

}  // namespace sikku
