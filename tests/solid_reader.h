// tests/solid_reader.h: reads meshes according to their specifications, and checks that they bound a solid.
#pragma once

#include <gtest/gtest.h>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace sikku {

/// Triangles with shared corners.
struct ReadMesh {
    std::vector<glm::dvec3> points;
    std::vector<std::array<std::uint32_t, 3>> triangles;
    std::vector<std::size_t> materials{};  ///< of triangles, in glTF and OBJ

    glm::dvec3 low() const {
        return bound([](double a, double b) { return std::min(a, b); });
    }
    glm::dvec3 high() const {
        return bound([](double a, double b) { return std::max(a, b); });
    }
    /// By the divergence theorem.
    double volume() const {
        double sum = 0;
        for (const auto& [a, b, c] : triangles) sum += glm::dot(points[a], glm::cross(points[b], points[c])) / 6;
        return sum;
    }

private:
    template <class Choose>
    glm::dvec3 bound(Choose choose) const {
        glm::dvec3 result = points.at(triangles.at(0)[0]);
        for (const auto& triangle : triangles) {
            for (const std::uint32_t corner : triangle) {
                for (int k = 0; k < 3; ++k) result[k] = choose(result[k], points[corner][k]);
            }
        }
        return result;
    }
};

template <class Number>
Number number_at(const std::string& bytes, std::size_t at) {
    Number value{};
    if (at + sizeof value > bytes.size()) throw std::runtime_error("the file ends too early");
    std::memcpy(&value, bytes.data() + at, sizeof value);
    return value;
}

/// Corners at the same place are one.
ReadMesh read_stl(const std::string& bytes);

/// Binary glTF with one node. Corners are those of the file, without the node's rotation and scale.
ReadMesh read_glb_mesh(const std::string& bytes, nlohmann::json* json_of = nullptr);

ReadMesh read_obj_mesh(const std::string& text);

/// Each edge belongs to two triangles, which run along it in opposite directions, and the triangles around each
/// corner are neighbours in one cycle: the surface touches itself nowhere.
void expect_closed(const ReadMesh& mesh);

}  // namespace sikku
