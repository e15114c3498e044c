// art/drawing/framed_drawing.h: a drawing with a border around it and a line of text below it.
#pragma once

#include "art/drawing/drawing.h"
#include "art/print/border.h"

#include <memory>

namespace sikku {

/// True if the style or the options request a border, a title line or an edition.
bool has_frame(const Style& style, const DrawingOptions& options);

/// Adds a border and a line of text to another drawing, in one palette.
class FramedDrawing : public DerivedDrawing {
public:
    /// @param border  null: only text
    FramedDrawing(std::unique_ptr<Drawing> inner, std::optional<Border> border, const DrawingOptions& options,
                  const Reading& reading);

    const DrawnExtent& seen() override;
    double border_space(const Page& page) const override;
    double foot_space(const Page& page) const override;
    using Drawing::read;
    void read(const Print& print, const Window& window, PathSink& sink) const override;

private:
    Border border_on(const Page& page) const;
    Window inside(const Window& window) const;
    void read_text(const Print& print, const Window& window, PathSink& sink) const;

    std::optional<Border> border_;
    glm::dvec2 size_{0.0};  ///< of the drawing, in steps; known once it was seen
    int border_colour_ = 0;
    int text_colour_ = 0;
};

}  // namespace sikku
