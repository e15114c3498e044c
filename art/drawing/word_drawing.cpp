#include "art/drawing/word_drawing.h"

#include "art/drawing/ink_shape.h"
#include "art/drawing/plot_scene.h"
#include "art/space/solid_raster.h"
#include "art/space/solids.h"
#include "engine/derivation/derivation.h"
#include "engine/derivation/forecast.h"
#include "engine/geometry/spline.h"
#include "engine/geometry/turtle.h"
#include "engine/measure/fold.h"

#include <fmt/format.h>
#include <glm/vec3.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace sikku {
namespace {

/// The box of what can be seen of a drawing as it will lie on the page, and its widest pen.
class ExtentSink : public PathSink {
public:
    ExtentSink(const Style& style, const glm::dmat3x2& orientation) : style_(style), orientation_(orientation) {}

    void begin_stroke(glm::dvec2 start, const Pen& pen) override {
        change_pen(pen);
        at_ = turned(start);
    }
    void lines(std::span<const glm::dvec2> ends) override {
        if (ends.empty()) return;
        if (draws_) {
            begin_line();
            for (const glm::dvec2 end : ends) box.add(turned(end));
        }
        at_ = turned(ends.back());
    }
    void curves(std::span<const glm::dvec2> controls) override {
        if (controls.size() < 3) return;
        if (!draws_) {
            at_ = turned(controls.back());
            return;
        }
        begin_line();
        add_curves(controls);
    }
    void change_pen(const Pen& pen) override {
        draws_ = style_.draws(pen);
        width_ = style_.pen_width(pen);
    }
    void end_stroke(bool) override {}
    void polygon(std::span<const glm::dvec2> vertices, const Pen& pen) override {
        if (style_.fill_colour(pen).alpha == 0) return;
        for (const glm::dvec2 vertex : vertices) box.add(turned(vertex));
    }
    void area(std::span<const glm::dvec2> outline, const Pen& pen) override {
        if (style_.fill_colour(pen).alpha == 0 || outline.empty()) return;
        const glm::dvec2 at = std::exchange(at_, turned(outline.front()));
        box.add(at_);
        add_curves(outline.subspan(1));
        at_ = at;
    }
    void disc(glm::dvec2 centre, double radius, const Pen& pen) override {
        if (style_.fill_colour(pen).alpha == 0) return;
        // A dot is twice as wide as the line.
        const double dot = radius > 0.0 ? 0.0 : 2 * style_.pen_width(pen);
        if (!(radius + dot > 0.0)) return;
        widest = std::max(widest, dot);
        const glm::dvec2 at = turned(centre);
        box.add(at - glm::dvec2(radius));
        box.add(at + glm::dvec2(radius));
    }

    Box box;
    double widest = 0.0;  ///< of pens and dots, in the measure of the style's stroke

private:
    glm::dvec2 turned(glm::dvec2 point) const { return orientation_ * glm::dvec3(point, 1.0); }

    /// Only now, as the pen may have been changed before anything was drawn with it.
    void begin_line() {
        box.add(at_);
        widest = std::max(widest, width_);
    }

    /// From at_.
    void add_curves(std::span<const glm::dvec2> controls) {
        for (std::size_t i = 0; i + 2 < controls.size(); i += 3) {
            const std::array<glm::dvec2, 4> b = {at_, turned(controls[i]), turned(controls[i + 1]),
                                                 turned(controls[i + 2])};
            box.add(b[3]);
            for (int axis = 0; axis < 2; ++axis) {
                const auto inside = [&](double value) { return value >= box.low[axis] && value <= box.high[axis]; };
                if (!inside(b[1][axis]) || !inside(b[2][axis])) add_extremes(b, axis);
            }
            at_ = b[3];
        }
    }

    /// Where the curve's derivative along `axis` vanishes.
    void add_extremes(const std::array<glm::dvec2, 4>& b, int axis) {
        const double p = b[1][axis] - b[0][axis];
        const double q = b[2][axis] - b[1][axis];
        const double r = b[3][axis] - b[2][axis];
        const double square = p - 2 * q + r;
        const double half = q - p;
        const double root = std::sqrt(std::max(0.0, half * half - square * p));
        for (const double t : {square == 0 ? -p / (2 * half) : (-half + root) / square,
                               square == 0 ? -1.0 : (-half - root) / square}) {
            if (!(t > 0 && t < 1)) continue;
            const double s = 1 - t;
            box.add(s * s * s * b[0] + 3 * s * s * t * b[1] + 3 * s * t * t * b[2] + t * t * t * b[3]);
        }
    }

    const Style& style_;
    glm::dmat3x2 orientation_;
    glm::dvec2 at_{0.0};
    bool draws_ = false;
    double width_ = 0.0;
};

/// Keeping a part of a scene takes the memory and time of about so many nodes.
constexpr double nodes_of_kept_part = 10;

DerivationOptions reading(const DrawOptions& options) {
    DerivationOptions derivation;
    derivation.interpreted = true;
    derivation.limit_whole_words(options.budget);
    derivation.watch = options.watch;
    return derivation;
}

/// Stems and spheres that are kept, as far as they are known beforehand.
double parts_of(const Grammar& grammar) {
    const auto known = estimate(grammar, true);
    return known ? drawn_symbols(grammar, *known) : 0;
}

/// @throws BudgetError, if there are more parts of a scene than `most`, before they are read
void require_room(const Grammar& grammar, double most) {
    const double parts = parts_of(grammar);
    if (parts <= most) return;
    std::int64_t fits = grammar.steps();
    for (bool is_found = false; !is_found && fits > 0;) {
        const auto other = grammar.with_steps(--fits);
        is_found = other && parts_of(*other) <= most;
    }
    throw BudgetError(fmt::format(
        "drawings in space are kept whole, and this one has {:.3g} segments and spheres (n = {}); the budget allows "
        "{:.0f}, up to n = {}",
        parts, grammar.steps(), most, fits));
}

}  // namespace

Grammar resolved(const Grammar& given, const DrawOptions& options) {
    DerivationOptions whole_words;
    whole_words.limit_whole_words(options.budget);
    whole_words.watch = options.watch;
    return resolve_contexts(shorten(given), whole_words);
}

Scene read_scene(const Grammar& grammar, const Style& style, const DrawOptions& options, double nodes_of_part) {
    const double most = options.budget / nodes_of_part;
    require_room(grammar, most);
    return Scene::of(grammar, style, reading(options), most);
}

void require_ink(const Box& box) {
    if (!box.empty()) return;
    throw std::runtime_error("nothing to draw: the word contains no visible line, polygon or disc");
}

DrawnExtent window_extent(const ViewWindow& window, const glm::dmat3x2& orientation) {
    DrawnExtent extent;
    for (const Quad x : {window.x0, window.x1}) {
        for (const Quad y : {window.y0, window.y1}) {
            extent.box.add(orientation * glm::dvec3(static_cast<double>(x), static_cast<double>(y), 1.0));
        }
    }
    return extent;
}

WordDrawing::WordDrawing(const Grammar& grammar, const Style& style, const DrawOptions& options)
    : Drawing(options), grammar_(resolved(grammar, options)), style_(style), spline_(style.line == Line::spline) {
    require_affordable(grammar_, true, options.budget);
    drawn_style_ = grammar_.is_spatial() && is_vector(options.format) && !is_plot() ? with_shades(style) : style;
    if (grammar_.is_spatial() && spline_) {
        throw std::runtime_error("'line: spline' is for drawings in the plane; this one pitches, rolls or bends");
    }
    const std::vector<char> reached = grammar_.reachable();
    for (std::size_t i = 0; i < reached.size(); ++i) {
        if (!reached[i]) continue;
        switch (grammar_.symbols()[i].command.action) {
            case Action::push:
            case Action::pop:
                has_brackets_ = true;
                break;
            case Action::polygon_begin:
            case Action::disc:
                has_areas_ = true;
                break;
            case Action::width_factor:
            case Action::width_set:
                has_widths_ = true;
                break;
            case Action::colour_step:
            case Action::colour_set:
                has_colours_ = true;
                break;
            default:
                break;
        }
    }
}

std::optional<SpaceBounds> WordDrawing::bounds() const {
    if (!scene_ || scene_->empty()) return std::nullopt;
    return scene_->bounds();
}

const DrawnExtent& WordDrawing::seen() {
    if (extent_) return *extent_;
    DrawnExtent found = measured();
    has_ink_ = !found.box.empty();
    if (options_.window) {
        const DrawnExtent window = window_extent(*options_.window, orientation(options_.placement));
        const auto is_apart = [&](int axis) {
            return found.box.low[axis] > window.box.high[axis] || found.box.high[axis] < window.box.low[axis];
        };
        is_outside_ = is_apart(0) || is_apart(1);
        found = {window.box, window.widest, found.widest};
    }
    return extent_.emplace(found);
}

Balance WordDrawing::balance() const {
    if (grammar_.is_spatial() || options_.window) return {};
    InkShape shape(style_);
    read({}, {}, shape);
    return balance_of(shape.hull(), shape.centre());
}

bool WordDrawing::has_ink() {
    seen();
    return has_ink_;
}

DrawnExtent WordDrawing::measured() {
    if (grammar_.is_spatial()) {
        if (options_.begin) options_.begin(1);
        scene_ = read_scene(grammar_, style_, options_, nodes_of_kept_part);
        const SceneExtent found = extent_of(*scene_, style_, orientation(options_.placement), options_.monitor);
        return {found.box, found.widest};
    }
    // The extent of straight lines that are all visible comes from the fold; a spline without brackets and lifts is
    // one stroke, and is folded for whether it closes.
    const bool folds_extent = !spline_ && !has_areas_ && !has_widths_ && all_lines_are_seen();
    std::optional<Fold> folded;
    const bool is_one_stroke = spline_ && !has_brackets_ && style_.moves_draw();
    if (folds_extent || is_one_stroke) folded = fold(grammar_);
    const bool takes_census = spline_ && !folded;
    const bool reads_extent = spline_ || !folded;
    if (options_.begin) options_.begin(1 + (takes_census ? 1 : 0) + (reads_extent ? 1 : 0));

    if (takes_census) {
        StrokeCensus census;
        read_straight(census);
        closed_ = std::move(census.closed);
    } else if (spline_) {
        closed_ = {folded->closed};
    }
    const glm::dmat3x2 turned = orientation(options_.placement);
    ExtentSink extent(style_, turned);
    if (!reads_extent) {
        for (const glm::dvec2 corner : folded->ink_hull) extent.box.add(turned * glm::dvec3(corner, 1.0));
        extent.widest = style_.pen_width({});
    } else {
        read({}, {}, extent);
    }
    return {extent.box, extent.widest};
}

void WordDrawing::read(const Print& print, const Window&, PathSink& sink) const {
    if (scene_) {
        return is_plot() ? plot_scene(*scene_, print, options_.plot.value_or(PlotOptions{}), sink, options_.monitor)
                         : draw_solids(*scene_, print, sink, options_.monitor);
    }
    if (!spline_) return read_straight(sink);
    SplineSink spline(sink, closed_);
    const auto turtle = Turtle::outlining(grammar_, spline, spline, style_.moves_draw());
    derive(grammar_, *turtle, reading(options_));
}

void WordDrawing::read_straight(PathSink& sink) const {
    const auto turtle = Turtle::drawing(grammar_, sink, style_.moves_draw());
    derive(grammar_, *turtle, reading(options_));
}

std::unique_ptr<Rendering> WordDrawing::rendering(const Print& print, const Window& window) const {
    return scene_ ? make_solid_raster(*scene_, print) : Drawing::rendering(print, window);
}

void WordDrawing::report(DrawReport& report) const {
    report.is_empty = is_outside_;
}

bool WordDrawing::is_plot() const {
    return options_.plot || is_for_plotters(options_.format);
}

/// In every colour that may occur.
bool WordDrawing::all_lines_are_seen() const {
    const int colours = has_colours_ ? static_cast<int>(style_.palette.size()) : 1;
    for (int colour = 0; colour < colours; ++colour) {
        if (!style_.draws(Pen{.colour = colour})) return false;
    }
    return true;
}

}  // namespace sikku
