// art/drawing/word_drawing.h: drawings in the plane and in space that are read from the word.
#pragma once

#include "art/drawing/drawing.h"

#include <memory>
#include <optional>
#include <vector>

namespace sikku {

class Scene;

class WordDrawing : public Drawing {
public:
    /// Resolves contexts and estimates the cost of the drawing. `style` sets visibility and how lines are drawn.
    /// @throws BudgetError, WordError
    WordDrawing(const Grammar& grammar, const Style& style, const DrawingOptions& options, const Reading& reading);

    /// Calculated from the fold if only straight lines are drawn and all are visible, else in one pass over the word.
    const DrawnExtent& seen() override;
    const Style& style() const override { return drawn_style_; }
    double scale() const override;
    /// Takes one pass over the word. In space, the balance of a full box.
    Balance balance() const override;
    std::optional<SpaceBounds> bounds() const override;
    /// Takes one pass over the word. Drawings in space are kept in memory and drawn from back to front.
    using Drawing::read;
    void read(const Print& print, const Window& window, PathSink& sink) const override;
    using Drawing::rendering;
    std::unique_ptr<Rendering> rendering(const Print& print, const Window& window) const override;
    void report(DrawingReport& report) const override;
    /// True if anything is drawn, inside or outside the window.
    bool has_ink();

private:
    DrawnExtent measured();
    void read_straight(PathSink& sink) const;
    bool all_lines_are_seen() const;

    std::shared_ptr<const Grammar> grammar_;
    Style style_;
    Style drawn_style_;  ///< the style, with shades for drawings in space
    bool spline_;
    bool has_brackets_ = false;
    bool has_areas_ = false;
    bool has_edges_ = false;
    bool has_widths_ = false;
    bool has_labels_ = false;
    bool has_colours_ = false;
    std::vector<bool> closed_;  ///< true for each closed stroke of a spline, in their order
    std::optional<DrawnExtent> extent_;
    bool has_ink_ = false;
    bool is_outside_ = false;             ///< nothing is drawn within the window
    std::shared_ptr<const Scene> scene_;  ///< scene of a drawing in space, once it was read
};

/// Reads a drawing in space. Each part kept takes the memory and time of about `nodes_of_part` nodes.
/// @throws BudgetError before reading if it does not fit the budget
Scene read_scene(const Grammar& grammar, const Style& style, const ReadingLimits& limits, double nodes_of_part);

/// The grammar without contexts, ready to be read. @throws BudgetError, WordError
Grammar resolved(const Grammar& given, const ReadingLimits& limits);

}  // namespace sikku
