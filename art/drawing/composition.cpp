#include "art/drawing/composition.h"

#include "art/print/ornaments.h"
#include "art/style/contrast.h"
#include "art/style/white_paper.h"
#include "engine/geometry/box.h"
#include "engine/geometry/point_tree.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <optional>
#include <stdexcept>
#include <utility>

namespace sikku {

bool has_ornaments(const Style& style, const DrawingOptions& options) {
    return style.dots || options.colours_strokes || has_line_work(style);
}

Composition::Composition(const Grammar& grammar, std::unique_ptr<WordDrawing> lines, const DrawingOptions& options,
                         const Reading& reading)
    : Drawing(options, reading), lines_(std::move(lines)), drawn_(lines_->style()), style_(drawn_) {
    if (grammar.is_spatial()) {
        throw std::runtime_error(
            "dots, fields, weaves, parallel lines and colours by strand apply only to drawings in the plane");
    }
    if (style_.dots || options.colours_strokes || has_line_work(style_)) examine(grammar);
    if (style_.dots) set_spacing();
    add_colours();
}

void Composition::examine(const Grammar& grammar) {
    if (options_.may_be_empty && !lines_->has_ink()) return;
    if (has_line_work(style_) && !style_.stroked) {
        throw std::runtime_error(
            "fields, weaves and parallel lines need lines, and 'stroke' is none; set a stroke such as 0.1mm");
    }
    KolamOptions examined;
    examined.spline = style_.line == Line::spline;
    examined.moves_lift = style_.moves_lift;
    examined.budget = reading_.budget;
    examined.watch = reading_.watch;
    examined.monitor = reading_.monitor;
    if (has_line_work(style_)) examined.nodes_of_segment = nodes_of_worked_segment;
    examined.draws = [style = drawn_](const Pen& pen) { return style.draws(pen); };
    const KolamExamination examination = examine_kolam(grammar, examined);
    for (const std::uint32_t line : examination.line_of_stroke) {
        orbit_of_stroke_.push_back(examination.orbit_of_line[line]);
    }
    if (has_line_work(style_) && !options_.only_dots) {
        lines_->seen();  // reading splines needs to know which of them are closed
        work_.emplace(*lines_, examination, drawn_, reading_);
    }
    if (!style_.dots) return;
    dots_ = dot_places(examination);
    has_dots_on_lines_ = examination.dots_on_lines() > 0;
    distance_ = least_distance(dots_);
}

void Composition::set_spacing() {
    if (options_.dot_spacing && !(options_.may_be_empty && dots_.size() < 2)) {
        if (!(distance_ > 0)) {
            throw std::runtime_error(fmt::format("dot spacing needs at least two dots; this drawing has {}",
                                                 dots_.empty() ? "none" : std::to_string(dots_.size())));
        }
        options_.placement.step = *options_.dot_spacing / distance_;
    }
    if (dots_.empty() && options_.only_dots && !options_.may_be_empty) {
        throw std::runtime_error("nothing to draw: the lines enclose no dots");
    }
}

void Composition::add_colours() {
    if (options_.colours_strokes) add_stroke_colours();
    if (work_) add_field_colours();
    if (style_.dots) {
        dot_pen_.colour = static_cast<int>(style_.palette.size());
        Colour colour = style_.line_colour({});
        if (options_.only_dots) {
            // For practice on white paper.
            colour = ink_on_paper(style_.ground, is_faint(colour, white_paper) ? deep_earth : colour);
            style_.ground = white_paper;
        }
        style_.palette.push_back(style_.dots->colour.value_or(colour));
    }
}

/// Uses the pattern's palette if its colours distinguish lines, otherwise the kolam colours on dark ground. Omits
/// colours close to the ground.
void Composition::add_stroke_colours() {
    constexpr double least = 0.12;  // in OKLab
    const Colour ground = ground_or_white(style_.ground);
    const auto is_seen = [&](Colour colour) { return colour_distance(colour, ground) >= least; };
    const bool is_dark = lightness(ground) < 0.6;
    if (!is_dark || style_.palette != default_palette()) {
        const std::vector<int> slots = style_.line_slots();
        for (int i = 0; i < static_cast<int>(slots.size()); ++i) {
            const Pen pen{.colour = i};
            if (slots[static_cast<std::size_t>(i)] == i && style_.draws(pen) && is_seen(style_.line_colour(pen))) {
                stroke_colours_.push_back(i);
            }
        }
        if (stroke_colours_.size() > 1) return;
    }
    stroke_colours_.clear();
    for (const Colour colour : is_dark ? kolam_palette() : default_palette()) {
        if (!is_seen(colour)) continue;
        stroke_colours_.push_back(static_cast<int>(style_.palette.size()));
        style_.palette.push_back(colour);
    }
}

void Composition::add_field_colours() {
    std::vector<Colour> lines;  // colours of the lines and the ground
    for (const int colour : stroke_colours_) lines.push_back(style_.palette[static_cast<std::size_t>(colour)]);
    if (lines.empty() && drawn_.stroked) lines.push_back(drawn_.line_colour({}));
    if (drawn_.ground) lines.push_back(*drawn_.ground);
    work_->add_colours(style_.palette, lines);
}

/// Parallel lines are wider than their pen.
const DrawnExtent& Composition::seen() {
    if (extent_) return *extent_;
    extent_ = lines_->seen();
    if (work_ && work_->draws_lines()) {
        extent_->widest += work_->parallel_width();
    }
    return *extent_;
}

void Composition::read(const Print& print, const Window& window, PathSink& sink) const {
    if (work_ && !reading_.is_plot()) work_->draw_fields(sink);
    if (work_ && reading_.is_plot() && reading_.pen->hatch) {
        InkSink ink(print, reading_.pen->pen_width);
        read_lines_and_dots(print, window, ink);
        work_->hatch_fields(print, *reading_.pen, reading_.monitor, ink.ink, sink);
    }
    read_lines_and_dots(print, window, sink);
}

void Composition::read_lines_and_dots(const Print& print, const Window& window, PathSink& sink) const {
    NotedDiscs noted(sink, print.style);
    PathSink& own = dots_.empty() ? sink : noted;
    if (work_ && work_->draws_lines()) {
        OnlyAreas areas(own);
        OldColours old(areas, drawn_);
        lines_->read(print, window, old);
        read_parallel(print, own);
    } else if (options_.colours_strokes && !options_.only_dots) {
        StrokeColours coloured(own, drawn_, stroke_colours_, orbit_of_stroke_);
        lines_->read(print, window, coloured);
    } else if (!options_.only_dots) {
        OldColours old(own, drawn_);
        lines_->read(print, window, old);
    }
    read_dots(print, noted.places, sink);
}

std::vector<int> Composition::hatched_colours() const {
    return work_ ? work_->field_colours() : std::vector<int>();
}

void Composition::read_parallel(const Print& print, PathSink& sink) const {
    work_->draw_lines(print, stroke_colours_, sink);
    const BandLook look = work_->look(print);
    if (look.count < 2) return;
    const double step = print.placement.step;
    const std::scoped_lock lock(reporting_);
    parallel_ = {look.spacing * step, look.wanted * step, look.width * step};
}

/// @param drawn  dots drawn by the pattern itself, which are not repeated
void Composition::read_dots(const Print& print, const std::vector<glm::dvec2>& drawn, PathSink& sink) const {
    const double radius = dot_radius(print);
    std::optional<PointTree> own;
    if (!drawn.empty()) own.emplace(drawn);
    const double nearby = distance_ > 0 ? distance_ / 4 : 0.25;
    std::vector<PointTree::Near> found;
    for (const glm::dvec2 dot : dots_) {
        if (own) own->nearest(dot, nearby, 1, found);
        if (found.empty()) sink.disc(dot, radius, dot_pen_);
    }
}

/// Distance from a dot that is alone to the ink around it, in steps.
double Composition::room_of_dot(const Print& print) const {
    constexpr double unlimited = 1e300;
    if (dots_.size() != 1 || has_dots_on_lines_) return unlimited;
    InkSink sink(print, 0);
    lines_->read(print, whole_page(print.page), sink);
    double least = unlimited;
    for (const Obstacle& ink : sink.ink) {
        least = std::min(least, distance_to_segment(dots_.front(), ink.from, ink.to) - ink.radius);
    }
    return least > 0 ? least : unlimited;
}

/// Radius of a dot in steps.
double Composition::dot_radius(const Print& print) const {
    if (!print.style.dots) return 0;
    const auto& size = print.style.dots->size;
    if (!size) {
        const double usual = distance_ > 0 ? distance_ / 12 : std::min(0.25, room_of_dot(print) / 2);
        // A dot on a line has to stand out from it.
        const double line = print.style.line_width({}, print.placement.step) / print.placement.step;
        return has_dots_on_lines_ ? std::max(usual, line) : usual;
    }
    return size->value / (size->in_steps ? 1.0 : print.placement.step) / 2;
}

void Composition::report(DrawingReport& report) const {
    lines_->report(report);
    report.dots = dots_.size();
    if (work_) report.fields = work_->fields();
    if (work_ && style_.weave) report.woven = work_->crossings();
    if (work_ && work_->draws_lines()) report.strokes = work_->lines();
    report.parallel = parallel_;
    const bool has_one_orbit = std::all_of(orbit_of_stroke_.begin(), orbit_of_stroke_.end(),
                                           [&](std::uint32_t orbit) { return orbit == orbit_of_stroke_.front(); });
    report.has_one_strand_colour =
        options_.colours_strokes && has_one_orbit && !stroke_colours_.empty() &&
        style_.palette[static_cast<std::size_t>(stroke_colours_.front())] == drawn_.line_colour({});
}

}  // namespace sikku
