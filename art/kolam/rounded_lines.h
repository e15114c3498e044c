// art/kolam/rounded_lines.h: rounds the lines of kolams on interlaced dots.
#pragma once

#include "art/kolam/kolam_rim.h"

#include <glm/vec2.hpp>
#include <vector>

namespace sikku {

/// Returns the control points of a closed uniform cubic B-spline along a line, in spacings from the middle of the
/// grid's box; the first is at the entry of the first step, unless the rim shapes the line.
/// In the square lattice they are the middles of the gaps. In the triangular lattice the line passes all gaps as its
/// steps do, keeps its distance from dots and from the strand on the other side of each gap, and bends as little as
/// that permits, so that loops become even and petals slender: the sums of squares of the second and, with less
/// weight, the first differences of the control points are minimal. Solved by projected Gauss-Seidel sweeps.
/// There is one control point for each step; loops that the rim shapes have others.
/// Cost: at most 400 sweeps of the line.
std::vector<glm::dvec2> rounded_line(const DotGrid& grid, const GapStates& states, const ArcStep& start,
                                     const KolamRim& rim, Pulse& pulse);

}  // namespace sikku
