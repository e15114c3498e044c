// art/drawing/composition.h: a drawing with dots, a border and colours for its strands.
#pragma once

#include "art/drawing/word_drawing.h"
#include "art/kolam/kolam.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace sikku {

/// True if style and options ask for anything that a Composition adds.
bool has_ornaments(const Style& style, const DrawOptions& options);

/// Another drawing with all that is drawn beside it, in the colours of one palette.
class Composition : public Drawing {
public:
    /// Examines the drawing for its dots and strands, if they count, and sets the step that a distance of dots asks
    /// for. `grammar` is that of `lines`.
    /// @throws BudgetError, WordError; std::runtime_error if dots are asked for and cannot be had
    Composition(const Grammar& grammar, std::unique_ptr<WordDrawing> lines, const DrawOptions& options);

    const DrawnExtent& seen() override { return lines_->seen(); }
    const Style& style() const override { return style_; }
    double scale() const override { return lines_->scale(); }
    double border_space(const Page& page) const override;
    using Drawing::read;
    void read(const Print& print, const Window& window, PathSink& sink) const override;
    void report(DrawReport& report) const override;

private:
    void examine(const Grammar& grammar);
    void set_spacing();
    void add_colours();
    void add_stroke_colours();
    double dot_radius(const Print& print) const;
    void read_dots(const Print& print, const std::vector<glm::dvec2>& drawn, PathSink& sink) const;

    std::unique_ptr<WordDrawing> lines_;
    Style drawn_;  ///< with the palette of the drawing alone
    Style style_;  ///< with the colours of what is added
    std::vector<glm::dvec2> dots_;
    double distance_ = 0;  ///< between the nearest of them, in steps
    Pen dot_pen_;
    int border_colour_ = 0;
    std::vector<std::uint32_t> orbit_of_stroke_;  ///< of its line
    std::vector<int> stroke_colours_;
};

}  // namespace sikku
