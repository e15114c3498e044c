// art/drawing/cell_drawing.h: a drawing that is cut off at the edges of a parallelogram.
#pragma once

#include "art/drawing/drawing.h"

#include <memory>

namespace sikku {

/// Draws the part of a drawing within a parallelogram, which the ground fills.
class CellDrawing : public Drawing {
public:
    CellDrawing(std::unique_ptr<Drawing> inner, const Cell& cell, const DrawOptions& options);

    const DrawnExtent& seen() override { return inner_->seen(); }
    const Style& style() const override { return style_; }
    double scale() const override { return inner_->scale(); }
    double dot_distance() const override { return inner_->dot_distance(); }
    using Drawing::read;
    void read(const Print& print, const Window& window, PathSink& sink) const override;
    std::vector<int> hatched_colours() const override { return inner_->hatched_colours(); }
    void report(DrawReport& report) const override { inner_->report(report); }

private:
    std::unique_ptr<Drawing> inner_;
    Cell cell_;
    Style drawn_;
    Style style_;  ///< without ground, whose colour is the last of the palette
};

}  // namespace sikku
