// art/plotter/plot_route.h: orders strokes for short pen-up travel.
#pragma once

#include "art/plotter/plot_join.h"

#include <glm/vec2.hpp>

namespace sikku {

/// Orders strokes, reverses some, and moves the starts of closed ones. One route goes from `start` always to the
/// nearest stroke. For over 1000 strokes that are all open, another one joins nearest ends; for over 20,000, it
/// replaces the first one if it is shorter in two samples. Routes are improved by exchanging two travels and by
/// moving up to three strokes, in parallel. If the shorter one is longer than `drawn`, in turtle steps, or there are
/// up to 1000 strokes, the given order is improved as well. The shortest route is used. Routes of up to 1000 strokes
/// are also shaken, and improved again when closed strokes begin elsewhere. Cost: about O(n log n), 0.2 ms a stroke
/// for up to 1000.
/// @param returns  the pen travels back to `start` in the end @throws Stopped
PlotStrokes sort_strokes(const PlotGraph& graph, const PlotStrokes& given, glm::dvec2 start, bool returns,
                         double drawn, const Monitor& monitor = {});

}  // namespace sikku
