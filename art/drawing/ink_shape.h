// art/drawing/ink_shape.h: the shape of a drawing's ink: its convex hull and its centre of mass.
#pragma once

#include "art/style/style.h"
#include "engine/geometry/path.h"

#include <cstddef>
#include <vector>

namespace sikku {

/// Collects the shape of a drawing in its own coordinates. Curves are followed by chords within a thousandth of a
/// step. Memory: some thousand points.
class InkShape : public PathSink {
public:
    explicit InkShape(const Style& style) : style_(style) {}

    void begin_stroke(glm::dvec2 start, const Pen& pen) override;
    void lines(std::span<const glm::dvec2> ends) override;
    void curves(std::span<const glm::dvec2> controls) override;
    void change_pen(const Pen& pen) override;
    void end_stroke(bool) override {}
    void polygon(std::span<const glm::dvec2> vertices, const Pen& pen) override;
    void disc(glm::dvec2 centre, double radius, const Pen& pen) override;

    /// The convex hull, anticlockwise; empty if nothing is visible.
    const std::vector<glm::dvec2>& hull();
    /// The mean of all lines, weighted by length; without lines, of the fills, weighted by area.
    glm::dvec2 centre();
    std::size_t strokes() const { return strokes_; }  ///< number of visible strokes

private:
    void add(glm::dvec2 point);
    void draw_to(glm::dvec2 end);

    const Style& style_;
    std::vector<glm::dvec2> points_;
    std::size_t next_prune_ = 4096;
    bool is_drawn_ = false;
    glm::dvec2 at_{0.0};
    double length_ = 0, area_ = 0;
    glm::dvec2 length_moment_{0.0}, area_moment_{0.0};
    std::size_t strokes_ = 0;
};

/// The corners of the convex hull of some points, anticlockwise. Source: Andrew 1979, monotone chain.
std::vector<glm::dvec2> convex_hull(std::vector<glm::dvec2> points);

/// The area of a polygon, positive if its corners run anticlockwise.
double polygon_area(const std::vector<glm::dvec2>& corners);

}  // namespace sikku
