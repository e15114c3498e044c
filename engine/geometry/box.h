// engine/geometry/box.h: axis-parallel boxes, products of vectors in the plane, and distances from segments.
#pragma once

#include <glm/vec2.hpp>

#include <algorithm>
#include <cmath>
#include <span>

namespace sikku {

/// An axis-parallel box of a drawing; empty until something is added.
struct Box {
    glm::dvec2 low{1e300, 1e300};
    glm::dvec2 high{-1e300, -1e300};
    bool empty() const { return low.x > high.x; }
    void add(glm::dvec2 point) {
        low = {point.x < low.x ? point.x : low.x, point.y < low.y ? point.y : low.y};
        high = {point.x > high.x ? point.x : high.x, point.y > high.y ? point.y : high.y};
    }
    /// Adds the square around a point. @param reach  half its side
    void add(glm::dvec2 point, double reach) {
        add(point - reach);
        add(point + reach);
    }
    bool contains(glm::dvec2 point) const {
        return point.x >= low.x && point.y >= low.y && point.x <= high.x && point.y <= high.y;
    }
    /// True if all points of another box lie within this one, off its sides.
    bool surrounds(const Box& other) const {
        return low.x < other.low.x && low.y < other.low.y && high.x > other.high.x && high.y > other.high.y;
    }
    glm::dvec2 size() const { return high - low; }
    /// The longer side.
    double longest() const { return std::max(high.x - low.x, high.y - low.y); }
};

inline Box box_of(std::span<const glm::dvec2> points) {
    Box box;
    for (const glm::dvec2 point : points) box.add(point);
    return box;
}

inline double determinant(glm::dvec2 a, glm::dvec2 b) {
    return a.x * b.y - a.y * b.x;
}
inline double scalar_product(glm::dvec2 a, glm::dvec2 b) {
    return a.x * b.x + a.y * b.y;
}
/// The product of complex numbers: the first vector, turned and scaled by the second.
inline glm::dvec2 complex_product(glm::dvec2 a, glm::dvec2 b) {
    return {a.x * b.x - a.y * b.y, a.x * b.y + a.y * b.x};
}
/// The vector turned anticlockwise by 90 degrees, with y up.
inline glm::dvec2 left_of(glm::dvec2 vector) {
    return {-vector.y, vector.x};
}

/// The distance of a point from the nearest point of a segment, which may have no length.
inline double distance_to_segment(glm::dvec2 point, glm::dvec2 from, glm::dvec2 to) {
    const glm::dvec2 along = to - from;
    const double square = scalar_product(along, along);
    const double share = square > 0 ? std::clamp(scalar_product(point - from, along) / square, 0.0, 1.0) : 0.0;
    const glm::dvec2 off = from + share * along - point;
    return std::sqrt(scalar_product(off, off));
}

}  // namespace sikku
