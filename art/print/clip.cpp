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

/// Draws lines or curves of `stride` points each.
void ClipSink::draw(std::span<const glm::dvec2> points, std::size_t stride,
                    void (PathSink::*pass)(std::span<const glm::dvec2>)) {
    for (std::size_t i = 0; i + stride <= points.size(); i += stride) {
        const auto piece = points.subspan(i, stride);
        if (sees(piece)) {
            lower(at_);
            (sink_.*pass)(piece);
        } else {
            lift(false);
            is_whole_ = false;
        }
        at_ = piece.back();
    }
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
