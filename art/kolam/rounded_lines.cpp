#include "art/kolam/rounded_lines.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace sikku {
namespace {

// In spacings. A loop of control points with this radius is a curve with 5/6 of it.
constexpr double least_radius = 0.32;
constexpr double rim_radius = 0.5;
constexpr double crossed_radius = 0.36;  ///< least distance from dots in a crossing
constexpr double turned_radius = 0.42;   ///< where another line turns back on the other side of the gap

/// A control point on a ray: `origin + at * ray`, from `least` to `most`.
struct RailPoint {
    glm::dvec2 origin;
    glm::dvec2 ray;
    double least;
    double most;
    double at;
};

/// The control point where a step leaves its dot.
RailPoint rail_of(const DotGrid& grid, const GapStates& states, const ArcStep& step) {
    const std::uint32_t side = exit(grid, step);
    const glm::dvec2 dot = dot_place(grid, step.dot), ray = lattice_ray(grid.lattice(), side);
    if (grid.lattice() == DotLattice::square) return {dot, ray, 0.5, 0.5, 0.5};
    const std::int32_t gap = grid.gap(step.dot, side);
    if (gap < 0) return {dot, ray, least_radius, rim_radius, least_radius};
    switch (states[static_cast<std::size_t>(gap)]) {
        case GapState::crossed:
            return {dot, ray, crossed_radius, 1 - crossed_radius, 0.5};
        case GapState::joined: {
            // The line runs past both dots, on the side where it passes this one, as far as the middle of three.
            const glm::dvec2 left(-ray.y, ray.x);
            constexpr double middle = std::numbers::sqrt3 / 6;
            return {dot + 0.5 * ray, step.anticlockwise ? -left : left, 0.5 * middle, middle, middle};
        }
        case GapState::turned:
            break;
    }
    return {dot, ray, least_radius, turned_radius, least_radius};
}

/// Moves control points along their rays.
void relax(std::vector<RailPoint>& rails, std::vector<glm::dvec2>& points, Pulse& pulse) {
    constexpr double tension = 0.3;  // weight of first differences, that of second ones is 1
    constexpr double precise = 1e-9;
    constexpr int most_sweeps = 400;
    const std::size_t count = rails.size();
    const auto point = [&](std::size_t i, std::size_t ahead) { return points[(i + ahead) % count]; };
    for (int sweep = 0; sweep < most_sweeps; ++sweep) {
        double moved = 0;
        for (std::size_t i = 0; i < count; ++i) {
            pulse();
            RailPoint& rail = rails[i];
            const glm::dvec2 beside = point(i, 1) + point(i, count - 1), beyond = point(i, 2) + point(i, count - 2);
            const glm::dvec2 wanted = ((4 + tension) * beside - beyond) / (6 + 2 * tension);
            const double at = std::clamp(glm::dot(wanted - rail.origin, rail.ray), rail.least, rail.most);
            moved = std::max(moved, std::fabs(at - rail.at));
            rail.at = at;
            points[i] = rail.origin + at * rail.ray;
        }
        if (moved < precise) break;
    }
}

}  // namespace

std::vector<glm::dvec2> rounded_line(const DotGrid& grid, const GapStates& states, const ArcStep& start,
                                     const KolamRim& rim, Pulse& pulse) {
    std::vector<ArcStep> steps;
    std::vector<RailPoint> rails;
    ArcStep step = start;
    do {
        steps.push_back(step);
        rails.push_back(rail_of(grid, states, step));
        step = next_step(grid, states, step);
    } while (step != start);
    std::vector<glm::dvec2> points;
    for (const RailPoint& rail : rails) points.push_back(rail.origin + rail.at * rail.ray);
    if (grid.lattice() == DotLattice::triangular) relax(rails, points, pulse);
    points = rim.reshaped(steps, points);
    // From the exits of steps to their entries.
    std::rotate(points.begin(), points.end() - 1, points.end());
    return points;
}

}  // namespace sikku
