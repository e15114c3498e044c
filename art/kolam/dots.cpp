#include "art/kolam/dots.h"

#include <array>

namespace sikku::kolam_plane {
namespace {

static glm::dvec2 centroid(std::span<const glm::dvec2> outline) {
    const glm::dvec2 origin = outline.front();
    glm::dvec2 sum(0.0);
    double area = 0;
    for (std::size_t i = 0; i < outline.size(); ++i) {
        const glm::dvec2 a = outline[i] - origin;
        const glm::dvec2 b = outline[(i + 1) % outline.size()] - origin;
        area += cross(a, b);
        sum += cross(a, b) * (a + b);
    }
    return area == 0 ? origin : origin + sum / (3 * area);
}
bool sees_all(glm::dvec2 point, std::span<const glm::dvec2> outline, double rounding) {
    for (std::size_t i = 0; i < outline.size(); ++i) {
        const glm::dvec2 a = outline[i];
        const glm::dvec2 along = outline[(i + 1) % outline.size()] - a;
        if (cross(along, point - a) <= rounding * (std::fabs(along.x) + std::fabs(along.y))) return false;
    }
    return true;
}
/// A point of the face in one of its corners.

bool find_place(const Faces& faces, std::uint32_t cycle, std::span<const glm::dvec2> outline, double inward,
                glm::dvec2& place) {
    for (std::size_t i = 0; i < outline.size(); ++i) {
        const glm::dvec2 corner = outline[i];
        const glm::dvec2 before = outline[(i + outline.size() - 1) % outline.size()];
        const glm::dvec2 after = outline[(i + 1) % outline.size()];
        if (cross(corner - before, after - corner) <= 0) continue;
        place = corner + inward / 3 * ((before - corner) + (after - corner));
        if (faces.at(place) == cycle) return true;
    }
    return false;
}

void flip_within(std::span<const glm::dvec2> loop, const SegmentGrid& near, std::span<const KolamDot> dots,
                 std::vector<char>& flips) {
    near.visit(loop, [&](std::uint32_t number) {
        const glm::dvec2 at = dots[number].at;
        bool inside = false;
        for (std::size_t j = 0; j < loop.size(); ++j) {
            const glm::dvec2 a = loop[j];
            const glm::dvec2 b = loop[(j + 1) % loop.size()];
            if ((a.y > at.y) == (b.y > at.y)) continue;
            if (at.x < a.x + (at.y - a.y) / (b.y - a.y) * (b.x - a.x)) inside = !inside;
        }
        if (inside) flips[number] ^= 1;
    });
}

/// Of a spline the dots have to lie within the curve, not only within its control polygon. Between the two, at
/// each span, lies a small loop; a dot in it changes sides.
void ask_the_curve(const PlanarGraph& graph, const Strokes& strokes, const Lines& lines, const KolamOptions& options,
                   std::vector<KolamDot>& dots) {
    Pulse pulse(options.monitor);
    constexpr int chords = 16;
    if (dots.empty()) return;
    glm::dvec2 low = dots.front().at;
    glm::dvec2 high = low;
    for (const KolamDot& mark : dots) {
        low = {std::min(low.x, mark.at.x), std::min(low.y, mark.at.y)};
        high = {std::max(high.x, mark.at.x), std::max(high.y, mark.at.y)};
    }
    SegmentGrid near(low, high, graph.grid->cell(), 0.0);
    for (std::uint32_t i = 0; i < dots.size(); ++i) near.add(i, dots[i].at, dots[i].at);
    near.sort(options.monitor);
    std::vector<char> flips(dots.size(), 0);
    std::vector<glm::dvec2> loop;
    for (std::size_t i = 0; i < strokes.count(); ++i) {
        if (lines.is_stroke_of_open_line[i]) continue;
        const auto nodes = strokes.stroke(i);
        const auto count = static_cast<std::ptrdiff_t>(nodes.size()) - 1;
        const bool closed = strokes.closed[i];
        const auto control = [&](std::ptrdiff_t j) {
            j = closed ? (j % count + count) % count : std::clamp<std::ptrdiff_t>(j, 0, count);
            return graph.node_places[nodes[static_cast<std::size_t>(j)]];
        };
        for (std::ptrdiff_t j = closed ? 0 : -1; j < (closed ? count : count + 1); ++j) {
            pulse();
            const std::array<glm::dvec2, 4> p = {control(j - 1), control(j), control(j + 1), control(j + 2)};
            const std::array<glm::dvec2, 4> reach = {p[1], p[2], (p[0] + 4.0 * p[1] + p[2]) / 6.0,
                                                     (p[1] + 4.0 * p[2] + p[3]) / 6.0};
            bool reaches_dots = false;
            const auto [left, right] = std::minmax({reach[0].x, reach[1].x, reach[2].x, reach[3].x});
            const auto [bottom, top] = std::minmax({reach[0].y, reach[1].y, reach[2].y, reach[3].y});
            near.visit(reach, [&, left = left, right = right, bottom = bottom, top = top](std::uint32_t number) {
                const glm::dvec2 at = dots[number].at;
                reaches_dots |= left <= at.x && at.x <= right && bottom <= at.y && at.y <= top;
            });
            if (!reaches_dots) continue;
            loop = {p[2], p[1]};
            for (int k = 0; k <= chords; ++k) {
                const double t = static_cast<double>(k) / chords;
                const double s = 1 - t;
                loop.push_back((s * s * s * p[0] + (3 * t * t * t - 6 * t * t + 4) * p[1] +
                                (3 * s * s * s - 6 * s * s + 4) * p[2] + t * t * t * p[3]) /
                               6.0);
            }
            flip_within(loop, near, dots, flips);
        }
    }
    for (std::size_t i = 0; i < flips.size(); ++i) {
        if (flips[i]) dots[i].is_enclosed = !dots[i].is_enclosed;
    }
}

}  // namespace

std::vector<KolamDot> set_dots(const PlanarGraph& graph, const Faces& faces, const Strokes& strokes,
                               const Lines& lines, const KolamOptions& options) {
    std::vector<KolamDot> dots;
    Pulse pulse(options.monitor);
    std::vector<glm::dvec2> outline;
    for (std::uint32_t cycle = 0; cycle < faces.cycles(); ++cycle) {
        pulse();
        const std::uint32_t first = faces.half_of(cycle);
        if (!faces.is_odd(cycle) || faces.is_outer(cycle)) continue;
        outline.clear();
        std::uint32_t half = first;
        do {
            outline.push_back(graph.places[graph.tail(half)]);
            half = graph.next(half);
        } while (half != first);
        KolamDot mark{centroid(outline), true, false};
        mark.is_alone = !faces.has_holes(cycle) && sees_all(mark.at, outline, graph.rounding);
        if (!mark.is_alone && faces.at(mark.at) != cycle) {
            mark.is_enclosed = false;
            for (const double inward : {0.9, 0.5, 0.1, 0.01, 1e-4}) {
                if (find_place(faces, cycle, outline, inward, mark.at)) {
                    mark.is_enclosed = true;
                    break;
                }
            }
        }
        dots.push_back(mark);
    }
    if (options.spline) ask_the_curve(graph, strokes, lines, options, dots);
    // Rounding must not put the dots of one row out of order.
    const auto key = [](const KolamDot& mark) {
        return std::pair(std::round(mark.at.y * 1e6), std::round(mark.at.x * 1e6));
    };
    sort(options, dots, [&](const KolamDot& a, const KolamDot& b) { return key(a) < key(b); });
    return dots;
}

}  // namespace sikku::kolam_plane
