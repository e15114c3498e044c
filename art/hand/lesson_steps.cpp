#include "art/hand/lesson_steps.h"

#include "art/print/page.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace sikku {
namespace {

constexpr double loops_of_stretch = 12;
constexpr std::size_t most_parts = 8;     // parts of a line under a rotation
constexpr std::size_t samples = 96;       // points of a line that are compared with its image
constexpr double image_tolerance = 0.06;  // loops

glm::dvec2 place(const HandLine& line, double along) {
    along = std::fmod(along, line.length);
    const auto after = std::upper_bound(line.nodes.begin(), line.nodes.end(), along,
                                        [](double at, const HandNode& node) { return at < node.along; });
    const std::size_t i = static_cast<std::size_t>(after - line.nodes.begin()) - 1;
    const double step = line.step(i);
    const double t = step > 0 ? (along - line.nodes[i].along) / step : 0;
    return line.nodes[i].at + t * (line.nodes[line.next(i)].at - line.nodes[i].at);
}

/// Number of equal parts into which rotations about the centre of its box divide the line.
std::size_t equal_parts(const HandLine& line) {
    if (!line.closed) return 1;
    Box box;
    for (const HandNode& node : line.nodes) box.add(node.at);
    const glm::dvec2 centre = (box.low + box.high) / 2.0;
    for (std::size_t parts = most_parts; parts > 1; --parts) {
        // The line goes around the centre once or more, or back: the image lies some parts farther on.
        for (std::size_t turn = 1; turn < parts; ++turn) {
            const double angle = 2 * std::numbers::pi * static_cast<double>(turn) / static_cast<double>(parts);
            if (std::gcd(turn, parts) != 1) continue;
            const double c = std::cos(angle), s = std::sin(angle);
            bool is_image = true;
            for (std::size_t k = 0; k < samples && is_image; ++k) {
                const double along = line.length * static_cast<double>(k) / samples;
                const glm::dvec2 from = place(line, along) - centre;
                const glm::dvec2 to = place(line, along + line.length / static_cast<double>(parts)) - centre;
                const glm::dvec2 image(c * from.x - s * from.y, s * from.x + c * from.y);
                is_image = glm::length(image - to) < image_tolerance * line.loop;
            }
            if (is_image) return parts;
        }
    }
    return 1;
}

std::size_t node_at(const HandLine& line, double along) {
    if (along >= line.length) return line.closed ? line.size() : line.size() - 1;
    const auto found = std::lower_bound(line.nodes.begin(), line.nodes.end(), along,
                                        [](const HandNode& node, double at) { return node.along < at; });
    return static_cast<std::size_t>(found - line.nodes.begin());
}

void cut(const HandLine& line, std::size_t number, std::vector<LessonStep>& steps) {
    const std::size_t parts = equal_parts(line);
    // A whole circle or ring is one movement.
    const double longest = loops_of_stretch * line.loop;
    if (line.length <= longest / 2) {
        steps.push_back({{number, 0, node_at(line, line.length)}});
        return;
    }
    const double part = line.length / static_cast<double>(parts);
    const double pieces = std::clamp(std::ceil(part / longest), 1.0, static_cast<double>(most_lesson_steps));
    const std::size_t count = parts * static_cast<std::size_t>(pieces);
    std::size_t from = 0;
    for (std::size_t k = 1; k <= count; ++k) {
        const std::size_t to = node_at(line, line.length * static_cast<double>(k) / static_cast<double>(count));
        if (to <= from) continue;
        steps.push_back({{number, from, to}});
        from = to;
    }
}

}  // namespace

std::vector<LessonStep> lesson_steps(const std::vector<HandLine>& lines, std::size_t most) {
    std::vector<LessonStep> steps;
    for (std::size_t i = 0; i < lines.size(); ++i) {
        if (lines[i].size() > 1) cut(lines[i], i, steps);
    }
    if (steps.size() <= most) return steps;
    // Stretches of one line that follow each other become one.
    std::vector<LessonStep> joined(most);
    for (std::size_t i = 0; i < steps.size(); ++i) {
        LessonStep& step = joined[i * most / steps.size()];
        const Stretch& stretch = steps[i].front();
        if (!step.empty() && step.back().line == stretch.line && step.back().to == stretch.from) {
            step.back().to = stretch.to;
        } else {
            step.push_back(stretch);
        }
    }
    return joined;
}

HandLine part_of(const HandLine& line, const Stretch& stretch) {
    HandLine part = line;
    part.closed = false;
    part.nodes.clear();
    for (std::size_t i = stretch.from; i <= stretch.to && i <= line.size(); ++i) {
        part.nodes.push_back(line.nodes[i % line.size()]);
        if (i == line.size()) part.nodes.back().along = line.length;
    }
    const double begin = part.nodes.front().along;
    for (HandNode& node : part.nodes) node.along -= begin;
    part.length = part.nodes.back().along;
    return part;
}

HandLine beginning_of(const HandLine& line, double share) {
    HandLine part = line;
    while (part.size() > 2 && part.nodes[part.size() - 2].along >= share * line.length) part.nodes.pop_back();
    part.length = part.nodes.back().along;
    return part;
}

}  // namespace sikku
