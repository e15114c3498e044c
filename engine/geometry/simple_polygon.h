// engine/geometry/simple_polygon.h: areas of polygons, points within them, and whether they cross themselves.
#pragma once

#include <glm/vec2.hpp>

#include <algorithm>
#include <cstddef>
#include <span>

namespace sikku {

/// Positive if `point` lies to the left of the line from `a` to `b`.
inline double side_of(glm::dvec2 a, glm::dvec2 b, glm::dvec2 point) {
    return (b.x - a.x) * (point.y - a.y) - (b.y - a.y) * (point.x - a.x);
}

/// Area, positive for anticlockwise corners.
inline double signed_area(std::span<const glm::dvec2> corners) {
    double area = 0;
    for (std::size_t i = 1; i + 1 < corners.size(); ++i) area += side_of(corners[0], corners[i], corners[i + 1]);
    return area / 2;
}

/// True if a point lies within a polygon, by the even-odd rule.
inline bool contains(std::span<const glm::dvec2> corners, glm::dvec2 point) {
    bool is_inside = false;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const glm::dvec2 a = corners[i], b = corners[(i + 1) % corners.size()];
        if ((a.y > point.y) == (b.y > point.y)) continue;
        if (point.x < a.x + (b.x - a.x) * ((point.y - a.y) / (b.y - a.y))) is_inside = !is_inside;
    }
    return is_inside;
}

/// True if `meet(a, b, c, d)` is for two sides of a polygon that are not neighbours. Cost: quadratic.
template <class Meet>
bool any_sides_meet(std::span<const glm::dvec2> corners, const Meet& meet) {
    const std::size_t count = corners.size();
    for (std::size_t i = 0; i < count; ++i) {
        for (std::size_t j = i + 2; j < count - (i == 0 ? 1 : 0); ++j) {
            if (meet(corners[i], corners[i + 1], corners[j], corners[(j + 1) % count])) return true;
        }
    }
    return false;
}

/// True if two sides of a polygon cross at inner points. Cost: quadratic.
inline bool crosses_itself(std::span<const glm::dvec2> corners) {
    return any_sides_meet(corners, [](glm::dvec2 a, glm::dvec2 b, glm::dvec2 c, glm::dvec2 d) {
        return side_of(a, b, c) * side_of(a, b, d) < 0 && side_of(c, d, a) * side_of(c, d, b) < 0;
    });
}

/// True if sides of a polygon that are not neighbours have points in common. Cost: quadratic.
inline bool touches_itself(std::span<const glm::dvec2> corners) {
    const auto overlap = [](double a, double b, double c, double d) {
        return std::min(a, b) <= std::max(c, d) && std::min(c, d) <= std::max(a, b);
    };
    return any_sides_meet(corners, [&](glm::dvec2 a, glm::dvec2 b, glm::dvec2 c, glm::dvec2 d) {
        return overlap(a.x, b.x, c.x, d.x) && overlap(a.y, b.y, c.y, d.y) &&
               side_of(a, b, c) * side_of(a, b, d) <= 0 && side_of(c, d, a) * side_of(c, d, b) <= 0;
    });
}

}  // namespace sikku
