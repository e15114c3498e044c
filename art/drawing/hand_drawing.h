// art/drawing/hand_drawing.h: a drawing whose lines and dots are drawn by a hand, with powder.
#pragma once

#include "art/drawing/drawing.h"
#include "art/drawing/hand_flour.h"
#include "art/hand/hand.h"
#include "art/hand/lesson_steps.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace sikku {

/// Makes the lines and dots of another drawing waver and swell (see draw_by_hand()), by the `hand` of its style.
/// Vector formats get outlines, pictures powder, plotters the middle of the lines. The visible part does not affect
/// the result. Memory: all lines.
class HandDrawing : public DerivedDrawing {
public:
    /// @param drawing  in the plane  @param seed  seed of all random choices
    HandDrawing(std::unique_ptr<Drawing> drawing, std::uint64_t seed, const DrawingOptions& options,
                const Reading& reading);

    const DrawnExtent& seen() override;
    using Drawing::read;
    void read(const Print& print, const Window& window, PathSink& sink) const override;
    using Drawing::rendering;
    std::unique_ptr<Rendering> rendering(const Print& print, const Window& window) const override;

    /// The strokes of a placed print. Fills are passed on, in their order. @param steps  if not null, receives the
    /// steps of a lesson
    /// @throws BudgetError, for a lesson also over its limits
    HandStrokes strokes(const Print& print, const Window& window, PathSink& fills,
                        std::vector<LessonStep>* steps = nullptr) const;

private:
    void read_middles(const HandStrokes& strokes, PathSink& sink) const;
    void read_outlines(const Print& print, const HandStrokes& strokes, PathSink& sink) const;

    HandOptions hand_;
    std::optional<DrawnExtent> extent_;
};

}  // namespace sikku
