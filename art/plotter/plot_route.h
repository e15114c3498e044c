// art/plotter/plot_route.h: orders strokes for short pen-up travel.
#pragma once

#include "art/plotter/plot_join.h"

#include <glm/vec2.hpp>

namespace sikku {

/// Orders strokes, reverses some, and moves the starts of closed ones: from `start` always to the nearest one, then
/// improved by 2-opt. If that is longer than `drawn`, in turtle steps, the given order is improved as well, and the
/// better route is used. Cost: O(n log n). @throws Stopped
PlotStrokes sort_strokes(const PlotGraph& graph, const PlotStrokes& given, glm::dvec2 start, double drawn,
                         const Monitor& monitor = {});

}  // namespace sikku
