// engine/geometry/spline_outlines.h: filled outlines that follow the splines drawn along them.
#pragma once

#include "engine/geometry/bezier.h"
#include "engine/geometry/path.h"

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

}  // namespace sikku
