#include "art/plotter/shading.h"

#include "engine/language/unit_vector.h"

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <stdexcept>

namespace sikku {
namespace {

constexpr std::size_t most_crossings = 5'000'000;  // some 500 MB
constexpr std::size_t nowhere = std::numeric_limits<std::size_t>::max();

/// A crossing of a line with the outline; crossings are numbered along the outline.
struct Crossing {
    std::int64_t line = 0;
    double at = 0;  ///< position along the line
    int winding = 0;
    std::size_t edge = 0;
};

/// A part of a line inside the polygon.
struct Stretch {
    std::int64_t line = 0;
    double from = 0, to = 0;
    std::size_t crossings[2] = {nowhere, nowhere};  ///< crossings at its ends
    bool is_drawn = false;
};

class Hatcher {
public:
    Hatcher(std::span<const glm::dvec2> vertices, glm::dvec2 along, double spacing, double inset,
            const Monitor& monitor)
        : vertices_(vertices),
          along_(along),
          across_(-along.y, along.x),
          spacing_(spacing),
          inset_(inset),
          pulse_(monitor) {}

    std::vector<std::vector<glm::dvec2>> lines() {
        find_crossings();
        find_stretches();
        std::vector<std::vector<glm::dvec2>> result;
        for (std::size_t i = 0; i < stretches_.size(); ++i) {
            if (!stretches_[i].is_drawn) result.push_back(zigzag(i));
        }
        return result;
    }

private:
    double height(std::int64_t line) const { return (static_cast<double>(line) + 0.5) * spacing_; }
    glm::dvec2 point(std::int64_t line, double at) const { return at * along_ + height(line) * across_; }

    void find_crossings() {
        hatched_heights(vertices_, across_, spacing_);
        for (std::size_t i = 0; i < vertices_.size(); ++i) {
            const glm::dvec2 a = vertices_[i], b = vertices_[(i + 1) % vertices_.size()];
            const double from = glm::dot(a, across_), to = glm::dot(b, across_);
            if (from == to) continue;
            // A half-open interval, so that a line through a vertex crosses once.
            const auto first = static_cast<std::int64_t>(std::ceil(std::min(from, to) / spacing_ - 0.5));
            const auto last = static_cast<std::int64_t>(std::ceil(std::max(from, to) / spacing_ - 0.5));
            if (static_cast<std::size_t>(last - first) > most_crossings - crossings_.size()) {
                throw std::runtime_error(
                    "hatching crosses the outline of one shape over 5 million times; use a wider spacing");
            }
            for (std::int64_t k = 0; k < last - first; ++k) {
                pulse_();
                const std::int64_t line = to > from ? first + k : last - 1 - k;
                const double t = std::clamp((height(line) - from) / (to - from), 0.0, 1.0);
                crossings_.push_back({line, glm::dot(a + t * (b - a), along_), to > from ? 1 : -1, i});
            }
        }
    }

    void find_stretches() {
        std::vector<std::size_t> order(crossings_.size());
        for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
        std::sort(order.begin(), order.end(), [&](std::size_t i, std::size_t k) {
            const Crossing &a = crossings_[i], &b = crossings_[k];
            return a.line != b.line ? a.line < b.line : a.at != b.at ? a.at < b.at : i < k;
        });
        stretch_of_.assign(crossings_.size(), nowhere);
        int winding = 0;
        std::size_t begin = nowhere;
        for (const std::size_t i : order) {
            pulse_();
            const int before = winding;
            winding += crossings_[i].winding;
            if (before == 0) begin = i;
            if (winding != 0) continue;
            const Stretch stretch{
                crossings_[i].line, crossings_[begin].at + inset_, crossings_[i].at - inset_, {begin, i}};
            if (!(stretch.to > stretch.from)) continue;
            stretch_of_[begin] = stretch_of_[i] = stretches_.size();
            stretches_.push_back(stretch);
        }
    }

    /// Joins stretches upwards along the outline into one line.
    std::vector<glm::dvec2> zigzag(std::size_t i) {
        std::vector<glm::dvec2> points;
        for (int side = 0; i != nowhere; side = 1 - side) {
            pulse_();
            Stretch& stretch = stretches_[i];
            stretch.is_drawn = true;
            points.push_back(point(stretch.line, side == 0 ? stretch.from : stretch.to));
            points.push_back(point(stretch.line, side == 0 ? stretch.to : stretch.from));
            i = next(stretch, 1 - side);
        }
        return points;
    }

    /// The stretch reached from the end of another by following the outline to the next line.
    std::size_t next(const Stretch& stretch, int side) const {
        const std::size_t here = stretch.crossings[side];
        const std::size_t count = crossings_.size();
        for (const bool forwards : {true, false}) {
            const std::size_t there = forwards ? (here + 1) % count : (here + count - 1) % count;
            const std::size_t found = stretch_of_[there];
            if (found == nowhere || stretches_[found].is_drawn || crossings_[there].line != stretch.line + 1)
                continue;
            if (stretches_[found].crossings[side] != there) continue;
            if (follows_outline(here, there, forwards)) return found;
        }
        return nowhere;
    }

    /// True if the outline between two crossings is nearly straight.
    bool follows_outline(std::size_t here, std::size_t there, bool forwards) const {
        const glm::dvec2 from = point(crossings_[here].line, crossings_[here].at);
        const glm::dvec2 way = point(crossings_[there].line, crossings_[there].at) - from;
        const double length = glm::length(way);
        const std::size_t count = vertices_.size();
        std::size_t edge = crossings_[here].edge;
        for (std::size_t steps = 0; edge != crossings_[there].edge; ++steps) {
            if (steps == 100) return false;
            const std::size_t vertex = forwards ? (edge + 1) % count : edge;
            edge = forwards ? vertex : (edge + count - 1) % count;
            const glm::dvec2 to = vertices_[vertex] - from;
            if (std::fabs(to.x * way.y - to.y * way.x) > 0.4 * spacing_ * length) return false;
        }
        return true;
    }

    std::span<const glm::dvec2> vertices_;
    glm::dvec2 along_, across_;
    double spacing_, inset_;
    Pulse pulse_;
    std::vector<Crossing> crossings_;
    std::vector<Stretch> stretches_;
    std::vector<std::size_t> stretch_of_;  ///< stretch of each crossing
};

/// Radius of the circle that a pen draws at the edge of a disc.
double edge_of(double radius, double pen) {
    return std::max(radius - pen / 2, radius / 4);
}

}  // namespace

std::vector<glm::dvec2> hatch_directions(const Hatch& hatch, const Placement& placement) {
    const glm::dmat2 turned(placement.to_page[0], placement.to_page[1]);
    const glm::dmat2 back = glm::determinant(turned) == 0 ? glm::dmat2(1.0) : glm::inverse(turned);
    std::vector<glm::dvec2> ways;
    for (const double angle : {hatch.angle, hatch.angle + 90}) {
        const glm::dvec2 way = unit_vector(angle);
        ways.push_back(glm::normalize(back * glm::dvec2(way.x, -way.y)));  // y points down the page
        if (!hatch.is_crossed) break;
    }
    return ways;
}

std::pair<double, double> hatched_heights(std::span<const glm::dvec2> vertices, glm::dvec2 across, double spacing) {
    constexpr double most_lines = 1e6;
    double low = std::numeric_limits<double>::infinity();
    double high = -low;
    for (const glm::dvec2 vertex : vertices) {
        low = std::min(low, glm::dot(vertex, across));
        high = std::max(high, glm::dot(vertex, across));
    }
    if (!((high - low) / spacing < most_lines && std::max(-low, high) / spacing < 1e15)) {
        throw std::runtime_error("hatching takes over a million lines for one shape; use a wider spacing");
    }
    return {low, high};
}

std::vector<std::vector<glm::dvec2>> hatch_lines(std::span<const glm::dvec2> vertices, glm::dvec2 along,
                                                 double spacing, double inset, const Monitor& monitor) {
    return Hatcher(vertices, along, spacing, inset, monitor).lines();
}

double spiral_reach(double radius, double pen) {
    return edge_of(radius, pen) + pen / 2;
}

std::vector<glm::dvec2> spiral(glm::dvec2 centre, double radius, double pen) {
    constexpr std::size_t eighths = 8;
    const double handle = 4.0 / 3.0 * std::tan(std::numbers::pi / 16);
    const double edge = edge_of(radius, pen);
    std::vector<glm::dvec2> path = {centre + edge * unit_vector(0.0)};
    // Adds an eighth of a turn with shrinking radius.
    const auto turn = [&](std::size_t i, double outer, double inner) {
        const glm::dvec2 from = unit_vector(45.0 * static_cast<double>(i % eighths));
        const glm::dvec2 to = unit_vector(45.0 * static_cast<double>((i + 1) % eighths));
        const double shrinking = (inner - outer) / (std::numbers::pi / 4);
        path.push_back(centre + outer * (from + handle * glm::dvec2(-from.y, from.x)) + handle * shrinking * from);
        path.push_back(centre + inner * (to - handle * glm::dvec2(-to.y, to.x)) - handle * shrinking * to);
        path.push_back(centre + inner * to);
    };
    for (std::size_t i = 0; i < eighths; ++i) turn(i, edge, edge);
    if (!(pen > 0 && edge > pen / 2 * (1 + 1e-9))) return path;
    const auto steps = eighths * static_cast<std::size_t>(std::min(std::ceil(edge / pen - 1e-9), 1e6));
    const auto at = [&](std::size_t i) { return edge * static_cast<double>(steps - i) / static_cast<double>(steps); };
    for (std::size_t i = 0; i < steps; ++i) turn(i, at(i), at(i + 1));
    return path;
}

}  // namespace sikku
