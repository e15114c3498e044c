// engine/geometry/cross.h: the cross product in the plane.
#pragma once

#include <glm/vec2.hpp>

namespace sikku {

/// Twice the area of a triangle with sides `a` and `b`, positive if `b` is to the left of `a`.
inline double cross(glm::dvec2 a, glm::dvec2 b) {
    return a.x * b.y - a.y * b.x;
}

}  // namespace sikku
