// art/plotter/plot_route.h: orders strokes for short pen-up travel.
#pragma once

#include "art/plotter/plot_join.h"

#include <glm/vec2.hpp>

namespace sikku {

/// The same strokes in another order, some of them the other way round, closed ones begun anywhere: from `start`
/// always on to the nearest one, then improved by 2-opt. Should that be longer than `drawn`, in turtle steps, the
/// order given is improved as well, and the better route is used. Cost: O(n log n). @throws Stopped
PlotStrokes sort_strokes(const PlotGraph& graph, const PlotStrokes& given, glm::dvec2 start, double drawn,
                         const Monitor& monitor = {});

}  // namespace sikku
