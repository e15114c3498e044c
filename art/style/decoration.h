// art/style/decoration.h: the lines that decorate tiles, from the key `decorate`.
#pragma once

#include "engine/language/pattern.h"

#include <cstddef>
#include <vector>

namespace sikku {

/// A curve between two places on the outline of a tile, or a dot in its middle. A place is the number of a side, from
/// 0 in the order in which the tile is drawn, and the share of that side before the place: 1.5 is the middle of the
/// second side, and a whole number is a corner.
struct TileCurve {
    enum class Kind { arc, line, dot };
    Kind kind = Kind::line;
    double from = 0, to = 0;  ///< unused for a dot
    int colour = 0;           ///< index into the palette
    std::vector<int> tiles;   ///< colour indices of the tiles that carry it
};

/// Decoration of tiles.
struct TileDecoration {
    bool kolam = false;    ///< strands that cross in the middles of sides, and turn back along the border
    bool truchet = false;  ///< arcs between the middles of neighbouring sides, arranged at random
    bool worms = false;    ///< centre lines of Conway worms: rows of three rhombs around a vertex
    bool dots = false;     ///< a dot in the middle of each tile
    bool strands = false;  ///< the colours of strands follow their lengths
    std::vector<TileCurve> curves;

    bool is_set() const { return kolam || truchet || worms || dots || !curves.empty(); }

    static constexpr std::size_t most_curves = 1000;
    static constexpr double most_sides = 1000;  ///< places are less than this
};

/// Reads the value of `decorate`. The result is empty if the value has errors or is `none`.
TileDecoration read_decoration(const Key& key, Diagnostics& diagnostics);

}  // namespace sikku
