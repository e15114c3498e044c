// engine/geometry/spline.h: converts strokes to uniform cubic B-splines as exact Béziers.
#pragma once

#include "engine/geometry/bezier.h"
#include "engine/geometry/path.h"
#include "engine/geometry/spline_outlines.h"

#include <array>
#include <cstddef>
#include <vector>

namespace sikku {

/// Takes the points of each stroke as the control points of a uniform cubic B-spline and passes the curve on as cubic
/// Béziers; nothing is flattened. A stroke that ends where it began is a closed curve, smooth at its start, too. An
/// open one runs from its first point to its last (clamped knots); with fewer than 4 segments, it triples its end
/// points instead. Polygons, discs and labels pass unchanged; outlines become areas that follow the curves
/// (SplineOutlines).
///
/// It must be known at the beginning of a stroke whether it is closed: a first pass with a StrokeCensus determines
/// that.
/// Memory: O(1) beside SplineOutlines. Source: Prusinkiewicz & Hanan 1989, section 2.2 (figures 2.10 and 2.11); de
/// Boor's knot insertion.
class SplineSink : public PathFilter, public OutlineSink {
public:
    /// @param closed  for each stroke, in order, true if it is closed; kept by reference
    SplineSink(PathSink& sink, const std::vector<bool>& closed)
        : Forwarding(sink), closed_(closed), outlines_(sink) {}

    void begin_stroke(glm::dvec2 start, const Pen& pen) override;
    void lines(std::span<const glm::dvec2> ends) override;
    void curves(std::span<const glm::dvec2> controls) override;
    void change_pen(const Pen& pen) override { pen_ = pen; }
    void end_stroke(bool closed) override;
    void label(std::string_view text, glm::dvec2 centre, double height, const Pen& pen) override {
        sink_.label(text, centre, height, pen);
    }
    void mark() override {}

    void begin_outline(glm::dvec2 at) override { outlines_.begin(at); }
    void outline_vertex(glm::dvec2 at) override { outlines_.vertex(at); }
    void end_outline(const Pen& pen, bool is_area) override { outlines_.end(pen, is_area); }

private:
    struct Control {
        glm::dvec2 at{0.0};
        Pen pen;  // of the segment that ends here
    };

    void add(glm::dvec2 point);
    const Control& recent(std::size_t index) const { return recent_[index % recent_.size()]; }
    Bezier uniform(const Control& a, const Control& b, const Control& c, const Control& d) const;
    Bezier clamped(std::size_t span, std::size_t segments) const;
    void emit(const Bezier& bezier, const Pen& pen);
    void emit_short();
    void flush();

    const std::vector<bool>& closed_;
    SplineOutlines outlines_;
    std::size_t stroke_ = 0;  // strokes begun
    bool is_closed_ = false;
    bool begun_ = false;                // part of this stroke was passed on
    Pen pen_;                           // of the points that arrive
    Pen sent_;                          // the last one passed on
    std::array<Control, 3> first_;      // the first control points
    std::array<Control, 6> recent_;     // the last ones, by index modulo 6
    std::size_t count_ = 0;             // control points so far
    std::vector<glm::dvec2> controls_;  // Béziers being gathered
};

/// Counts strokes and notes which of them are closed; draws nothing.
class StrokeCensus : public PolygonSink {
public:
    void end_stroke(bool is_closed) override { closed.push_back(is_closed); }
    void polygon(std::span<const glm::dvec2>, const Pen&) override {}
    void label(std::string_view, glm::dvec2, double, const Pen&) override {}

    std::vector<bool> closed;
};

}  // namespace sikku
