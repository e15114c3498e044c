#include "art/print/crop.h"

#include <glm/geometric.hpp>
#include <glm/mat2x2.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace sikku {
namespace {

double beyond(const HalfPlane& side, glm::dvec2 point) {
    return glm::dot(side.normal, point) - side.offset;
}

/// Parameters between 0 and 1 at which a Bézier in one dimension has no slope.
std::vector<double> turning_points(const std::array<double, 4>& b) {
    const double p = b[1] - b[0], q = b[2] - b[1], r = b[3] - b[2];
    const double square = p - 2 * q + r, half = q - p;
    const double root = std::sqrt(std::max(0.0, half * half - square * p));
    std::vector<double> found;
    for (const double t :
         {square == 0 ? -p / (2 * half) : (-half + root) / square, square == 0 ? -1.0 : (-half - root) / square}) {
        if (t > 0 && t < 1) found.push_back(t);
    }
    std::sort(found.begin(), found.end());
    return found;
}

/// Adds the parameters at which a curve crosses an edge.
void add_crossings(const Bezier& curve, const HalfPlane& side, std::vector<double>& crossings) {
    std::array<double, 4> b{};
    std::transform(curve.begin(), curve.end(), b.begin(), [&](glm::dvec2 point) { return beyond(side, point); });
    const auto value = [&](double t) {
        const double s = 1 - t;
        return s * s * s * b[0] + 3 * s * s * t * b[1] + 3 * s * t * t * b[2] + t * t * t * b[3];
    };
    std::vector<double> ends = turning_points(b);
    ends.push_back(1);
    double from = 0;
    for (const double end : ends) {
        double low = from, high = end;
        from = end;
        const bool begins_inside = value(low) <= 0;
        if (begins_inside == (value(high) <= 0)) continue;
        for (int i = 0; i < 60; ++i) {
            const double middle = (low + high) / 2;
            ((value(middle) <= 0) == begins_inside ? low : high) = middle;
        }
        crossings.push_back(begins_inside ? low : high);
    }
}

}  // namespace

CropSink::CropSink(PathSink& sink, glm::dvec2 low, glm::dvec2 high, const glm::dmat3x2& to_page, double tolerance)
    : CutStrokes(sink), tolerance_(tolerance) {
    const glm::dmat2x2 linear(to_page[0], to_page[1]);
    const auto side = [&](glm::dvec2 normal, double offset) {
        return HalfPlane{glm::transpose(linear) * normal, offset - glm::dot(normal, to_page[2])};
    };
    sides_ = {side({1, 0}, high.x), side({-1, 0}, -low.x), side({0, 1}, high.y), side({0, -1}, -low.y)};
}

bool CropSink::contains(std::span<const glm::dvec2> points) const {
    return std::all_of(sides_.begin(), sides_.end(), [&](const HalfPlane& side) {
        return std::all_of(points.begin(), points.end(), [&](glm::dvec2 point) { return beyond(side, point) <= 0; });
    });
}

bool CropSink::misses(std::span<const glm::dvec2> points) const {
    return std::any_of(sides_.begin(), sides_.end(), [&](const HalfPlane& side) {
        return std::all_of(points.begin(), points.end(), [&](glm::dvec2 point) { return beyond(side, point) > 0; });
    });
}

/// Draws the parts of a piece that lie inside. @param is_line  ignore its control points
void CropSink::draw(const Bezier& piece, bool is_line) {
    const auto put = [&](const Bezier& part) {
        lower(part[0]);
        is_line ? sink_.lines(std::span(part).subspan(3)) : sink_.curves(std::span(part).subspan(1));
    };
    if (contains(piece)) return put(piece);
    is_whole_ = false;
    if (misses(piece)) return lift(false);
    std::vector<double> ends;
    for (const HalfPlane& side : sides_) add_crossings(piece, side, ends);
    std::sort(ends.begin(), ends.end());
    ends.push_back(1);
    double from = 0;
    for (const double end : ends) {
        const double begin = std::exchange(from, end);
        if (!(end - begin > 1e-12)) continue;
        const glm::dvec2 middle = point_of(piece, (begin + end) / 2);
        if (!contains({&middle, 1})) {
            lift(false);
            continue;
        }
        put(part_of(piece, begin, end));
        if (end < 1) lift(false);
    }
}

void CropSink::lines(std::span<const glm::dvec2> ends) {
    for (const glm::dvec2 end : ends) draw(straight_curve(std::exchange(at_, end), end), true);
}

void CropSink::curves(std::span<const glm::dvec2> controls) {
    for (std::size_t i = 0; i + 2 < controls.size(); i += 3) {
        draw({at_, controls[i], controls[i + 1], controls[i + 2]}, false);
        at_ = controls[i + 2];
    }
}

/// Source: Sutherland & Hodgman, Reentrant polygon clipping, 1974.
void CropSink::fill(std::vector<glm::dvec2> corners, const Pen& pen) {
    for (const HalfPlane& side : sides_) {
        std::vector<glm::dvec2> kept;
        for (std::size_t i = 0; i < corners.size(); ++i) {
            const glm::dvec2 one = corners[i], two = corners[(i + 1) % corners.size()];
            const double a = beyond(side, one), b = beyond(side, two);
            if (a <= 0) kept.push_back(one);
            if ((a <= 0) != (b <= 0)) kept.push_back(one + (two - one) * (a / (a - b)));
        }
        corners = std::move(kept);
    }
    if (corners.size() > 2) sink_.polygon(corners, pen);
}

void CropSink::polygon(std::span<const glm::dvec2> vertices, const Pen& pen) {
    if (contains(vertices)) return sink_.polygon(vertices, pen);
    if (!misses(vertices)) fill({vertices.begin(), vertices.end()}, pen);
}

void CropSink::area(std::span<const glm::dvec2> outline, const Pen& pen) {
    if (outline.empty() || misses(outline)) return;
    if (contains(outline)) return sink_.area(outline, pen);
    std::vector<glm::dvec2> corners = {outline.front()};
    for (std::size_t i = 0; i + 3 < outline.size(); i += 3) {
        flatten(outline[i], outline[i + 1], outline[i + 2], outline[i + 3], tolerance_,
                [&](glm::dvec2 end) { corners.push_back(end); });
    }
    fill(std::move(corners), pen);
}

void CropSink::disc(glm::dvec2 centre, double radius, const Pen& pen) {
    const std::array<glm::dvec2, 4> box = {centre + glm::dvec2(-radius, -radius),
                                           centre + glm::dvec2(radius, -radius), centre + glm::dvec2(radius, radius),
                                           centre + glm::dvec2(-radius, radius)};
    if (misses(box)) return;
    // A radius of 0 is a dot, sized by the pen.
    if (contains(box)) return sink_.disc(centre, radius, pen);
    if (!(radius > 0)) return;
    const double turn = std::acos(std::max(0.9, 1 - tolerance_ / radius));
    const int count = std::min(10'000, static_cast<int>(std::ceil(std::numbers::pi / turn)));
    std::vector<glm::dvec2> corners;
    for (int i = 0; i < count; ++i) {
        const double angle = 2 * std::numbers::pi * i / count;
        corners.push_back(centre + radius * glm::dvec2(std::cos(angle), std::sin(angle)));
    }
    fill(std::move(corners), pen);
}

}  // namespace sikku
