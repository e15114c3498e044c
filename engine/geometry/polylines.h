// engine/geometry/polylines.h: the lines of a drawing as arrays of points.
#pragma once

#include "engine/derivation/derivation.h"
#include "engine/geometry/path.h"

#include <cstdint>
#include <functional>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

namespace sikku {

/// The strokes of a drawing in order, in turtle steps; the turtle starts at the origin.
template <class Point>
struct Polylines {
    std::vector<Point> points;
    /// Index of the first point of each stroke, then the number of points: stroke i consists of the points from
    /// begins[i] up to begins[i + 1], at least two.
    std::vector<std::int64_t> begins;
};

struct TraceOptions {
    /// Moves without drawing are part of strokes, as in the control polygon of a spline.
    bool moves_draw = false;
    std::function<bool(const Pen&)> draws = {};             ///< true for visible lines; null: all are visible
    double budget = 200e6;                                  ///< maximum number of derivation nodes visited
    std::function<void(std::uint64_t symbols)> watch = {};  ///< as DerivationOptions::watch
};

/// Traces the lines that the turtle draws in the plane; polygons, discs and labels are left out.
/// Cost: about 15 ns and 16 bytes per point. @throws BudgetError, also for more points than half of the memory holds;
/// WordError; exceptions of `watch`
Polylines<glm::dvec2> trace(const Grammar& grammar, const TraceOptions& options);

/// The same in space, with 24 bytes per point, for grammars with Grammar::is_spatial(). `moves_draw` has no effect.
Polylines<glm::dvec3> trace_in_space(const Grammar& grammar, const TraceOptions& options);

}  // namespace sikku
