// engine/tiling/tile_growth.h: how the numbers of tiles grow, from the productions alone.
#pragma once

#include "engine/base/integer.h"
#include "engine/tiling/tiling.h"

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace sikku {

/// Number of tiles of a shape, hand and colour after n steps.
struct TileKindCount {
    std::uint32_t shape = 0;    ///< index into TileGrowth::shapes
    bool is_reflected = false;  ///< of the other hand than the first of its shape
    std::optional<int> colour;  ///< absent if it depends on the symbols around those that draw the tile
    std::string letters;        ///< the symbols that draw it
    Integer count = 0;
    std::optional<double> share;  ///< of all tiles, in the limit; absent if it has none
};

struct TileGrowth {
    std::string unknown;            ///< why the productions determine nothing; else empty
    std::vector<TileShape> shapes;  ///< with angles, sides and areas only, in the order of the symbols
    std::vector<TileKindCount> counts;

    /// Absent, with a reason in `no_limit`, if numbers do not grow by a factor.
    std::optional<double> tiles;  ///< factor of the number of tiles in a step, in the limit
    bool is_average = false;      ///< `tiles` is the mean factor of steps that alternate
    /// Shares of all tiles in the limit; empty if they alternate for ever.
    std::vector<double> frequencies;              ///< of the shapes
    std::vector<double> reflected;                ///< of the tiles of each shape that are reflected
    std::vector<std::pair<int, double>> colours;  ///< of the colours, ascending; empty also if one is not known
    /// Greatest common divisor of the lengths of the cycles of tile symbols; 1: primitive (after some steps each
    /// leads to all); 0: not every tile symbol leads to every other.
    std::size_t period = 0;
    std::string no_limit;

    std::optional<double> length;  ///< factor of lengths in a step, if it multiplies all moves
    double turn = 0;               ///< degrees by which a step turns all moves, -180 to 180
    std::string no_length;         ///< reason for the lack of such a factor
};

/// Counts tiles by kind after grammar.steps() steps, and finds the limits of their numbers. Cost: that of forecast(),
/// and O(symbols^3) at most.
TileGrowth find_growth(const Grammar& grammar);

/// `τ`, `2 + √3`, `√7` for a number that is an integer, a sum of an integer or half of one with a square root, or the
/// root of either; else empty.
std::string closed_form(double value);

}  // namespace sikku
