// engine/geometry/moved_path.h: moves, turns, mirrors and scales a drawing.
#pragma once

#include "engine/geometry/path.h"

#include <glm/mat2x2.hpp>
#include <glm/mat3x2.hpp>
#include <glm/matrix.hpp>
#include <glm/vec3.hpp>

#include <cmath>
#include <vector>

namespace sikku {

/// Passes a drawing on with an affine map applied to its points. Radii are scaled by the root of the determinant.
class MovedPath : public PathFilter {
public:
    MovedPath(PathSink& sink, const glm::dmat3x2& map)
        : Forwarding(sink), map_(map), scale_(std::sqrt(std::fabs(glm::determinant(glm::dmat2x2(map[0], map[1]))))) {}

    void begin_stroke(glm::dvec2 start, const Pen& pen) override { sink_.begin_stroke(moved(start), pen); }
    void lines(std::span<const glm::dvec2> ends) override { sink_.lines(moved(ends)); }
    void curves(std::span<const glm::dvec2> controls) override { sink_.curves(moved(controls)); }
    void polygon(std::span<const glm::dvec2> vertices, const Pen& pen) override {
        sink_.polygon(moved(vertices), pen);
    }
    void area(std::span<const glm::dvec2> outline, const Pen& pen) override { sink_.area(moved(outline), pen); }
    void disc(glm::dvec2 centre, double radius, const Pen& pen) override {
        sink_.disc(moved(centre), radius * scale_, pen);
    }

private:
    glm::dvec2 moved(glm::dvec2 point) const { return map_ * glm::dvec3(point, 1.0); }
    std::span<const glm::dvec2> moved(std::span<const glm::dvec2> points) {
        points_.clear();
        for (const glm::dvec2 point : points) points_.push_back(moved(point));
        return points_;
    }

    glm::dmat3x2 map_;
    double scale_;
    std::vector<glm::dvec2> points_;
};

}  // namespace sikku
