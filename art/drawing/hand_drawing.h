// art/drawing/hand_drawing.h: a drawing whose lines and dots are drawn by a hand, with powder.
#pragma once

#include "art/drawing/drawing.h"
#include "art/hand/hand.h"
#include "art/hand/lesson_steps.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace sikku {

/// The lines of a drawing in the order in which a hand draws them, and its dots.
struct HandStrokes {
    std::vector<HandLine> lines;
    std::vector<HandDot> dots;
};

/// Lets the lines and dots of another drawing waver and swell (see draw_by_hand()), by the `hand` of its style.
/// Vector formats get outlines, pictures powder, plotters the middle of the lines. The visible part does not affect
/// the result. Memory: all lines.
class HandDrawing : public Drawing {
public:
    /// @param drawing  in the plane  @param seed  seed of all random choices
    HandDrawing(std::unique_ptr<Drawing> drawing, std::uint64_t seed, const DrawOptions& options);

    const DrawnExtent& seen() override;
    const Style& style() const override { return style_; }
    double scale() const override { return drawing_->scale(); }
    double dot_distance() const override { return drawing_->dot_distance(); }
    Balance balance() const override { return drawing_->balance(); }
    double border_space(const Page& page) const override { return drawing_->border_space(page); }
    double foot_space(const Page& page) const override { return drawing_->foot_space(page); }
    using Drawing::read;
    void read(const Print& print, const Window& window, PathSink& sink) const override;
    using Drawing::rendering;
    std::unique_ptr<Rendering> rendering(const Print& print, const Window& window) const override;
    std::vector<int> hatched_colours() const override { return drawing_->hatched_colours(); }
    void report(DrawReport& report) const override { drawing_->report(report); }

    /// The strokes of a placed print. Fills are passed on. @param steps  if not null, receives the steps of a lesson
    /// @throws BudgetError, for a lesson also over its limits
    HandStrokes strokes(const Print& print, const Window& window, PathSink& fills,
                        std::vector<LessonStep>* steps = nullptr) const;

private:
    void read_middles(const HandStrokes& strokes, PathSink& sink) const;
    void read_outlines(const Print& print, const HandStrokes& strokes, PathSink& sink) const;

    std::unique_ptr<Drawing> drawing_;
    Style drawn_;  ///< style of the other drawing
    Style style_;  ///< with the colour of its lines among those of its fills
    HandOptions hand_;
    std::optional<DrawnExtent> extent_;
};

}  // namespace sikku
