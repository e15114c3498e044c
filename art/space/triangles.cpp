#include "art/space/triangles.h"

#include "engine/geometry/box.h"
#include "engine/geometry/simple_polygon.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include <cmath>
#include <cstddef>

namespace sikku {
namespace {

constexpr std::size_t most_ears = 1000;

/// True if a triangle contains a point, also on its edges.
bool contains(glm::dvec2 a, glm::dvec2 b, glm::dvec2 c, glm::dvec2 point) {
    return side_of(a, b, point) >= 0 && side_of(b, c, point) >= 0 && side_of(c, a, point) >= 0;
}

}  // namespace

glm::dvec3 area_normal(std::span<const glm::vec3> vertices) {
    glm::dvec3 sum(0.0);
    const glm::dvec3 origin = vertices.front();
    for (std::size_t i = 0; i < vertices.size(); ++i) {
        sum += glm::cross(glm::dvec3(vertices[i]) - origin,
                          glm::dvec3(vertices[i + 1 < vertices.size() ? i + 1 : 0]) - origin);
    }
    return sum;
}

Triangulation triangulate(std::span<const glm::vec3> vertices) {
    Triangulation result;
    auto& triangles = result.triangles;
    if (vertices.size() < 3) return result;
    std::vector<std::uint32_t> left(vertices.size());
    for (std::size_t i = 0; i < left.size(); ++i) left[i] = static_cast<std::uint32_t>(i);
    const glm::dvec3 normal = area_normal(vertices);
    // Seen along the axis nearest to the normal, anticlockwise.
    const glm::dvec3 size = glm::abs(normal);
    const int axis = size.x > size.y && size.x > size.z ? 0 : size.y > size.z ? 1 : 2;
    std::vector<glm::dvec2> flat;
    if (vertices.size() <= most_ears) {
        for (const glm::vec3& vertex : vertices) {
            glm::dvec2 point(vertex[(axis + 1) % 3], vertex[(axis + 2) % 3]);
            if (normal[axis] < 0) point.x = -point.x;
            flat.push_back(point);
        }
    }
    const auto is_ear = [&](std::size_t before, std::size_t at, std::size_t after) {
        const glm::dvec2 a = flat[left[before]], b = flat[left[at]], c = flat[left[after]];
        if (!(determinant(b - a, c - b) > 0)) return false;
        for (std::size_t i = 0; i < left.size(); ++i) {
            if (i == before || i == at || i == after) continue;
            const glm::dvec2 point = flat[left[i]];
            if (point != a && point != b && point != c && contains(a, b, c, point)) return false;
        }
        return true;
    };
    std::size_t at = 1;
    std::size_t tried = 0;
    while (left.size() > 3 && !flat.empty() && tried < left.size()) {
        at %= left.size();
        const std::size_t before = (at + left.size() - 1) % left.size();
        const std::size_t after = (at + 1) % left.size();
        if (is_ear(before, at, after)) {
            triangles.push_back({left[before], left[at], left[after]});
            left.erase(left.begin() + static_cast<std::ptrdiff_t>(at));
            tried = 0;
        } else {
            ++at;
            ++tried;
        }
    }
    result.is_whole = left.size() == 3 && !crosses_itself(flat);
    for (std::size_t i = 1; i + 1 < left.size(); ++i) triangles.push_back({left[0], left[i], left[i + 1]});
    return result;
}

}  // namespace sikku
