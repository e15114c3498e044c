// art/drawing/repeated_drawing.h: repeats a drawing as a frieze, a wallpaper or a ring.
#pragma once

#include "art/drawing/drawing.h"

#include <memory>
#include <vector>

namespace sikku {

/// Reads another drawing once for each copy. The step and the extent are those of all copies together.
class RepeatedDrawing : public Drawing {
public:
    /// Reads the drawing once, for its hull. The options' `repeat` is set.
    /// @throws BudgetError, WordError; std::runtime_error if nothing is drawn, unless it may be empty
    RepeatedDrawing(std::unique_ptr<Drawing> inner, const DrawOptions& options);

    const DrawnExtent& seen() override { return extent_; }
    const Style& style() const override { return inner_->style(); }
    double scale() const override { return inner_->scale(); }
    Balance balance() const override;
    using Drawing::read;
    void read(const Print& print, const Window& window, PathSink& sink) const override;
    void report(DrawReport& report) const override;

private:
    std::unique_ptr<Drawing> inner_;
    std::vector<glm::dmat3x2> copies_;
    DrawnExtent extent_;
    std::vector<glm::dvec2> hull_;  ///< of one copy
    glm::dvec2 centre_{0.0};        ///< of its mass
    std::size_t strokes_ = 0;       ///< of one copy
};

}  // namespace sikku
