#include "art/plotter/plot_writer.h"

#include "engine/geometry/bezier.h"

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace sikku {
namespace {

/// Number of equal steps of its parameter for which the chords of a curve stay within `tolerance`.
/// Source: Wang, Proc. SPIE, 1984: by the second differences.
int chords(const Bezier& b, double tolerance) {
    const double bend = std::max(glm::length(b[0] - 2.0 * b[1] + b[2]), glm::length(b[1] - 2.0 * b[2] + b[3]));
    const double count = std::ceil(std::sqrt(0.75 * bend / tolerance));
    return static_cast<int>(std::clamp(count, 1.0, 1e6));
}

}  // namespace

void PlotWriter::begin_stroke(glm::dvec2 start, const Pen& pen) {
    here_ = start;
    take_pen(pen);
    started_ = false;
}

void PlotWriter::curves(std::span<const glm::dvec2> controls) {
    start();
    for (std::size_t i = 0; i + 2 < controls.size(); i += 3) {
        const Bezier bezier = {on_page(here_), on_page(controls[i]), on_page(controls[i + 1]),
                               on_page(controls[i + 2])};
        const int count = std::max(least_chords_, chords(bezier, tolerance_));
        for (int k = 1; k < count; ++k) curve_point(point_of(bezier, static_cast<double>(k) / count));
        curve_point(bezier[3]);
        here_ = controls[i + 2];
    }
}

void PlotWriter::change_pen(const Pen& pen) {
    // The stroke ends and continues as another one.
    end_stroke(false);
    begin_stroke(here_, pen);
}

void PlotWriter::number_pens(std::span<const Pen> pens) {
    for (const Pen& pen : pens) number(pen);
}

int PlotWriter::number(const Pen& pen) {
    const int next = static_cast<int>(numbers_.size()) + 1;
    return numbers_.try_emplace(print_.style.index(pen), next).first->second;
}

glm::dvec2 PlotWriter::on_page(glm::dvec2 point) const {
    const glm::dvec2 down = print_.placement.to_page * glm::dvec3(point, 1.0);
    return {down.x, print_.page.height - down.y};
}

void PlotWriter::require_on_page(glm::dvec2 millimetres) const {
    constexpr double slack = 1e-6;
    const auto inside = [](double value, double most) { return value >= -slack && value <= most + slack; };
    if (!inside(millimetres.x, print_.page.width) || !inside(millimetres.y, print_.page.height)) {
        throw std::runtime_error("the drawing is larger than the page, and a plotter cannot cut it off at the edge");
    }
}

}  // namespace sikku
