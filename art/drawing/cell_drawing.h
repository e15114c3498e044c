// art/drawing/cell_drawing.h: a drawing that is cut off at the edges of a parallelogram.
#pragma once

#include "art/drawing/drawing.h"

#include <memory>

namespace sikku {

/// Draws the part of a drawing within a parallelogram. The ground fills it as a polygon, whose colour is the
/// last of the palette.
class CellDrawing : public DerivedDrawing {
public:
    CellDrawing(std::unique_ptr<Drawing> inner, const Cell& cell, const DrawingOptions& options,
                const Reading& reading);

    using Drawing::read;
    void read(const Print& print, const Window& window, PathSink& sink) const override;

private:
    Cell cell_;
};

}  // namespace sikku
