#include "art/print/clip.h"

namespace sikku {

bool ClipSink::overlaps(const Box& box) const {
    return box.low.x <= box_.high.x && box.high.x >= box_.low.x && box.low.y <= box_.high.y &&
           box.high.y >= box_.low.y;
}

bool ClipSink::sees(std::span<const glm::dvec2> points) const {
    Box box = box_of(points);
    box.add(at_);
    return overlaps(box);
}

void ClipSink::lift(bool closed) {
    if (is_down_) sink_.end_stroke(closed);
    is_down_ = false;
}

void ClipSink::start() {
    if (!is_down_) sink_.begin_stroke(at_, pen_);
    is_down_ = true;
}

void ClipSink::begin_stroke(glm::dvec2 start_at, const Pen& pen) {
    at_ = start_at;
    pen_ = pen;
    is_whole_ = true;
}

void ClipSink::lines(std::span<const glm::dvec2> ends) {
    for (std::size_t i = 0; i < ends.size(); ++i) {
        const auto end = ends.subspan(i, 1);
        if (sees(end)) {
            start();
            sink_.lines(end);
        } else {
            lift(false);
            is_whole_ = false;
        }
        at_ = end.front();
    }
}

void ClipSink::curves(std::span<const glm::dvec2> controls) {
    for (std::size_t i = 0; i + 2 < controls.size(); i += 3) {
        const auto curve = controls.subspan(i, 3);
        if (sees(curve)) {
            start();
            sink_.curves(curve);
        } else {
            lift(false);
            is_whole_ = false;
        }
        at_ = curve.back();
    }
}

void ClipSink::change_pen(const Pen& pen) {
    pen_ = pen;
    if (is_down_) sink_.change_pen(pen);
}

void ClipSink::end_stroke(bool closed) {
    lift(closed && is_whole_);
}

void ClipSink::polygon(std::span<const glm::dvec2> vertices, const Pen& pen) {
    if (overlaps(box_of(vertices))) sink_.polygon(vertices, pen);
}

void ClipSink::area(std::span<const glm::dvec2> outline, const Pen& pen) {
    // A curve lies within the convex hull, and so within the box, of its control points.
    if (overlaps(box_of(outline))) sink_.area(outline, pen);
}

void ClipSink::disc(glm::dvec2 centre, double radius, const Pen& pen) {
    Box box;
    box.add(centre - glm::dvec2(radius));
    box.add(centre + glm::dvec2(radius));
    if (overlaps(box)) sink_.disc(centre, radius, pen);
}

}  // namespace sikku
