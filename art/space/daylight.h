// art/space/daylight.h: the light of sun and sky that reaches a place of a scene.
#pragma once

#include "art/space/scene.h"
#include "art/style/light.h"

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

namespace sikku {

/// Depth maps of a scene, seen from directions spread over the sky and over the disc of the sun. Light from a
/// direction reaches a place if no surface is nearer to the light there. Points and directions are those of the scene
/// (see Scene), y up; the ground is level, at the height of the lowest point of the scene.
///
/// The maps have about the resolution of the picture, those of the sky half of it: for drawings of 512 to 2,048
/// pixels at most 64 of 0.5 MB and 40 of 2 MB, a quarter for smaller and four times as much for larger ones.
///
/// Cost: each direction draws all of the scene once, 20 ns a triangle and more; a query costs 0.3 µs. Memory: the
/// maps, and 40 bytes a segment.
/// Source: many shadow maps for one area light: Segal et al. 1992; sky of an overcast day: Moon and Spencer 1942.
class Daylight {
public:
    /// @param step    millimetres of a turtle step, for widths in millimetres
    /// @param pixels  length of the drawing's longer side in the picture
    Daylight(const Scene& scene, const Style& style, double step, double pixels);
    /// Draws the maps on `threads` threads (0: all cores). Call once, before the queries. @param watch  may be empty;
    /// may throw to stop
    void build(int threads, const std::function<void()>& watch);

    /// Linear light on both sides of a surface, in red, green and blue; 1 or more for one that faces the sun in the
    /// open.
    struct OnSurface {
        glm::vec3 front{0.0F}, behind{0.0F};
    };
    /// @param normal  of length 1, on the side of the eye
    /// @param is_thin  light from behind passes through it; else `behind` is 0
    OnSurface on_surface(const glm::vec3& point, const glm::vec3& normal, bool is_thin) const;
    /// Share of the light of the sky that reaches the ground.
    float sky_on_ground(const glm::vec3& point) const;
    /// Light of the sun on the ground.
    float sun_on_ground(const glm::vec3& point) const;
    /// Light on the ground, as a share of that on open ground, from the results of the two functions above.
    glm::vec3 on_ground(float sky, float sun) const;
    /// Height of the ground: that of the lowest surface.
    float ground() const { return ground_; }

private:
    /// A depth map of one direction: heights of the surfaces nearest to the light.
    struct Map {
        glm::vec3 towards{0.0F};                           ///< direction of the light
        glm::vec3 across{0.0F}, along{0.0F}, depth{0.0F};  ///< columns, rows and heights for a point …
        glm::vec3 offset{0.0F};                            ///< … and at the origin
        float bias = 0;                                    ///< difference of heights that are taken to be equal
        float nudge = 0;  ///< steps by which places are moved off their surfaces, out of their own shadow
        int width = 0, rows = 0;
        std::vector<std::uint16_t> heights;
        glm::vec3 seen(const glm::vec3& point) const;
        /// Share of the light that reaches the point, 0 to 1, smooth between the squares of the map.
        float reaches(const glm::vec3& point) const;
    };
    /// A round stem or a ball.
    struct Round {
        glm::vec3 from, to;
        float before = 0, after = 0;  ///< radii
    };
    class Drawer;

    Map framed(const glm::vec3& towards, int side) const;
    void draw(Map& map) const;
    void find_open_ground();
    int tile() const { return side_ / 32; }
    /// Light of the sky and of the sun.
    struct Parts {
        float sky = 0, sun = 0;
    };
    float sky(const glm::vec3& point, const glm::vec3& normal) const;
    float sun(const glm::vec3& point, const glm::vec3& normal) const;
    Parts parts(const glm::vec3& point, const glm::vec3& normal) const;
    glm::vec3 mixed(const Parts& parts) const;

    Light light_;
    std::vector<std::uint32_t> triangles_;  ///< indices of `corners_`, three each
    /// Polygons that cross themselves: the first corner and the number of corners of each.
    std::vector<std::pair<std::uint32_t, std::uint32_t>> outlines_;
    std::vector<glm::vec3> corners_;
    std::vector<Round> rounds_;
    glm::vec3 low_{0.0F}, high_{0.0F};
    float ground_ = 0;
    int side_ = 0;  ///< side of the sun's maps, in squares
    std::vector<Map> sky_, sun_;
    std::vector<float> sky_weights_;
    glm::vec3 open_{1.0F};           ///< light on open ground
    float open_sun_ = 1;             ///< light of the sun on open ground
    int columns_ = 0;                ///< number of columns of tiles
    std::vector<char> may_be_dark_;  ///< tiles of the first sun's map that shadows may reach
};

}  // namespace sikku
