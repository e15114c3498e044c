#include "art/hand/hand.h"
#include "art/hand/hand_noise.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>

namespace sikku {
namespace {

/// Distance of a control point from its end point, for a quarter circle of radius 1.
constexpr double cap_control = 0.5522847498307936;
/// Greatest distance of an edge from the exact one, as a share of half the line's width.
constexpr double tolerance_share = 0.015;
/// Greatest distance of an edge towards the centre of a bend, as a share of its radius.
constexpr double inner_share = 0.9;

/// A smooth curve through points, given by their places along it.
class Edge {
public:
    void add(glm::dvec2 at, double along) {
        if (!at_.empty() && !(along > along_.back())) return;
        at_.push_back(at);
        along_.push_back(along);
    }
    std::size_t size() const { return at_.size(); }
    glm::dvec2 front() const { return at_.front(); }
    glm::dvec2 back() const { return at_.back(); }

    /// Sets the tangent at each point. The last point of a closed curve is its first.
    void set_ways(bool closed) {
        const std::size_t count = at_.size();
        ways_.resize(count);
        const auto chord = [&](std::size_t i) { return (at_[i + 1] - at_[i]) / (along_[i + 1] - along_[i]); };
        for (std::size_t i = 1; i + 1 < count; ++i) ways_[i] = mean(chord(i - 1), chord(i), i - 1, i);
        if (count < 2) return;
        if (closed) {
            ways_.front() = ways_.back() = mean(chord(count - 2), chord(0), count - 2, 0);
        } else {
            ways_.front() = chord(0);
            ways_.back() = chord(count - 2);
        }
    }

    /// The points that are needed for Béziers within a distance of the curve.
    std::vector<std::size_t> thinned(double tolerance) const {
        std::vector<std::size_t> kept;
        for (std::size_t from = 0; from + 1 < size();) {
            kept.push_back(from);
            std::size_t to = from + 1;
            while (to + 1 < size() && to - from < 8 && fits(from, to + 1, tolerance)) ++to;
            from = to;
        }
        kept.push_back(size() - 1);
        return kept;
    }

    glm::dvec2 after(std::size_t i, std::size_t to) const {
        return at_[i] + ways_[i] * ((along_[to] - along_[i]) / 3);
    }
    glm::dvec2 before(std::size_t i, std::size_t from) const {
        return at_[i] - ways_[i] * ((along_[i] - along_[from]) / 3);
    }
    glm::dvec2 at(std::size_t i) const { return at_[i]; }
    glm::dvec2 point(std::size_t from, std::size_t to, double t) const {
        const double u = 1 - t;
        return u * u * u * at_[from] + 3 * u * u * t * after(from, to) + 3 * u * t * t * before(to, from) +
               t * t * t * at_[to];
    }

private:
    glm::dvec2 mean(glm::dvec2 in, glm::dvec2 out, std::size_t before, std::size_t after) const {
        const double h0 = along_[before + 1] - along_[before], h1 = along_[after + 1] - along_[after];
        return (h1 * in + h0 * out) / (h0 + h1);
    }
    bool fits(std::size_t from, std::size_t to, double tolerance) const {
        const double whole = along_[to] - along_[from];
        for (std::size_t i = from + 1; i < to; ++i) {
            if (glm::length(point(from, to, (along_[i] - along_[from]) / whole) - at_[i]) > tolerance) return false;
        }
        return true;
    }

    std::vector<glm::dvec2> at_, ways_;
    std::vector<double> along_;
};

void append(const Edge& edge, double tolerance, bool backwards, std::vector<glm::dvec2>& outline) {
    const std::vector<std::size_t> kept = edge.thinned(tolerance);
    if (backwards) {
        for (std::size_t k = kept.size(); k-- > 1;) {
            outline.insert(outline.end(), {edge.before(kept[k], kept[k - 1]), edge.after(kept[k - 1], kept[k]),
                                           edge.at(kept[k - 1])});
        }
        return;
    }
    for (std::size_t k = 0; k + 1 < kept.size(); ++k) {
        outline.insert(outline.end(),
                       {edge.after(kept[k], kept[k + 1]), edge.before(kept[k + 1], kept[k]), edge.at(kept[k + 1])});
    }
}

/// Half a circle around `centre` from centre + side to centre - side, by way of centre + ahead.
void append_cap(glm::dvec2 centre, glm::dvec2 side, glm::dvec2 ahead, std::vector<glm::dvec2>& outline) {
    outline.insert(outline.end(),
                   {centre + side + cap_control * ahead, centre + ahead + cap_control * side, centre + ahead,
                    centre + ahead - cap_control * side, centre - side + cap_control * ahead, centre - side});
}

}  // namespace

std::vector<glm::dvec2> hand_outline(const HandLine& stroke, std::size_t from, std::size_t to) {
    Edge left, right;
    double widest = 0;
    for (std::size_t i = from; i <= to; ++i) {
        const HandNode& node = stroke.nodes[i];
        const glm::dvec2 way = hand_unit_direction(stroke, i);
        const glm::dvec2 normal(-way.y, way.x);
        double inner = node.half;
        double bend = 0;  // to the left, divided by length
        if (i > from && i < to) {
            const glm::dvec2 in = node.at - stroke.nodes[i - 1].at, out = stroke.nodes[i + 1].at - node.at;
            const double length = (glm::length(in) + glm::length(out)) / 2;
            if (length > 0) bend = hand_turn(stroke, i) / length;
            if (bend != 0) inner = std::min(inner, inner_share / std::fabs(bend));
        }
        widest = std::max(widest, node.half);
        left.add(node.at + (bend > 0 ? inner : node.half) * normal, node.along);
        right.add(node.at - (bend < 0 ? inner : node.half) * normal, node.along);
    }
    if (left.size() < 2) return dot_outline({stroke.nodes[from].at, stroke.nodes[from].half, stroke.pen}, 0, {0.0});
    left.set_ways(false);
    right.set_ways(false);
    std::vector<glm::dvec2> outline = {left.front()};
    append(left, tolerance_share * widest, false, outline);
    const HandNode &first = stroke.nodes[from], &last = stroke.nodes[to];
    const glm::dvec2 end = hand_unit_direction(stroke, to), start = hand_unit_direction(stroke, from);
    const glm::dvec2 end_side = (left.back() - right.back()) / 2.0, start_side = (right.front() - left.front()) / 2.0;
    append_cap((left.back() + right.back()) / 2.0, end_side, last.half * end, outline);
    append(right, tolerance_share * widest, true, outline);
    append_cap((left.front() + right.front()) / 2.0, start_side, -first.half * start, outline);
    return outline;
}

std::vector<glm::dvec2> hand_middle(const HandLine& line) {
    Edge middle;
    double widest = 0;
    for (const HandNode& node : line.nodes) {
        middle.add(node.at, node.along);
        widest = std::max(widest, node.half);
    }
    if (line.closed) middle.add(line.nodes.front().at, line.length);
    std::vector<glm::dvec2> controls;
    if (middle.size() < 2) return controls;
    middle.set_ways(line.closed);
    append(middle, tolerance_share * widest, false, controls);
    return controls;
}

std::vector<glm::dvec2> dot_outline(const HandDot& dot, std::uint64_t number, const HandOptions& options) {
    constexpr std::size_t corners = 6;
    Edge edge;
    const std::uint64_t seed = scrambled(scrambled(options.seed + 0x646f74) + number);
    const LineNoise noise(seed, 1, 0.4, true);
    for (std::size_t k = 0; k <= corners; ++k) {
        const double part = static_cast<double>(k % corners) / corners;
        const double angle = 2 * std::numbers::pi * part;
        const double radius = dot.radius * (1 + 0.25 * options.strength * noise(part));
        edge.add(dot.at + radius * glm::dvec2(std::cos(angle), std::sin(angle)), static_cast<double>(k));
    }
    edge.set_ways(true);
    std::vector<glm::dvec2> outline = {edge.front()};
    append(edge, 0, false, outline);
    return outline;
}

std::vector<HandDot> heaps_of(const HandDot& dot, std::uint64_t number, const HandOptions& options) {
    constexpr std::uint64_t lobes = 3;
    const double away = std::min(0.1 + 0.3 * options.strength, 0.3);
    const std::uint64_t seed = scrambled(scrambled(options.seed + 0x68656170) + number);
    std::vector<HandDot> heaps = {{dot.at, (1 - away / 2) * dot.radius, dot.pen}};
    for (std::uint64_t k = 0; k < lobes; ++k) {
        const glm::dvec2 off(hand_chance(seed, 3 * k), hand_chance(seed, 3 * k + 1));
        const double size = 0.75 + 0.25 * hand_chance(seed, 3 * k + 2);
        heaps.push_back({dot.at + away * dot.radius * off, (1 - away) * size * dot.radius, dot.pen});
    }
    return heaps;
}

std::vector<HandNode> flattened(const HandLine& stroke, double tolerance) {
    Edge middle;
    std::vector<std::size_t> nodes;
    for (std::size_t i = 0; i < stroke.size(); ++i) {
        const std::size_t before = middle.size();
        middle.add(stroke.nodes[i].at, stroke.nodes[i].along);
        if (middle.size() > before) nodes.push_back(i);
    }
    if (middle.size() < 2) return {stroke.nodes.front()};
    middle.set_ways(false);
    std::vector<HandNode> points = {stroke.nodes.front()};
    for (std::size_t k = 0; k + 1 < nodes.size(); ++k) {
        const glm::dvec2 a = middle.at(k), d = middle.at(k + 1);
        const glm::dvec2 second = glm::abs(a - 2.0 * middle.after(k, k + 1) + middle.before(k + 1, k)) +
                                  glm::abs(d - 2.0 * middle.before(k + 1, k) + middle.after(k, k + 1));
        const int parts = static_cast<int>(
            std::clamp(std::ceil(std::sqrt(0.75 * glm::length(second) / std::max(tolerance, 1e-12))), 1.0, 64.0));
        for (int part = 1; part <= parts; ++part) {
            const double t = static_cast<double>(part) / parts;
            HandNode point = stroke.nodes[nodes[k]];
            const HandNode& next = stroke.nodes[nodes[k + 1]];
            point.at = middle.point(k, k + 1, t);
            point.along += t * (next.along - point.along);
            point.half += t * (next.half - point.half);
            point.flow += t * (next.flow - point.flow);
            points.push_back(point);
        }
    }
    return points;
}

}  // namespace sikku
