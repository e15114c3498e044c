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
std::vector<std::vector<glm::dvec2>> true_lines(const PlotPlan& plan, const Print& print, double spacing);

/// The farthest that a point of one line lies from those of the other, both ways.
double hausdorff(const std::vector<glm::dvec2>& a, const std::vector<glm::dvec2>& b);

/// Random curves that hang together smoothly, loops and spirals, on a page of 100 x 60 mm.
void draw_curves(PathSink& sink);

}  // namespace sikku
