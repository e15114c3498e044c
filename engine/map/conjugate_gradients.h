// engine/map/conjugate_gradients.h: solves large symmetric systems of equations with two unknowns for each vertex.
#pragma once

#include "engine/base/monitor.h"

#include <cstddef>
#include <glm/geometric.hpp>
#include <glm/mat2x2.hpp>
#include <glm/vec2.hpp>
#include <vector>

namespace sikku {

/// A vector of two numbers for each vertex.
using VertexVector = std::vector<glm::dvec2>;

inline double dot(const VertexVector& a, const VertexVector& b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += glm::dot(a[i], b[i]);
    return sum;
}

/// Solves A x = b until the residual is `tolerance` times its first norm. Where A turns out not to be positive
/// definite, returns the solution so far, or the first direction: one along which x·b > 0.
/// @param apply  apply(x, y) sets y to A x
/// @param inverses  for each vertex an approximate inverse of its 2 x 2 block, positive definite
/// Cost: one apply() for each step, about as many steps as the map has edges across. @throws Stopped
/// Source: Steihaug 1983, without the trust region.
template <class Apply>
VertexVector conjugate_gradients(Apply apply, const std::vector<glm::dmat2>& inverses, const VertexVector& b,
                                 double tolerance, std::size_t most_rounds, const Monitor& monitor) {
    const std::size_t size = b.size();
    VertexVector x(size, glm::dvec2(0.0));
    VertexVector residual = b;
    VertexVector conditioned(size);
    VertexVector image(size);
    const auto condition = [&] {
        for (std::size_t i = 0; i < size; ++i) conditioned[i] = inverses[i] * residual[i];
        return dot(residual, conditioned);
    };
    double norm = condition();
    const double wanted = norm * tolerance * tolerance;
    VertexVector direction = conditioned;
    for (std::size_t step = 0; step < most_rounds && norm > wanted && norm > 0; ++step) {
        monitor.check();
        apply(direction, image);
        const double curvature = dot(direction, image);
        if (!(curvature > 0)) return step == 0 ? direction : x;
        const double length = norm / curvature;
        for (std::size_t i = 0; i < size; ++i) {
            x[i] += length * direction[i];
            residual[i] -= length * image[i];
        }
        const double next = condition();
        const double share = next / norm;
        norm = next;
        for (std::size_t i = 0; i < size; ++i) direction[i] = conditioned[i] + share * direction[i];
    }
    return x;
}

}  // namespace sikku
