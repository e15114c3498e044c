// art/drawing/faint_inks.h: finds ink that is hardly visible on the ground, and the kinds of shapes in a drawing.
#pragma once

#include "art/drawing/drawing.h"

#include <vector>

namespace sikku {

/// The colours of lines, discs and areas that are faint on the ground, each once. Leaves out polygons with
/// outlines, and everything on a transparent ground. Reads the drawing again, up to ten million points, only if
/// its palette has such colours. @param print  placed
/// @throws Stopped
std::vector<FaintInk> faint_inks(const Drawing& drawing, const Print& print);

/// The kinds of shapes in the drawing, up to ten million points. @param print  placed
/// @throws Stopped
Contents contents_of(const Drawing& drawing, const Print& print);

}  // namespace sikku
