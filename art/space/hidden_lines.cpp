#include "art/space/hidden_lines.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace sikku {
namespace {

constexpr double steepest = 1000.0;        // maximum slope of surfaces that hide lines
constexpr double share_of_noise = 1e-6;    // share of the drawing's size: scenes are stored in floats
constexpr double most_in_cells = 16;       // mean number of cells for each surface
constexpr std::int64_t most_cells = 1024;  // cells along a side of the grid

/// Restricts an interval to where the linear function with these values at 0 and 1 is positive.
template <class Interval>
void keep_positive(double at_0, double at_1, Interval& interval) {
    if (at_0 <= 0 && at_1 <= 0) {
        interval.to = interval.from;
        return;
    }
    if (at_0 > 0 && at_1 > 0) return;
    const double root = at_0 / (at_0 - at_1);
    if (at_0 > 0) {
        interval.to = std::min(interval.to, root);
    } else {
        interval.from = std::max(interval.from, root);
    }
}

double length_of(std::span<const glm::dvec2> points) {
    double sum = 0;
    for (std::size_t i = 1; i < points.size(); ++i) sum += glm::distance(points[i - 1], points[i]);
    return sum;
}

}  // namespace

void HiddenLines::add_polygon(std::span<const glm::dvec3> vertices, Owner owner) {
    Surface surface;
    surface.owner = owner;
    surface.count = static_cast<int>(vertices.size());
    glm::dvec3 normal(0.0), middle(0.0);
    for (std::size_t i = 0; i < vertices.size(); ++i) {
        const glm::dvec3 a = vertices[i] - vertices[0], b = vertices[(i + 1) % vertices.size()] - vertices[0];
        normal += glm::cross(a, b);
        middle += a / static_cast<double>(vertices.size());
    }
    if (!(std::fabs(normal.z) * steepest > glm::length(normal))) return;
    middle += vertices[0];
    const glm::dvec2 slope = -glm::dvec2(normal) / normal.z;
    surface.plane = {slope, middle.z - glm::dot(slope, glm::dvec2(middle))};
    surface.slack = 1 + glm::length(slope);  // multiplied by rounding_ once it is known
    surface.low = surface.high = glm::dvec2(vertices[0]);
    surface.nearest = vertices[0].z;
    for (std::size_t i = 0; i < vertices.size(); ++i) {
        const glm::dvec2 a(vertices[i]), b(vertices[(i + 1) % vertices.size()]);
        surface.low = glm::min(surface.low, a);
        surface.high = glm::max(surface.high, a);
        surface.nearest = std::max(surface.nearest, vertices[i].z);
        const glm::dvec2 way = normal.z > 0 ? b - a : a - b;
        const double length = glm::length(way);
        if (!(length > 0)) {
            surface.sides[i] = {0, 0, 1e300};
            continue;
        }
        const glm::dvec2 inwards = glm::dvec2(-way.y, way.x) / length;
        surface.sides[i] = {inwards, -glm::dot(inwards, a)};
    }
    surfaces_.push_back(surface);
}

void HiddenLines::add_ball(const glm::dvec3& centre, double radius, Owner owner) {
    if (!(radius > 0)) return;
    Surface surface;
    surface.owner = owner;
    surface.sides[0] = centre;
    surface.sides[1].x = radius;
    surface.slack = 1;
    surface.nearest = centre.z + radius;
    surface.low = glm::dvec2(centre) - radius;
    surface.high = glm::dvec2(centre) + radius;
    surfaces_.push_back(surface);
}

std::array<std::int64_t, 2> HiddenLines::cell_of(glm::dvec2 point) const {
    std::array<std::int64_t, 2> cell{};
    for (int axis = 0; axis < 2; ++axis) {
        const auto last = static_cast<double>(cells_[static_cast<std::size_t>(axis)] - 1);
        const double at = std::floor((point[axis] - low_[axis]) / cell_);
        cell[static_cast<std::size_t>(axis)] = static_cast<std::int64_t>(std::clamp(at, 0.0, last));
    }
    return cell;
}

void HiddenLines::build(const Monitor& monitor) {
    if (surfaces_.empty()) return;
    Pulse pulse(monitor);
    low_ = surfaces_[0].low;
    high_ = surfaces_[0].high;
    double depth = 0;
    for (const Surface& surface : surfaces_) {
        low_ = glm::min(low_, surface.low);
        high_ = glm::max(high_, surface.high);
        depth = std::max(depth, std::fabs(surface.nearest));
    }
    const glm::dvec2 size = high_ - low_;
    rounding_ = share_of_noise * std::max({size.x, size.y, depth * 1e-3, 1e-290});
    for (Surface& surface : surfaces_) surface.slack *= rounding_;
    std::stable_sort(surfaces_.begin(), surfaces_.end(),
                     stoppable(monitor, [](const Surface& a, const Surface& b) { return a.nearest > b.nearest; }));
    // Make the grid as fine as memory allows.
    const auto visit = [&](const auto& enter) {
        for (std::uint32_t i = 0; i < surfaces_.size(); ++i) {
            pulse();
            const auto first = cell_of(surfaces_[i].low), last = cell_of(surfaces_[i].high);
            for (std::int64_t y = first[1]; y <= last[1]; ++y) {
                for (std::int64_t x = first[0]; x <= last[0]; ++x) {
                    enter(static_cast<std::size_t>(y * cells_[0] + x), i);
                }
            }
        }
    };
    const auto count = static_cast<double>(surfaces_.size());
    for (auto side = static_cast<std::int64_t>(2 * std::sqrt(count)) + 1;; side /= 2) {
        side = std::clamp<std::int64_t>(side, 1, most_cells);
        cell_ = std::max({size.x, size.y, 1e-290}) / static_cast<double>(side);
        for (int axis = 0; axis < 2; ++axis) {
            cells_[static_cast<std::size_t>(axis)] = static_cast<std::int64_t>(size[axis] / cell_) + 1;
        }
        double entries = 0;
        for (const Surface& surface : surfaces_) {
            const auto first = cell_of(surface.low), last = cell_of(surface.high);
            entries += static_cast<double>((last[0] - first[0] + 1) * (last[1] - first[1] + 1));
        }
        if (entries <= most_in_cells * count || side == 1) break;
    }
    begin_.assign(static_cast<std::size_t>(cells_[0] * cells_[1]) + 1, 0);
    visit([&](std::size_t cell, std::uint32_t) { ++begin_[cell + 1]; });
    for (std::size_t i = 1; i < begin_.size(); ++i) begin_[i] += begin_[i - 1];
    inside_.resize(begin_.back());
    std::vector<std::size_t> next(begin_.begin(), begin_.end() - 1);
    visit([&](std::size_t cell, std::uint32_t i) { inside_[next[cell]++] = i; });
}

/// Removes from `visible` the part of the line from a to b that the surface hides.
void HiddenLines::hide(const Surface& surface, const glm::dvec3& a, const glm::dvec3& b, Owner owner,
                       Intervals& visible) const {
    std::array<Interval, 2> hidden = {{{0, 1}, {0, 0}}};
    if (surface.count > 0) {
        for (int i = 0; i < surface.count; ++i) {
            const glm::dvec3& side = surface.sides[static_cast<std::size_t>(i)];
            keep_positive(side.x * a.x + side.y * a.y + side.z - rounding_,
                          side.x * b.x + side.y * b.y + side.z - rounding_, hidden[0]);
            if (hidden[0].from >= hidden[0].to) return;
        }
        const double slack = surface.owner > owner ? -surface.slack : surface.slack;
        const glm::dvec3& plane = surface.plane;
        keep_positive(plane.x * a.x + plane.y * a.y + plane.z - a.z - slack,
                      plane.x * b.x + plane.y * b.y + plane.z - b.z - slack, hidden[0]);
    } else {
        const glm::dvec3 way = b - a, from = a - surface.sides[0];
        const double radius = surface.sides[1].x - rounding_;
        // Intersects the line with a circle or a ball.
        const auto inside = [&](double square, double half, double rest) {
            const double root = half * half - square * rest;
            if (!(square > 0)) return rest < 0 ? Interval{0, 1} : Interval{};
            if (!(root > 0)) return Interval{};
            return Interval{std::max(0.0, (-half - std::sqrt(root)) / square),
                            std::min(1.0, (-half + std::sqrt(root)) / square)};
        };
        const glm::dvec2 flat(way), flat_from(from);
        hidden[0] =
            inside(glm::dot(flat, flat), glm::dot(flat, flat_from), glm::dot(flat_from, flat_from) - radius * radius);
        if (hidden[0].from >= hidden[0].to) return;
        keep_positive(-from.z, -(b.z - surface.sides[0].z), hidden[0]);
        hidden[1] = inside(glm::dot(way, way), glm::dot(way, from), glm::dot(from, from) - radius * radius);
    }
    for (const Interval& part : hidden) {
        if (!(part.from < part.to)) continue;
        Intervals left;
        for (const Interval& seen : visible) {
            if (part.from > seen.from) left.push_back({seen.from, std::min(seen.to, part.from)});
            if (part.to < seen.to) left.push_back({std::max(seen.from, part.to), seen.to});
        }
        std::erase_if(left, [](const Interval& seen) { return !(seen.from < seen.to); });
        visible = std::move(left);
    }
}

void HiddenLines::look_in_cell(std::int64_t cell, Interval within, const glm::dvec3& a, const glm::dvec3& b,
                               Owner owner, Intervals& visible) const {
    Intervals seen = {within};
    const double farthest = std::min(a.z + within.from * (b.z - a.z), a.z + within.to * (b.z - a.z));
    for (std::size_t i = begin_[static_cast<std::size_t>(cell)];
         i < begin_[static_cast<std::size_t>(cell) + 1] && !seen.empty(); ++i) {
        const Surface& surface = surfaces_[inside_[i]];
        if (surface.nearest + steepest * rounding_ < farthest) break;
        if (surface.owner != owner) hide(surface, a, b, owner, seen);
    }
    for (const Interval& part : seen) {
        if (!visible.empty() && visible.back().to >= part.from) {
            visible.back().to = part.to;
        } else {
            visible.push_back(part);
        }
    }
}

/// Computes the visible parts of the line from a to b, cell by cell.
void HiddenLines::look(const glm::dvec3& a, const glm::dvec3& b, Owner owner, Intervals& visible) const {
    Interval grid{0, 1};
    const glm::dvec2 from(a), to(b);
    for (int axis = 0; axis < 2; ++axis) {
        keep_positive(from[axis] - low_[axis] + rounding_, to[axis] - low_[axis] + rounding_, grid);
        keep_positive(high_[axis] - from[axis] + rounding_, high_[axis] - to[axis] + rounding_, grid);
    }
    if (!(grid.from < grid.to)) {
        visible.push_back({0, 1});
        return;
    }
    if (grid.from > 0) visible.push_back({0, grid.from});
    const glm::dvec2 way = to - from;
    auto cell = cell_of(from + grid.from * way);
    double at = grid.from;
    while (at < grid.to) {
        // Find the point where the line leaves the cell.
        double leave = grid.to;
        int across = -1;
        for (int axis = 0; axis < 2; ++axis) {
            if (way[axis] == 0) continue;
            const std::int64_t side = cell[static_cast<std::size_t>(axis)] + (way[axis] > 0 ? 1 : 0);
            const double t = (low_[axis] + cell_ * static_cast<double>(side) - from[axis]) / way[axis];
            if (t < leave) {
                leave = std::max(t, at);
                across = axis;
            }
        }
        if (leave > at) look_in_cell(cell[1] * cells_[0] + cell[0], {at, leave}, a, b, owner, visible);
        at = leave;
        if (across < 0) break;
        auto& step = cell[static_cast<std::size_t>(across)];
        step += way[across] > 0 ? 1 : -1;
        if (step < 0 || step >= cells_[static_cast<std::size_t>(across)]) break;
    }
    if (at >= 1) return;
    if (!visible.empty() && visible.back().to >= at) {
        visible.back().to = 1;
    } else {
        visible.push_back({at, 1});
    }
}

std::vector<std::vector<glm::dvec2>> HiddenLines::visible(std::span<const glm::dvec3> points, Owner owner,
                                                          double detail) const {
    std::vector<std::vector<glm::dvec2>> parts;
    bool is_down = false;
    double gap = std::numeric_limits<double>::infinity();
    const auto begin_at = [&](glm::dvec2 at) {
        // Draw across a gap too short to be visible.
        if (gap < detail && !parts.empty()) {
            parts.back().push_back(at);
        } else {
            parts.push_back({at});
        }
        gap = 0;
        is_down = true;
    };
    Intervals seen;
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
        seen.clear();
        if (surfaces_.empty()) {
            seen.push_back({0, 1});
        } else {
            look(points[i], points[i + 1], owner, seen);
        }
        const glm::dvec2 from(points[i]), to(points[i + 1]);
        const double length = glm::distance(from, to);
        double at = 0;
        for (const Interval& part : seen) {
            if (part.from > at) is_down = false;
            gap += (part.from - at) * length;
            if (!is_down) begin_at(from + part.from * (to - from));
            parts.back().push_back(part.to < 1 ? from + part.to * (to - from) : to);
            at = part.to;
            gap = 0;
        }
        if (at < 1) {
            is_down = false;
            gap += (1 - at) * length;
        }
    }
    const bool is_whole = parts.size() == 1 && parts[0].size() == points.size();
    if (!is_whole) {
        std::erase_if(parts, [&](const std::vector<glm::dvec2>& part) { return length_of(part) < detail; });
    }
    return parts;
}

}  // namespace sikku
