#include "art/drawing/ink_shape.h"

#include "engine/geometry/bezier.h"
#include "engine/geometry/cross.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace sikku {
namespace {}  // namespace

std::vector<glm::dvec2> convex_hull(std::vector<glm::dvec2> points) {
    const auto is_before = [](glm::dvec2 a, glm::dvec2 b) { return a.x != b.x ? a.x < b.x : a.y < b.y; };
    std::sort(points.begin(), points.end(), is_before);
    points.erase(std::unique(points.begin(), points.end()), points.end());
    if (points.size() < 3) return points;
    std::vector<glm::dvec2> hull;
    for (int side = 0; side < 2; ++side) {
        const std::size_t first = hull.size();
        for (const glm::dvec2 point : points) {
            while (hull.size() >= first + 2 && cross(hull.back() - hull[hull.size() - 2], point - hull.back()) <= 0) {
                hull.pop_back();
            }
            hull.push_back(point);
        }
        hull.pop_back();
        std::reverse(points.begin(), points.end());
    }
    return hull;
}

double polygon_area(const std::vector<glm::dvec2>& corners) {
    double area = 0;
    for (std::size_t i = 0; i < corners.size(); ++i) area += cross(corners[i], corners[(i + 1) % corners.size()]);
    return area / 2;
}

void InkShape::add(glm::dvec2 point) {
    points_.push_back(point);
    if (points_.size() < next_prune_) return;
    points_ = convex_hull(std::move(points_));
    next_prune_ = 2 * points_.size() + 4096;
}

void InkShape::draw_to(glm::dvec2 end) {
    add(end);
    const double length = glm::length(end - at_);
    length_ += length;
    length_moment_ += length * 0.5 * (at_ + end);
    at_ = end;
}

void InkShape::begin_stroke(glm::dvec2 start, const Pen& pen) {
    is_drawn_ = false;
    at_ = start;
    change_pen(pen);
}

void InkShape::change_pen(const Pen& pen) {
    const bool was_drawn = std::exchange(is_drawn_, style_.draws(pen));
    if (is_drawn_ && !was_drawn) {
        ++strokes_;
        add(at_);
    }
}

void InkShape::lines(std::span<const glm::dvec2> ends) {
    if (!is_drawn_ && !ends.empty()) at_ = ends.back();
    if (!is_drawn_) return;
    for (const glm::dvec2 end : ends) draw_to(end);
}

void InkShape::curves(std::span<const glm::dvec2> controls) {
    if (!is_drawn_ && !controls.empty()) at_ = controls.back();
    if (!is_drawn_) return;
    for (std::size_t i = 0; i + 2 < controls.size(); i += 3) {
        flatten(glm::dvec2(at_), controls[i], controls[i + 1], controls[i + 2], 0.001,
                [&](glm::dvec2 end) { draw_to(end); });
    }
}

void InkShape::polygon(std::span<const glm::dvec2> vertices, const Pen& pen) {
    if (style_.fill_colour(pen).alpha == 0) return;
    for (const glm::dvec2 vertex : vertices) add(vertex);
    double area = 0;
    glm::dvec2 moment(0.0);
    for (std::size_t i = 0; i < vertices.size(); ++i) {
        const glm::dvec2 one = vertices[i], two = vertices[(i + 1) % vertices.size()];
        area += cross(one, two) / 2;
        moment += cross(one, two) / 6 * (one + two);
    }
    area_ += std::fabs(area);
    area_moment_ += area < 0 ? -moment : moment;
}

void InkShape::disc(glm::dvec2 centre, double radius, const Pen& pen) {
    if (style_.fill_colour(pen).alpha == 0) return;
    constexpr int corners = 32;
    for (int i = 0; i < corners; ++i) {
        const double angle = 2 * std::numbers::pi * i / corners;
        add(centre + radius * glm::dvec2(std::cos(angle), std::sin(angle)));
    }
    const double area = std::numbers::pi * radius * radius;
    area_ += area;
    area_moment_ += area * centre;
}

const std::vector<glm::dvec2>& InkShape::hull() {
    points_ = convex_hull(std::move(points_));
    next_prune_ = 2 * points_.size() + 4096;
    return points_;
}

glm::dvec2 InkShape::centre() {
    if (length_ > 0) return length_moment_ / length_;
    if (area_ > 0) return area_moment_ / area_;
    glm::dvec2 sum(0.0);
    for (const glm::dvec2 point : hull()) sum += point;
    return points_.empty() ? sum : sum / static_cast<double>(points_.size());
}

}  // namespace sikku
