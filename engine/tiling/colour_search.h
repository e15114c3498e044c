// engine/tiling/colour_search.h: neighbours of tiles, and the fewest colours with which they differ.
#pragma once

#include "engine/base/monitor.h"

#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace sikku {

struct TilePieces;

/// The tiles that share a piece of an edge with each tile, ascending.
class TileNeighbours {
public:
    explicit TileNeighbours(const TilePieces& pieces);
    /// @param pairs  ascending, each once
    TileNeighbours(std::uint32_t tiles, std::span<const std::pair<std::uint32_t, std::uint32_t>> pairs);

    std::uint32_t tiles() const { return static_cast<std::uint32_t>(begin_.size() - 1); }
    std::span<const std::uint32_t> of(std::uint32_t tile) const {
        return std::span(others_).subspan(begin_[tile], begin_[tile + 1] - begin_[tile]);
    }

private:
    std::vector<std::uint32_t> begin_;
    std::vector<std::uint32_t> others_;
};

/// Answer of an exact search.
enum class Colourable : std::uint8_t { yes, no, undecided };

/// Result of find_colours().
struct TileColouring {
    int at_least = 1;                    ///< lower bound of the number needed
    int at_most = 1;                     ///< a number that suffices
    std::vector<std::uint32_t> colours;  ///< of the tiles, at_most different ones
};

/// Limits of a search for three colours.
struct ColourBudget {
    std::uint64_t conflicts = 20'000;
    std::uint64_t steps = 10'000'000;  ///< values set, clauses and causes visited; 20 more for each tile
};

/// Numbers tiles so that neighbours differ, with few numbers: one if none touch, two if there are no odd cycles,
/// often three, four where exchanging the colours of chains of tiles (Kempe 1879) succeeds, seldom more. Cost:
/// linear, except for exchanges.
std::vector<std::uint32_t> colours_of_neighbours(const TileNeighbours& neighbours, const Monitor& monitor);

/// Returns the parity of distances as colours; nullopt if neighbours do not always differ in it.
std::optional<std::vector<std::uint32_t>> two_colours(const TileNeighbours& neighbours);

/// Colours tiles with as few colours as possible: as colours_of_neighbours(), and with three if that has more and an
/// exact search finds them. Tiles with fewer than three neighbours, also after others are removed, take no part in
/// the search. Cost: linear, and the search. @throws Stopped
TileColouring find_colours(const TileNeighbours& neighbours, const ColourBudget& budget, const Monitor& monitor);

}  // namespace sikku
