#include "tests/plot_tools.h"

namespace sikku {

std::vector<std::vector<glm::dvec2>> true_lines(const PlotPlan& plan, const Print& print, double spacing) {
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

double hausdorff(const std::vector<glm::dvec2>& a, const std::vector<glm::dvec2>& b) {
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

void draw_curves(PathSink& sink) {
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
