#include "art/plotter/plot_writer.h"

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace sikku {

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

int PlotWriter::chords(const Bezier& b, double tolerance) {
    const double bend = std::max(glm::length(b[0] - 2.0 * b[1] + b[2]), glm::length(b[1] - 2.0 * b[2] + b[3]));
    const double count = std::ceil(std::sqrt(0.75 * bend / tolerance));
    return static_cast<int>(std::clamp(count, 1.0, 1e6));
}

glm::dvec2 PlotWriter::at(const Bezier& b, double t) {
    const double s = 1 - t;
    return s * s * s * b[0] + 3 * s * s * t * b[1] + 3 * s * t * t * b[2] + t * t * t * b[3];
}

void PlotWriter::require_on_page(glm::dvec2 millimetres) const {
    constexpr double slack = 1e-6;
    const auto inside = [](double value, double most) { return value >= -slack && value <= most + slack; };
    if (!inside(millimetres.x, print_.page.width) || !inside(millimetres.y, print_.page.height)) {
        throw std::runtime_error("the drawing is larger than the page, and a plotter cannot cut it off at the edge");
    }
}

}  // namespace sikku
