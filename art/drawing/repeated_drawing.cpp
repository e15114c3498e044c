#include "art/drawing/repeated_drawing.h"

#include "art/drawing/ink_shape.h"
#include "engine/geometry/moved_path.h"

#include <utility>

namespace sikku {

RepeatedDrawing::RepeatedDrawing(std::unique_ptr<Drawing> inner, const DrawOptions& options)
    : Drawing(options), inner_(std::move(inner)) {
    options_.placement.step = inner_->fixed_step();
    const DrawnExtent& one = options_.may_be_empty ? inner_->seen() : inner_->extent();
    extent_.widest = one.widest;
    extent_.around = one.around;
    if (one.box.empty()) return;
    Print print;
    print.style = inner_->style();
    InkShape shape(print.style);
    inner_->read(print, shape);
    hull_ = shape.hull();
    centre_ = shape.centre();
    strokes_ = shape.strokes();
    copies_ = copies_of(*options_.repeat, hull_, print.style.stroke.in_steps ? one.widest : 0.0);
    const glm::dmat3x2 turned = orientation(options_.placement);
    for (const glm::dmat3x2& copy : copies_) {
        for (const glm::dvec2 corner : hull_) extent_.box.add(turned * glm::dvec3(copy * glm::dvec3(corner, 1), 1));
    }
}

Balance RepeatedDrawing::balance() const {
    std::vector<glm::dvec2> corners;
    glm::dvec2 sum(0.0);
    for (const glm::dmat3x2& copy : copies_) {
        for (const glm::dvec2 corner : hull_) corners.push_back(copy * glm::dvec3(corner, 1));
        sum += copy * glm::dvec3(centre_, 1);
    }
    if (copies_.empty()) return {};
    return balance_of(corners, sum / static_cast<double>(copies_.size()));
}

void RepeatedDrawing::read(const Print& print, const Window& window, PathSink& sink) const {
    for (const glm::dmat3x2& copy : copies_) {
        options_.monitor.check();
        MovedPath moved(sink, copy);
        inner_->read(print, window, moved);
    }
}

void RepeatedDrawing::report(DrawReport& report) const {
    inner_->report(report);
    report.dots *= copies_.size();
    report.copies = copies_.size();
    report.strokes = strokes_ * copies_.size();
}

}  // namespace sikku
