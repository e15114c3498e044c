// art/drawing/draw_view.h: prints through a view, so that their cost is what is seen.
#pragma once

#include "art/drawing/draw.h"
#include "engine/measure/parts.h"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>

namespace sikku {

/// A picture of a larger word is seen through a view where it has one.
constexpr double most_read_symbols = 4e6;

/// The parts of what is drawn through a view, of a grammar whose contexts are resolved: of lines in one pen, straight
/// or splines, for a window, and for pictures of words of more than `most_read_symbols`. Nullopt: the word is read.
/// @throws std::runtime_error for a window on a drawing that has no view
std::optional<Parts<double>> seen_parts(const Grammar& grammar, const Style& style, const DrawOptions& options);

/// What a drawing costs, roughly.
struct DrawingCost {
    double nodes = 0;          ///< of the derivation that are visited in a pass
    double lines = 0;          ///< and what is drawn of them
    double memory = 0;         ///< bytes, on one thread
    double thread_memory = 0;  ///< more for each further thread
    double lines_memory = 0;   ///< bytes of `memory` kept by a Raster when it has read the whole drawing
};
/// @param parts  seen_parts(), or null: the word is read
DrawingCost drawing_cost(const Grammar& grammar, const Parts<double>* parts, const Print& print,
                         const DrawOptions& options);

/// A drawing that is placed and then seen, any number of times. Under a pen of less than a pixel, parts up to half a
/// pixel become blots of their ink; under a wider one, parts up to a quarter of its width (an eighth under two
/// pixels) become chords; in vector prints chords alone.
class SeenDrawing {
public:
    /// `grammar` must outlive it; `parts` are seen_parts() of the same. @throws std::runtime_error if nothing is
    /// drawn
    SeenDrawing(const Grammar& grammar, Parts<double> parts, const Style& style, const DrawOptions& options);

    /// Of the window, or of all.
    const DrawnExtent& extent() const { return extent_; }
    DrawReport place(Print& print) const;
    /// What is seen on the page of `print`, which is placed, or on a part of it as a page of its own. Several threads
    /// may read at once. @param pixel  millimetres; 0: there are none
    ViewReport read(const Print& print, double pixel, BlotSink& sink, double budget,
                    const std::function<void(std::uint64_t)>& watch) const;
    ViewReport draw_lines(const Print& print, PathSink& writer) const;

    /// Of the window, or of a whole that lies in its box.
    static DrawnExtent extent_of(const DrawnPart<double>& whole, const Style& style, const DrawOptions& options);

private:
    const Grammar& grammar_;
    DrawOptions options_;
    DrawnExtent extent_;
    bool spline_;
    double spline_share_ = 1;
    double longest_step_;
    std::unique_ptr<View> view_;
};

/// As draw(), of what has seen_parts(); else nullopt, and nothing is written. Pictures are made in strips, each from
/// a walk of its own that passes over what lies outside.
std::optional<DrawReport> draw_view(const Grammar& grammar, Print print, const DrawOptions& options,
                                    const std::filesystem::path& file, Destination& destination);

}  // namespace sikku
