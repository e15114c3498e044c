// art/drawing/extent_sink.h: the visible extent of a drawing.
#pragma once

#include "art/drawing/drawing_options.h"
#include "art/style/style.h"
#include "engine/geometry/path.h"

#include <glm/mat3x2.hpp>

#include <array>

namespace sikku {

/// Collects the box of the visible parts of a drawing in its orientation on the page, and its widest pen. Boxes of
/// curves are exact.
class ExtentSink : public PathSink {
public:
    ExtentSink(const Style& style, const glm::dmat3x2& orientation) : style_(style), orientation_(orientation) {}

    void begin_stroke(glm::dvec2 start, const Pen& pen) override;
    void lines(std::span<const glm::dvec2> ends) override;
    void curves(std::span<const glm::dvec2> controls) override;
    void change_pen(const Pen& pen) override;
    void end_stroke(bool) override {}
    void polygon(std::span<const glm::dvec2> vertices, const Pen& pen) override;
    void area(std::span<const glm::dvec2> outline, const Pen& pen) override;
    void disc(glm::dvec2 centre, double radius, const Pen& pen) override;

    Box box;
    double widest = 0.0;  ///< width of pens and dots, in the unit of the style's stroke

private:
    glm::dvec2 turned(glm::dvec2 point) const;
    void begin_line();
    void add_curves(std::span<const glm::dvec2> controls);
    void add_extremes(const std::array<glm::dvec2, 4>& b, int axis);

    const Style& style_;
    glm::dmat3x2 orientation_;
    glm::dvec2 at_{0.0};
    bool draws_ = false;
    double width_ = 0.0;
};

/// The extent of a window: no pen is added, because lines continue outside it.
DrawnExtent window_extent(const ViewWindow& window, const glm::dmat3x2& orientation);

/// The extent to be placed: that of the whole drawing, or of the options' window. @param is_outside  set to true if
/// the drawing lies outside the window
DrawnExtent placed_extent(const DrawnExtent& whole, const DrawingOptions& options, bool& is_outside);

}  // namespace sikku
