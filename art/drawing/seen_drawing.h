// art/drawing/seen_drawing.h: drawings through a view, so that their cost is what is seen.
#pragma once

#include "art/drawing/drawing.h"
#include "engine/measure/parts.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

namespace sikku {

/// A picture of a larger word is seen through a view where it has one.
constexpr double most_read_symbols = 4e6;

/// The parts of what is drawn through a view, of a grammar whose contexts are resolved: of lines in one pen, straight
/// or splines, for a window, and for pictures of words of more than `most_read_symbols`. Nullopt: the word is read;
/// `why` is set to the reason if there is a window.
std::optional<Parts<double>> seen_parts(const Grammar& grammar, const Style& style, const DrawOptions& options,
                                        std::string& why);

/// Checks that the window of the options can be shown by reading the whole word.
/// @throws std::runtime_error, which says why there is no view, for drawings in space and for words over the budget
void require_window(const Grammar& grammar, const DrawOptions& options, const std::string& why);

/// Under a pen of less than a pixel, parts up to half a pixel become blots of their ink; under a wider one, parts up
/// to a quarter of its width (an eighth under two pixels) become chords; in vector prints chords alone.
class SeenDrawing : public Drawing {
public:
    /// `parts` are seen_parts() of the same grammar. @throws std::runtime_error if nothing is drawn
    SeenDrawing(std::shared_ptr<const Grammar> grammar, Parts<double> parts, const Style& style,
                const DrawOptions& options);

    /// Of the window, or of all.
    const DrawnExtent& seen() override { return extent_; }
    const Style& style() const override { return style_; }
    double scale() const override { return options_.placement.scale * (grammar_->scale_percent() / 100); }
    using Drawing::read;
    void read(const Print& print, const Window& window, PathSink& sink) const override;
    /// Rendered in strips, each from a walk of its own that passes over what lies outside; single bands from one
    /// walk.
    using Drawing::rendering;
    std::unique_ptr<Rendering> rendering(const Print& print, const Window& window) const override;
    void report(DrawReport& report) const override;

    /// What is seen in a window of the page. Several threads may read at once.
    /// @param pixel  millimetres; 0: there are none
    void read(const Print& print, const Window& window, double pixel, BlotSink& sink, double budget,
              const std::function<void(std::uint64_t)>& watch) const;
    const DrawOptions& options() const { return options_; }

private:
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
