#include "art/drawing/hand_drawing.h"

#include "art/print/ornaments.h"
#include "art/raster/raster.h"

#include <algorithm>
#include <utility>

namespace sikku {
namespace {

constexpr double nodes_of_curve = 400;  // memory and time of a curve that is kept, in derivation nodes

}  // namespace

HandDrawing::HandDrawing(std::unique_ptr<Drawing> drawing, std::uint64_t seed, const DrawingOptions& options,
                         const Reading& reading)
    : DerivedDrawing(std::move(drawing), options, reading) {
    hand_.strength = style_.hand;
    hand_.seed = seed;
    hand_.monitor = reading.monitor;
    // Outlines are filled in the colours of lines.
    if (hand_.strength > 0 && style_.fill_colour({}) != style_.line_colour({}))
        style_.palette.push_back(style_.line_colour({}));
}

const DrawnExtent& HandDrawing::seen() {
    if (!extent_) {
        extent_ = inner_->seen();
        // Lines swell and waver.
        const double more = 1 + 0.6 * hand_.strength;
        extent_->widest *= more;
        extent_->around *= more;
    }
    return *extent_;
}

HandStrokes HandDrawing::strokes(const Print& print, const Window& window, PathSink& fills,
                                 std::vector<LessonStep>* steps) const {
    const double step = print.placement.step;
    HandGatherer gatherer(print.style, step, reading_.budget / nodes_of_curve);
    if (steps) gatherer.limit(most_lesson_lines, most_lesson_points);
    OldColours coloured(gatherer, drawn_);
    inner_->read(print, window, coloured);
    HandStrokes strokes{std::move(gatherer.gathered), std::move(gatherer.dots)};
    order_by_hand(strokes.lines);
    if (steps) *steps = lesson_steps(strokes.lines, options_.most_steps);
    draw_by_hand(strokes.lines, strokes.dots, gatherer.fills, hand_);
    for (const HandFill& fill : gatherer.fills) {
        if (fill.is_polygon) {
            fills.polygon(fill.outline, fill.pen);
        } else {
            fills.area(fill.outline, fill.pen);
        }
    }
    return strokes;
}

void HandDrawing::read(const Print& print, const Window& window, PathSink& sink) const {
    if (!(hand_.strength > 0)) {
        OldColours coloured(sink, drawn_);
        inner_->read(print, window, coloured);
        return;
    }
    const HandStrokes strokes = this->strokes(print, window, sink);
    if (reading_.is_plot()) {
        read_middles(strokes, sink);
    } else {
        read_outlines(print, strokes, sink);
    }
}

void HandDrawing::read_middles(const HandStrokes& strokes, PathSink& sink) const {
    for (const HandLine& line : strokes.lines) {
        const std::vector<glm::dvec2> controls = hand_middle(line);
        if (controls.empty()) continue;
        sink.begin_stroke(line.nodes.front().at, line.pen);
        sink.curves(controls);
        sink.end_stroke(line.closed);
    }
    for (const HandDot& dot : strokes.dots) sink.disc(dot.at, dot.radius, dot.pen);
}

void HandDrawing::read_outlines(const Print& print, const HandStrokes& strokes, PathSink& sink) const {
    // One colour after the other, as in every print.
    const std::vector<int> slots = style_.line_slots();
    std::vector<const HandLine*> lines;
    for (const HandLine& line : strokes.lines) lines.push_back(&line);
    const auto slot_of = [&](const HandLine* line) {
        return slots[static_cast<std::size_t>(style_.index(line->pen))];
    };
    std::stable_sort(lines.begin(), lines.end(),
                     [&](const HandLine* a, const HandLine* b) { return slot_of(a) < slot_of(b); });
    const auto write_dots = [&] {
        for (std::size_t i = 0; i < strokes.dots.size(); ++i) {
            sink.area(dot_outline(strokes.dots[i], i, hand_), strokes.dots[i].pen);
        }
    };
    // A hand sets the dots first; in a picture they lie on top.
    if (print.animation) write_dots();
    for (const HandLine* line : lines) {
        hand_.monitor.check();
        const HandLine stroke = drawn_stroke(*line, hand_);
        Pen pen = line->pen;
        if (style_.palette.size() > drawn_.palette.size() && style_.index(pen) == 0) {
            pen.colour = static_cast<int>(drawn_.palette.size());
        }
        const std::size_t last = stroke.size() - 1;
        if (!print.animation) {
            sink.area(hand_outline(stroke, 0, last), pen);
            continue;
        }
        for (std::size_t from = 0; from < last;) {
            std::size_t to = from + 1;
            const double length = 1.6 * stroke.nodes[from].half;
            while (to < last && stroke.nodes[to].along - stroke.nodes[from].along < length) ++to;
            sink.area(hand_outline(stroke, from, to), pen);
            from = to;
        }
    }
    if (!print.animation) write_dots();
}

std::unique_ptr<Rendering> HandDrawing::rendering(const Print& print, const Window& window) const {
    if (!(hand_.strength > 0)) return Drawing::rendering(print, window);
    auto raster = make_raster(print);
    lay_flour(strokes(print, window, *raster), hand_, print, *raster);
    return raster;
}

}  // namespace sikku
