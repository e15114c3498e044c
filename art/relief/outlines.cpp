#include "art/relief/outlines.h"

#include "engine/geometry/box.h"
#include "engine/geometry/simple_polygon.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

namespace sikku {
namespace {

using Points = std::vector<glm::dvec2>;

constexpr std::size_t most_checked = 64;  // corners of polygons that are checked side by side
constexpr double least_length = 0.004;    // shortest part of a stroke, in millimetres

Micrometres whole(glm::dvec2 point) {
    return {to_whole(point.x * 1000), to_whole(point.y * 1000)};
}

glm::dvec2 turned(glm::dvec2 vector, double angle) {
    return complex_product(vector, {std::cos(angle), std::sin(angle)});
}

/// True if corners turn only left, once around.
bool is_convex(std::span<const glm::dvec2> corners) {
    const std::size_t count = corners.size();
    int rises = 0;  // changes of the direction along y
    for (std::size_t i = 0; i < count; ++i) {
        const glm::dvec2 a = corners[i], b = corners[(i + 1) % count], c = corners[(i + 2) % count];
        if (!(side_of(a, b, c) > 0)) return false;
        if ((a.y <= b.y) != (b.y <= c.y)) ++rises;
    }
    return rises == 2;
}

bool is_simple(std::span<const glm::dvec2> corners) {
    return is_convex(corners) || (corners.size() <= most_checked && !touches_itself(corners));
}

/// The corners anticlockwise, without repetitions.
Points cleaned(std::span<const glm::dvec2> corners) {
    Points points;
    for (const glm::dvec2 corner : corners) {
        if (points.empty() || !(whole(corner) == whole(points.back()))) points.push_back(corner);
    }
    while (points.size() > 1 && whole(points.front()) == whole(points.back())) points.pop_back();
    if (signed_area(points) < 0) std::reverse(points.begin(), points.end());
    return points;
}

std::vector<LayerEdge> edges_between(std::span<const glm::dvec2> corners) {
    std::vector<LayerEdge> edges;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        edges.push_back({whole(corners[i]), whole(corners[(i + 1) % corners.size()]), 0});
    }
    return edges;
}

constexpr double sharpest = -0.5;  // cosine of the sharpest turn to the right that is mitred

/// A simple polygon with its sides moved inwards, where all of them remain and do not meet others.
std::optional<Points> mitred(const Points& corners, double distance) {
    const std::size_t count = corners.size();
    Points moved(count);
    for (std::size_t i = 0; i < count; ++i) {
        const glm::dvec2 before = glm::normalize(corners[i] - corners[(i + count - 1) % count]);
        const glm::dvec2 after = glm::normalize(corners[(i + 1) % count] - corners[i]);
        const double cosine = glm::dot(before, after);
        if (!(cosine > sharpest) && !(determinant(before, after) > 0)) return std::nullopt;
        moved[i] = corners[i] + (left_of(before) + left_of(after)) * (distance / (1 + cosine));
    }
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t next = (i + 1) % count;
        if (!(glm::dot(moved[next] - moved[i], corners[next] - corners[i]) > 0)) return std::nullopt;
    }
    if (!is_simple(moved)) return std::nullopt;
    return moved;
}

/// The path of a point at a distance on the left of a polygon's outline, mitred likewise. Where it winds around a
/// place once, that place lies deeper inside.
Points parallel(const Points& corners, double distance, double tolerance) {
    const std::size_t count = corners.size();
    Points path;
    for (std::size_t i = 0; i < count; ++i) {
        const glm::dvec2 before = glm::normalize(corners[i] - corners[(i + count - 1) % count]);
        const glm::dvec2 after = glm::normalize(corners[(i + 1) % count] - corners[i]);
        const double cosine = glm::dot(before, after);
        const double turn = std::atan2(determinant(before, after), cosine);
        path.push_back(corners[i] + left_of(before) * distance);
        if (turn > 0) {
            path.push_back(corners[i]);
        } else if (cosine > sharpest) {
            path.push_back(corners[i] + (left_of(before) + left_of(after)) * (distance / (1 + cosine)));
        } else {
            const int chords = chords_of(-turn, distance, tolerance);
            for (int k = 1; k < chords; ++k) {
                path.push_back(corners[i] + turned(left_of(before) * distance, turn * k / chords));
            }
        }
        path.push_back(corners[i] + left_of(after) * distance);
    }
    return path;
}

/// A part of a stroke, and its joint with the next one.
struct Part {
    glm::dvec2 from{0.0}, to{0.0};
    glm::dvec2 direction{0.0};
    double turn = 0;                  ///< angle at its end, in radians; 0 at the end of the stroke
    std::optional<glm::dvec2> mitre;  ///< from its end to the left side of both parts, if they share a straight end
};

std::vector<Part> parts_of(std::span<const glm::dvec2> points, double radius, bool is_closed, double tolerance) {
    std::vector<Part> parts;
    glm::dvec2 at = points.front();
    for (std::size_t i = 1; i < points.size(); ++i) {
        const bool is_last = i + 1 == points.size();
        if (glm::distance(at, points[i]) < least_length) {
            // The end of a stroke stays where it is.
            if (is_last && !parts.empty()) parts.back().to = points[i];
            continue;
        }
        parts.push_back({at, points[i], {}, 0, {}});
        at = points[i];
    }
    std::erase_if(parts, [](const Part& part) { return part.from == part.to; });
    for (Part& part : parts) part.direction = glm::normalize(part.to - part.from);
    for (std::size_t i = 0; i < parts.size(); ++i) {
        if (i + 1 == parts.size() && !is_closed) break;
        Part &part = parts[i], &next = parts[(i + 1) % parts.size()];
        const double cosine = glm::dot(part.direction, next.direction);
        part.turn = std::atan2(determinant(part.direction, next.direction), cosine);
        const double half = std::tan(std::fabs(part.turn) / 2);
        const double shorter = std::min(glm::distance(part.from, part.to), glm::distance(next.from, next.to));
        // The tip of the mitre is as near to the arc as its chords would be, and parts keep their inner sides.
        if (cosine > 0 && radius * (std::hypot(1, half) - 1) <= tolerance && radius * half < 0.45 * shorter) {
            part.mitre = (left_of(part.direction) + left_of(next.direction)) * (radius / (1 + cosine));
        }
    }
    return parts;
}

}  // namespace

int chords_of(double angle, double radius, double tolerance) {
    constexpr double widest = std::numbers::pi / 4;
    // Beyond a radius of 1e12 tolerances the cosine would be 1.
    const double sagitta = std::max(tolerance / std::max(radius, tolerance), 1e-12);
    const double step = 2 * std::acos(1 - sagitta);
    return std::max(1, static_cast<int>(std::ceil(angle / std::min(step, widest) - 1e-9)));
}

void Outlines::add_ring(std::span<const glm::dvec2> corners, std::uint32_t layer) {
    add_edges(edges_between(corners), layer);
}

void Outlines::add_edges(const std::vector<LayerEdge>& edges, std::uint32_t layer) {
    for (const LayerEdge& edge : edges) edges_.push_back({edge.from, edge.to, layer});
}

void Outlines::add_polygon(std::span<const glm::dvec2> corners, std::uint32_t layer) {
    const Points points = cleaned(corners);
    if (points.size() < 3) return;
    if (is_simple(points)) return add_ring(points, layer);
    add_edges(united(edges_between(points), 0, monitor_), layer);
}

bool Outlines::add_inside(std::span<const glm::dvec2> corners, double distance, std::uint32_t layer) {
    const Points points = cleaned(corners);
    if (points.size() < 3) return false;
    if (is_simple(points)) {
        if (const auto moved = mitred(points, distance)) {
            add_ring(*moved, layer);
            return true;
        }
        const auto rest = united(edges_between(parallel(points, distance, tolerance_)), 1, monitor_);
        add_edges(rest, layer);
        return !rest.empty();
    }
    // The part that a line along the outline does not cover.
    constexpr std::uint32_t shape = 0, line = 1;
    Outlines both(tolerance_, monitor_);
    both.add_polygon(points, shape);
    Points around = points;
    around.push_back(points.front());
    both.add_stroke(around, true, distance, line);
    const auto region_of = [](std::span<const Winding> windings) {
        return windings.size() == 1 && windings.front().layer == shape ? 0 : PlaneRegions::outside;
    };
    const auto rest =
        outlines_of(divide_plane(both.edges_, 0, region_of, monitor_), [](std::int32_t region) { return region; });
    add_edges(rest, layer);
    return !rest.empty();
}

/// A piece of a disc, between two points on its rim, as seen from its centre.
void Outlines::add_wedge(glm::dvec2 centre, glm::dvec2 first, glm::dvec2 last, double angle, std::uint32_t layer) {
    const int chords = chords_of(angle, glm::length(first), tolerance_);
    Points corners = {centre, centre + first};
    for (int k = 1; k < chords; ++k) corners.push_back(centre + turned(first, angle * k / chords));
    corners.push_back(centre + last);
    add_ring(corners, layer);
}

void Outlines::add_disc(glm::dvec2 centre, double radius, std::uint32_t layer) {
    const int chords = std::max(12, chords_of(2 * std::numbers::pi, radius, tolerance_));
    Points corners;
    for (int k = 0; k < chords; ++k) {
        corners.push_back(centre + turned({radius, 0}, 2 * std::numbers::pi * k / chords));
    }
    add_ring(corners, layer);
}

/// Neighbouring parts share their ends, which cancel, or have a wedge of a disc between them. Ends at wedges pass
/// through their centre, so that these edges cancel, too.
void Outlines::add_stroke(std::span<const glm::dvec2> points, bool is_closed, double radius, std::uint32_t layer) {
    const std::vector<Part> parts = parts_of(points, radius, is_closed, tolerance_);
    if (parts.empty()) return add_disc(points.front(), radius, layer);
    is_closed = is_closed && parts.size() > 1;
    Points corners;
    for (std::size_t i = 0; i < parts.size(); ++i) {
        const Part& part = parts[i];
        const Part* before = i > 0 ? &parts[i - 1] : is_closed ? &parts.back() : nullptr;
        const bool is_end = i + 1 == parts.size() && !is_closed;
        const glm::dvec2 across = left_of(part.direction) * radius;
        const auto add_end = [&](glm::dvec2 at, glm::dvec2 first, const std::optional<glm::dvec2>& mitre) {
            const double sign = glm::dot(first, across) > 0 ? 1 : -1;
            if (mitre) {
                corners.insert(corners.end(), {at + sign * *mitre, at - sign * *mitre});
            } else {
                corners.insert(corners.end(), {at + first, at, at - first});
            }
        };
        corners.clear();
        add_end(part.from, across, before ? before->mitre : std::nullopt);
        add_end(part.to, -across, part.mitre);
        add_ring(corners, layer);
        if (!before) add_wedge(part.from, across, -across, std::numbers::pi, layer);
        if (is_end) {
            add_wedge(part.to, -across, across, std::numbers::pi, layer);
        } else if (!part.mitre) {
            const glm::dvec2 next = left_of(parts[(i + 1) % parts.size()].direction) * radius;
            if (part.turn > 0) add_wedge(part.to, -across, -next, part.turn, layer);
            if (part.turn < 0) add_wedge(part.to, next, across, -part.turn, layer);
        }
    }
}

}  // namespace sikku
