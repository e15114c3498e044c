// art/drawing/framed_drawing.h: a drawing with a border around it and a line of text below it.
#pragma once

#include "art/drawing/drawing.h"
#include "art/font/letters.h"
#include "art/print/border.h"

#include <atomic>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace sikku {

/// True if the style or the options request a border, a title line or an edition.
bool has_frame(const Style& style, const DrawingOptions& options);

/// Adds a border and lines of text to another drawing, in one palette.
class FramedDrawing : public DerivedDrawing {
public:
    /// @param border  null: only text
    FramedDrawing(std::unique_ptr<Drawing> inner, std::optional<Border> border, const DrawingOptions& options,
                  const Reading& reading);

    const DrawnExtent& seen() override;
    double border_space(const Page& page) const override;
    TextSpace text_space(const Page& page) const override;
    using Drawing::read;
    void read(const Print& print, const Window& window, PathSink& sink) const override;
    void report(DrawingReport& report) const override;

private:
    /// A line of text on the page.
    struct Line {
        std::string text;
        glm::dvec2 at{0.0};  ///< beginning of the baseline, in millimetres of the page, y down
        double height = 0;   ///< of capitals, in millimetres
        double stem = 0;     ///< width of single strokes
        double width = 0;
        bool is_title = false;
        bool is_cut = false;
    };

    double title_height(const Page& page) const;
    double title_stem(const Page& page) const;
    double foot_lift(const Page& page) const;
    double head_drop(const Page& page) const;
    double edition_room(double width, const Page& page) const;
    Line edition_line(double width, const Page& page) const;
    Line title_line(double room, const Page& page) const;
    std::vector<Line> lines_of(const Window& window) const;
    Page without_text(const Page& page) const;
    Border border_on(const Page& page) const;
    Window inside(const Window& window) const;
    void read_text(const Print& print, const Window& window, PathSink& sink) const;

    Letters letters_;
    double depth_ = 0;   ///< of the texts below the drawing, as part of the height of capitals
    double ascent_ = 0;  ///< of a title above it
    std::optional<Border> border_;
    glm::dvec2 size_{0.0};  ///< of the drawing, in steps; known once it was seen
    int border_colour_ = 0;
    int text_colour_ = 0;
    mutable std::atomic<bool> cuts_title_ = false;
    mutable std::atomic<bool> cuts_edition_ = false;
};

}  // namespace sikku
