// art/plotter/clear_hatch.h: hatching of areas that keeps clear of the lines and dots around and within them.
#pragma once

#include "engine/base/monitor.h"

#include <glm/vec2.hpp>

#include <span>
#include <vector>

namespace sikku {

/// Ink that hatching must not touch: a line with round ends, or a disc if both ends are the same.
struct Obstacle {
    glm::dvec2 from{0.0}, to{0.0};
    double radius = 0.0;  ///< half the width of the ink, plus half the pen that hatches
};

/// Hatches the area within an outline (non-zero winding rule) with lines along the unit vector `along`, `spacing`
/// apart, outside all obstacles. All areas share one set of lines. Ends of successive lines are joined where a path
/// between the two lines keeps clear of the obstacles, too, so that most areas become a few zigzags. Lines shorter
/// than half a spacing are left out unless they are part of a zigzag.
/// All lengths are in the units of the vertices.
/// @param tolerance  how much nearer joins may come to an obstacle
/// Cost: O(k log k) for k crossings of hatch lines with edges and obstacles, times the obstacles between two
/// lines. @throws std::runtime_error for over 10^6 lines in one area; Stopped
std::vector<std::vector<glm::dvec2>> clear_hatch_lines(std::span<const glm::dvec2> vertices,
                                                       std::span<const Obstacle> obstacles, glm::dvec2 along,
                                                       double spacing, double tolerance, const Monitor& monitor = {});

}  // namespace sikku
