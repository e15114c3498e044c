// art/drawing/colouring_drawing.h: outlines to be coloured in.
#pragma once

#include "art/drawing/drawing.h"

#include <memory>

namespace sikku {

class Grammar;

/// Least width of the lines of a colouring page, in millimetres: a little more than 3 points, which rounding keeps.
constexpr double colouring_line = 1.06;

/// Converts a style to that of a colouring page: lines of even width in one ink on white paper, as the turtle draws
/// them, without dots, fields, borders and fills. The edges of polygons are drawn once.
/// @param ink, width  of the lines; a width in millimetres
void prepare_colouring(Style& style, const Grammar& grammar, Colour ink, double width);

/// Draws only the visible lines of another drawing, with one pen, and fills the specks of its options. Its style was
/// made by prepare_colouring().
class ColouringDrawing : public DerivedDrawing {
public:
    ColouringDrawing(std::unique_ptr<Drawing> inner, const DrawingOptions& options, const Reading& reading);

    using Drawing::read;
    void read(const Print& print, const Window& window, PathSink& sink) const override;
    std::vector<int> hatched_colours() const override { return {}; }
};

}  // namespace sikku
