// engine/geometry/bezier.h: points, derivatives, parts and chords of cubic Béziers.
#pragma once

#include <glm/vec2.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace sikku {

/// Start, two controls, end.
using Bezier = std::array<glm::dvec2, 4>;

inline glm::dvec2 point_of(const Bezier& b, double t) {
    const double s = 1 - t;
    return s * s * s * b[0] + 3 * s * s * t * b[1] + 3 * s * t * t * b[2] + t * t * t * b[3];
}
/// The first derivative at a parameter.
inline glm::dvec2 derivative_of(const Bezier& b, double t) {
    const double s = 1 - t;
    return 3 * s * s * (b[1] - b[0]) + 6 * s * t * (b[2] - b[1]) + 3 * t * t * (b[3] - b[2]);
}
/// A straight line as a Bézier.
inline Bezier straight_curve(glm::dvec2 from, glm::dvec2 to) {
    return {from, from + (to - from) / 3.0, from + (to - from) * (2.0 / 3.0), to};
}

/// A value of the blossom of a cubic, by de Boor's algorithm. @param share  returns the share of point i + 1 in the
/// point that replaces i and i + 1
template <class Share>
glm::dvec2 de_boor(Bezier points, const Share& share) {
    for (std::size_t level = 0; level < 3; ++level) {
        for (std::size_t i = 0; i < 3 - level; ++i) {
            const double next = share(level, i);
            points[i] = (1 - next) * points[i] + next * points[i + 1];
        }
    }
    return points[0];
}

/// The piece between two parameters, 0 <= from <= to <= 1, by its blossom.
inline Bezier part_of(const Bezier& whole, double from, double to) {
    const auto blossom = [&](double u, double v, double w) {
        const std::array<double, 3> at = {u, v, w};
        return de_boor(whole, [&](std::size_t level, std::size_t) { return at[level]; });
    };
    return {blossom(from, from, from), blossom(from, from, to), blossom(from, to, to), blossom(to, to, to)};
}

/// Calls `visit(end)` for each chord of the curve, the last of which ends at `p3`; the curve deviates from them by at
/// most `tolerance`. At most 100,000 chords.
/// Source: Wang's bound, Proc. SPIE, 1984: a cubic in n equal parts is off its chords by at most
/// max |second difference| * 6 / 8 / n^2.
template <class Visit>
void flatten(glm::dvec2 p0, glm::dvec2 p1, glm::dvec2 p2, glm::dvec2 p3, double tolerance, Visit&& visit) {
    const glm::dvec2 a = p0 - 2.0 * p1 + p2, b = p1 - 2.0 * p2 + p3;
    const double bend = std::sqrt(std::max(a.x * a.x + a.y * a.y, b.x * b.x + b.y * b.y));
    const double parts = std::ceil(std::sqrt(bend * (0.75 / tolerance)));
    const int count = parts > 1 ? static_cast<int>(std::min(parts, 100'000.0)) : 1;
    const glm::dvec2 c1 = 3.0 * (p1 - p0), c2 = 3.0 * a, c3 = b - a;
    for (int part = 1; part < count; ++part) {
        const double t = static_cast<double>(part) / count;
        visit(p0 + t * (c1 + t * (c2 + t * c3)));
    }
    visit(p3);
}

}  // namespace sikku
