// art/space/casters.h: the surfaces of a scene that cast shadows.
#pragma once

#include "art/space/depth_map.h"
#include "art/space/scene.h"

#include <glm/vec3.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace sikku {

/// The surfaces of a scene as triangles and round stems, which are drawn into depth maps. Memory: 40 bytes a segment,
/// 18 a quadrilateral and 12 a corner.
class Casters {
public:
    /// @param step   millimetres of a turtle step, for widths in millimetres
    /// @param parts  number of parts of the scene's extent to which curved surfaces may be simplified
    Casters(const Scene& scene, const Style& style, double step, int parts);
    /// Draws the heights of a map. Cost: 5 ns a triangle smaller than a square.
    void draw(DepthMap& map) const;

    /// A box around all of them.
    const glm::vec3& low() const { return low_; }
    const glm::vec3& high() const { return high_; }
    /// Height of the lowest surface.
    float ground() const { return ground_; }

private:
    /// A round stem or a ball.
    struct Round {
        glm::vec3 from, to;
        float before = 0, after = 0;  ///< radii
    };
    /// A stretch of corners and the triangles between them. Short enough for 16 bits, and for the processor's cache.
    struct Chunk {
        std::size_t first = 0, end = 0;  ///< corners
        std::size_t first_triangle = 0, end_triangle = 0;
    };
    /// Corners of a polygon that crosses itself.
    struct Outline {
        std::size_t first = 0, count = 0;
    };

    /// Begins a new chunk if `count` corners more would not fit. Returns the number of the next corner in the chunk.
    std::size_t make_room(std::size_t count);
    void add_corners(std::span<const glm::vec3> corners);
    void add_triangle(std::size_t a, std::size_t b, std::size_t c);
    void add_polygons(const Scene& scene);
    void add_surfaces(const Scene& scene, double deviation);
    void add_rounds(const Scene& scene, const Style& style, double step);
    glm::vec3 corner(std::size_t i) const { return {corners_[0][i], corners_[1][i], corners_[2][i]}; }
    void draw_triangles(DepthMap& map) const;
    void draw_outlines(DepthMap& map) const;

    std::array<std::vector<float>, 3> corners_;  ///< by axis
    std::vector<Chunk> chunks_;
    std::vector<std::array<std::uint16_t, 3>> triangles_;  ///< corners, from the first one of the chunk
    std::vector<Outline> outlines_;
    std::vector<Round> rounds_;
    glm::vec3 low_{0.0F}, high_{0.0F};
    float ground_ = 0;
};

}  // namespace sikku
