// art/drawing/hand_flour.h: draws the strokes of a hand in a picture, as flour.
#pragma once

#include "art/hand/hand.h"
#include "art/print/print.h"
#include "art/raster/raster.h"

#include <vector>

namespace sikku {

/// The lines of a drawing in the order in which a hand draws them, and its dots.
struct HandStrokes {
    std::vector<HandLine> lines;
    std::vector<HandDot> dots;
};

/// Draws lines and dots as flour with grain and crumbs; lines under three pixels wide with pens. Crumbs smaller than
/// a pixel are left out. Cost: about 4 µs for each node of a line, and what lay_powder() takes.
void lay_flour(const HandStrokes& strokes, const HandOptions& options, const Print& print, Raster& raster);

}  // namespace sikku
