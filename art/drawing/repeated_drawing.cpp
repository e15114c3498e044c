#include "art/drawing/repeated_drawing.h"

#include "art/drawing/ink_shape.h"
#include "art/print/crop.h"
#include "engine/derivation/derivation.h"
#include "engine/geometry/moved_path.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include <utility>

namespace sikku {

void make_one_copy(const DrawingOptions& options, const Reading& reading,
                   const std::function<void(const Reading& one)>& make) {
    if (!options.repeat) return make(reading);
    // The number of copies that fill a page is known after placement; with a given step, it may reach the maximum.
    const bool has_step = options.placement.step || options.dot_spacing;
    const int copies = options.repeat->fills && has_step ? most_copies : options.repeat->copies();
    Reading one = reading;
    one.budget /= copies;
    try {
        make(one);
    } catch (const BudgetError& error) {
        if (copies == 1) throw;
        throw BudgetError(fmt::format("{}; the {} copies of 'repeat' share the budget of {:.0f} nodes", error.what(),
                                      copies, reading.budget));
    }
}

RepeatedDrawing::RepeatedDrawing(std::unique_ptr<Drawing> inner, const DrawingOptions& options,
                                 const Reading& reading)
    : DerivedDrawing(std::move(inner), options, reading) {
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
    const double ink = print.style.stroke.in_steps ? one.widest : 0.0;
    if (options_.repeat->group != "ring") {
        Repeat packed = *options_.repeat;
        packed.group = "packed";
        covered_ = covered_share(*options_.repeat, hull_, ink);
        constexpr double much = 0.7;
        covered_if_packed_ = covered_ > much ? covered_ : covered_share(packed, hull_, ink);
    }
    if (options_.repeat->fills) {
        measure_cells(ink);
        return;
    }
    copies_ = copies_of(*options_.repeat, hull_, ink);
    drawn_ = copies_.size();
    const glm::dmat3x2 turned = orientation(options_.placement);
    for (const glm::dmat3x2& copy : copies_) {
        for (const glm::dvec2 corner : hull_) extent_.box.add(turned * glm::dvec3(copy * glm::dvec3(corner, 1), 1));
    }
}

/// The extent is that of as many cells as the page is wide, or of a single one if the step is fixed.
void RepeatedDrawing::measure_cells(double ink) {
    filling_ = wallpaper_of(*options_.repeat, hull_, ink);
    const double columns = fixed_step() ? 1 : options_.repeat->columns;
    const glm::dvec2 centre =
        orientation(options_.placement) * glm::dvec3((columns * filling_->across + filling_->up) / 2.0, 1);
    const glm::dvec2 half = glm::dvec2(columns * glm::length(filling_->across), glm::length(filling_->up)) / 2.0;
    extent_.box.add(centre - half);
    extent_.box.add(centre + half);
}

Balance RepeatedDrawing::balance() const {
    if (filling_) return {};
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
    filling_ ? read_filling(print, window, sink) : read_copies(copies_, print, window, sink);
}

void RepeatedDrawing::read_copies(const std::vector<glm::dmat3x2>& copies, const Print& print, const Window& window,
                                  PathSink& sink) const {
    for (const glm::dmat3x2& copy : copies) {
        reading_.monitor.check();
        MovedPath moved(sink, copy);
        inner_->read(print, window, moved);
    }
}

void RepeatedDrawing::read_filling(const Print& print, const Window& window, PathSink& sink) const {
    constexpr double tolerance = 0.005;  // millimetres
    const double step = print.placement.step;
    const double pen = extent_.widest * (print.style.stroke.in_steps ? step : 1.0);
    const bool is_plot = reading_.is_plot();
    // Beyond the trim and the bleed, where the ends of lines are invisible.
    const double around = window.clips ? 0.0 : is_plot ? -window.margin : print.press.bleed + pen;
    const glm::dvec2 low = glm::dvec2(window.left, window.top) - around;
    const glm::dvec2 high = glm::dvec2(window.left + window.width, window.top + window.height) + around;
    Box box;
    for (const glm::dvec2 point : hull_) box.add(point);
    box = {box.low - pen / step, box.high + pen / step};
    const std::vector<glm::dmat3x2> copies = covering_copies(*filling_, box, seen_box(print, window, around));
    drawn_ = copies.size();
    CropSink crop(sink, low, high, print.placement.to_page, tolerance / step);
    read_copies(copies, print, window, crop);
}

void RepeatedDrawing::report(DrawingReport& report) const {
    inner_->report(report);
    report.dots *= drawn_;
    report.copies = drawn_;
    report.strokes = report.strokes.value_or(strokes_) * drawn_;
    report.covered = covered_;
    report.covered_if_packed = covered_if_packed_;
}

}  // namespace sikku
