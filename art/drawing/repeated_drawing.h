// art/drawing/repeated_drawing.h: repeats a drawing as a frieze, a wallpaper or a ring.
#pragma once

#include "art/drawing/drawing.h"

#include <atomic>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

namespace sikku {

/// Calls `make` with the reading of one copy: copies share the budget.
/// @throws exceptions of `make`; a BudgetError of a repeat also names the number of copies
void make_one_copy(const DrawingOptions& options, const Reading& reading,
                   const std::function<void(const Reading& one)>& make);

/// Reads another drawing once for each copy. The step and the extent are those of all copies together, or of a row of
/// cells if they fill the page: then read() covers its window, or, in a plot, the part within its margin, and cuts
/// copies off there.
class RepeatedDrawing : public DerivedDrawing {
public:
    /// Reads the drawing once, for its hull. The options' `repeat` is set.
    /// @throws BudgetError, WordError; std::runtime_error if nothing is drawn, unless it may be empty
    RepeatedDrawing(std::unique_ptr<Drawing> inner, const DrawingOptions& options, const Reading& reading);

    const DrawnExtent& seen() override { return extent_; }
    Balance balance() const override;
    using Drawing::read;
    void read(const Print& print, const Window& window, PathSink& sink) const override;
    void report(DrawingReport& report) const override;

private:
    void measure_cells(double ink);
    void read_filling(const Print& print, const Window& window, PathSink& sink) const;
    void read_copies(const std::vector<glm::dmat3x2>& copies, const Print& print, const Window& window,
                     PathSink& sink) const;

    std::vector<glm::dmat3x2> copies_;  ///< unless they fill the page
    std::optional<Wallpaper> filling_;
    mutable std::atomic<std::size_t> drawn_ = 0;  ///< number of copies
    DrawnExtent extent_;
    std::vector<glm::dvec2> hull_;  ///< hull of one copy
    glm::dvec2 centre_{0.0};        ///< centre of mass of one copy
    double covered_ = 0;            ///< see DrawReport
    double covered_if_packed_ = 0;
    std::size_t strokes_ = 0;  ///< strokes of one copy
};

}  // namespace sikku
