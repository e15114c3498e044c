// tests/hilbert.h: a long line that stays on its page, for tests and benchmarks.
#pragma once

#include <glm/vec2.hpp>
#include <utility>
#include <vector>

namespace sikku {

/// The point at distance `d` along Hilbert's curve on a square of `side` (a power of two) points.
inline glm::dvec2 hilbert_point(int side, int d) {
    int x = 0;
    int y = 0;
    for (int s = 1; s < side; s *= 2, d /= 4) {
        const int right = 1 & (d / 2);
        const int up = 1 & (d ^ right);
        if (up == 0) {
            if (right == 1) {
                x = s - 1 - x;
                y = s - 1 - y;
            }
            std::swap(x, y);
        }
        x += s * right;
        y += s * up;
    }
    return {x, y};
}

/// All of them, from (offset, offset), `step` apart.
inline std::vector<glm::dvec2> hilbert_points(int side, double step = 1.0, double offset = 0.0) {
    std::vector<glm::dvec2> points;
    for (int d = 0; d < side * side; ++d) points.push_back(step * hilbert_point(side, d) + offset);
    return points;
}

}  // namespace sikku
