#include "engine/geometry/polygon_classes.h"

#include "engine/geometry/box.h"
#include "engine/geometry/simple_polygon.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <limits>
#include <numbers>

namespace sikku {
namespace {

constexpr double parts_of_step = 1e5;  // of a step and of a radian that are distinguished
/// Moves round values away from the borders between parts.
constexpr double shift = 0.3183;

std::int64_t rounded(double value) {
    return static_cast<std::int64_t>(std::floor(std::clamp(value * parts_of_step + shift, -9e18, 9e18)));
}

/// The corners, anticlockwise, without those on straight stretches.
std::vector<glm::dvec2> true_corners(std::span<const glm::dvec2> given) {
    std::vector<glm::dvec2> corners;
    for (std::size_t i = 0; i < given.size(); ++i) {
        const glm::dvec2 before = given[i] - given[(i + given.size() - 1) % given.size()];
        const glm::dvec2 after = given[(i + 1) % given.size()] - given[i];
        const double scale = glm::length(before) * glm::length(after);
        if (std::fabs(determinant(before, after)) > 1e-9 * scale || glm::dot(before, after) < 0)
            corners.push_back(given[i]);
    }
    if (signed_area(corners) < 0) std::reverse(corners.begin(), corners.end());
    return corners;
}

/// The same polygon seen from behind: its sides in reverse order, each with the angle at its other end.
std::vector<std::int64_t> reflected(const std::vector<std::int64_t>& sides) {
    const std::size_t count = sides.size() / 2;
    std::vector<std::int64_t> result;
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t side = count - 1 - i;
        result.push_back(sides[2 * side]);
        result.push_back(sides[2 * ((side + count - 1) % count) + 1]);
    }
    return result;
}

/// The corners at which the cyclic sequence is least: several if the polygon has a rotation.
std::vector<std::size_t> least_starts(const std::vector<std::int64_t>& sides) {
    const std::size_t count = sides.size() / 2;
    const auto compare = [&](std::size_t a, std::size_t b) {
        for (std::size_t i = 0; i < sides.size(); ++i) {
            const std::int64_t difference = sides[(2 * a + i) % sides.size()] - sides[(2 * b + i) % sides.size()];
            if (difference != 0) return difference;
        }
        return std::int64_t{0};
    };
    std::vector<std::size_t> least;
    for (std::size_t start = 0; start < count; ++start) {
        const std::int64_t order = least.empty() ? 0 : compare(start, least.front());
        if (order < 0) least.clear();
        if (order <= 0) least.push_back(start);
    }
    return least;
}

std::vector<std::int64_t> turned_to(const std::vector<std::int64_t>& sides, std::size_t start) {
    std::vector<std::int64_t> result = sides;
    std::rotate(result.begin(), result.begin() + static_cast<std::ptrdiff_t>(2 * start), result.end());
    return result;
}

}  // namespace

double angle_error(double tolerance, double first_side, double second_side) {
    return std::min(2 * tolerance * (1 / first_side + 1 / second_side), 0.02);
}

/// A side of each corner and the angle to the next one, alternately: rounded, or numbered.
PolygonClasses::Signature PolygonClasses::sides_and_angles(const std::vector<glm::dvec2>& corners) {
    Signature result;
    const auto ignore = [](std::uint32_t) {};
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const glm::dvec2 side = corners[(i + 1) % corners.size()] - corners[i];
        const glm::dvec2 next = corners[(i + 2) % corners.size()] - corners[(i + 1) % corners.size()];
        const double angle = std::atan2(determinant(side, next), glm::dot(side, next));
        if (tolerance_ > 0) {
            result.push_back(lengths_.number(glm::length(side), tolerance_, ignore));
            const double error = angle_error(tolerance_, glm::length(side), glm::length(next));
            result.push_back(angles_.number(angle, error, ignore));
        } else {
            result.push_back(rounded(glm::length(side)));
            result.push_back(rounded(angle));
        }
    }
    return result;
}

PolygonClass PolygonClasses::classify(std::span<const glm::dvec2> given) {
    const std::vector<glm::dvec2> corners = true_corners(given);
    return classify(corners, sides_and_angles(corners));
}

PolygonClass PolygonClasses::classify(std::span<const glm::dvec2> corners, const std::vector<std::int64_t>& sides) {
    const std::vector<std::size_t> starts = least_starts(sides);
    const Signature own = starts.empty() ? Signature{} : turned_to(sides, starts.front());
    const Signature seen = reflected(sides);
    const std::vector<std::size_t> other_starts = least_starts(seen);
    const Signature mirror = other_starts.empty() ? Signature{} : turned_to(seen, other_starts.front());

    PolygonClass result;
    const auto [shape, is_new] =
        shapes_.try_emplace(std::min(own, mirror), Shape{static_cast<std::uint32_t>(shapes_.size()), own});
    result.shape = shape->second.number;
    result.is_reflected = own != shape->second.first;
    result.hand = hands_.try_emplace(own, static_cast<std::uint32_t>(hands_.size())).first->second;

    std::int64_t heading = std::numeric_limits<std::int64_t>::max();
    const std::int64_t circle = rounded(2 * std::numbers::pi);
    for (const std::size_t start : starts) {
        const glm::dvec2 side = corners[(start + 1) % corners.size()] - corners[start];
        double angle = std::atan2(side.y, side.x);
        if (angle < -0.5 / parts_of_step) angle += 2 * std::numbers::pi;
        heading = std::min(heading, rounded(angle) % circle);
    }
    Signature directed = own;
    directed.push_back(heading);
    result.direction =
        directions_.try_emplace(directed, static_cast<std::uint32_t>(directions_.size())).first->second;
    return result;
}

}  // namespace sikku
