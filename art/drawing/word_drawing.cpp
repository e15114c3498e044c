#include "art/drawing/word_drawing.h"

#include "art/drawing/extent_sink.h"
#include "art/drawing/ink_shape.h"
#include "art/drawing/plot_scene.h"
#include "art/raster/raster.h"
#include "art/space/solid_raster.h"
#include "art/space/solids.h"
#include "engine/derivation/derivation.h"
#include "engine/derivation/forecast.h"
#include "engine/geometry/spline.h"
#include "engine/geometry/turtle.h"
#include "engine/language/surface.h"
#include "engine/measure/fold.h"

#include <fmt/format.h>
#include <glm/vec3.hpp>

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace sikku {
namespace {

/// A part of a scene takes the memory and time of about this many nodes.
constexpr double nodes_of_kept_part = 10;

DerivationOptions interpreted(const ReadingLimits& limits) {
    DerivationOptions derivation;
    derivation.interpreted = true;
    derivation.limit_whole_words(limits.budget);
    derivation.watch = limits.watch;
    return derivation;
}

/// Stems, spheres and patches that are kept, as far as they are known beforehand.
double parts_of(const Grammar& grammar) {
    const auto known = estimate(grammar, true);
    if (!known) return 0;
    double parts = drawn_symbols(grammar, *known) + label_lines(grammar, *known);
    for (std::size_t i = 0; i < std::min(known->rough_counts.size(), grammar.symbols().size()); ++i) {
        const Command& command = grammar.symbols()[i].command;
        if (command.action != Action::surface) continue;
        const auto patches = static_cast<double>(grammar.surfaces()[command.surface]->patches.size());
        parts += known->rough_counts[i] * (parts_of_patch * patches - 1);
    }
    return parts;
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
        "drawings in space are held in memory, and this one has {:.3g} segments, spheres and parts of surfaces "
        "(n = {}); "
        "the budget allows "
        "{:.0f}, up to n = {}",
        parts, grammar.steps(), most, fits));
}

}  // namespace

Grammar resolved(const Grammar& given, const ReadingLimits& limits) {
    DerivationOptions whole_words;
    whole_words.limit_whole_words(limits.budget);
    whole_words.watch = limits.watch;
    return resolve_contexts(shorten(given), whole_words);
}

Scene read_scene(const Grammar& grammar, const Style& style, const ReadingLimits& limits, double nodes_of_part) {
    const double most = limits.budget / nodes_of_part;
    require_room(grammar, most);
    return Scene::of(grammar, style, interpreted(limits), most);
}

WordDrawing::WordDrawing(const Grammar& grammar, const Style& style, const DrawingOptions& options,
                         const Reading& reading)
    : Drawing(options, reading),
      grammar_(std::make_shared<const Grammar>(resolved(grammar, reading))),
      style_(style),
      spline_(style.line == Line::spline) {
    require_affordable(*grammar_, true, reading.budget);
    drawn_style_ = grammar_->is_spatial() && reading.is_vector && !reading.is_plot() ? with_shades(style) : style;
    if (grammar_->is_spatial() && spline_) {
        throw std::runtime_error(
            "'line: spline' is for drawings in the plane; this one pitches, rolls, bends or has surfaces");
    }
    const std::vector<char> reached = grammar_->reachable();
    for (std::size_t i = 0; i < reached.size(); ++i) {
        if (!reached[i]) continue;
        switch (grammar_->symbols()[i].command.action) {
            case Action::push:
            case Action::pop:
                has_brackets_ = true;
                break;
            case Action::edge_begin:
                has_edges_ = true;
                has_areas_ = true;
                break;
            case Action::polygon_begin:
            case Action::disc:
                has_areas_ = true;
                break;
            case Action::label:
                has_labels_ = true;
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

double WordDrawing::scale() const {
    return options_.placement.scale * grammar_->scale_percent() / 100;
}

std::optional<SpaceBounds> WordDrawing::bounds() const {
    if (!scene_ || scene_->empty()) return std::nullopt;
    return scene_->bounds();
}

const DrawnExtent& WordDrawing::seen() {
    if (extent_) return *extent_;
    const DrawnExtent found = measured();
    has_ink_ = !found.box.empty();
    return extent_.emplace(placed_extent(found, options_, is_outside_));
}

Balance WordDrawing::balance() const {
    if (grammar_->is_spatial() || options_.window) return {};
    InkShape shape(style_);
    read({}, {}, shape);
    return balance_of(shape.hull(), shape.centre());
}

bool WordDrawing::has_ink() {
    seen();
    return has_ink_;
}

DrawnExtent WordDrawing::measured() {
    if (grammar_->is_spatial()) {
        if (reading_.begin) reading_.begin(1);
        scene_ = std::make_shared<const Scene>(read_scene(*grammar_, style_, reading_, nodes_of_kept_part));
        const SceneExtent found = extent_of(*scene_, style_, orientation(options_.placement), reading_.monitor);
        return {found.box, found.widest};
    }
    // The extent of straight lines that are all visible comes from the fold; a spline without brackets and lifts is
    // one stroke, and the fold determines whether it closes.
    const bool folds_extent = !spline_ && !has_areas_ && !has_widths_ && !has_labels_ && all_lines_are_seen();
    std::optional<Fold> folded;
    const bool is_one_stroke = spline_ && !has_brackets_ && !has_edges_ && style_.moves_draw();
    if (folds_extent || is_one_stroke) folded = fold(*grammar_);
    const bool takes_census = spline_ && !folded;
    const bool reads_extent = spline_ || !folded;
    if (reading_.begin) reading_.begin(1 + (takes_census ? 1 : 0) + (reads_extent ? 1 : 0));

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
        return reading_.is_plot() ? plot_scene(*scene_, print, *reading_.pen, sink, reading_.monitor)
                                  : draw_solids(*scene_, print, sink, reading_.monitor);
    }
    if (!spline_) return read_straight(sink);
    SplineSink spline(sink, closed_);
    const auto turtle = Turtle::outlining(*grammar_, spline, spline, style_.moves_draw());
    derive(*grammar_, *turtle, interpreted(reading_));
}

void WordDrawing::read_straight(PathSink& sink) const {
    const auto turtle = Turtle::drawing(*grammar_, sink, style_.moves_draw());
    derive(*grammar_, *turtle, interpreted(reading_));
}

std::unique_ptr<Rendering> WordDrawing::rendering(const Print& print, const Window& window) const {
    return scene_ ? make_solid_raster(*scene_, print) : Drawing::rendering(print, window);
}

void WordDrawing::report(DrawingReport& report) const {
    report.is_empty = is_outside_;
}

/// True if lines are visible in every colour that may occur.
bool WordDrawing::all_lines_are_seen() const {
    const int colours = has_colours_ ? static_cast<int>(style_.palette.size()) : 1;
    for (int colour = 0; colour < colours; ++colour) {
        if (!style_.draws(Pen{.colour = colour})) return false;
    }
    return true;
}

}  // namespace sikku
