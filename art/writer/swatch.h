// art/writer/swatch.h: the smallest part of a periodic tiling whose copies join without a seam.
#pragma once

#include "art/drawing/drawing_options.h"
#include "art/drawing/reading.h"

#include <cstdint>
#include <stdexcept>

namespace sikku {

/// A place of a tiling that repeats.
struct Swatch {
    std::int64_t steps = 0;        ///< derivation length at which the tiling contains the place
    double turn = 0;               ///< degrees by which the drawing is turned, in addition to the given rotation
    bool is_rectangle = true;      ///< along the axes of the page; else a parallelogram
    Cell cell;                     ///< the place, in the coordinates of the drawing
    Box frame;                     ///< bounding box, in the orientation of the page
    std::size_t tiles = 0;         ///< number of tiles in it
    bool has_tile_period = false;  ///< colours by neighbours are to repeat with the cell

    /// The window of the drawing that contains it.
    ViewWindow window() const;
};

/// Thrown if the tiling or its drawing does not repeat; the message gives the reason.
class SwatchError : public std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// Finds the translations that map a tiling and its colours onto themselves, and the smallest rectangle along the
/// axes of the page whose sides are such translations; if there is none, the smallest one of any direction, to which
/// the drawing is turned; else a parallelogram. Its corner is a corner of a tile. The drawing is compared with its
/// translated images, so that lines and discs repeat, too.
/// @param grammar    of any derivation length
/// @param placement  rotation and mirroring
/// @param may_turn   turn the drawing also where that makes the rectangle smaller
/// @throws SwatchError, BudgetError, WordError, Stopped
Swatch find_swatch(const Grammar& grammar, const Style& style, const DrawingOptions& options,
                   const ReadingLimits& limits, bool may_turn);

}  // namespace sikku
