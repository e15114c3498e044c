#include "engine/geometry/parallel_curve.h"
#include "engine/geometry/box.h"

#include <cmath>

namespace sikku {
namespace {

constexpr int most_halvings = 10;

glm::dvec2 acceleration(const Bezier& b, double t) {
    return 6 * (1 - t) * (b[2] - 2.0 * b[1] + b[0]) + 6 * t * (b[3] - 2.0 * b[2] + b[1]);
}
/// Distance of a point from the curve, whose nearest point is near `t`.
double distance_from(glm::dvec2 from, const Bezier& curve, double t) {
    for (int i = 0; i < 3; ++i) {
        const glm::dvec2 gap = point_of(curve, t) - from;
        const glm::dvec2 along = derivative_of(curve, t);
        const glm::dvec2 bend = acceleration(curve, t);
        const double slope = along.x * along.x + along.y * along.y + gap.x * bend.x + gap.y * bend.y;
        if (!(slope > 0)) break;
        t -= (gap.x * along.x + gap.y * along.y) / slope;
    }
    const glm::dvec2 gap = point_of(curve, t) - from;
    return std::hypot(gap.x, gap.y);
}

void add_part(const Bezier& curve, double from, double to, double distance, double tolerance, int halvings,
              std::vector<glm::dvec2>& controls) {
    const auto moved = [&](double t) { return point_of(curve, t) + distance * left_of(tangent_of(curve, t)); };
    const auto handle = [&](double t) {
        return (1 - distance * curvature_of(curve, t)) * (to - from) / 3 * derivative_of(curve, t);
    };
    const glm::dvec2 begin = moved(from);
    const glm::dvec2 end = moved(to);
    const Bezier fit = {begin, begin + handle(from), end - handle(to), end};
    bool is_near = true;
    for (const double share : {0.25, 0.5, 0.75}) {
        const double off =
            distance_from(point_of(fit, share), curve, from + share * (to - from)) - std::fabs(distance);
        is_near = is_near && std::fabs(off) <= tolerance;
    }
    if (is_near || halvings >= most_halvings) {
        controls.insert(controls.end(), fit.begin() + 1, fit.end());
        return;
    }
    const double middle = (from + to) / 2;
    add_part(curve, from, middle, distance, tolerance, halvings + 1, controls);
    add_part(curve, middle, to, distance, tolerance, halvings + 1, controls);
}

}  // namespace

glm::dvec2 tangent_of(const Bezier& curve, double t) {
    const double scale = std::hypot(curve[3].x - curve[0].x, curve[3].y - curve[0].y) +
                         std::hypot(curve[1].x - curve[0].x, curve[1].y - curve[0].y) + 1e-300;
    glm::dvec2 along = derivative_of(curve, t);
    if (std::hypot(along.x, along.y) < 1e-9 * scale) along = derivative_of(curve, t < 0.5 ? t + 1e-4 : t - 1e-4);
    const double length = std::hypot(along.x, along.y);
    return length > 0 ? along / length : glm::dvec2(1.0, 0.0);
}

double curvature_of(const Bezier& curve, double t) {
    const glm::dvec2 along = derivative_of(curve, t);
    const glm::dvec2 bend = acceleration(curve, t);
    const double speed = std::hypot(along.x, along.y);
    const double scale = std::hypot(curve[3].x - curve[0].x, curve[3].y - curve[0].y);
    if (speed <= 1e-6 * scale) return 0;
    return (along.x * bend.y - along.y * bend.x) / (speed * speed * speed);
}

void add_parallel(const Bezier& curve, double distance, double tolerance, std::vector<glm::dvec2>& controls) {
    add_part(curve, 0, 1, distance, tolerance, 0, controls);
}

}  // namespace sikku
