// art/plotter/plot.h: arranges a drawing for a pen plotter: no line twice, few pen lifts, little pen-up travel.
#pragma once

#include "art/plotter/passes.h"
#include "art/plotter/pen_rules.h"
#include "art/plotter/shading.h"
#include "art/print/print.h"
#include "art/print/tile_kinds.h"
#include "engine/base/monitor.h"
#include "engine/geometry/path.h"

#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <vector>

namespace sikku {

struct PlotCourse;
struct PlotLayer;

/// Speeds of a plotter. Acceleration is ignored: real plotters are slower on short strokes.
struct PlotSpeeds {
    double drawing = 40.0;     ///< mm/s, pen down
    double travelling = 80.0;  ///< mm/s, pen up
    double lift = 0.3;         ///< seconds for lifting the pen and lowering it again
};

struct PlotOptions {
    /// Maximum length of a stroke in millimetres: a longer one is cut into several, each beginning where the last one
    /// ended. Cuts lie between lines and curves, so that a longer one stays whole. 0: strokes are not cut.
    double split = 0.0;
    double pen_width = 0.0;           ///< millimetres; 0: each stroke is drawn with a pen of its own width
    std::optional<Hatch> hatch = {};  ///< hatching of filled shapes; absent: outlines only
    bool leaves_tiles =
        false;  ///< polygons are counted but not drawn; draw_plot() passes them to the writer of the file
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

/// The lines of the plot that one pen draws.
struct PenTally {
    int number = 0;  ///< from 1
    Colour colour;
    double drawn = 0.0;             ///< millimetres
    std::uint64_t lifts = 0;        ///< number of times it is lowered
    std::optional<double> speed{};  ///< mm/s, if it has its own
    std::optional<double> pause{};  ///< seconds, if it has its own
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

/// One movement of the lifted pen, in pattern units.
struct PlotTravel {
    glm::dvec2 from{0.0}, to{0.0};
};

/// Extends the palette of a style so that each fill colour is also a line colour, and therefore has a pen.
Style with_fill_pens(const Style& style);
/// For each colour index, the index whose line colour equals its fill colour; otherwise the index itself.
std::vector<int> fill_pens(const Style& style);

/// Gathers a drawing and arranges it for a plotter. Skips invisible lines and shapes.
///
/// A plotter draws lines only, and each colour of the style is a pen:
/// - Polygons and areas become outlines, in the pen of their fill colour, and hatching if requested. An
///   edge that lies on a line of any pen, or on another outline, is not drawn again.
/// - Discs and dots are filled by spirals (see spiral()), from the outside to the centre unless the other direction
///   shortens pen-up travel.
/// - With a `pen_width`, wider strokes are drawn in several passes (see pen_passes()). Without, a pen is as wide as
///   its strokes; in SVG, PDF and EPS, as wide as its first stroke.
/// - Pens that only hatch draw first, then those that draw lines, then those that only fill discs; otherwise in the
///   order of the palette.
/// - Fills do not hide lines, except in drawings in space (see plot_scene()).
///
/// Points that are less than a billionth of the drawing's larger side apart are one. (Points of a lattice are equal
/// to the bit; those of splines and of turtles that add up doubles are not.) Of lines and curves with the same
/// points, forwards or backwards, one is drawn, unless omitting the others would need more pen lifts than the
/// drawing: a line that runs back over itself stays one line. Lines that overlap in part are drawn unchanged.
///
/// Strokes of straight lines that meet are joined into as few as possible: one for each connected part, or half as
/// many as it has points in which an odd number of lines meet. At each point, lines are paired so that they turn
/// least; lines that only cross or touch are connected where that saves a stroke. Curves are connected only if all
/// that continued smoothly (within 10 degrees) still do: a kolam of two lines keeps two lines, and every line its
/// course. Ends left over at a point are joined at any angle.
///
/// The strokes of a pen are then ordered, and reversed or begun elsewhere, by nearest neighbours and 2-opt over near
/// ones, in a bounded number of passes. The result is the same on every run. A pen keeps the strokes of the drawing
/// if arranged ones would need more lifts or more time, and so does the whole plot: it is never worse than the
/// drawing.
///
/// Memory: linear, below 400 bytes for each line or curve. Time: O(n log n), 1 to 9 µs a line.
/// Source: Hierholzer 1873; Johnson & McGeoch, The travelling salesman problem: a case study in local optimization,
/// 1997.
class PlotPlan : public PathSink {
public:
    /// Uses style, page and placement of `print`, which is kept by reference.
    /// @throws std::runtime_error if the split is not finite or below 0
    explicit PlotPlan(const Print& print, const PlotOptions& options = {});
    ~PlotPlan() override;

    /// The drawing functions throw std::runtime_error for points that are not finite and for over 10^9 points.
    void begin_stroke(glm::dvec2 start, const Pen& pen) override;
    void lines(std::span<const glm::dvec2> ends) override;
    void curves(std::span<const glm::dvec2> controls) override;
    void change_pen(const Pen& pen) override;
    void end_stroke(bool closed) override;
    void polygon(std::span<const glm::dvec2> vertices, const Pen& pen) override;
    void area(std::span<const glm::dvec2> outline, const Pen& pen) override;
    void disc(glm::dvec2 centre, double radius, const Pen& pen) override;

    /// Arranges the plot. Call once, after the last stroke and before the functions below.
    /// @throws Stopped; SettingError if the plot ends before the place at which it resumes
    void arrange();
    /// Draws the strokes of the plot, in pattern units, pen after pen. The caller draws them in the colour of their
    /// pen even with `stroke: none`: fills may have outlines where lines are invisible. Calls `dip` for visits to the
    /// ink, with the place in millimetres from the bottom left corner of the page. @throws Stopped
    void draw(PathSink& sink, const std::function<void(glm::dvec2 place, const Pen& pen)>& dip = {}) const;
    const PlotReport& report() const { return report_; }
    /// Kinds of the polygons that are left to the writer.
    const std::vector<TileKind>& tile_kinds() const { return kinds_.kinds(); }
    /// Pen-up movements in order, from the start to the first stroke and, if there is a home, back to it.
    std::vector<PlotTravel> travels() const;
    /// Converts a position in millimetres from the bottom left corner of the page into pattern units.
    glm::dvec2 drawn_at(glm::dvec2 millimetres) const;
    /// A pen of the plot with its number and its own settings.
    struct PlottedPen {
        Pen pen;
        int number;
        PenSettings settings;
    };
    /// All pens in the order in which they draw, including those whose part a resumed plot skips.
    std::vector<PlottedPen> pens() const;

private:
    struct Gathered;

    int slot_of(const Pen& pen, bool fills) const;
    Gathered& gathered(const Pen& pen, bool fills = false);
    std::vector<int> slots_in_order() const;
    bool is_hatching(const Pen& pen) const;
    Gathered& outlines(const Pen& pen);
    void add(std::span<const glm::dvec2> points, bool curves);
    double pen_steps(const Pen& pen) const;
    Pen real_pen(const Pen& pen) const;
    bool is_wide(const Pen& pen) const;
    void draw_wide(bool closed);
    void hatch(std::span<const glm::dvec2> vertices, const Pen& pen);
    double tolerance() const;
    void add_outlines(double tolerance);
    void merge_colours();
    void read_layer(Gathered& from, double tolerance, glm::dvec2& at, PlotLayer& layer);
    void arrange_layer(PlotLayer& layer, glm::dvec2 start, double drawn);
    PlotCourse course() const;
    PlotTally tally(const PlotCourse& course, std::vector<PenTally>& pens) const;
    void tally_as_drawn();
    std::vector<PlotTravel> travels(const PlotCourse& course) const;

    const Print& print_;
    PlotOptions options_;
    std::vector<int> slots_;                             ///< slots of colour indices
    std::vector<int> fill_slots_;                        ///< pen slots of colour indices, for fills
    std::map<int, std::unique_ptr<Gathered>> gathered_;  ///< by slot
    std::map<int, std::unique_ptr<Gathered>> outlines_;  ///< outlines of fills by pen slot
    std::unique_ptr<Gathered> covered_;                  ///< middle lines of strokes drawn in several passes
    std::vector<std::unique_ptr<PlotLayer>> layers_;     ///< pens in their order
    PlotReport report_;
    TileKinds kinds_;
    Gathered* into_ = nullptr;  ///< destination of the current stroke; null if it is invisible
    bool down_ = false;         ///< the piece with the current pen has begun
    bool is_whole_ = false;     ///< the pen has not changed since the stroke began
    Pen pen_;
    std::optional<PenPath> wide_;  ///< the stroke so far, if it takes several passes
    glm::dvec2 at_{0.0};
};

}  // namespace sikku
