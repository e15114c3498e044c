#include "art/kolam/dots.h"

#include "engine/geometry/bezier.h"
#include "engine/geometry/point_tree.h"
#include "engine/geometry/simple_polygon.h"

#include <array>
#include <numeric>

namespace sikku::kolam_plane {
namespace {

glm::dvec2 centroid(std::span<const glm::dvec2> outline) {
    const glm::dvec2 origin = outline.front();
    glm::dvec2 sum(0.0);
    double area = 0;
    for (std::size_t i = 0; i < outline.size(); ++i) {
        const glm::dvec2 a = outline[i] - origin;
        const glm::dvec2 b = outline[(i + 1) % outline.size()] - origin;
        area += determinant(a, b);
        sum += determinant(a, b) * (a + b);
    }
    return area == 0 ? origin : origin + sum / (3 * area);
}
bool sees_all(glm::dvec2 point, std::span<const glm::dvec2> outline, double rounding) {
    for (std::size_t i = 0; i < outline.size(); ++i) {
        const glm::dvec2 a = outline[i];
        const glm::dvec2 along = outline[(i + 1) % outline.size()] - a;
        if (determinant(along, point - a) <= rounding * (std::fabs(along.x) + std::fabs(along.y))) return false;
    }
    return true;
}
std::vector<glm::dvec2> outline_of(const PlanarGraph& graph, const Faces& faces, std::uint32_t cycle) {
    std::vector<glm::dvec2> outline;
    const std::uint32_t first = faces.half_of(cycle);
    std::uint32_t half = first;
    do {
        outline.push_back(graph.places[graph.tail(half)]);
        half = graph.next(half);
    } while (half != first);
    return outline;
}
/// A point of the face in one of its corners.
bool find_place(const Faces& faces, std::uint32_t cycle, std::span<const glm::dvec2> outline, double inward,
                glm::dvec2& place) {
    for (std::size_t i = 0; i < outline.size(); ++i) {
        const glm::dvec2 corner = outline[i];
        const glm::dvec2 before = outline[(i + outline.size() - 1) % outline.size()];
        const glm::dvec2 after = outline[(i + 1) % outline.size()];
        if (determinant(corner - before, after - corner) <= 0) continue;
        place = corner + inward / 3 * ((before - corner) + (after - corner));
        if (faces.at(place) == cycle) return true;
    }
    return false;
}

void flip_within(std::span<const glm::dvec2> loop, const SegmentGrid& near, std::span<const KolamDot> dots,
                 std::vector<char>& flips) {
    near.visit(loop, [&](std::uint32_t number) {
        if (contains(loop, dots[number].at)) flips[number] ^= 1;
    });
}

/// A control point of a stroke: closed ones go round, open ones end.
glm::dvec2 control_of(const PlanarGraph& graph, std::span<const std::uint32_t> nodes, bool closed, std::ptrdiff_t j) {
    const auto count = static_cast<std::ptrdiff_t>(nodes.size()) - 1;
    j = closed ? (j % count + count) % count : std::clamp<std::ptrdiff_t>(j, 0, count);
    return graph.node_places[nodes[static_cast<std::size_t>(j)]];
}

/// The dots of a spline have to lie within the curve, not only within its control polygon. Between the two, at
/// each span, lies a small loop; a dot in it changes sides.
void ask_the_curve(const PlanarGraph& graph, const Strokes& strokes, const Lines& lines, const KolamOptions& options,
                   std::vector<KolamDot>& dots) {
    Pulse pulse(options.monitor);
    constexpr int chords = 16;
    if (dots.empty()) return;
    Box whole;
    for (const KolamDot& mark : dots) whole.add(mark.at);
    SegmentGrid near(whole, graph.grid->cell(), 0.0);
    for (std::uint32_t i = 0; i < dots.size(); ++i) near.add(i, dots[i].at, dots[i].at);
    near.sort(options.monitor);
    std::vector<char> flips(dots.size(), 0);
    std::vector<glm::dvec2> loop;
    for (std::size_t i = 0; i < strokes.count(); ++i) {
        if (lines.is_stroke_of_open_line[i]) continue;
        const auto nodes = strokes.stroke(i);
        const auto count = static_cast<std::ptrdiff_t>(nodes.size()) - 1;
        const bool closed = strokes.closed[i];
        const auto control = [&](std::ptrdiff_t j) { return control_of(graph, nodes, closed, j); };
        for (std::ptrdiff_t j = closed ? 0 : -1; j < (closed ? count : count + 1); ++j) {
            pulse();
            const std::array<glm::dvec2, 4> p = {control(j - 1), control(j), control(j + 1), control(j + 2)};
            const std::array<glm::dvec2, 4> reach = {p[1], p[2], (p[0] + 4.0 * p[1] + p[2]) / 6.0,
                                                     (p[1] + 4.0 * p[2] + p[3]) / 6.0};
            bool reaches_dots = false;
            const Box box = box_of(reach);
            near.visit(reach, [&](std::uint32_t number) { reaches_dots |= box.contains(dots[number].at); });
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

/// Calls `visit` for each curve of a stroke, in order.
template <class Visit>
void visit_curves(const PlanarGraph& graph, std::span<const std::uint32_t> nodes, bool closed, bool spline,
                  Visit&& visit) {
    const auto count = static_cast<std::ptrdiff_t>(nodes.size()) - 1;
    const auto control = [&](std::ptrdiff_t j) { return control_of(graph, nodes, closed, j); };
    const std::ptrdiff_t more = spline && !closed ? 1 : 0;  // an open spline begins and ends in its end points
    for (std::ptrdiff_t j = -more; j < count + more; ++j) {
        const glm::dvec2 b = control(j), c = control(j + 1);
        if (!spline) {
            visit(straight_curve(b, c));
            continue;
        }
        const glm::dvec2 a = control(j - 1), d = control(j + 2);
        visit({(a + 4.0 * b + c) / 6.0, (2.0 * b + c) / 3.0, (b + 2.0 * c) / 3.0, (b + 4.0 * c + d) / 6.0});
    }
}

/// Finds the dots that a line runs through, and counts how often each line runs around each dot.
class Winding {
public:
    Winding(std::vector<KolamDot>& dots, const Monitor& monitor)
        : dots_(dots), pulse_(monitor), times_(dots.size()), is_touched_(dots.size()) {}

    /// Parts of a line may have different directions, so that only the parity of crossings counts.
    void add(const Bezier& curve, bool is_closed_stroke) {
        const Box box = box_of(curve);
        const auto first = std::lower_bound(dots_.begin(), dots_.end(), box.low.y - 2 * steps_are_one,
                                            [](const KolamDot& dot, double y) { return dot.at.y < y; });
        for (auto dot = first; dot != dots_.end() && dot->at.y <= box.high.y + 2 * steps_are_one; ++dot) {
            pulse_();
            if (dot->at.x > box.high.x + 2 * steps_are_one) continue;
            const auto number = static_cast<std::size_t>(dot - dots_.begin());
            if (dot->at.x < box.low.x - 2 * steps_are_one) {
                pass(number, curve[0], curve[3], is_closed_stroke);
            } else {
                pass_near(number, curve, is_closed_stroke);
            }
        }
    }
    void end_line(bool is_closed) {
        for (const std::size_t number : touched_) {
            if (is_closed && times_[number] != 0) dots_[number].is_enclosed = true;
            times_[number] = 0;
            is_touched_[number] = 0;
        }
        touched_.clear();
    }

private:
    /// Adds a chord on the right of a dot, or around it.
    void pass(std::size_t number, glm::dvec2 a, glm::dvec2 b, bool is_closed_stroke) {
        const glm::dvec2 at = dots_[number].at;
        if ((a.y > at.y) == (b.y > at.y)) return;
        if (at.x >= a.x + (at.y - a.y) / (b.y - a.y) * (b.x - a.x)) return;
        if (!is_touched_[number]) touched_.push_back(number);
        is_touched_[number] = 1;
        int& times = times_[number];
        times = is_closed_stroke ? times + (b.y > a.y ? 1 : -1) : 1 - times;
    }
    void pass_near(std::size_t number, const Bezier& curve, bool is_closed_stroke) {
        KolamDot& dot = dots_[number];
        glm::dvec2 from = curve[0];
        flatten(curve[0], curve[1], curve[2], curve[3], steps_are_one / 4, [&](glm::dvec2 to) {
            pulse_();
            const glm::dvec2 way = to - from, apart = dot.at - from;
            const double square = way.x * way.x + way.y * way.y;
            const double share =
                square > 0 ? std::clamp((apart.x * way.x + apart.y * way.y) / square, 0.0, 1.0) : 0.0;
            const glm::dvec2 gap = apart - share * way;
            dot.is_on_line |= std::hypot(gap.x, gap.y) <= steps_are_one;
            pass(number, from, to, is_closed_stroke);
            from = to;
        });
    }

    std::vector<KolamDot>& dots_;
    Pulse pulse_;
    std::vector<int> times_;
    std::vector<char> is_touched_;
    std::vector<std::size_t> touched_;
};

/// Rounding must not put the dots of one row out of order.
void sort_rows(std::vector<KolamDot>& dots, const KolamOptions& options) {
    const auto key = [](const KolamDot& mark) {
        return std::pair(std::round(mark.at.y * 1e6), std::round(mark.at.x * 1e6));
    };
    sort(options, dots, [&](const KolamDot& a, const KolamDot& b) { return key(a) < key(b); });
}

}  // namespace

bool has_dots_elsewhere(std::span<const glm::dvec2> discs, const std::vector<KolamDot>& set) {
    if (discs.size() < 3) return false;
    std::vector<glm::dvec2> places;
    for (const KolamDot& mark : set) places.push_back(mark.at);
    const PointTree tree(places);
    std::vector<PointTree::Near> found;
    return std::any_of(discs.begin(), discs.end(), [&](glm::dvec2 disc) {
        tree.nearest(disc, 0.25, 1, found);
        return found.empty();
    });
}

std::vector<KolamDot> own_dots(const PlanarGraph& graph, const Strokes& strokes, const Lines& lines,
                               const KolamOptions& options) {
    std::vector<KolamDot> dots;
    for (const glm::dvec2 disc : strokes.discs) dots.push_back({.at = disc, .is_alone = true});
    sort(options, dots,
         [](const KolamDot& a, const KolamDot& b) { return std::pair(a.at.y, a.at.x) < std::pair(b.at.y, b.at.x); });
    Winding winding(dots, options.monitor);
    std::vector<std::size_t> order(strokes.count());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return lines.line_of_stroke[a] < lines.line_of_stroke[b]; });
    for (std::size_t k = 0; k < order.size(); ++k) {
        const std::size_t i = order[k];
        const bool closed = strokes.closed[i];
        visit_curves(graph, strokes.stroke(i), closed, options.spline,
                     [&](const Bezier& curve) { winding.add(curve, closed); });
        if (k + 1 == order.size() || lines.line_of_stroke[order[k + 1]] != lines.line_of_stroke[i]) {
            winding.end_line(!lines.is_stroke_of_open_line[i]);
        }
    }
    sort_rows(dots, options);
    const auto same = [](const KolamDot& a, const KolamDot& b) {
        return std::hypot(a.at.x - b.at.x, a.at.y - b.at.y) <= steps_are_one;
    };
    for (KolamDot& mark : dots) mark.is_enclosed &= !mark.is_on_line;
    dots.erase(std::unique(dots.begin(), dots.end(), same), dots.end());
    return dots;
}

void enclose_in_fields(const PlanarGraph& graph, const Faces& faces, std::vector<KolamDot>& dots) {
    // Corners of fields lie below centred dots, where rounding would decide.
    constexpr glm::dvec2 beside(1e-4, 0);
    std::vector<std::uint32_t> face_of, dots_in(faces.cycles());
    for (const KolamDot& dot : dots) {
        face_of.push_back(dot.is_on_line ? none : faces.at(dot.at + beside));
        if (face_of.back() != none) ++dots_in[face_of.back()];
    }
    for (std::size_t i = 0; i < dots.size(); ++i) {
        const std::uint32_t face = face_of[i];
        if (face == none || dots[i].is_enclosed || dots_in[face] != 1 || faces.has_holes(face)) continue;
        dots[i].is_enclosed = sees_all(dots[i].at, outline_of(graph, faces, face), graph.rounding);
    }
}

std::vector<KolamDot> set_dots(const PlanarGraph& graph, const Faces& faces, const Strokes& strokes,
                               const Lines& lines, const KolamOptions& options) {
    std::vector<KolamDot> dots;
    Pulse pulse(options.monitor);
    std::vector<glm::dvec2> outline;
    for (std::uint32_t cycle = 0; cycle < faces.cycles(); ++cycle) {
        pulse();
        if (!faces.is_odd(cycle) || faces.is_outer(cycle)) continue;
        outline = outline_of(graph, faces, cycle);
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
    sort_rows(dots, options);
    return dots;
}

}  // namespace sikku::kolam_plane
