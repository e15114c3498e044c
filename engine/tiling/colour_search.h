// engine/tiling/colour_search.h: the fewest colours with which neighbouring tiles differ.
#pragma once

#include "engine/base/monitor.h"
#include "engine/tiling/tile_neighbours.h"

#include <cstdint>
#include <vector>

namespace sikku {

/// Answer of an exact search.
enum class Colourable : std::uint8_t { yes, no, undecided };

/// Result of find_colours().
struct TileColouring {
    int at_least = 1;                    ///< so many are needed
    int at_most = 4;                     ///< so many suffice; four always do for tiles without holes
    std::vector<std::uint32_t> colours;  ///< of the tiles, if at_most is 3 or less
};

/// Limits of a search for three colours.
struct ColourBudget {
    std::uint64_t conflicts = 20'000;
    std::uint64_t steps = 10'000'000;  ///< values set, clauses and causes looked at; 20 more for each tile
};

/// Colours tiles with as few colours as possible: one if none touch, two if there are no odd cycles, three if an
/// exact search finds them. Tiles with fewer than three neighbours, also after others are removed, take no part in
/// it. Cost: linear, and the search. @throws Stopped
TileColouring find_colours(const TileNeighbours& neighbours, const ColourBudget& budget, const Monitor& monitor);

}  // namespace sikku
