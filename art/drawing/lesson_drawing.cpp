#include "art/drawing/lesson_drawing.h"

#include "art/print/ornaments.h"
#include "art/raster/raster.h"
#include "art/style/contrast.h"
#include "art/style/white_paper.h"
#include "engine/geometry/lettering.h"
#include "engine/geometry/point_tree.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/mat2x2.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

namespace sikku {
namespace {

constexpr double pale_share = 0.62;                        // share of the ground in earlier lines
constexpr double arrow_loops = 3.5;                        // between two arrow heads
constexpr double least_letters = 1.5, most_letters = 9.0;  // millimetres
constexpr double letters_share = 0.42;                     // share of the pitch
constexpr double most_arm = 1.5, arm_share = 0.26;         // of arrow heads: millimetres, and share of the pitch
constexpr double most_mark = 0.8, mark_share = 0.16;       // radius of the mark at a start
constexpr std::size_t most_numbers = 20;                   // numbered lines of a step; the others follow them
constexpr double caption_letters = 3.2;
constexpr double stem = 0.13;  // share of the height of letters
constexpr double halo = 0.6;   // share of the stem of letters, on either side

/// Adds a colour above all others. Equal colours share a layer, so a different one that looks the same is added.
void add_layer(Style& style, Colour colour) {
    const int step = colour.blue < 128 ? 1 : -1;
    const auto is_known = [&] {
        return std::any_of(style.palette.begin(), style.palette.end(),
                           [&](Colour other) { return other == colour; }) ||
               style.line_colour({}) == colour;
    };
    while (is_known()) colour.blue = static_cast<std::uint8_t>(colour.blue + step);
    style.palette.push_back(colour);
}

/// Ignores polygons.
class NoAreas : public PolygonSink {
public:
    void polygon(std::span<const glm::dvec2>, const Pen&) override {}
    void area(std::span<const glm::dvec2>, const Pen&) override {}
};

/// Converts points in millimetres of the page, y up from its top left corner, into the drawing.
class OnPage : public PathFilter {
public:
    OnPage(PathSink& sink, const Print& print)
        : Forwarding(sink),
          back_(glm::inverse(glm::dmat2x2(print.placement.to_page[0], print.placement.to_page[1]))),
          origin_(print.placement.to_page[2]) {}

    void begin_stroke(glm::dvec2 start, const Pen& pen) override { sink_.begin_stroke(drawn(start), pen); }
    void lines(std::span<const glm::dvec2> ends) override { sink_.lines(drawn(ends)); }
    void curves(std::span<const glm::dvec2> controls) override { sink_.curves(drawn(controls)); }

private:
    glm::dvec2 drawn(glm::dvec2 point) const { return back_ * (glm::dvec2(point.x, -point.y) - origin_); }
    std::span<const glm::dvec2> drawn(std::span<const glm::dvec2> points) {
        points_.clear();
        for (const glm::dvec2 point : points) points_.push_back(drawn(point));
        return points_;
    }

    glm::dmat2x2 back_;
    glm::dvec2 origin_;
    std::vector<glm::dvec2> points_;
};

glm::dvec2 unit(glm::dvec2 way) {
    const double length = glm::length(way);
    return length > 0 ? way / length : glm::dvec2(1.0, 0.0);
}

/// A pen of that width in millimetres.
Pen pen_of(const Print& print, double millimetres, int colour) {
    const StrokeWidth& stroke = print.style.stroke;
    return {millimetres / (stroke.in_steps ? print.placement.step : 1.0) / stroke.unit, true, colour};
}

/// The median distance between neighbouring dots, or without two of them the median loop.
double pitch_of(const HandStrokes& strokes) {
    std::vector<double> sizes;
    if (strokes.dots.size() > 1) {
        std::vector<glm::dvec2> places;
        for (const HandDot& dot : strokes.dots) places.push_back(dot.at);
        const PointTree tree(places);
        std::vector<PointTree::Near> near;
        for (const glm::dvec2 at : places) {
            tree.nearest(at, 1e300, 2, near);
            for (const PointTree::Near& one : near) {
                if (one.square > 0) sizes.push_back(std::sqrt(one.square));
            }
        }
    }
    if (sizes.empty()) {
        for (const HandLine& line : strokes.lines) sizes.push_back(line.loop);
    }
    if (sizes.empty()) return 1;
    const auto middle = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2);
    std::nth_element(sizes.begin(), middle, sizes.end());
    return *middle;
}

/// The colour that stands out most from the ground and the lines.
Colour sign_colour(const Style& style, Colour ground) {
    constexpr std::array<Colour, 5> known = {{{0xf2, 0xb6, 0x32, 255},
                                              {0xd5, 0x5e, 0x00, 255},
                                              {0x00, 0x72, 0xb2, 255},
                                              {0x56, 0xb4, 0xe9, 255},
                                              {0xc2, 0x1e, 0x56, 255}}};
    Colour best = known[0];
    double most = -1;
    for (const Colour colour : known) {
        const double distance =
            std::min(colour_distance(colour, ground), colour_distance(colour, style.line_colour({})));
        if (distance > most + 1e-9) {
            most = distance;
            best = colour;
        }
    }
    return best;
}

}  // namespace

LessonDrawing::LessonDrawing(std::unique_ptr<HandDrawing> drawing, const DrawingOptions& options,
                             const Reading& reading)
    : DerivedDrawing(std::move(drawing), options, reading),
      memo_(options.lesson_memo ? options.lesson_memo : std::make_shared<LessonMemo>()) {
    step_ = options.lesson_step.value_or(0);
    const Colour ground = ground_or_white(style_.ground);
    const int colours = static_cast<int>(drawn_.palette.size());
    pale_begin_ = colours;
    new_begin_ = 2 * colours;
    halo_ = 3 * colours;
    sign_ = halo_ + 1;
    for (int i = 0; i < colours; ++i) {
        const Colour ink = drawn_.line_colour({.colour = i});
        Colour pale = mixed(ink, ground, pale_share);
        pale.alpha = ink.alpha;
        add_layer(style_, pale);
    }
    for (int i = 0; i < colours; ++i) add_layer(style_, drawn_.line_colour({.colour = i}));
    add_layer(style_, {ground.red, ground.green, ground.blue, 255});
    add_layer(style_, sign_colour(drawn_, ground));
}

std::shared_ptr<const LessonPlan> LessonDrawing::plan(const Print& print, const Window& window) const {
    const double step = print.placement.step;
    return memo_->plan(step, print.style.line_width({}, step), [&] {
        LessonPlan plan;
        NoAreas none;
        plan.strokes = by_hand().strokes(print, window, none, &plan.steps);
        plan.pitch = pitch_of(plan.strokes);
        return plan;
    });
}

std::size_t LessonDrawing::count(const Print& print) const {
    return plan(print, whole_page(print.page))->steps.size() + 2;
}

std::vector<glm::dvec2> LessonDrawing::starts(const Print& print) const {
    const auto plan = this->plan(print, whole_page(print.page));
    std::vector<glm::dvec2> starts;
    for (const LessonStep& step : plan->steps) {
        starts.push_back(plan->strokes.lines[step.front().line].nodes[step.front().from].at);
    }
    return starts;
}

void LessonDrawing::read(const Print& print, const Window& window, PathSink& sink) const {
    const auto plan = this->plan(print, window);
    if (step_ > plan->steps.size()) {
        inner_->read(print, window, sink);
        return;
    }
    if (options_.traced) return draw_traced(print, *plan, sink);
    for (std::size_t number = 1; number <= step_; ++number) {
        for (const Stretch& stretch : plan->steps[number - 1]) {
            HandLine line = part_of(plan->strokes.lines[stretch.line], stretch);
            if (number == step_ && share_ < 1) line = beginning_of(line, share_);
            draw_stretch(line, (number == step_ ? new_begin_ : pale_begin_) + drawn_.index(line.pen), sink);
        }
    }
    for (const HandDot& dot : plan->strokes.dots) sink.disc(dot.at, dot.radius, dot.pen);
    draw_signs(print, window, *plan, sink);
}

/// Pale strokes to trace, and a mark where the first stroke begins that is missing, or the first of all.
void LessonDrawing::draw_traced(const Print& print, const LessonPlan& plan, PathSink& sink) const {
    const auto count =
        static_cast<std::size_t>(std::lround(*options_.traced * static_cast<double>(plan.steps.size())));
    for (std::size_t i = 0; i < std::min(count, plan.steps.size()); ++i) {
        for (const Stretch& stretch : plan.steps[i]) {
            const HandLine line = part_of(plan.strokes.lines[stretch.line], stretch);
            draw_stretch(line, pale_begin_ + drawn_.index(line.pen), sink);
        }
    }
    for (const HandDot& dot : plan.strokes.dots) sink.disc(dot.at, dot.radius, dot.pen);
    if (plan.steps.empty()) return;
    const Stretch& next = plan.steps[count < plan.steps.size() ? count : 0].front();
    const HandNode& start = plan.strokes.lines[next.line].nodes[next.from];
    draw_mark(start, mark_of(start, print, plan), sink);
}

/// Radius of the mark at the start of a line, in steps.
double LessonDrawing::mark_of(const HandNode& start, const Print& print, const LessonPlan& plan) const {
    return std::max(1.25 * start.half, std::min(most_mark / print.placement.step, mark_share * plan.pitch));
}

void LessonDrawing::draw_mark(const HandNode& start, double radius, PathSink& sink) const {
    sink.disc(start.at, 1.35 * radius, Pen{.colour = halo_});
    sink.disc(start.at, radius, Pen{.colour = sign_});
}

std::unique_ptr<Rendering> LessonDrawing::rendering(const Print& print, const Window& window) const {
    if (step_ > plan(print, window)->steps.size()) return inner_->rendering(print, window);
    return Drawing::rendering(print, window);
}

void LessonDrawing::draw_stretch(const HandLine& line, int colour, PathSink& sink) const {
    const std::vector<glm::dvec2> controls = hand_middle(line);
    if (controls.empty()) return;
    Pen pen = line.pen;
    pen.colour = colour;
    sink.begin_stroke(line.nodes.front().at, pen);
    sink.curves(controls);
    sink.end_stroke(false);
}

void LessonDrawing::write(const std::string& text, glm::dvec2 start, double height, const Print& print,
                          PathSink& sink) const {
    OnPage page(sink, print);
    for (const auto& [colour, more] : {std::pair(halo_, 2 * halo), std::pair(sign_, 0.0)}) {
        write_text(text, start, height, pen_of(print, stem * height * (1 + more), colour), page);
    }
}

/// @param arm  length of a head in steps
void LessonDrawing::draw_heads(const Print& print, const HandLine& line, double arm, PathSink& sink) const {
    const double heads = std::clamp(std::floor(line.length / (arrow_loops * line.loop)), 1.0, 8.0);
    std::size_t at = 0;
    for (double k = 0; k < heads; ++k) {
        const double along = line.length * (k + 0.62) / heads;
        while (at + 1 < line.size() && line.nodes[at].along < along) ++at;
        const glm::dvec2 middle = line.nodes[at].at, way = unit(hand_direction(line, at)), side(-way.y, way.x);
        const std::array<glm::dvec2, 2> ends = {middle + 0.6 * arm * way,
                                                middle - 0.4 * arm * way - 0.8 * arm * side};
        for (const auto& [colour, more] : {std::pair(halo_, 1.8), std::pair(sign_, 1.0)}) {
            sink.begin_stroke(middle - 0.4 * arm * way + 0.8 * arm * side,
                              pen_of(print, 0.36 * arm * print.placement.step * more, colour));
            sink.lines(ends);
            sink.end_stroke(false);
        }
    }
}

/// Writes a number in free space, as near to the start of a line as possible.
/// @param mark  radius of the mark at the start, in millimetres
void LessonDrawing::write_number(const std::string& text, const HandLine& line, double mark, const Print& print,
                                 const Window& window, const LessonPlan& plan, PathSink& sink) const {
    const double step_length = print.placement.step;
    const auto on_page = [&](glm::dvec2 at) { return glm::dvec2(print.placement.to_page * glm::dvec3(at, 1.0)); };
    const double height = std::min(std::clamp(letters_share * plan.pitch * step_length, least_letters, most_letters),
                                   0.06 * std::min(window.width, window.height));
    const double width = text_width(text, height);
    const glm::dvec2 start = on_page(line.nodes.front().at);
    struct Near {
        glm::dvec2 at;
        double half;
    };
    std::vector<Near> near;
    const double reach = 3 * (mark + height) + width;
    const auto keep = [&](glm::dvec2 at, double half) {
        const glm::dvec2 place = on_page(at);
        if (glm::length(place - start) < reach + half * step_length) near.push_back({place, half * step_length});
    };
    for (const HandLine& other : plan.strokes.lines) {
        for (const HandNode& node : other.nodes) keep(node.at, node.half);
    }
    for (const HandDot& dot : plan.strokes.dots) keep(dot.at, dot.radius);
    glm::dvec2 best = start;
    double most = -1e9;
    for (int k = 0; k < 16; ++k) {
        for (const double far : {1.0, 1.35}) {
            const double angle = (k + 0.5) * std::numbers::pi / 8;
            const double away = far * (mark + 0.75 * height);
            const glm::dvec2 middle = start + away * glm::dvec2(std::cos(angle), std::sin(angle)) +
                                      glm::dvec2(std::cos(angle) * (width - height) / 2, 0);
            double room = std::min({middle.x - width / 2 - window.left, middle.y - height / 2 - window.top,
                                    window.left + window.width - middle.x - width / 2,
                                    window.top + window.height - middle.y - height / 2});
            // A number may cover lines, but it stays on the page.
            if (room < 0) room -= 1e3;
            for (const Near& other : near) {
                const glm::dvec2 off = glm::abs(other.at - middle) - glm::dvec2(width, height) / 2.0;
                room = std::min(room, std::max(off.x, off.y) - other.half);
            }
            if (room > most + 1e-6) {
                most = room;
                best = middle;
            }
        }
    }
    write(text, {best.x - width / 2, -(best.y + height / 2)}, height, print, sink);
}

/// Start marks, arrow heads, numbers, and the number of the step among all.
void LessonDrawing::draw_signs(const Print& print, const Window& window, const LessonPlan& plan,
                               PathSink& sink) const {
    if (step_ == 0) return;
    const double step_length = print.placement.step;
    if (numbers_pages_) {
        const std::string caption = fmt::format("{} / {}", step_, plan.steps.size());
        const double height = std::min(caption_letters, 0.4 * std::max(window.margin, 5.0));
        const double right = window.left + window.width - std::max(window.margin, 4.0);
        write(
            caption,
            {right - text_width(caption, height), -(window.top + window.height - 0.6 * std::max(window.margin, 4.0))},
            height, print, sink);
    }
    const LessonStep& step = plan.steps[step_ - 1];
    std::vector<HandLine> lines;
    for (const Stretch& stretch : step) lines.push_back(part_of(plan.strokes.lines[stretch.line], stretch));
    for (const HandLine& line : lines) {
        const double half = line.nodes.front().half;
        const double arm = std::min(std::max(2.4 * half, most_arm / step_length), arm_share * plan.pitch);
        draw_heads(print, line, std::max(arm, 1.6 * half), sink);
    }
    std::size_t part = 0;
    for (const HandLine& line : lines) {
        reading_.monitor.check();
        ++part;
        const double mark = mark_of(line.nodes.front(), print, plan);
        draw_mark(line.nodes.front(), mark, sink);
        if (part > most_numbers) continue;
        const std::string text = lines.size() > 1 ? fmt::format("{}.{}", step_, part) : std::to_string(step_);
        write_number(text, line, mark * step_length, print, window, plan, sink);
    }
}

}  // namespace sikku
