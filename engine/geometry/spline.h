// engine/geometry/spline.h: converts strokes, and outlines along them, to uniform cubic B-splines as exact Béziers.
#pragma once

#include "engine/geometry/bezier.h"
#include "engine/geometry/path.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <vector>

namespace sikku {

/// Bounds polygons with the curves of a SplineSink. An edge between consecutive control points of a stroke follows
/// the piece of the curve between them: control point k corresponds to the curve at the knot that is k's Greville
/// abscissa (with uniform knots (P[k-1] + 4 P[k] + P[k+1]) / 6, where the curve is nearest). An edge that no stroke
/// draws is straight.
///
/// An outline is passed to the sink as soon as all its curves are known, in the order in which outlines end. Memory:
/// the curves of open or waiting outlines; one at the start of a closed stroke waits for the end of the stroke.
class SplineOutlines {
public:
    explicit SplineOutlines(PathSink& sink) : sink_(sink) {}

    void begin_stroke(glm::dvec2 start, bool closed);
    /// The stroke's next control point.
    void control(glm::dvec2 point);
    /// The stroke's next Bézier.
    void piece(const Bezier& bezier);
    void end_stroke();

    /// Begins an outline at `at`; control points and vertices belong to the most recently begun outline.
    void begin(glm::dvec2 at);
    /// Adds a vertex reached without drawing.
    void vertex(glm::dvec2 at);
    /// Ends the most recently begun outline; it is dropped unless it `is_area`.
    void end(const Pen& pen, bool is_area);

private:
    struct Stroke {
        std::uint64_t first_piece = 0;  // number of its first Bézier among all
        std::size_t pieces = 0;         // so far
        std::size_t controls = 0;       // so far
        bool closed = false;
        bool ended = false;
    };
    /// Consecutive control points of a stroke, or one point that belongs to none.
    struct Run {
        std::uint64_t stroke = 0;
        std::size_t from = 0;
        std::size_t to = 0;
        bool is_point = false;
        glm::dvec2 at{0.0};  // of the point
    };
    struct Outline {
        std::vector<Run> runs;
        glm::dvec2 last{0.0};      // vertex
        std::uint64_t stroke = 0;  // the first stroke that it needs
        std::uint64_t piece = 0;   // the first Bézier that it needs
        Pen pen;
    };

    bool is_idle() const { return open_.empty() && waiting_.empty(); }
    const Stroke& stroke(const Run& run) const { return strokes_[run.stroke - first_stroke_]; }
    std::uint64_t current() const { return first_stroke_ + strokes_.size() - 1; }
    bool is_known(const Run& run) const;
    void settle();
    void forget();
    double parameter(const Stroke& stroke, std::size_t control) const;
    const Bezier& bezier(const Stroke& stroke, double number) const;
    void pass_on(const Outline& outline);

    PathSink& sink_;
    std::deque<Stroke> strokes_;  // the last one is being drawn
    std::uint64_t first_stroke_ = 0;
    std::vector<Bezier> kept_;
    std::uint64_t first_kept_ = 0;  // number of the first one among all
    std::uint64_t pieces_ = 0;      // of all strokes
    std::size_t forget_at_ = 1024;
    bool down_ = false;
    glm::dvec2 at_{0.0};  // the last control point
    std::vector<Outline> open_;
    std::deque<Outline> waiting_;
    std::vector<glm::dvec2> points_;
};

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
