// engine/geometry/parallel_curve.h: curves at a constant distance from Béziers.
#pragma once

#include "engine/geometry/bezier.h"

#include <glm/vec2.hpp>
#include <vector>

namespace sikku {

/// Unit tangent of a curve at t; where the derivative is 0, that of the curve nearby.
glm::dvec2 tangent_of(const Bezier& curve, double t);
/// Curvature at t, positive to the left; 0 where the derivative is 0.
double curvature_of(const Bezier& curve, double t);

/// Adds the control points of Béziers (three for each, without the start) that run `distance` to the left of a curve
/// and deviate from the parallel curve by at most `tolerance`. They end exactly at the end of the curve, moved along
/// its normal. The distance must be less than the radius of curvature on the left side everywhere.
/// Method: Hermite interpolation of the parallel curve, halved until it is near enough.
void add_parallel(const Bezier& curve, double distance, double tolerance, std::vector<glm::dvec2>& controls);

}  // namespace sikku
