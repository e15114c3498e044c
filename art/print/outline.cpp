#include "art/print/outline.h"

#include "engine/geometry/box.h"
#include "engine/geometry/lettering.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>
#include <utility>

namespace sikku {
namespace {

constexpr double dash = 3, dash_gap = 2;

/// True if two sides have a common point.
bool meet(glm::dvec2 a, glm::dvec2 b, glm::dvec2 c, glm::dvec2 d) {
    const double first = determinant(b - a, c - a), second = determinant(b - a, d - a);
    const double third = determinant(d - c, a - c), fourth = determinant(d - c, b - c);
    return ((first > 0) != (second > 0)) && ((third > 0) != (fourth > 0));
}

bool crosses_itself(const std::vector<glm::dvec2>& outline) {
    const std::size_t count = outline.size();
    for (std::size_t i = 0; i < count; ++i) {
        for (std::size_t k = i + 2; k < count; ++k) {
            if (i == 0 && k + 1 == count) continue;
            if (meet(outline[i], outline[i + 1], outline[k], outline[(k + 1) % count])) return true;
        }
    }
    return false;
}

bool contains(std::span<const glm::dvec2> outline, glm::dvec2 point) {
    bool inside = false;
    for (std::size_t i = 0, k = outline.size() - 1; i < outline.size(); k = i++) {
        const glm::dvec2 a = outline[i], b = outline[k];
        if ((a.y > point.y) != (b.y > point.y) && point.x < (b.x - a.x) * (point.y - a.y) / (b.y - a.y) + a.x) {
            inside = !inside;
        }
    }
    return inside;
}

/// A point far from all sides, on a grid, and its distance from them.
std::pair<glm::dvec2, double> roomiest(std::span<const glm::dvec2> outline) {
    constexpr int cells = 32;
    const Box box = box_of(outline);
    const glm::dvec2 low = box.low, high = box.high;
    std::pair<glm::dvec2, double> best{(low + high) / 2.0, 0.0};
    for (int y = 1; y < cells; ++y) {
        for (int x = 1; x < cells; ++x) {
            const glm::dvec2 point = low + (high - low) * glm::dvec2(x, y) / static_cast<double>(cells);
            if (!contains(outline, point)) continue;
            double distance = std::numeric_limits<double>::max();
            for (std::size_t i = 0; i < outline.size(); ++i) {
                distance =
                    std::min(distance, distance_to_segment(point, outline[i], outline[(i + 1) % outline.size()]));
            }
            if (distance > best.second * (1 + 1e-9)) best = {point, distance};
        }
    }
    return best;
}

}  // namespace

std::vector<glm::dvec2> turned(std::span<const glm::dvec2> corners, double angle) {
    const glm::dvec2 way(std::cos(angle), std::sin(angle));
    std::vector<glm::dvec2> result;
    for (const glm::dvec2 corner : corners) result.push_back(complex_product(corner, way));
    return result;
}

std::optional<std::vector<glm::dvec2>> offset_sides(std::span<const glm::dvec2> corners, double distance) {
    if (!(distance > 0)) return std::vector<glm::dvec2>(corners.begin(), corners.end());
    std::vector<glm::dvec2> outline;
    std::vector<std::pair<std::size_t, std::size_t>> of_corner;  // first and last point of each corner
    const std::size_t count = corners.size();
    for (std::size_t i = 0; i < count; ++i) {
        const glm::dvec2 at = corners[i];
        const glm::dvec2 before = glm::normalize(at - corners[(i + count - 1) % count]);
        const glm::dvec2 after = glm::normalize(corners[(i + 1) % count] - at);
        const glm::dvec2 first(before.y, -before.x), second(after.y, -after.x);
        const double cosine = glm::dot(first, second);
        of_corner.emplace_back(outline.size(), 0);
        // The mitre is longer than twice the distance at angles below 60 degrees. The slack avoids sides of length 0
        // at 60.
        if (determinant(before, after) > 0 && cosine < -0.5 - 1e-9) {
            const glm::dvec2 tip = glm::normalize(before - after);
            const double beyond = distance * (2 - glm::dot(first, tip)) / glm::dot(before, tip);
            outline.push_back(at + first * distance + before * beyond);
            outline.push_back(at + second * distance - after * beyond);
        } else {
            outline.push_back(at + (first + second) * (distance / (1 + cosine)));
        }
        of_corner.back().second = outline.size() - 1;
    }
    // Each side keeps its direction.
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t next = (i + 1) % count;
        const glm::dvec2 side = outline[of_corner[next].first] - outline[of_corner[i].second];
        if (!(glm::dot(side, corners[next] - corners[i]) > 0)) return std::nullopt;
    }
    return outline;
}

std::vector<glm::dvec2> offset_outline(std::span<const glm::dvec2> corners, double distance) {
    auto outline = offset_sides(corners, distance);
    if (outline && (!(distance > 0) || !crosses_itself(*outline))) return std::move(*outline);
    throw std::runtime_error(
        fmt::format("an allowance of {} mm does not fit into the notches of its outline", distance));
}

void draw_closed(const std::vector<glm::dvec2>& outline, glm::dvec2 offset, const Pen& pen, PathSink& sink) {
    std::vector<glm::dvec2> ends;
    for (std::size_t i = 1; i <= outline.size(); ++i) ends.push_back(outline[i % outline.size()] + offset);
    sink.begin_stroke(outline.front() + offset, pen);
    sink.lines(ends);
    sink.end_stroke(true);
}

void draw_dashed(const std::vector<glm::dvec2>& outline, glm::dvec2 offset, const Pen& pen, PathSink& sink) {
    for (std::size_t i = 0; i < outline.size(); ++i) {
        const glm::dvec2 from = outline[i], to = outline[(i + 1) % outline.size()];
        const double length = glm::distance(from, to);
        const double gaps = std::max(0.0, std::round((length - dash) / (dash + dash_gap)));
        const double scale = length / (dash + gaps * (dash + dash_gap));
        for (double k = 0; k <= gaps; ++k) {
            const glm::dvec2 along = (to - from) / length * scale;
            const glm::dvec2 end = from + along * (k * (dash + dash_gap) + dash) + offset;
            sink.begin_stroke(from + along * (k * (dash + dash_gap)) + offset, pen);
            sink.lines({&end, 1});
            sink.end_stroke(false);
        }
    }
}

LabelPlace label_place(std::string_view text, std::span<const glm::dvec2> outline, double most_height) {
    const auto [middle, room] = roomiest(outline);
    const double width = text_width(text, 1);
    const double height = std::min(most_height, 1.7 * room / std::hypot(width, 1 + letter_descent));
    return {middle - glm::dvec2(width * height / 2, height / 2), height};
}

}  // namespace sikku
