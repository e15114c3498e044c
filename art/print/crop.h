// art/print/crop.h: cuts a drawing off exactly at the edges of a rectangle.
#pragma once

#include "art/print/clip.h"
#include "engine/geometry/bezier.h"

#include <glm/mat3x2.hpp>

#include <array>
#include <vector>

namespace sikku {

/// One side of a line: the points for which dot(normal, point) <= offset.
struct HalfPlane {
    glm::dvec2 normal{0.0};
    double offset = 0;
};

/// Passes on the parts of a drawing that lie in a rectangle. Lines and curves end at its edges, without the width of
/// their pens; fills that cross an edge become polygons.
class CropSink : public CutStrokes {
public:
    /// @param low, high  corners of the rectangle, in the coordinates of the page
    /// @param to_page    maps the drawing to the page, invertible @param tolerance  of curved fills, in the drawing
    CropSink(PathSink& sink, glm::dvec2 low, glm::dvec2 high, const glm::dmat3x2& to_page, double tolerance);

    void lines(std::span<const glm::dvec2> ends) override;
    void curves(std::span<const glm::dvec2> controls) override;
    void polygon(std::span<const glm::dvec2> vertices, const Pen& pen) override;
    void area(std::span<const glm::dvec2> outline, const Pen& pen) override;
    void disc(glm::dvec2 centre, double radius, const Pen& pen) override;

private:
    bool contains(std::span<const glm::dvec2> points) const;
    bool misses(std::span<const glm::dvec2> points) const;
    void draw(const Bezier& piece, bool is_line);
    void fill(std::vector<glm::dvec2> corners, const Pen& pen);

    std::array<HalfPlane, 4> sides_;
    double tolerance_;
};

}  // namespace sikku
