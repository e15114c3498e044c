// engine/tiling/tile_repeats.h: parts of a word that recur are read once; their tiles are then moved.
#pragma once

#include "engine/derivation/derivation.h"
#include "engine/geometry/turtle.h"
#include "engine/tiling/tile_set.h"

#include <cstdint>
#include <map>
#include <optional>
#include <tuple>
#include <vector>

namespace sikku {

/// Skips parts of the word whose tiles are known: expansions of the same symbol with as many remaining steps that
/// the turtle enters with the same heading and pen. The first one is read, and its tiles and corners are kept
/// relative to its beginning; the others add them at other places, in the same order. Points are still compared
/// exactly, and each tile with those before it. Only for a turtle on a lattice. Memory: up to about 10 MB.
class TileRepeats : public Pruner {
public:
    /// Keeps references. @param turtle  its polygons go to the collector
    TileRepeats(const Grammar& grammar, Turtle& turtle, TileCollector& collector, const Monitor& monitor);
    bool passes_over(Symbol symbol, std::int64_t level) override;

private:
    using Key = std::tuple<Symbol, std::int64_t, std::uint32_t, int>;
    struct Part {
        bool is_usable = false;
        std::optional<std::uint32_t> tiles;  ///< number of their part; none: it only moves the turtle
        TurtleStand end;                     ///< coordinates and position relative to those at its beginning
    };

    bool is_worthwhile(Symbol symbol, std::int64_t level) const;
    void begin(Part& part, std::int64_t level, const TurtleStand& here);
    void end();

    static constexpr double least_tiles = 4, most_tiles = 512;       ///< of a part
    static constexpr double least_moves = 64, most_moves = 1 << 16;  ///< symbols of a part without tiles
    static constexpr std::size_t most_kept = 30'000, most_parts = 4'096;
    static constexpr std::int64_t farthest = std::int64_t{1} << 61;  ///< way of a part: sums stay within 64 bits

    std::size_t symbols_;
    Turtle& turtle_;
    TileCollector& collector_;
    const Monitor& monitor_;
    std::vector<double> polygons_, lengths_;  ///< of the expansions of symbols, by level
    std::map<Key, Part> parts_;
    Part* begun_ = nullptr;  ///< the part that is being read
    std::int64_t level_ = 0;
    TurtleStand start_;
    TileMark mark_;
    std::size_t kept_ = 0;  ///< tiles of all parts
};

}  // namespace sikku
