// art/drawing/composition.h: a drawing with dots, colours for its strands and line work.
#pragma once

#include "art/drawing/line_work.h"
#include "art/drawing/word_drawing.h"

#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

namespace sikku {

/// True if the style or the options request dots, strand colours or line work.
bool has_ornaments(const Style& style, const DrawingOptions& options);

/// Adds fields, dots and strand colours to another drawing, in one palette, and draws its lines as a weave or as
/// parallel lines.
class Composition : public Drawing {
public:
    /// Finds dots and strands if they are needed, and computes the step for a requested dot spacing. `grammar` is the
    /// grammar of `lines`.
    /// @throws BudgetError, WordError; std::runtime_error if requested dots cannot be drawn
    Composition(const Grammar& grammar, std::unique_ptr<WordDrawing> lines, const DrawingOptions& options,
                const Reading& reading);

    const DrawnExtent& seen() override;
    const Style& style() const override { return style_; }
    double scale() const override { return lines_->scale(); }
    Balance balance() const override { return lines_->balance(); }
    double dot_distance() const override { return distance_; }
    using Drawing::read;
    void read(const Print& print, const Window& window, PathSink& sink) const override;
    std::vector<int> hatched_colours() const override;
    void report(DrawingReport& report) const override;

private:
    void examine(const Grammar& grammar);
    void set_spacing();
    void add_colours();
    void add_stroke_colours();
    void add_field_colours();
    void read_lines_and_dots(const Print& print, const Window& window, PathSink& sink) const;
    void read_parallel(const Print& print, PathSink& sink) const;
    double room_of_dot(const Print& print) const;
    double dot_radius(const Print& print) const;
    void read_dots(const Print& print, const std::vector<glm::dvec2>& drawn, PathSink& sink) const;

    std::unique_ptr<WordDrawing> lines_;
    Style drawn_;  ///< the style of the drawing, with its own palette
    Style style_;  ///< with the colours of dots and strands added
    std::vector<glm::dvec2> dots_;
    double distance_ = 0;  ///< distance between the nearest dots, in steps
    bool has_dots_on_lines_ = false;
    Pen dot_pen_;
    std::vector<std::uint32_t> orbit_of_stroke_;  ///< orbit of the stroke's line
    std::vector<int> stroke_colours_;
    std::optional<LineWork> work_;
    std::optional<DrawnExtent> extent_;
    mutable std::mutex reporting_;
    mutable std::optional<ParallelReport> parallel_;
};

}  // namespace sikku
