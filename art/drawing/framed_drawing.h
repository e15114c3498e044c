// art/drawing/framed_drawing.h: a drawing with a border around it and a line of text below it.
#pragma once

#include "art/drawing/drawing.h"
#include "art/print/border.h"

#include <memory>

namespace sikku {

/// True if the style or the options request a border, a title line or an edition.
bool has_frame(const Style& style, const DrawOptions& options);

/// Adds a border and a line of text to another drawing, in one palette.
class FramedDrawing : public Drawing {
public:
    /// @throws BudgetError, WordError; std::runtime_error if the border's pattern cannot be drawn
    FramedDrawing(std::unique_ptr<Drawing> inner, const DrawOptions& options);

    const DrawnExtent& seen() override { return inner_->seen(); }
    const Style& style() const override { return style_; }
    double scale() const override { return inner_->scale(); }
    double dot_distance() const override { return inner_->dot_distance(); }
    Balance balance() const override { return inner_->balance(); }
    double border_space(const Page& page) const override;
    double foot_space(const Page& page) const override;
    using Drawing::read;
    void read(const Print& print, const Window& window, PathSink& sink) const override;
    std::vector<int> hatched_colours() const override { return inner_->hatched_colours(); }
    void report(DrawReport& report) const override { inner_->report(report); }

private:
    Window inside(const Window& window) const;
    void read_text(const Print& print, const Window& window, PathSink& sink) const;

    std::unique_ptr<Drawing> inner_;
    Style drawn_;  ///< the style of the drawing, with its own palette
    Style style_;  ///< with the colours of the border and the text added
    std::optional<Border> border_;
    int border_colour_ = 0;
    int text_colour_ = 0;
};

}  // namespace sikku
