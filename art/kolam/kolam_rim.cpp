#include "art/kolam/kolam_rim.h"

#include "engine/base/diagnostic.h"
#include "engine/base/text.h"
#include "engine/geometry/box.h"
#include "engine/language/unit_vector.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace sikku {
namespace {

constexpr std::string_view rim_names[] = {"round", "pointed", "petal", "horn", "crescent"};

/// A control point of a loop: its distance from the dot in spacings, and its angle from the direction outwards, in
/// degrees.
struct RimPoint {
    double radius;
    double angle;
    bool is_tip = false;
};

/// From the right to the left, looking outwards.
std::span<const RimPoint> rim_points(RimStyle style) {
    static constexpr RimPoint pointed[] = {{0.5, -40}, {0.82, 0, true}, {0.5, 40}};
    static constexpr RimPoint petal[] = {{0.54, -62}, {0.68, -28}, {0.95, 0, true}, {0.68, 28}, {0.54, 62}};
    static constexpr RimPoint horn[] = {{0.54, -48}, {0.85, -12}, {1.1, 28, true}, {0.62, 20}, {0.48, 50}};
    static constexpr RimPoint crescent[] = {{0.58, -58}, {1.0, -25, true}, {0.58, 0}, {1.0, 25, true}, {0.58, 58}};
    switch (style) {
        case RimStyle::pointed:
            return pointed;
        case RimStyle::petal:
            return petal;
        case RimStyle::horn:
            return horn;
        case RimStyle::crescent:
            return crescent;
        case RimStyle::round:
            break;
    }
    return {};
}

/// Positive if a horn has room on the left, negative for the right: where there are fewer dots, or away from the axis
/// through the centre of the grid. Near 0 if it would break a symmetry.
double room_aside(const DotGrid& grid, glm::dvec2 centre, std::uint32_t dot, glm::dvec2 outwards) {
    const glm::dvec2 left = left_of(outwards);
    double room = 0;
    for (std::uint32_t side = 0; side < grid.sides(); ++side) {
        if (grid.gap(dot, side) < 0) room += glm::dot(lattice_ray(grid.lattice(), side), left);
    }
    return std::fabs(room) > 0.1 ? room : glm::dot(dot_place(grid, dot) - centre, left);
}

std::vector<glm::dvec2> shape_of(const DotGrid& grid, glm::dvec2 centre, std::uint32_t dot, glm::dvec2 outwards,
                                 RimStyle style) {
    const double aside = style == RimStyle::horn ? room_aside(grid, centre, dot, outwards) : 1;
    const std::span<const RimPoint> points = rim_points(std::fabs(aside) < 1e-6 ? RimStyle::pointed : style);
    std::vector<glm::dvec2> shape;
    for (const RimPoint& point : points) {
        const glm::dvec2 turn = unit_vector(aside < 0 ? -point.angle : point.angle);
        const glm::dvec2 ray = turn.x * outwards + turn.y * left_of(outwards);
        const glm::dvec2 place = dot_place(grid, dot) + point.radius * ray;
        // Control points that nearly coincide make a corner.
        const double apart = point.is_tip ? (aside < 0 ? -0.01 : 0.01) : 0;
        if (point.is_tip) shape.push_back(place - apart * left_of(ray));
        shape.push_back(place);
        if (point.is_tip) shape.push_back(place + apart * left_of(ray));
    }
    if (aside < 0) std::reverse(shape.begin(), shape.end());
    return shape;
}

/// Calls `visit` for the other dots at most `reach` half spacings away along each axis.
template <typename Visit>
void visit_near(const DotGrid& grid, std::uint32_t dot, std::int32_t reach, Visit&& visit) {
    for (std::int32_t y = -reach; y <= reach; ++y) {
        for (std::int32_t x = -reach; x <= reach; ++x) {
            const auto other = grid.dot_at(grid.dots()[dot] + GridDot{x, y});
            if (other && *other != dot) visit(*other);
        }
    }
}

/// Adds points between those of a shape.
std::vector<glm::dvec2> dense(const std::vector<glm::dvec2>& shape) {
    constexpr int parts = 4;
    std::vector<glm::dvec2> points;
    for (std::size_t i = 0; i + 1 < shape.size(); ++i) {
        for (int part = 0; part < parts; ++part)
            points.push_back(glm::mix(shape[i], shape[i + 1], static_cast<double>(part) / parts));
    }
    if (!shape.empty()) points.push_back(shape.back());
    return points;
}

double square_between(glm::dvec2 a, glm::dvec2 b) {
    return glm::dot(a - b, a - b);
}

}  // namespace

RimStyle parse_rim_style(std::string_view text) {
    const std::string word = lower_case(text);
    for (std::size_t i = 0; i < std::size(rim_names); ++i) {
        if (word == rim_names[i]) return static_cast<RimStyle>(i);
    }
    throw std::runtime_error(fmt::format("'{}': expected {}", printable(text, 80), fmt::join(rim_names, ", ")));
}

std::string_view rim_style_name(RimStyle style) {
    return rim_names[static_cast<std::size_t>(style)];
}

KolamRim::KolamRim(const DotGrid& grid, const GapStates& states, RimStyle style)
    : grid_(grid), centre_(centre_of(grid)), outwards_(grid.dots().size()), shapes_(grid.dots().size()) {
    if (style == RimStyle::round) return;
    find_loops(states, style);
    for (const std::uint32_t dot : loops_that_meet())
        shapes_[dot] = shape_of(grid, centre_, dot, outwards_[dot], RimStyle::pointed);
    for (const std::uint32_t dot : loops_that_meet()) shapes_[dot].clear();
    shaped_ = static_cast<std::size_t>(
        std::count_if(shapes_.begin(), shapes_.end(), [](const auto& shape) { return !shape.empty(); }));
}

void KolamRim::find_loops(const GapStates& states, RimStyle style) {
    const std::uint32_t sides = grid_.sides();
    for (std::uint32_t dot = 0; dot < grid_.dots().size(); ++dot) {
        const auto turns = [&](std::uint32_t side) {
            const std::int32_t gap = grid_.gap(dot, side % sides);
            return gap < 0 || states[static_cast<std::size_t>(gap)] == GapState::turned;
        };
        for (std::uint32_t first = 0; first < sides; ++first) {
            std::uint32_t length = 0;
            while (length < sides && turns(first + length)) ++length;
            if (turns(first + sides - 1) || length <= sides / 2) continue;
            const std::uint32_t middle = first + (length - 1) / 2, other = first + length / 2;
            if (grid_.gap(dot, middle % sides) >= 0 || grid_.gap(dot, other % sides) >= 0) continue;
            outwards_[dot] =
                glm::normalize(lattice_ray(grid_.lattice(), middle) + lattice_ray(grid_.lattice(), other));
            shapes_[dot] = shape_of(grid_, centre_, dot, outwards_[dot], style);
        }
    }
}

std::vector<std::uint32_t> KolamRim::loops_that_meet() const {
    constexpr double least = 0.12, least_from_dots = 0.5;
    std::vector<std::vector<glm::dvec2>> outlines;
    for (const std::vector<glm::dvec2>& shape : shapes_) outlines.push_back(dense(shape));
    std::vector<std::uint32_t> found;
    for (std::uint32_t dot = 0; dot < shapes_.size(); ++dot) {
        bool meets = false;
        visit_near(grid_, dot, shapes_[dot].empty() ? 0 : 5, [&](std::uint32_t other) {
            for (const glm::dvec2 point : outlines[dot]) {
                meets |= square_between(point, dot_place(grid_, other)) < least_from_dots * least_from_dots;
                for (const glm::dvec2 near : outlines[other]) meets |= square_between(point, near) < least * least;
            }
        });
        if (meets) found.push_back(dot);
    }
    return found;
}

std::vector<glm::dvec2> KolamRim::reshaped(std::span<const ArcStep> steps,
                                           const std::vector<glm::dvec2>& points) const {
    const std::size_t count = points.size();
    const auto turns_back = [&](std::size_t i) {
        const ArcStep &from = steps[i % count], &to = steps[(i + 1) % count];
        return from.dot == to.dot && from.anticlockwise == to.anticlockwise && exit(grid_, from) == entry(grid_, to);
    };
    std::size_t begin = 0;  // not within a loop
    while (begin < count && turns_back(begin)) ++begin;
    if (shaped_ == 0 || begin == count) return points;
    std::vector<glm::dvec2> result;
    for (std::size_t i = begin; i < begin + count;) {
        std::size_t end = i;
        while (turns_back(end)) ++end;
        const ArcStep& from = steps[i % count];
        const std::vector<glm::dvec2>& shape = shapes_[from.dot];
        const bool is_loop = end - i > grid_.sides() / 2 && !shape.empty();
        result.push_back(points[i % count]);
        if (is_loop && from.anticlockwise) result.insert(result.end(), shape.begin(), shape.end());
        if (is_loop && !from.anticlockwise) result.insert(result.end(), shape.rbegin(), shape.rend());
        for (++i; i < end; ++i) {
            if (!is_loop || i + 1 == end) result.push_back(points[i % count]);
        }
    }
    return result;
}

}  // namespace sikku
