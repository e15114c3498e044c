#include "art/drawing/extent_sink.h"

#include <glm/vec3.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace sikku {

void ExtentSink::begin_stroke(glm::dvec2 start, const Pen& pen) {
    change_pen(pen);
    at_ = turned(start);
}

void ExtentSink::lines(std::span<const glm::dvec2> ends) {
    if (ends.empty()) return;
    if (draws_) {
        begin_line();
        for (const glm::dvec2 end : ends) box.add(turned(end));
    }
    at_ = turned(ends.back());
}

void ExtentSink::curves(std::span<const glm::dvec2> controls) {
    if (controls.size() < 3) return;
    if (!draws_) {
        at_ = turned(controls.back());
        return;
    }
    begin_line();
    add_curves(controls);
}

void ExtentSink::change_pen(const Pen& pen) {
    draws_ = style_.draws(pen);
    width_ = style_.pen_width(pen);
}

void ExtentSink::polygon(std::span<const glm::dvec2> vertices, const Pen& pen) {
    if (style_.fill_colour(pen).alpha == 0) return;
    for (const glm::dvec2 vertex : vertices) box.add(turned(vertex));
}

void ExtentSink::area(std::span<const glm::dvec2> outline, const Pen& pen) {
    if (style_.fill_colour(pen).alpha == 0 || outline.empty()) return;
    const glm::dvec2 at = std::exchange(at_, turned(outline.front()));
    box.add(at_);
    add_curves(outline.subspan(1));
    at_ = at;
}

void ExtentSink::disc(glm::dvec2 centre, double radius, const Pen& pen) {
    if (style_.fill_colour(pen).alpha == 0) return;
    // A dot is twice as wide as the line.
    const double dot = radius > 0.0 ? 0.0 : 2 * style_.pen_width(pen);
    if (!(radius + dot > 0.0)) return;
    widest = std::max(widest, dot);
    const glm::dvec2 at = turned(centre);
    box.add(at - glm::dvec2(radius));
    box.add(at + glm::dvec2(radius));
}

glm::dvec2 ExtentSink::turned(glm::dvec2 point) const {
    return orientation_ * glm::dvec3(point, 1.0);
}

/// The pen may have been changed before anything was drawn with it, so only lines count.
void ExtentSink::begin_line() {
    box.add(at_);
    widest = std::max(widest, width_);
}

/// Adds the curves that start at at_.
void ExtentSink::add_curves(std::span<const glm::dvec2> controls) {
    for (std::size_t i = 0; i + 2 < controls.size(); i += 3) {
        const std::array<glm::dvec2, 4> b = {at_, turned(controls[i]), turned(controls[i + 1]),
                                             turned(controls[i + 2])};
        box.add(b[3]);
        for (int axis = 0; axis < 2; ++axis) {
            const auto inside = [&](double value) { return value >= box.low[axis] && value <= box.high[axis]; };
            if (!inside(b[1][axis]) || !inside(b[2][axis])) add_extremes(b, axis);
        }
        at_ = b[3];
    }
}

/// Adds the points where the curve's derivative along `axis` vanishes.
void ExtentSink::add_extremes(const std::array<glm::dvec2, 4>& b, int axis) {
    const double p = b[1][axis] - b[0][axis];
    const double q = b[2][axis] - b[1][axis];
    const double r = b[3][axis] - b[2][axis];
    const double square = p - 2 * q + r;
    const double half = q - p;
    const double root = std::sqrt(std::max(0.0, half * half - square * p));
    for (const double t :
         {square == 0 ? -p / (2 * half) : (-half + root) / square, square == 0 ? -1.0 : (-half - root) / square}) {
        if (!(t > 0 && t < 1)) continue;
        const double s = 1 - t;
        box.add(s * s * s * b[0] + 3 * s * s * t * b[1] + 3 * s * t * t * b[2] + t * t * t * b[3]);
    }
}

DrawnExtent window_extent(const ViewWindow& window, const glm::dmat3x2& orientation) {
    DrawnExtent extent;
    for (const Quad& x : {window.x0, window.x1}) {
        for (const Quad& y : {window.y0, window.y1}) {
            extent.box.add(orientation * glm::dvec3(static_cast<double>(x), static_cast<double>(y), 1.0));
        }
    }
    return extent;
}

DrawnExtent placed_extent(const DrawnExtent& whole, const DrawingOptions& options, bool& is_outside) {
    if (!options.window) return whole;
    const DrawnExtent window = window_extent(*options.window, orientation(options.placement));
    const auto is_apart = [&](int axis) {
        return whole.box.low[axis] > window.box.high[axis] || whole.box.high[axis] < window.box.low[axis];
    };
    is_outside = is_apart(0) || is_apart(1);
    return {window.box, window.widest, whole.widest};
}

}  // namespace sikku
