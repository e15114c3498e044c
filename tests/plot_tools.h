// tests/plot_tools.h: what the tests of plots share: patterns on a page, lines as dense points, how far they are
// apart.
#pragma once

#include "art/drawing/word_drawing.h"
#include "art/plotter/plot.h"
#include "engine/geometry/point_tree.h"
#include "tests/print_tools.h"
#include "tests/reference.h"

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <cmath>
#include <limits>
#include <memory>
#include <string>
#include <vector>

namespace sikku {

/// A bundled pattern, placed on a page.
struct PlacedPattern {
    PlacedPattern(const std::string& name, std::int64_t steps, const Page& page) {
        Diagnostics diagnostics;
        const std::string file = std::string(SIKKU_SOURCE_DIR) + "/patterns/" + name + ".lsys";
        const Pattern pattern = parse_pattern(file, contents(file), diagnostics);
        Grammar grammar = compile_grammar(pattern, diagnostics);
        if (steps >= 0) grammar = grammar.with_steps(steps).value();
        print.style = read_style(pattern, 300.0, diagnostics);
        diagnostics.throw_if_errors();
        print.page = page;
        print.title = pattern.text("title");
        drawing = std::make_unique<WordDrawing>(grammar, print.style, DrawingOptions{}, Reading{});
        drawing->place(print);
    }
    void read(PathSink& sink) const { drawing->read(print, sink); }

    Print print;
    std::unique_ptr<Drawing> drawing;
};

/// Arranges what `draw(sink)` draws.
template <typename Draw>
std::unique_ptr<PlotPlan> arranged(const Print& print, Draw&& draw, const PlotOptions& options = {}) {
    auto plan = std::make_unique<PlotPlan>(print, options);
    draw(*plan);
    plan->arrange();
    return plan;
}

/// Points of a line `spacing` apart or closer.
class Samples {
public:
    explicit Samples(double spacing) : spacing_(spacing) {}
    void start(glm::dvec2 at) { points = {at}; }
    void line(glm::dvec2 end) {
        const glm::dvec2 start = points.back();
        const int count = static_cast<int>(std::ceil(glm::distance(start, end) / spacing_)) + 1;
        for (int i = 1; i <= count; ++i) points.push_back(start + (end - start) * (static_cast<double>(i) / count));
    }
    void curve(glm::dvec2 first, glm::dvec2 second, glm::dvec2 end) {
        const glm::dvec2 b = points.back();
        const double length = glm::distance(b, first) + glm::distance(first, second) + glm::distance(second, end);
        const int count = static_cast<int>(std::ceil(3 * length / spacing_)) + 1;
        for (int i = 1; i <= count; ++i) {
            const double t = static_cast<double>(i) / count;
            const double s = 1 - t;
            points.push_back(s * s * s * b + 3 * s * s * t * first + 3 * s * t * t * second + t * t * t * end);
        }
    }
    void arc(glm::dvec2 centre, glm::dvec2 end, bool left) {
        const glm::dvec2 from = points.back() - centre;
        const glm::dvec2 to = end - centre;
        double sweep = std::atan2(from.x * to.y - from.y * to.x, glm::dot(from, to));
        if (left && sweep <= 0) sweep += 2 * std::numbers::pi;
        if (!left && sweep >= 0) sweep -= 2 * std::numbers::pi;
        const int count = static_cast<int>(std::ceil(std::fabs(sweep) * glm::length(from) / spacing_)) + 1;
        const double angle = std::atan2(from.y, from.x);
        for (int i = 1; i <= count; ++i) {
            const double a = angle + sweep * i / count;
            points.push_back(centre + glm::length(from) * glm::dvec2(std::cos(a), std::sin(a)));
        }
        points.push_back(end);
    }

    std::vector<glm::dvec2> points;

private:
    double spacing_;
};

/// Where the strokes ought to be, in millimetres from the bottom left corner of the page.
inline std::vector<std::vector<glm::dvec2>> true_lines(const PlotPlan& plan, const Print& print, double spacing) {
    reference::Recorder recorder;
    plan.draw(recorder);
    std::vector<std::vector<glm::dvec2>> lines;
    for (const reference::Line& stroke : recorder.strokes) {
        std::vector<glm::dvec2> points;
        for (const glm::dvec2 point : stroke.points) {
            const glm::dvec2 down = print.placement.to_page * glm::dvec3(point, 1.0);
            points.emplace_back(down.x, print.page.height - down.y);
        }
        Samples samples(spacing);
        samples.start(points[0]);
        if (points.size() == stroke.pens.size() + 1) {
            for (std::size_t i = 1; i < points.size(); ++i) samples.line(points[i]);
        } else {
            EXPECT_EQ(points.size(), 3 * stroke.pens.size() + 1) << "lines and curves in one stroke";
            for (std::size_t i = 1; i + 2 < points.size(); i += 3) {
                samples.curve(points[i], points[i + 1], points[i + 2]);
            }
        }
        lines.push_back(std::move(samples.points));
    }
    return lines;
}

/// The farthest that a point of one line lies from those of the other, both ways.
inline double hausdorff(const std::vector<glm::dvec2>& a, const std::vector<glm::dvec2>& b) {
    double worst = 0;
    std::vector<PointTree::Near> near;
    for (const auto& [from, to] : {std::pair{&a, &b}, std::pair{&b, &a}}) {
        const PointTree tree(*to);
        for (const glm::dvec2 point : *from) {
            tree.nearest(point, std::numeric_limits<double>::infinity(), 1, near);
            worst = std::max(worst, near.at(0).square);
        }
    }
    return std::sqrt(worst);
}

/// Random curves that hang together smoothly, loops and spirals, on a page of 100 x 60 mm.
inline void draw_curves(PathSink& sink) {
    std::mt19937 random(11);
    std::uniform_real_distribution<double> share(0.15, 0.85);
    const auto anywhere = [&] {
        const double x = 100 * share(random);
        return glm::dvec2(x, 60 * share(random));
    };
    for (int stroke = 0; stroke < 9; ++stroke) {
        const glm::dvec2 start = anywhere();
        std::vector<glm::dvec2> controls = {anywhere(), anywhere(), anywhere()};
        for (int i = 0; i < stroke; ++i) {
            controls.push_back(controls.back() + 0.3 * (controls.back() - controls[controls.size() - 2]));
            controls.push_back(anywhere());
            controls.push_back(anywhere());
        }
        for (glm::dvec2& point : controls) point = glm::clamp(point, glm::dvec2(0.0), glm::dvec2(100.0, 60.0));
        sink.begin_stroke(start, Pen{.colour = stroke % 3});
        sink.curves(controls);
        sink.end_stroke(false);
    }
    std::vector<glm::dvec2> spiral;
    for (int i = 0; i <= 300; ++i) {
        const double angle = 0.05 * i;
        spiral.push_back(glm::dvec2(50, 30) + angle * glm::dvec2(std::cos(angle), std::sin(angle)));
    }
    sink.begin_stroke(spiral.front(), Pen{});
    sink.curves(std::span(spiral).subspan(1));
    sink.end_stroke(false);
    for (const double radius : {0.002, 0.02, 0.5, 5.0, 29.0}) sink.disc({50, 30}, radius, Pen{.colour = 1});
    sink.disc({20, 20}, 0.0, Pen{});
}

}  // namespace sikku
