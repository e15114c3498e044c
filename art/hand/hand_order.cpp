#include "art/hand/hand_order.h"

#include "art/print/page.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <tuple>
#include <utility>

namespace sikku {
namespace {

Box box_of(const HandLine& line) {
    Box box;
    for (const HandNode& node : line.nodes) box.add(node.at);
    return box;
}

/// Twice the area that a closed line goes around, positive if anticlockwise.
double area_of(const HandLine& line) {
    double area = 0;
    for (std::size_t i = 0; i < line.size(); ++i) {
        const glm::dvec2 a = line.nodes[i].at - line.nodes[0].at;
        const glm::dvec2 b = line.nodes[line.next(i)].at - line.nodes[0].at;
        area += determinant(a, b);
    }
    return area;
}

/// Rounded, so that images of each other compare equal.
std::int64_t rounded(double value, double unit) {
    return std::llround(std::clamp(value / unit, -1e15, 1e15));
}

/// The node at the upper left where the line bends least, in 8ths of its bend.
std::size_t start_of(const HandLine& line, const Box& box) {
    const double size = std::max(box.longest(), 1e-12);
    std::int64_t least = INT64_MAX;
    std::size_t start = 0;
    for (std::size_t i = 0; i < line.size(); ++i) {
        const glm::dvec2 at = line.nodes[i].at;
        const glm::dvec2 in = at - line.nodes[line.previous(i)].at, out = line.nodes[line.next(i)].at - at;
        const double turn = std::fabs(hand_turn(line, i));
        const double step = (glm::length(in) + glm::length(out)) / 2;
        // A circle as large as the line's loops has a bend of 2.
        const double bend = step > 0 ? std::min(turn / step * line.loop, 8.0) : 0;
        const double place = ((at.x - box.low.x) - (at.y - box.high.y)) / size;
        const std::int64_t score = rounded(place + std::min(0.12, line.loop / size) * bend, 1e-7);
        if (score < least) {
            least = score;
            start = i;
        }
    }
    return start;
}

void turn_around(HandLine& line) {
    std::reverse(line.nodes.begin(), line.nodes.end());
}

}  // namespace

void order_by_hand(std::vector<HandLine>& lines) {
    Box whole;
    for (HandLine& line : lines) {
        const Box box = box_of(line);
        whole.add(box.low);
        whole.add(box.high);
        if (line.closed) {
            if (area_of(line) < 0) turn_around(line);
            const auto start = static_cast<std::ptrdiff_t>(start_of(line, box));
            std::rotate(line.nodes.begin(), line.nodes.begin() + start, line.nodes.end());
        } else {
            const glm::dvec2 a = line.nodes.front().at, b = line.nodes.back().at;
            if (a.x - a.y > b.x - b.y) turn_around(line);
        }
        measure_again(line);
    }
    const glm::dvec2 centre = (whole.low + whole.high) / 2.0;
    const double unit = std::max(whole.longest(), 1e-12) * 1e-3;
    using Rank = std::tuple<std::int64_t, std::int64_t, std::int64_t, std::uint64_t>;
    std::vector<std::pair<Rank, std::size_t>> keys;
    for (std::size_t i = 0; i < lines.size(); ++i) {
        const Box box = box_of(lines[i]);
        const glm::dvec2 way = (box.low + box.high) / 2.0 - centre;
        const double distance = glm::length(way);
        // Anticlockwise from the top left.
        constexpr double whole_turn = 2 * std::numbers::pi;
        const double angle = distance > unit ? std::atan2(way.y, way.x) - 0.75 * std::numbers::pi : 0;
        const double around = angle < -1e-6 ? angle + whole_turn : angle;
        keys.push_back(
            {{rounded(distance, unit), rounded(lines[i].length, unit), rounded(around, 1e-6), lines[i].number}, i});
    }
    std::sort(keys.begin(), keys.end());
    std::vector<HandLine> ordered;
    ordered.reserve(lines.size());
    for (const auto& [key, index] : keys) ordered.push_back(std::move(lines[index]));
    lines = std::move(ordered);
}

}  // namespace sikku
