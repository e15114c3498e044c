// art/sheet/sheet_plot.h: the drawings of a sheet as one drawing, in millimetres and in one palette, for plotters.
#pragma once

#include "art/drawing/drawing.h"

#include <functional>
#include <vector>

namespace sikku {

/// A drawing with its place on a sheet.
struct PlacedDrawing {
    const Drawing* drawing;
    const Print* print;  ///< placed on the sheet
    Window window;
};

/// Draws texts and drawings in millimetres from the top left corner of the sheet, y up.
class SheetDrawing : public Drawing {
public:
    /// @param sheet  print of the sheet, whose pens are in millimetres @param texts  draws in its pens
    SheetDrawing(std::vector<PlacedDrawing> drawings, const Print& sheet, std::function<void(PathSink&)> texts,
                 const DrawingOptions& options, const Reading& reading);

    const DrawnExtent& seen() override { return extent_; }
    const Style& style() const override { return style_; }
    double scale() const override { return 1.0; }
    std::vector<int> hatched_colours() const override;
    using Drawing::read;
    void read(const Print& print, const Window& window, PathSink& sink) const override;

private:
    std::vector<PlacedDrawing> drawings_;
    std::function<void(PathSink&)> texts_;
    Style style_;                          ///< with the colours of all drawings
    std::vector<std::vector<int>> lines_;  ///< for each drawing and colour, the index of its line colour
    std::vector<std::vector<int>> fills_;  ///< the index of its fill colour
    DrawnExtent extent_;                   ///< extent of the sheet
};

}  // namespace sikku
