#include "engine/tiling/lattice_rectangle.h"

#include "engine/geometry/box.h"

#include <cmath>
#include <numeric>

namespace sikku {
namespace {

constexpr int most_multiples = 1000;
constexpr double rounding = 1e-7;  // rounding error of a multiple

/// The shortest vector m a + n b, m > 0 or n = 1, that is perpendicular to another; nullopt if there is none.
std::optional<glm::dvec2> perpendicular(glm::dvec2 a, glm::dvec2 b, glm::dvec2 to) {
    const double along_a = scalar_product(a, to), along_b = scalar_product(b, to);
    const double size = std::sqrt(scalar_product(to, to));
    if (std::fabs(along_b) <= rounding * size * std::sqrt(scalar_product(b, b))) return b;
    for (int m = 1; m <= most_multiples; ++m) {
        const double n = -m * along_a / along_b;
        if (std::fabs(n) <= most_multiples && std::fabs(n - std::round(n)) <= rounding) {
            return static_cast<double>(m) * a + std::round(n) * b;
        }
    }
    return std::nullopt;
}

}  // namespace

std::optional<LatticeRectangle> upright_rectangle(glm::dvec2 a, glm::dvec2 b) {
    const auto across = perpendicular(a, b, {0, 1}), up = perpendicular(a, b, {1, 0});
    if (!across || !up) return std::nullopt;
    return LatticeRectangle{{std::fabs(across->x), 0}, {0, std::fabs(up->y)}};
}

std::optional<LatticeRectangle> least_rectangle(glm::dvec2 a, glm::dvec2 b) {
    constexpr int most = 24;
    std::optional<LatticeRectangle> least;
    for (int m = 0; m <= most; ++m) {
        for (int n = m == 0 ? 1 : -most; n <= most; ++n) {
            if (std::gcd(m, n) != 1) continue;
            glm::dvec2 across = static_cast<double>(m) * a + static_cast<double>(n) * b;
            const auto found = perpendicular(a, b, across);
            if (!found) continue;
            // To the right, within 45 degrees of the axis.
            glm::dvec2 up = *found;
            if (std::fabs(across.y) > std::fabs(across.x) * (1 + rounding)) std::swap(across, up);
            if (across.x < 0) across = -across;
            if (determinant(across, up) < 0) up = -up;
            const LatticeRectangle rectangle{across, up};
            const bool is_smaller = !least || rectangle.area() < least->area() * (1 - rounding);
            const bool is_as_large = least && rectangle.area() < least->area() * (1 + rounding);
            const auto slope = [](const LatticeRectangle& each) { return std::fabs(each.across.y / each.across.x); };
            if (is_smaller || (is_as_large && slope(rectangle) < slope(*least) - rounding)) least = rectangle;
        }
    }
    return least;
}

}  // namespace sikku
