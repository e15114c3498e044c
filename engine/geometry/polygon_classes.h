// engine/geometry/polygon_classes.h: classes of congruent polygons.
#pragma once

#include <glm/vec2.hpp>

#include <cstdint>
#include <map>
#include <span>
#include <vector>

namespace sikku {

/// Class of a polygon; each number counts from 0, in the order of their first polygons.
struct PolygonClass {
    std::uint32_t shape = 0;      ///< the same up to motions and reflections
    std::uint32_t hand = 0;       ///< the same up to motions
    std::uint32_t direction = 0;  ///< the same up to translations
    bool is_reflected = false;  ///< it is the mirror image of the first polygon of its shape, and not congruent to it
    bool operator==(const PolygonClass&) const = default;
};

/// Distinguishes polygons by the lengths of their sides and the angles between them, to about 1e-5 of a step and of a
/// radian. Corners on straight stretches do not count, nor does the sense in which a polygon is drawn.
class PolygonClasses {
public:
    /// Cost: k log k for k corners, and a search among the classes.
    PolygonClass classify(std::span<const glm::dvec2> corners);
    std::size_t shapes() const { return shapes_.size(); }

private:
    /// Sides and angles, from the corner at which their sequence is least.
    using Signature = std::vector<std::int64_t>;
    struct Shape {
        std::uint32_t number = 0;
        Signature first;  ///< of the first polygon, as it was drawn
    };

    std::map<Signature, Shape> shapes_;  ///< by the lesser of the signatures of both hands
    std::map<Signature, std::uint32_t> hands_;
    std::map<Signature, std::uint32_t> directions_;
};

}  // namespace sikku
