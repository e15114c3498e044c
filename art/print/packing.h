// art/print/packing.h: copies of a convex shape, translated and packed in a dense lattice.
#pragma once

#include <glm/vec2.hpp>
#include <span>

namespace sikku {

/// A basis of the lattice of copies: `across` is the most level short step to the right, `up` the shortest step
/// upwards that completes it.
struct PlaneLattice {
    glm::dvec2 across{0.0}, up{0.0};
};

/// Finds the lattice with the least cell in which translated copies of a convex hull stay a gap apart: squares in
/// rows and columns, diamonds and hexagons in shifted rows. Lattices with level rows that stand above each other, or
/// in each other's gaps, are preferred if their cell is at most 10 % larger than the least. Two copies stay apart if
/// the step between them is not inside the difference body of the hull, widened by the gap. Source: Mount &
/// Silverman, Packing and covering the plane with translates of a convex polygon, J. Algorithms 11 (1990). Cost:
/// about 10 ms.
/// @param hull  at least one point  @param gap  may be negative: copies overlap
/// @throws std::runtime_error for drawings so large that lengths overflow
PlaneLattice densest_lattice(std::span<const glm::dvec2> hull, double gap);

}  // namespace sikku
