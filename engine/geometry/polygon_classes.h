// engine/geometry/polygon_classes.h: classes of congruent polygons.
#pragma once

#include <glm/vec2.hpp>

#include <cmath>
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

/// Numbers values that differ by errors: values near an earlier one get its number.
class RoughNumbers {
public:
    /// The number of the nearest value within `error`, or a new one, for which `added` is called. Cost: a search.
    template <class Added>
    std::uint32_t number(double value, double error, Added&& added) {
        auto nearest = values_.end();
        for (auto at = values_.lower_bound(value - error); at != values_.end() && at->first <= value + error; ++at) {
            if (nearest == values_.end() || std::fabs(at->first - value) < std::fabs(nearest->first - value)) {
                nearest = at;
            }
        }
        if (nearest != values_.end()) return nearest->second;
        const auto fresh = static_cast<std::uint32_t>(values_.size());
        values_.emplace(value, fresh);
        added(fresh);
        return fresh;
    }

private:
    std::map<double, std::uint32_t> values_;
};

/// Radians by which the angle between two sides may be wrong if each corner is wrong by half of `tolerance`; at most
/// 0.02, about a degree.
double angle_error(double tolerance, double first_side, double second_side);

/// Distinguishes polygons by the lengths of their sides and the angles between them, to about 1e-5 of a step and of a
/// radian. Corners on straight stretches do not count, nor does the sense in which a polygon is drawn.
class PolygonClasses {
public:
    PolygonClasses() = default;
    /// @param tolerance  difference of equal lengths in steps; 0: as above
    explicit PolygonClasses(double tolerance) : tolerance_(tolerance) {}

    /// Cost: k log k for k corners, and a search among the classes.
    PolygonClass classify(std::span<const glm::dvec2> corners);
    /// The same for lengths and angles that the caller distinguishes.
    /// @param corners  anticlockwise, none on a straight stretch
    /// @param sides  for each corner, a number of the side that begins there, and one of the angle at its end
    PolygonClass classify(std::span<const glm::dvec2> corners, const std::vector<std::int64_t>& sides);
    std::size_t shapes() const { return shapes_.size(); }

private:
    /// Sides and angles, from the corner at which their sequence is least.
    using Signature = std::vector<std::int64_t>;
    struct Shape {
        std::uint32_t number = 0;
        Signature first;  ///< of the first polygon, as it was drawn
    };

    Signature sides_and_angles(const std::vector<glm::dvec2>& corners);

    double tolerance_ = 0;
    RoughNumbers lengths_, angles_;
    std::map<Signature, Shape> shapes_;  ///< by the lesser of the signatures of both hands
    std::map<Signature, std::uint32_t> hands_;
    std::map<Signature, std::uint32_t> directions_;
};

}  // namespace sikku
