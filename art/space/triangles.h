// art/space/triangles.h: divides polygons in space into triangles.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace sikku {

/// The normal of a polygon, which need not be flat, as long as twice its area: the polygon is anticlockwise seen from
/// the tip.
/// Source: Newell's method (Sutherland, Sproull and Schumacker 1974).
glm::dvec3 area_normal(std::span<const glm::vec3> vertices);

/// Triangles of a polygon by the indices of its vertices, in the same orientation.
struct Triangulation {
    std::vector<std::array<std::uint32_t, 3>> triangles;
    /// False for a polygon that crosses itself in the plane of its normal, or has more than 1000 vertices: part of
    /// the result is a fan from one of its vertices, which does not cover the same area.
    bool is_whole = true;
};
/// Triangulates by cutting off ears in the plane of the normal. Cost: between linear and cubic in the vertices, up to
/// 1000 of them.
Triangulation triangulate(std::span<const glm::vec3> vertices);

}  // namespace sikku
