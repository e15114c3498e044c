// engine/geometry/left_of.h: a quarter turn to the left.
#pragma once

#include <glm/vec2.hpp>

namespace sikku {

/// The vector turned anticlockwise by 90 degrees, with y up.
inline glm::dvec2 left_of(glm::dvec2 vector) {
    return {-vector.y, vector.x};
}

}  // namespace sikku
