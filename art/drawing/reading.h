// art/drawing/reading.h: options for reading a drawing: limits, progress, and the kind of its print.
#pragma once

#include "art/plotter/shading.h"
#include "engine/base/monitor.h"

#include <cstdint>
#include <functional>
#include <optional>

namespace sikku {

/// Limits and progress of making and reading a drawing.
struct ReadingLimits {
    double budget = 200e6;  ///< maximum number of derivation nodes visited in one pass
    Monitor monitor = {};   ///< polled in long stages that read no words
    /// Called once, before the word is read, with the number of passes. `watch` may have been called before.
    std::function<void(int passes)> begin;
    /// Called with the number of symbols read since the last call, and with 0 for each band of pixels; may throw to
    /// stop.
    std::function<void(std::uint64_t symbols)> watch;
};

/// Options for reading a drawing from the word.
struct Reading : ReadingLimits {
    Reading() = default;
    explicit Reading(const ReadingLimits& limits) : ReadingLimits(limits) {}

    bool is_vector = true;        ///< as lines and shapes; else as pixels
    bool is_in_sheets = false;    ///< sheet by sheet
    bool has_cut_layers = false;  ///< inner edges of a tiling and its border are cut in layers of their own
    std::optional<PlotPen> pen;   ///< a plotter's pen draws it

    bool is_plot() const { return pen.has_value(); }
};

}  // namespace sikku
