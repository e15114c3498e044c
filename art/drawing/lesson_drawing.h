// art/drawing/lesson_drawing.h: one step of a drawing lesson.
#pragma once

#include "art/drawing/hand_drawing.h"
#include "art/hand/lesson_steps.h"

#include <cstddef>
#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

namespace sikku {

/// The strokes of a lesson and their steps.
struct LessonPlan {
    HandStrokes strokes;
    std::vector<LessonStep> steps;
    double pitch = 1;  ///< distance between neighbouring dots, or size of the drawing's loops, in steps
};

/// Keeps the plan of a lesson for the drawings of its steps, which may be made in several threads.
class LessonMemo {
public:
    /// Returns the last plan if it is for lines of that width; otherwise a new one. @param step, width  millimetres
    template <class Make>
    std::shared_ptr<const LessonPlan> plan(double step, double width, Make&& make) {
        const std::lock_guard lock(mutex_);
        if (!plan_ || step != step_ || width != width_) {
            plan_ = std::make_shared<const LessonPlan>(make());
            step_ = step;
            width_ = width;
        }
        return plan_;
    }

private:
    std::mutex mutex_;
    std::shared_ptr<const LessonPlan> plan_;
    double step_ = 0, width_ = 0;
};

/// A lesson shows how a drawing is made: the dots alone, then stretch after stretch in the order and direction of a
/// hand (order_by_hand(), lesson_steps()), then the whole drawing. The stretch of a step is drawn as a line with its
/// number, a mark where it starts and arrow heads; those before it are pale. Fields and other areas come last, with
/// the whole. Numbers are upright on the page, however the drawing is rotated or mirrored.
/// With DrawingOptions::traced, it shows the strokes of the first steps instead, all of them pale, to be traced.
class LessonDrawing : public DerivedDrawing {
public:
    LessonDrawing(std::unique_ptr<HandDrawing> drawing, const DrawingOptions& options, const Reading& reading);

    Balance balance() const override { return {}; }
    TextSpace text_space(const Page&) const override { return {}; }
    std::vector<int> hatched_colours() const override { return {}; }
    using Drawing::read;
    void read(const Print& print, const Window& window, PathSink& sink) const override;
    using Drawing::rendering;
    std::unique_ptr<Rendering> rendering(const Print& print, const Window& window) const override;

    /// Number of steps: the dots, the stretches, and the whole. Call after place().
    std::size_t count(const Print& print) const;
    /// Where the strokes begin, in turtle steps. Call after place().
    std::vector<glm::dvec2> starts(const Print& print) const;
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
    std::shared_ptr<const LessonPlan> plan(const Print& print, const Window& window) const;
    void draw_stretch(const HandLine& line, int colour, PathSink& sink) const;
    void draw_traced(const Print& print, const LessonPlan& plan, PathSink& sink) const;
    double mark_of(const HandNode& start, const Print& print, const LessonPlan& plan) const;
    void draw_mark(const HandNode& start, double radius, PathSink& sink) const;
    void draw_signs(const Print& print, const Window& window, const LessonPlan& plan, PathSink& sink) const;
    void draw_heads(const Print& print, const HandLine& line, double arm, PathSink& sink) const;
    void write(const std::string& text, glm::dvec2 start, double height, const Print& print, PathSink& sink) const;
    void write_number(const std::string& text, const HandLine& line, double mark, const Print& print,
                      const Window& window, const LessonPlan& plan, PathSink& sink) const;

    const HandDrawing& by_hand() const { return static_cast<const HandDrawing&>(*inner_); }

    std::shared_ptr<LessonMemo> memo_;
    int pale_begin_, new_begin_, halo_, sign_;  ///< first indices of colours
    std::size_t step_ = 0;
    double share_ = 1.0;
    bool numbers_pages_ = false;
};

}  // namespace sikku
