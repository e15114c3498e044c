// art/triangles.h: polygons in space as triangles.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace sikku {

/// The normal of a polygon, which need not be flat, as long as twice its area: anticlockwise seen from its tip.
/// Source: Newell's method (Sutherland, Sproull and Schumacker 1974).
glm::dvec3 area_normal(std::span<const glm::vec3> vertices);

/// Triangles of its vertices, by their indices, wound as it is: by cutting off ears in the plane of its normal; a
/// polygon that crosses itself there, or has more than 1000 vertices, becomes a fan from its first vertex in part.
/// Cost: quadratic in the vertices, up to 1000 of them.
std::vector<std::array<std::uint32_t, 3>> triangles_of(std::span<const glm::vec3> vertices);

}  // namespace sikku
