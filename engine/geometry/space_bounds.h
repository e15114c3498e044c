// engine/geometry/space_bounds.h: axis-parallel boxes in space.
#pragma once

#include <glm/vec3.hpp>

namespace sikku {

/// An axis-parallel box in space, in turtle steps.
struct SpaceBounds {
    glm::dvec3 low{0.0};
    glm::dvec3 high{0.0};
    bool operator==(const SpaceBounds&) const = default;
};

}  // namespace sikku
