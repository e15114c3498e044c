// art/drawing/lesson_drawing.h: one step of a drawing lesson.
#pragma once

#include "art/drawing/hand_drawing.h"
#include "art/hand/lesson_steps.h"

#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

namespace sikku {

/// A lesson shows how a drawing is made: the dots alone, then stretch after stretch in the order and direction of a
/// hand (order_by_hand(), lesson_steps()), then the whole drawing. The stretch of a step is drawn as a line with its
/// number, a mark where it starts and arrow heads; those before it are pale. Numbers are upright on the page, however
/// the drawing is rotated or mirrored.
class LessonDrawing : public Drawing {
public:
    LessonDrawing(std::unique_ptr<HandDrawing> drawing, const DrawOptions& options);

    const DrawnExtent& seen() override { return drawing_->seen(); }
    const Style& style() const override { return style_; }
    double scale() const override { return drawing_->scale(); }
    double border_space(const Page& page) const override { return drawing_->border_space(page); }
    using Drawing::read;
    void read(const Print& print, const Window& window, PathSink& sink) const override;
    using Drawing::rendering;
    std::unique_ptr<Rendering> rendering(const Print& print, const Window& window) const override;
    void report(DrawReport& report) const override { drawing_->report(report); }

    /// Number of steps: the dots, the stretches, and the whole. Call after place().
    std::size_t count(const Print& print) const;
    /// Selects the step that read() and rendering() show, from 0, and the share of its stretch that is drawn.
    void show(std::size_t step, double share = 1.0) {
        step_ = step;
        share_ = share;
    }
    /// Writes `3 / 12` in the corner of the page.
    void number_pages() { numbers_pages_ = true; }
    /// First and last index of the colours in which the stretch of a step is drawn.
    std::pair<int, int> new_colours() const { return {new_begin_, halo_ - 1}; }

private:
    struct Lesson;
    Lesson lesson(const Print& print, const Window& window, PathSink& fills) const;
    void draw_stretch(const HandLine& line, int colour, PathSink& sink) const;
    void draw_signs(const Print& print, const Window& window, const Lesson& lesson, PathSink& sink) const;

    std::unique_ptr<HandDrawing> drawing_;
    Style drawn_;
    Style style_;  ///< with pale colours, the colours of new stretches, and those of numbers
    int pale_begin_, new_begin_, halo_, sign_;
    std::size_t step_ = 0;
    double share_ = 1.0;
    bool numbers_pages_ = false;
};

}  // namespace sikku
