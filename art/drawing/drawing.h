// art/drawing/drawing.h: the interface of all drawings, which are placed on a page and then read.
#pragma once

#include "art/drawing/drawing_options.h"
#include "art/drawing/drawing_report.h"
#include "art/drawing/reading.h"
#include "art/print/print.h"
#include "engine/geometry/space_bounds.h"

#include <memory>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

namespace sikku {

class Rendering;

/// Calculates the placement of `print` on its page, including the width of the pen, whose unit `stroke` gives.
/// @throws std::runtime_error if the margins leave no room
DrawingReport place_print(Print& print, const DrawnExtent& seen, const StrokeWidth& stroke,
                          const PlacementOptions& placement);

/// The whole page of a print, with its margin.
Window whole_page(const Page& page);

/// Converts a window of the page, widened by `around` millimetres, into the coordinates of the drawing.
Box seen_box(const Print& print, const Window& window, double around);

/// Heights in millimetres, within the margins.
struct TextSpace {
    double above = 0, below = 0;
    double total() const { return above + below; }
};

/// A drawing that is placed once and then read any number of times, with the same strokes each time. Implementations
/// read the word (WordDrawing), draw only the visible parts (SeenDrawing), add dots and colours to another drawing
/// (Composition), or frame it (FramedDrawing); make_drawing() combines them.
class Drawing {
public:
    Drawing(const DrawingOptions& options, const Reading& reading) : options_(options), reading_(reading) {}
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
    /// Space for lines of text above and below the drawing and its border. @throws SettingError if they are too high
    virtual TextSpace text_space(const Page&) const { return {}; }
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
    DrawingReport place(Print& print);

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
    std::unique_ptr<Rendering> rendering(const Print& print) const;

    /// Palette indices of the fields between lines, which plots hatch before they draw anything else; -1 for none.
    virtual std::vector<int> hatched_colours() const { return {}; }

    /// Adds the findings of read() and the renderings so far to a report.
    virtual void report(DrawingReport&) const {}

protected:
    /// @param points  with the same convex hull as the drawing @param centre  centre of mass; both in its coordinates
    Balance balance_of(const std::vector<glm::dvec2>& points, glm::dvec2 centre) const;

    DrawingOptions options_;
    Reading reading_;

private:
    double around_ = 0;  ///< widest pen of lines that continue outside a window, in the unit of the style's stroke
};

/// A drawing made of another one, with its step. Has the properties and the findings of the other by default.
class DerivedDrawing : public Drawing {
public:
    DerivedDrawing(std::unique_ptr<Drawing> inner, const DrawingOptions& options, const Reading& reading)
        : Drawing(options, reading), inner_(std::move(inner)), drawn_(inner_->style()), style_(drawn_) {
        options_.placement.step = inner_->fixed_step();
    }

    const DrawnExtent& seen() override { return inner_->seen(); }
    const Style& style() const override { return style_; }
    double scale() const override { return inner_->scale(); }
    Balance balance() const override { return inner_->balance(); }
    double border_space(const Page& page) const override { return inner_->border_space(page); }
    TextSpace text_space(const Page& page) const override { return inner_->text_space(page); }
    double dot_distance() const override { return inner_->dot_distance(); }
    std::vector<int> hatched_colours() const override { return inner_->hatched_colours(); }
    void report(DrawingReport& report) const override { inner_->report(report); }

protected:
    std::unique_ptr<Drawing> inner_;
    Style drawn_;  ///< the style of the other drawing, with its own palette
    Style style_;  ///< with the colours that this drawing adds
};

/// Thrown if nothing is drawn.
class NothingDrawn : public std::runtime_error {
public:
    NothingDrawn()
        : std::runtime_error("nothing to draw: the word contains no visible line, polygon, disc or label") {}
};
/// @throws NothingDrawn if the box is empty
void require_ink(const Box& box);

}  // namespace sikku
