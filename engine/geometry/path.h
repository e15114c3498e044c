// engine/geometry/path.h: receivers of a turtle's output: strokes of lines or Béziers, polygons, discs.
#pragma once

#include <glm/vec2.hpp>
#include <span>
#include <string_view>

namespace sikku {

/// Width and colour of a line. The colour is an index into the style's palette; it may be negative or past the
/// palette's end, and is then taken modulo its size.
struct Pen {
    double width = 1.0;      ///< a factor of the style's stroke width, or, if `width_set`, a width in its unit
    bool width_set = false;  ///< set by `#(w)` or `!(w)`
    int colour = 0;          ///< stepped by `'` `;` `,`

    bool operator==(const Pen&) const = default;
};

/// Receives a drawing in drawing order, in blocks of points, in turtle steps, with y up and not yet on a page. Spans
/// are valid only during the call. A stroke is begin_stroke, then any number of lines, curves and change_pen, then
/// end_stroke; strokes never nest. Polygons and discs may arrive in the middle of a stroke.
class PathSink {
public:
    virtual ~PathSink() = default;

    /// Lowers the pen at `start`. At least one line or curve follows before end_stroke().
    virtual void begin_stroke(glm::dvec2 start, const Pen& pen) = 0;
    /// Draws straight lines, each from the end of the last one to the next of `ends`.
    virtual void lines(std::span<const glm::dvec2> ends) = 0;
    /// Draws cubic Béziers of three control points each, of which the third is the end.
    virtual void curves(std::span<const glm::dvec2> controls) = 0;
    /// Continues the stroke with another pen.
    virtual void change_pen(const Pen& pen) = 0;
    /// Lifts the pen. @param closed  true if the stroke ended exactly where it began
    virtual void end_stroke(bool closed) = 0;

    /// A filled polygon of at least three vertices, without the first repeated at the end; it may cross itself
    /// (non-zero winding rule).
    virtual void polygon(std::span<const glm::dvec2> vertices, const Pen& pen) = 0;
    /// A filled area bounded by Béziers: the point where its outline begins, then three control points for each
    /// curve, at least one curve; a straight line closes it if the last curve ends elsewhere. It may cross itself
    /// (non-zero winding rule). Further contours follow after bridges: see engine/geometry/contours.h. By default it
    /// is passed on as a polygon that deviates by at most 1/1000 of the larger side of its bounding box.
    virtual void area(std::span<const glm::dvec2> outline, const Pen& pen);
    /// A filled disc. `radius` in turtle steps; 0 is a dot (`@.`), which the style sizes by the pen.
    virtual void disc(glm::dvec2 centre, double radius, const Pen& pen) = 0;
    /// An upright text with its middle at `centre`, whose capital letters are `height` steps high. Never called
    /// within a stroke. By default, draws its strokes as lines and curves.
    virtual void label(std::string_view text, glm::dvec2 centre, double height, const Pen& pen);
    /// Ends a part of the drawing: see Grammar::with_marks().
    virtual void mark() {}
};

/// Passes a drawing on to another sink; derived classes override the calls that they change.
template <typename Sink>
class Forwarding : public Sink {
public:
    explicit Forwarding(PathSink& sink) : sink_(sink) {}
    void begin_stroke(glm::dvec2 start, const Pen& pen) override { sink_.begin_stroke(start, pen); }
    void lines(std::span<const glm::dvec2> ends) override { sink_.lines(ends); }
    void curves(std::span<const glm::dvec2> controls) override { sink_.curves(controls); }
    void change_pen(const Pen& pen) override { sink_.change_pen(pen); }
    void end_stroke(bool closed) override { sink_.end_stroke(closed); }
    void polygon(std::span<const glm::dvec2> vertices, const Pen& pen) override { sink_.polygon(vertices, pen); }
    void area(std::span<const glm::dvec2> outline, const Pen& pen) override { sink_.area(outline, pen); }
    void disc(glm::dvec2 centre, double radius, const Pen& pen) override { sink_.disc(centre, radius, pen); }
    void mark() override { sink_.mark(); }

protected:
    PathSink& sink_;
};
using PathFilter = Forwarding<PathSink>;

/// Ignores strokes.
template <typename Sink>
class WithoutStrokes : public Sink {
public:
    using Sink::Sink;
    void begin_stroke(glm::dvec2, const Pen&) override {}
    void lines(std::span<const glm::dvec2>) override {}
    void curves(std::span<const glm::dvec2>) override {}
    void change_pen(const Pen&) override {}
    void end_stroke(bool) override {}
};

/// Takes only polygons, and areas as polygons.
class PolygonSink : public WithoutStrokes<PathSink> {
public:
    void disc(glm::dvec2, double, const Pen&) override {}
};

/// Forwards only polygons.
class OnlyPolygons : public WithoutStrokes<PathFilter> {
public:
    using WithoutStrokes::WithoutStrokes;
    void area(std::span<const glm::dvec2>, const Pen&) override {}
    void disc(glm::dvec2, double, const Pen&) override {}
};

/// Receives the outlines of polygons between the points of strokes, so that a polygon can follow the curves drawn
/// along it. Outlines nest; a point of a stroke belongs to the most recently begun outline.
class OutlineSink {
public:
    virtual ~OutlineSink() = default;
    virtual void begin_outline(glm::dvec2 at) = 0;
    /// Adds a vertex reached without drawing.
    virtual void outline_vertex(glm::dvec2 at) = 0;
    /// @param is_area  true if the outline has at least three vertices
    virtual void end_outline(const Pen& pen, bool is_area) = 0;
};

}  // namespace sikku
