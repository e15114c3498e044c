// art/drawing/drawing.h: a drawing before it has a place: whatever draws takes one of these.
#pragma once

#include "art/drawing/draw_options.h"
#include "art/raster/raster.h"
#include "art/space/scene.h"
#include "engine/language/grammar.h"

#include <memory>
#include <optional>
#include <string>

namespace sikku {

/// Calculates the placement of `print` on its page, with the pen around what is seen; `stroke` gives its measure.
/// @throws std::runtime_error if the margins leave no room
DrawReport place_print(Print& print, const DrawnExtent& seen, const StrokeWidth& stroke,
                       const PlacementOptions& placement);

/// The whole page of a print, with its margin.
Window whole_page(const Page& page);

/// What lies in a window of the page, and up to `around` millimetres outside of it, as the drawing sees it.
Box seen_box(const Print& print, const Window& window, double around);

/// A drawing that is placed and then read, any number of times, always into the same strokes. Its implementations
/// read the word (WordDrawing), look at it through a view (SeenDrawing), or add dots, a border and colours to another
/// drawing (Composition); make_drawing() chooses.
class Drawing {
public:
    explicit Drawing(const DrawOptions& options) : options_(options) {}
    virtual ~Drawing() = default;
    Drawing(const Drawing&) = delete;
    Drawing& operator=(const Drawing&) = delete;

    /// What the page has to hold: all that is drawn, or the window. Calculated when it is first requested. The box is
    /// empty if nothing is drawn.
    virtual const DrawnExtent& seen() = 0;
    /// The same. @throws std::runtime_error if nothing is drawn
    const DrawnExtent& extent();
    /// The style in which read() draws.
    virtual const Style& style() const = 0;
    /// Fraction of the page that a fitted drawing fills.
    virtual double scale() const = 0;
    /// Millimetres on each side, within the margins, that are kept free for a border on a page of that size.
    virtual double border_space(const Page&) const { return 0; }
    /// Bounds of all points of a drawing in space, without the width of pens, once it was read.
    virtual std::optional<SpaceBounds> bounds() const { return std::nullopt; }
    /// Millimetres of a step, if the options or the dots set it.
    std::optional<double> fixed_step() const { return options_.placement.step; }

    /// Calculates the placement of `print` on its page. @throws as extent(), unless the options have a frame, and if
    /// the margins leave no room
    DrawReport place(Print& print);

    /// Draws all strokes into `sink`. To be called after extent() or place().
    /// @param print   placed, in style()
    /// @param window  where on the page the drawing lies: a view looks no further, and a border lies within its
    /// margin
    virtual void read(const Print& print, const Window& window, PathSink& sink) const = 0;
    void read(const Print& print, PathSink& sink) const { read(print, whole_page(print.page), sink); }
    /// The same without the strokes that lie outside, if the options have a window. To be called after place().
    void read_visible(const Print& print, const Window& window, PathSink& sink) const;

    /// The same as pixels of the page. `print` and the drawing must outlive them.
    virtual std::unique_ptr<Rendering> rendering(const Print& print, const Window& window) const;
    std::unique_ptr<Rendering> rendering(const Print& print) const {
        return rendering(print, whole_page(print.page));
    }

    /// Adds what read() and the renderings found so far.
    virtual void report(DrawReport&) const {}

protected:
    DrawOptions options_;

private:
    double around_ = 0;  ///< widest pen of what goes on around a window, in the measure of the style's stroke
};

/// The drawing of a grammar with all that `style` and `options` ask for: read from the word, or seen through a view
/// where it has one, with dots, border and strand colours around it.
/// @throws BudgetError, WordError; std::runtime_error if it cannot be drawn
std::unique_ptr<Drawing> make_drawing(const Grammar& grammar, const Style& style, const DrawOptions& options);

/// What a drawing costs, roughly.
struct DrawingCost {
    double nodes = 0;          ///< of the derivation that are visited in a pass
    double lines = 0;          ///< and what is drawn of them
    double memory = 0;         ///< bytes, on one thread
    double thread_memory = 0;  ///< more for each further thread
    double kept_memory = 0;    ///< bytes of `memory` that the drawing itself keeps
    double lines_memory = 0;   ///< bytes of `memory` kept by a Raster when it has read the whole drawing
};

/// Forecasts the cost of make_drawing() and one print. @param print  its page, style and resolution count
/// @throws BudgetError if the word is too long to be read
DrawingCost drawing_cost(const Grammar& grammar, const Print& print, const DrawOptions& options);

}  // namespace sikku
