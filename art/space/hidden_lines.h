// art/space/hidden_lines.h: computes the visible parts of lines behind surfaces, for pens, which cannot paint over
// lines.
#pragma once

#include "engine/base/monitor.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace sikku {

/// Surfaces seen along z, which points to the eye: flat convex polygons and balls. A line is hidden where a surface
/// lies nearer to the eye; the depth is compared at each point, so that surfaces that intersect hide each other in
/// part. At equal depth a surface hides the lines of earlier owners, as painting in order would. A surface hides
/// neither lines along its edges nor those of its owner.
///
/// Cost: for each cell of a grid that a line passes through, the surfaces in it from the nearest on, until the line
/// is hidden or all others lie behind it; memory: about 200 bytes for each surface.
class HiddenLines {
public:
    using Owner = std::uint32_t;

    /// Adds a polygon of 3 or 4 vertices in one plane. Polygons seen edge-on do not hide lines.
    void add_polygon(std::span<const glm::dvec3> vertices, Owner owner);
    void add_ball(const glm::dvec3& centre, double radius, Owner owner);
    /// Call once, after the last surface. @throws Stopped
    void build(const Monitor& monitor);

    /// Returns the visible parts of a line through `points`, in order; a fully visible line is a single part equal to
    /// it. Hidden gaps shorter than `detail` are closed, and visible parts shorter than that are omitted.
    std::vector<std::vector<glm::dvec2>> visible(std::span<const glm::dvec3> points, Owner owner,
                                                 double detail) const;

private:
    struct Surface {
        std::array<glm::dvec3, 4> sides;  ///< dot(side, (x, y, 1)) > 0 inside; balls: centre, radius
        int count = 0;                    ///< number of sides; 0: a ball
        glm::dvec3 plane{0.0};            ///< depth of the surface: dot(plane, (x, y, 1))
        double slack = 0.0;               ///< rounding error of depths
        double nearest = 0.0;
        glm::dvec2 low{0.0}, high{0.0};
        Owner owner = 0;
    };
    struct Interval {
        double from = 0.0, to = 0.0;
    };
    using Intervals = std::vector<Interval>;

    void hide(const Surface& surface, const glm::dvec3& a, const glm::dvec3& b, Owner owner,
              Intervals& visible) const;
    void look(const glm::dvec3& a, const glm::dvec3& b, Owner owner, Intervals& visible) const;
    void look_in_cell(std::int64_t cell, Interval within, const glm::dvec3& a, const glm::dvec3& b, Owner owner,
                      Intervals& visible) const;
    std::array<std::int64_t, 2> cell_of(glm::dvec2 point) const;

    std::vector<Surface> surfaces_;  ///< the nearest first, once built
    glm::dvec2 low_{0.0}, high_{0.0};
    double rounding_ = 0.0;  ///< rounding error of positions
    double cell_ = 1.0;      ///< side of a cell
    std::array<std::int64_t, 2> cells_{0, 0};
    std::vector<std::size_t> begin_;  ///< first index of each cell's surfaces
    std::vector<std::uint32_t> inside_;
};

}  // namespace sikku
