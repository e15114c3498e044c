// art/deep/seen_drawing.h: drawings through a view, whose cost depends only on the visible parts.
#pragma once

#include "art/deep/view.h"
#include "art/drawing/drawing.h"
#include "art/drawing/drawing_cost.h"
#include "engine/measure/parts.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

namespace sikku {

/// Pictures of longer words are drawn through a view if the grammar has one.
constexpr double most_read_symbols = 4e6;

/// Composes the parts of a grammar with resolved contexts that is to be drawn through a view: lines in one pen,
/// straight or splines, for a window, or for a picture of a word over `most_read_symbols`. Returns nullopt if the
/// word must be read; `why` then receives the reason if there is a window.
std::optional<Parts<double>> seen_parts(const Grammar& grammar, const Style& style, const DrawingOptions& options,
                                        const Reading& reading, std::string& why);

/// False if seen_parts() returns nullopt regardless of the grammar's parts.
bool may_be_seen(const Grammar& grammar, const Style& style, const DrawingOptions& options, const Reading& reading);

/// Forecasts the cost of a drawing through a view and one print. @param parts  seen_parts() of the grammar
DrawingCost seen_cost(const Grammar& grammar, const Parts<double>& parts, const Print& print,
                      const DrawingOptions& options, const Reading& reading);

/// Checks that the window of the options can be shown by reading the whole word.
/// @throws std::runtime_error with the reason, for drawings in space and for words over the budget
void require_window(const Grammar& grammar, const ReadingLimits& limits, const std::string& why);

/// Draws the visible parts. With a pen narrower than a pixel, parts up to half a pixel become blots of their ink;
/// with a wider one, parts up to a quarter of its width (an eighth below two pixels) become chords. Vector prints
/// have chords only.
class SeenDrawing : public Drawing {
public:
    /// @param parts  seen_parts() of the same grammar @throws std::runtime_error if nothing is drawn
    SeenDrawing(std::shared_ptr<const Grammar> grammar, Parts<double> parts, const Style& style,
                const DrawingOptions& options, const Reading& reading);

    /// Extent of the window, or of the whole drawing.
    const DrawnExtent& seen() override { return extent_; }
    const Style& style() const override { return style_; }
    double scale() const override { return options_.placement.scale * (grammar_->scale_percent() / 100); }
    using Drawing::read;
    void read(const Print& print, const Window& window, PathSink& sink) const override;
    /// Renders in strips, each from its own walk, which skips parts outside; single bands share one walk.
    using Drawing::rendering;
    std::unique_ptr<Rendering> rendering(const Print& print, const Window& window) const override;
    void report(DrawingReport& report) const override;

    /// Draws the parts visible in a window of the page. Several threads may call it at once.
    /// @param pixel  size in millimetres; 0 for vector prints
    void read(const Print& print, const Window& window, double pixel, BlotSink& sink, double budget,
              const std::function<void(std::uint64_t)>& watch) const;
    const Reading& reading() const { return reading_; }
    /// Estimates the nodes that a walk visits, by a walk at a coarser level. Exact up to a million nodes.
    double expected_nodes(const Print& print, const Window& window, double pixel) const;

private:
    /// The level of detail of a window; the lines of a spline are examined at its steps if `reads_steps`.
    Sight sight_of(const Print& print, const Window& window, double pixel) const;
    bool reads_steps(const Sight& sight) const;
    /// Refuses a walk that would exceed the budget after seconds of work. @throws BudgetError
    void require_affordable(const Print& print, const Window& window, double pixel, double budget) const;
    void add(const ViewReport& report) const;

    std::shared_ptr<const Grammar> grammar_;
    Style style_;
    DrawnExtent extent_;
    bool spline_;
    double spline_share_ = 1;
    double longest_step_;
    std::unique_ptr<View> view_;
    mutable std::mutex reporting_;
    mutable ViewReport found_;
};

}  // namespace sikku
