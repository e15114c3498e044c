#include "art/drawing/cell_drawing.h"

#include "art/print/crop.h"
#include "art/print/ornaments.h"

#include <glm/mat2x2.hpp>
#include <glm/matrix.hpp>

#include <array>
#include <cmath>
#include <utility>

namespace sikku {

CellDrawing::CellDrawing(std::unique_ptr<Drawing> inner, const Cell& cell, const DrawingOptions& options,
                         const Reading& reading)
    : DerivedDrawing(std::move(inner), options, reading), cell_(cell) {
    if (!drawn_.ground) return;
    style_.palette.push_back(*drawn_.ground);
    style_.ground.reset();
}

void CellDrawing::read(const Print& print, const Window& window, PathSink& sink) const {
    constexpr double chord = 1e-3;  // deviation of chords from curves, as a share of a side
    const std::array<glm::dvec2, 2>& sides = cell_.sides;
    if (drawn_.ground) {
        const std::array<glm::dvec2, 4> corners = {cell_.corner, cell_.corner + sides[0],
                                                   cell_.corner + sides[0] + sides[1], cell_.corner + sides[1]};
        sink.polygon(corners, Pen{.colour = static_cast<int>(drawn_.palette.size())});
    }
    const glm::dmat2x2 to_cell = glm::inverse(glm::dmat2x2(sides[0], sides[1]));
    const double length = std::sqrt(sides[0].x * sides[0].x + sides[0].y * sides[0].y);
    // Lines along an edge belong to the copies on both of its sides.
    constexpr double rounding = 1e-9;
    CropSink crop(sink, glm::dvec2(-rounding), glm::dvec2(1 + rounding),
                  {to_cell[0], to_cell[1], -(to_cell * cell_.corner)}, chord * length);
    OldColours old(crop, drawn_);
    inner_->read(print, window, old);
}

}  // namespace sikku
