// art/hand/hand_noise.h: smooth noise along a line and in the plane, the same on every machine.
#pragma once

#include "engine/base/chance.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/vec2.hpp>

namespace sikku {

/// Pseudorandom number in [-1, 1), uniform.
inline double hand_chance(std::uint64_t seed, std::uint64_t number) {
    const std::uint64_t bits = scrambled(seed + 0x9E3779B97F4A7C15U * (number + 1)) >> 11;
    return static_cast<double>(bits) * 0x1p-52 - 1;
}

/// Cubic step with level ends: 0 up to 0, 1 from 1 on.
inline double smooth_step(double t) {
    t = std::clamp(t, 0.0, 1.0);
    return t * t * (3 - 2 * t);
}

/// Weights of a uniform cubic B-spline at `t` between two knots.
inline std::array<double, 4> spline_weights(double t) {
    const double u = 1 - t;
    return {u * u * u / 6, (3 * t * t * t - 6 * t * t + 4) / 6, (3 * u * u * u - 6 * u * u + 4) / 6, t * t * t / 6};
}

/// Twice differentiable noise along a line, between -1 and 1, with a standard deviation of about 0.4. On a closed
/// line its end meets its beginning.
class LineNoise {
public:
    LineNoise(std::uint64_t seed, double length, double wavelength, bool closed)
        : seed_(seed),
          count_(static_cast<std::uint64_t>(std::fmin(std::fmax(3, std::round(2 * length / wavelength)), 1e12))),
          scale_(length > 0 ? static_cast<double>(count_) / length : 0),
          closed_(closed) {}

    double operator()(double along) const {
        const double at = along * scale_;
        const double knot = std::floor(at);
        const std::array<double, 4> weights = spline_weights(at - knot);
        double sum = 0;
        for (std::uint64_t k = 0; k < 4; ++k) {
            std::uint64_t index = static_cast<std::uint64_t>(static_cast<std::int64_t>(knot) + 1) + k;
            if (closed_) index %= count_;
            sum += weights[k] * hand_chance(seed_, index);
        }
        return sum;
    }

private:
    std::uint64_t seed_;
    std::uint64_t count_;
    double scale_;
    bool closed_;
};

/// Displacement by two such noises over the plane. @param spacing  distance between knots
inline glm::dvec2 plane_noise(std::uint64_t seed, glm::dvec2 at, double spacing) {
    const glm::dvec2 scaled = at / spacing;
    const glm::dvec2 knot(std::floor(scaled.x), std::floor(scaled.y));
    const std::array<double, 4> across = spline_weights(scaled.x - knot.x), up = spline_weights(scaled.y - knot.y);
    glm::dvec2 sum(0.0);
    for (std::int64_t y = 0; y < 4; ++y) {
        const std::uint64_t row = scrambled(seed ^ static_cast<std::uint64_t>(static_cast<std::int64_t>(knot.y) + y));
        for (std::int64_t x = 0; x < 4; ++x) {
            const std::uint64_t place = row + 2 * static_cast<std::uint64_t>(static_cast<std::int64_t>(knot.x) + x);
            const double weight = across[static_cast<std::size_t>(x)] * up[static_cast<std::size_t>(y)];
            sum += weight * glm::dvec2(hand_chance(row, place), hand_chance(row, place + 1));
        }
    }
    return sum;
}

}  // namespace sikku
