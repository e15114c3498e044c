// art/drawing/drawing.h: the interface of all drawings, which are placed on a page and then read.
#pragma once

#include "art/drawing/draw_options.h"
#include "art/raster/raster.h"
#include "art/space/scene.h"
#include "engine/language/grammar.h"

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace sikku {

/// Calculates the placement of `print` on its page, including the width of the pen, whose unit `stroke` gives.
/// @throws std::runtime_error if the margins leave no room
DrawReport place_print(Print& print, const DrawnExtent& seen, const StrokeWidth& stroke,
                       const PlacementOptions& placement);

/// The whole page of a print, with its margin.
Window whole_page(const Page& page);

/// Converts a window of the page, widened by `around` millimetres, into the coordinates of the drawing.
Box seen_box(const Print& print, const Window& window, double around);

/// A drawing that is placed once and then read any number of times, with the same strokes each time. Implementations
/// read the word (WordDrawing), draw only the visible parts (SeenDrawing), add dots and colours to another drawing
/// (Composition), or frame it (FramedDrawing); make_drawing() combines them.
class Drawing {
public:
    explicit Drawing(const DrawOptions& options) : options_(options) {}
    virtual ~Drawing() = default;
    Drawing(const Drawing&) = delete;
    Drawing& operator=(const Drawing&) = delete;

    /// The extent to be placed on the page: the whole drawing, or the window. Calculated on the first call. The box
    /// is empty if nothing is drawn.
    virtual const DrawnExtent& seen() = 0;
    /// extent(). @throws std::runtime_error if nothing is drawn
    const DrawnExtent& extent();
    /// The style in which read() draws.
    virtual const Style& style() const = 0;
    /// Fraction of the page that a fitted drawing fills.
    virtual double scale() const = 0;
    /// The shape and the mass of the drawing in the orientation of the page. Call after seen(). By default, those of
    /// a full box.
    virtual Balance balance() const { return {}; }
    /// Width of the border on a page of that size, in millimetres on each side within the margins; 0 without a
    /// border.
    virtual double border_space(const Page&) const { return 0; }
    /// Height of a line of text below the drawing and its border, in millimetres, within the margins; 0 without one.
    virtual double foot_space(const Page&) const { return 0; }
    /// Bounds of all points of a drawing in space, without the width of pens; available after reading.
    virtual std::optional<SpaceBounds> bounds() const { return std::nullopt; }
    /// Distance between the nearest dots that are drawn, in steps; 0 if there are fewer than two.
    virtual double dot_distance() const { return 0; }
    /// Step length in millimetres, if the options or the dot spacing fix it.
    std::optional<double> fixed_step() const { return options_.placement.step; }

    /// The placement of the options, with the balance if they request a composed page. Call after seen().
    PlacementOptions placement() const;
    /// Calculates the placement of `print` on its page. @throws std::runtime_error if nothing is drawn, unless the
    /// options have a frame, or if the margins leave no room
    DrawReport place(Print& print);

    /// Draws all strokes into `sink`. Call after extent() or place().
    /// @param print   placed, in style()
    /// @param window  part of the page that is drawn on: a view visits nothing outside it, and a border lies within
    /// its margin
    virtual void read(const Print& print, const Window& window, PathSink& sink) const = 0;
    void read(const Print& print, PathSink& sink) const { read(print, whole_page(print.page), sink); }
    /// Draws a polygon of each kind that may occur, so that classes of polygons have the same numbers in all windows
    /// of a drawing. Draws nothing if the drawing is read whole.
    virtual void read_samples(PathSink&) const {}
    /// Like read(), but omits strokes outside the window of the options, if there is one. Call after place().
    void read_visible(const Print& print, const Window& window, PathSink& sink) const;

    /// Renders the page as pixels. `print` and the drawing must outlive the result.
    virtual std::unique_ptr<Rendering> rendering(const Print& print, const Window& window) const;
    std::unique_ptr<Rendering> rendering(const Print& print) const {
        return rendering(print, whole_page(print.page));
    }

    /// Palette indices of the fields between lines, which plots hatch before they draw anything else; -1 for none.
    virtual std::vector<int> hatched_colours() const { return {}; }

    /// Adds the findings of read() and the renderings so far to a report.
    virtual void report(DrawReport&) const {}

protected:
    /// @param points  with the same convex hull as the drawing @param centre  centre of mass; both in its coordinates
    Balance balance_of(const std::vector<glm::dvec2>& points, glm::dvec2 centre) const;

    DrawOptions options_;

private:
    double around_ = 0;  ///< widest pen of lines that continue outside a window, in the unit of the style's stroke
};

/// Makes the drawing of a grammar: read from the word, or through a view if there is one, with the dots, strand
/// colours and frame that `style` and `options` request.
/// @throws BudgetError, WordError; std::runtime_error if it cannot be drawn
std::unique_ptr<Drawing> make_drawing(const Grammar& grammar, const Style& style, const DrawOptions& options);

/// Rough estimate of the cost of a drawing.
struct DrawingCost {
    double nodes = 0;          ///< derivation nodes visited in a pass
    bool is_doubtful = false;  ///< by its growth so far, the word exceeds the budget
    double lines = 0;          ///< lines, polygons and discs drawn in a pass
    double points = 0;         ///< ends of lines, corners of polygons and discs that a writer receives
    double strokes = 0;        ///< lines without a lift
    double polygons = 0;       ///< polygons, in space without those of patches
    double patches = 0;        ///< patches of surfaces in space
    std::vector<std::pair<double, double>> bent{};  ///< bends of patches in millimetres, and their numbers
    double length = 0;                              ///< millimetres of lines
    double ink = 0;                                 ///< square millimetres of lines, however often they cross
    double area = 0;                                ///< square millimetres of polygons, discs and patches, likewise
    glm::dvec2 size{0.0};                           ///< millimetres of the drawing
    double reach = 0;                               ///< longest side in space, in millimetres
    double seconds = 0;                             ///< processor time of making the drawing and reading it once
    double memory = 0;                              ///< bytes, on one thread
    double thread_memory = 0;                       ///< bytes for each further thread
    double kept_memory = 0;                         ///< bytes of `memory` that the drawing itself keeps
    double lines_memory = 0;  ///< bytes of `memory` kept by a Raster when it has read the whole drawing
};

/// Forecasts the cost of make_drawing() and one print. Uses the page, the style and the resolution of `print`.
/// @throws BudgetError if the word is too long to be read
DrawingCost drawing_cost(const Grammar& grammar, const Print& print, const DrawOptions& options);

}  // namespace sikku
