// engine/tiling/lattice_rectangle.h: rectangles that repeat under the translations of a lattice.
#pragma once

#include <glm/vec2.hpp>

#include <optional>

namespace sikku {

/// Two perpendicular vectors of a lattice.
struct LatticeRectangle {
    glm::dvec2 across{0.0}, up{0.0};
    double area() const { return across.x * up.y - across.y * up.x; }
};

/// The smallest rectangle with sides along the axes whose sides are sums of multiples of two vectors, up to multiples
/// of 1000; across to the right and up. Nullopt if there is none.
std::optional<LatticeRectangle> upright_rectangle(glm::dvec2 a, glm::dvec2 b);

/// The smallest such rectangle of any direction, among sides of up to 24 vectors. It is returned in the orientation
/// with `across` within 45 degrees of the x axis.
std::optional<LatticeRectangle> least_rectangle(glm::dvec2 a, glm::dvec2 b);

}  // namespace sikku
