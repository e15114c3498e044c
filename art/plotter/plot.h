// art/plotter/plot.h: arranges a drawing for a pen plotter: no line twice, few pen lifts, little pen-up travel.
#pragma once

#include "art/plotter/passes.h"
#include "art/plotter/plot_options.h"
#include "art/print/print.h"
#include "art/print/tile_kinds.h"
#include "engine/geometry/path.h"

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <vector>

namespace sikku {

struct PlotCourse;
struct PlotLayer;

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
/// - With a `pen_width`, wider strokes are drawn in several passes (see pen_passes()). Without it, each stroke
///   is drawn once, and a pen is as wide as the thinnest of its strokes.
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
/// The strokes of a pen are then ordered, and reversed or begun elsewhere: see sort_strokes(). The number of
/// passes is bounded. The result is the same on every run. A pen keeps the strokes of the drawing
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
    template <class Travel, class Visit>
    void follow(const PlotCourse& course, const Travel& add_travel, const Visit& visit) const;

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
