// art/plotter/plot_options.h: options of a plot, and the report about the result.
#pragma once

#include "art/plotter/pen_rules.h"
#include "art/plotter/shading.h"
#include "art/style/colour.h"
#include "engine/base/monitor.h"

#include <glm/vec2.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace sikku {

/// Speeds of a plotter. Acceleration is ignored: real plotters are slower on short strokes.
struct PlotSpeeds {
    double drawing = 40.0;     ///< mm/s, pen down
    double travelling = 80.0;  ///< mm/s, pen up
    double lift = 0.3;         ///< seconds for lifting the pen and lowering it again
};

struct PlotOptions : PlotPen {
    /// Maximum length of a stroke in millimetres: a longer one is cut into several, each beginning where the last one
    /// ended. Cuts lie between lines and curves, so that a longer one stays whole. 0: strokes are not cut.
    double split = 0.0;
    std::vector<int> hatched{};  ///< palette indices whose lines are hatching, which is drawn before other lines
    bool draws_circles = false;  ///< discs are circles of their own size, not spirals, unless the pen has a width
    int pens = 0;                ///< maximum number of pens, to which colours are merged; 0: one for each colour
    glm::dvec2 start{0.0};  ///< position of the pen, in millimetres from the bottom left corner of the page, y up
    std::optional<glm::dvec2> home = {};  ///< position of the pen after the last stroke, in the same coordinates
    PlotSpeeds speeds = {};               ///< by which arrangements are compared
    std::vector<PenRule> rules = {};      ///< settings of single pens
    std::optional<Refill> refill = {};    ///< refill of pens without their own
    std::optional<glm::dvec2> park = {};  ///< place of the pen while it is changed, in the same coordinates
    double resume = 0.0;                  ///< millimetres drawn before the plot was interrupted; it begins there
    Monitor monitor = {};                 ///< polled while the plot is arranged and drawn
};

/// Lengths and counts of a plot. Pen-up travel begins at PlotOptions::start and ends at the last stroke or at home.
struct PlotTally {
    double drawn = 0.0;       ///< mm, pen down
    double travelled = 0.0;   ///< mm, pen up
    std::uint64_t lifts = 0;  ///< number of times the pen is lowered
    bool operator==(const PlotTally&) const = default;
};

/// @throws std::runtime_error unless both speeds are between 0.001 and 10^6 mm/s, and the lift is at most an hour
double plot_seconds(const PlotTally& tally, const PlotSpeeds& speeds);

/// A colour that is drawn with the pen of another colour.
struct MergedPen {
    Colour colour;
    Colour pen;
    int number = 0;      ///< number of the pen, from 1
    double drawn = 0.0;  ///< millimetres
};

/// Widths of strokes in millimetres. `most` is 0 for a pen without strokes, and if `pen_width` is set.
struct StrokeWidths {
    double least = 0.0;
    double most = 0.0;
};

/// The lines of the plot that one pen draws.
struct PenTally {
    int number = 0;  ///< from 1
    Colour colour;
    double drawn = 0.0;             ///< millimetres
    std::uint64_t lifts = 0;        ///< number of times it is lowered
    std::optional<double> speed{};  ///< mm/s, if it has its own
    std::optional<double> pause{};  ///< seconds, if it has its own
    StrokeWidths widths{};
};

struct PlotReport {
    PlotTally before;  ///< pens and refills as in the plot, strokes as in the drawing
    PlotTally after;
    std::uint64_t segments = 0;           ///< lines and curves drawn, and edges of fills that no line draws
    std::uint64_t curves = 0;             ///< number of Béziers among them
    double skipped = 0;                   ///< millimetres that a resumed plot leaves out
    std::uint64_t duplicates = 0;         ///< drawn lines and curves left out because they lay on another one
    std::uint64_t fills = 0;              ///< number of polygons, areas and discs drawn
    std::uint64_t tiles = 0;              ///< number of polygons passed to the writer of the file
    bool returns = false;                 ///< travel includes the return home
    std::size_t colours = 0;              ///< number of colours drawn
    std::vector<PenTally> pens;           ///< in the order in which they draw
    std::vector<PenTally> pens_before{};  ///< the same pens, with strokes as in the drawing
    std::vector<MergedPen> merged;        ///< merged colours, in the order of the palette
};

/// Duration of a plot whose pens may have their own speeds and pauses. @throws std::runtime_error as above
double plot_seconds(const PlotTally& tally, const std::vector<PenTally>& pens, const PlotSpeeds& speeds);

}  // namespace sikku
