// art/space/depth_map.h: which places of a scene the light from one direction reaches.
#pragma once

#include "art/raster/stroke.h"
#include "art/space/lit_places.h"

#include <glm/vec3.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>

namespace sikku {

/// Two axes across a direction, each of length 1.
std::pair<glm::vec3, glm::vec3> axes_across(const glm::vec3& towards);

/// Heights of the surfaces nearest to a light, seen from its direction, in a grid of squares.
struct DepthMap {
    /// A map of the box between two points. @param side  longer side of the map, in squares
    DepthMap(const glm::vec3& towards, const glm::vec3& low, const glm::vec3& high, int side);

    static constexpr float highest = 65535.0F;

    glm::vec3 towards;                                 ///< direction of the light
    glm::vec3 across{0.0F}, along{0.0F}, depth{0.0F};  ///< columns, rows and heights for a point …
    glm::vec3 offset{0.0F};                            ///< … and at the origin
    float scale = 1;                                   ///< squares in a turtle step
    float bias = 0;                                    ///< difference of heights that are taken to be equal
    float nudge = 0;  ///< steps by which places are moved off their surfaces, out of their own shadow
    int width = 0, rows = 0;
    /// By rows; given by the owner, and drawn by Casters. The outermost squares are empty.
    std::span<std::uint16_t> heights;
    std::size_t squares() const { return std::size_t(width) * std::size_t(rows); }

    glm::vec3 seen(const glm::vec3& point) const;
    /// Share of the light that reaches the point, 0 to 1, smooth between the squares of the map.
    float reaches(const glm::vec3& point) const;
    /// Adds the light that reaches each of the places: the share, times the cosine of the angle to the normal, times
    /// `weight`. All instruction sets add the same, bit for bit. Cost: 2 ns a place.
    void shine(float weight, LitPlaces& places, Simd simd = best_simd()) const;
};

}  // namespace sikku
