#include "art/plotter/arc_writer.h"

#include "engine/geometry/box.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <optional>

namespace sikku {
namespace {

// A curve may be off by 0.01 mm. Chords between its points are off by `arc_chord`, an arc is off its chords by at
// most twice as much, and the points are off the fitted arc by `fit` (all in mm). The rest is for rounding ends and
// centres to 0.001 mm.
constexpr double arc_chord = 0.0005;
constexpr double fit = 0.0065;
constexpr double largest_radius = 1000.0;  // controllers count in single precision
constexpr double largest_sweep = 4.7;      // radians; an arc's ends must not fall together
constexpr std::size_t most_pending = 8192;

/// The circle through three points; nullopt if they are almost on a line.
std::optional<PlotArc> arc_through(glm::dvec2 a, glm::dvec2 b, glm::dvec2 c) {
    const glm::dvec2 to_b = b - a;
    const glm::dvec2 to_c = c - a;
    const double twice = 2 * determinant(to_b, to_c);
    const glm::dvec2 offset =
        (glm::dvec2(to_c.y, -to_c.x) * glm::dot(to_b, to_b) + glm::dvec2(-to_b.y, to_b.x) * glm::dot(to_c, to_c)) /
        twice;
    // False for NaN.
    if (!(glm::length(offset) <= largest_radius)) return std::nullopt;
    return PlotArc{a + offset, twice > 0};
}

bool line_fits(std::span<const glm::dvec2> points) {
    const glm::dvec2 whole = points.back() - points.front();
    const double length = glm::length(whole);
    if (length == 0) return points.size() <= 2;
    double reached = 0;
    for (const glm::dvec2 point : points) {
        const glm::dvec2 way = point - points.front();
        const double along = glm::dot(way, whole) / length;
        if (std::fabs(determinant(way, whole)) > fit * length || along < reached - fit) return false;
        reached = std::max(reached, along);
    }
    return reached <= length + fit;
}

std::optional<PlotArc> fitting_arc(std::span<const glm::dvec2> points) {
    if (points.size() < 3) return std::nullopt;
    const auto arc = arc_through(points.front(), points[points.size() / 2], points.back());
    if (!arc) return std::nullopt;
    const double radius = glm::distance(arc->centre, points.front());
    double sweep = 0;
    for (std::size_t i = 1; i < points.size(); ++i) {
        const glm::dvec2 from = points[i - 1] - arc->centre;
        const glm::dvec2 to = points[i] - arc->centre;
        const glm::dvec2 way = to - from;
        sweep += determinant(from, to) / (radius * radius) * (arc->is_left ? 1 : -1);
        if (std::fabs(glm::length(to) - radius) > fit || glm::dot(way, way) > 16 * arc_chord * radius ||
            (determinant(from, to) > 0) != arc->is_left) {
            return std::nullopt;
        }
    }
    return sweep <= largest_sweep ? arc : std::nullopt;
}

/// The last of `count` points up to which fits(last) holds, searched for in doubling steps from `known`.
template <class Fits>
std::size_t longest(std::size_t known, std::size_t count, std::size_t step, const Fits& fits) {
    const auto extend = [&] {
        const bool more = known + step < count && fits(known + step);
        if (more) known += step;
        return more;
    };
    while (extend()) step *= 2;
    for (; step > 0; step /= 2) extend();
    return known;
}

}  // namespace

// Four chords are enough for an arc of a small circle.
ArcWriter::ArcWriter(const Print& print, Output& file, bool arcs, double least)
    : PlotWriter(print, file, arc_chord, 4), arcs_(arcs), least_(least) {}

void ArcWriter::lines(std::span<const glm::dvec2> ends) {
    start();
    finish_curve();
    for (const glm::dvec2 end : ends) line_to(on_page(here_ = end));
    begin_curve(on_page(here_));
}

void ArcWriter::curve_point(glm::dvec2 point) {
    points_.push_back(point);
    if (points_.size() >= most_pending) follow(false);
}

/// Passes on lines and arcs along the pending points; the last one is kept if more may come.
void ArcWriter::follow(bool is_all) {
    const std::span<const glm::dvec2> all(points_);
    std::size_t done = 0;
    while (done + 1 < all.size()) {
        const auto rest = all.subspan(done);
        const std::size_t line =
            longest(1, rest.size(), 1, [&](std::size_t last) { return line_fits(rest.first(last + 1)); });
        // Where it is almost straight no short arc fits.
        const std::size_t last = !arcs_ ? line : longest(line, rest.size(), (line + 1) / 2, [&](std::size_t end) {
            return fitting_arc(rest.first(end + 1)).has_value();
        });
        if (!is_all && done > 0 && last + 1 == rest.size()) break;
        if (last > line && !is_short(rest.first(last + 1))) {
            arc_to(*fitting_arc(rest.first(last + 1)), rest[last]);
            done += last;
        } else {
            line_to(rest[line]);
            done += line;
        }
    }
    points_.erase(points_.begin(), points_.begin() + static_cast<std::ptrdiff_t>(done));
}

/// True for arcs that are to become lines.
bool ArcWriter::is_short(std::span<const glm::dvec2> points) const {
    double length = 0;
    for (std::size_t i = 1; i < points.size() && length < least_; ++i) {
        length += glm::distance(points[i - 1], points[i]);
    }
    return length < least_;
}

}  // namespace sikku
