#include "art/kolam/curve_intersections.h"

#include "art/kolam/curved_lines.h"
#include "engine/geometry/box.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace sikku {
namespace {

constexpr double touching = 1e-11;   // in steps: boxes as near as this overlap
constexpr double contact = 2e-6;     // in steps: curves this short that still overlap touch
constexpr double one_point = 1e-9;   // in steps: the most that Newton's method may leave
constexpr double on_segment = 1e-7;  // in steps: an end as near as this lies on a segment
constexpr double beyond = 1e-9;      // a parameter so far outside of [0, 1] is an end
constexpr int deepest = 26;          // halvings
constexpr int most_contacts = 100;

double length(glm::dvec2 a) {
    return std::hypot(a.x, a.y);
}

bool boxes_overlap(const Bezier& a, const Bezier& b) {
    const Box first = box_of(a), second = box_of(b);
    for (int axis = 0; axis < 2; ++axis) {
        if (first.low[axis] > second.high[axis] + touching) return false;
        if (second.low[axis] > first.high[axis] + touching) return false;
    }
    return true;
}

/// True if the curve deviates from its chord by little, and runs along it evenly.
bool is_flat(const Bezier& b) {
    const glm::dvec2 along = (b[3] - b[0]) / 3.0;
    const double most = 1e-3 * length(along) + 1e-12;
    return length(b[1] - b[0] - along) <= most && length(b[3] - b[2] - along) <= most;
}

/// True if a direction exists in which all of the curves advance.
bool advance(const Bezier& a, const Bezier& b) {
    for (const glm::dvec2 along : {b[3] - a[0], a[3] - a[0], b[3] - b[0]}) {
        bool is_ahead = true;
        for (std::size_t i = 0; i < 3; ++i) {
            is_ahead = is_ahead && scalar_product(a[i + 1] - a[i], along) >= 0 &&
                       scalar_product(b[i + 1] - b[i], along) >= 0;
        }
        if (is_ahead && scalar_product(a[3] - a[0], along) > 0 && scalar_product(b[3] - b[0], along) > 0) return true;
    }
    return false;
}

}  // namespace

CurveIntersections::Part CurveIntersections::half(const Part& part, bool is_second) {
    return {part_of(part.curve, is_second ? 0.5 : 0.0, is_second ? 1.0 : 0.5), is_second ? part.middle() : part.from,
            is_second ? part.to : part.middle()};
}

void CurveIntersections::begin(const Bezier& a, const Bezier& b, const Note& note) {
    first_ = &a;
    second_ = &b;
    note_ = &note;
    contacts_ = 0;
}

void CurveIntersections::of_two(const Bezier& a, const Bezier& b, const Note& note) {
    begin(a, b, note);
    meet({a}, {b}, 0);
}

void CurveIntersections::of_neighbours(const Bezier& a, const Bezier& b, const Note& note) {
    begin(a, b, note);
    meet_neighbours({a}, {b}, 0);
}

void CurveIntersections::of_one(const Bezier& curve, const Note& note) {
    begin(curve, curve, note);
    meet_self({curve}, 0);
}

void CurveIntersections::meet_self(const Part& part, int depth) {
    if (advance(part.curve, part.curve) || depth >= deepest) return;
    const Part first = half(part, false);
    const Part second = half(part, true);
    meet_self(first, depth + 1);
    meet_self(second, depth + 1);
    meet_neighbours(first, second, depth + 1);
}

void CurveIntersections::meet_neighbours(const Part& a, const Part& b, int depth) {
    if (advance(a.curve, b.curve) || depth >= deepest) return;
    const Part a_first = half(a, false);
    const Part a_last = half(a, true);
    const Part b_first = half(b, false);
    const Part b_last = half(b, true);
    meet_neighbours(a_last, b_first, depth + 1);
    meet(a_first, b_first, depth + 1);
    meet(a_first, b_last, depth + 1);
    meet(a_last, b_last, depth + 1);
}

void CurveIntersections::meet(const Part& a, const Part& b, int depth) {
    if (!boxes_overlap(a.curve, b.curve)) return;
    const bool a_is_flat = is_flat(a.curve);
    const bool b_is_flat = is_flat(b.curve);
    const glm::dvec2 along_a = a.curve[3] - a.curve[0];
    const glm::dvec2 along_b = b.curve[3] - b.curve[0];
    if (a_is_flat && b_is_flat) {
        const double area = determinant(along_a, along_b);
        const glm::dvec2 between = b.curve[0] - a.curve[0];
        if (std::fabs(area) > 1e-2 * length(along_a) * length(along_b)) {
            constexpr double margin = 0.1;
            const double t = determinant(between, along_b) / area;
            const double s = determinant(between, along_a) / area;
            const auto lies_on = [](double at) { return at > -margin && at < 1 + margin; };
            if (!lies_on(t) || !lies_on(s)) return;
            return settle(a, b, a.from + t * (a.to - a.from), b.from + s * (b.to - b.from));
        }
    }
    if (depth >= deepest || std::max(length(along_a), length(along_b)) < contact) {
        // Parallel, and too near to be separated.
        if (++contacts_ > most_contacts) {
            throw std::runtime_error("cannot find the crossings of lines that run along each other");
        }
        return (*note_)(a.middle(), b.middle());
    }
    const bool halves_a = !a_is_flat || (b_is_flat && length(along_a) >= length(along_b));
    const bool halves_b = !b_is_flat || !halves_a;
    if (halves_a && halves_b) {
        for (const bool i : {false, true}) {
            for (const bool j : {false, true}) meet(half(a, i), half(b, j), depth + 1);
        }
    } else {
        for (const bool i : {false, true}) {
            meet(halves_a ? half(a, i) : a, halves_b ? half(b, i) : b, depth + 1);
        }
    }
}

/// Newton's method on the whole curves.
void CurveIntersections::settle(const Part& a, const Part& b, double t, double s) {
    glm::dvec2 gap(0.0);
    for (int i = 0; i < 12; ++i) {
        gap = point_of(*second_, s) - point_of(*first_, t);
        const glm::dvec2 along_a = derivative_of(*first_, t);
        const glm::dvec2 along_b = derivative_of(*second_, s);
        const double area = determinant(along_a, along_b);
        if (area == 0) break;
        const double dt = determinant(gap, along_b) / area;
        const double ds = determinant(gap, along_a) / area;
        t += dt;
        s += ds;
        if (std::fabs(dt) < 1e-15 && std::fabs(ds) < 1e-15) break;
    }
    gap = point_of(*second_, s) - point_of(*first_, t);
    const auto lies_in = [](const Part& part, double at) {
        const double margin = 0.5 * (part.to - part.from);
        return at >= std::max(part.from - margin, -beyond) && at <= std::min(part.to + margin, 1 + beyond);
    };
    if (!(length(gap) <= one_point) || !lies_in(a, t) || !lies_in(b, s)) return;
    (*note_)(std::clamp(t, 0.0, 1.0), std::clamp(s, 0.0, 1.0));
}

void CurveIntersections::of_segments(const Bezier& a, const Bezier& b, const Note& note) {
    if (!boxes_overlap(a, b)) return;
    const glm::dvec2 along_a = a[3] - a[0];
    const glm::dvec2 along_b = b[3] - b[0];
    const double area = determinant(along_a, along_b);
    const glm::dvec2 between = b[0] - a[0];
    const double length_a = length(along_a);
    const double length_b = length(along_b);
    // Parameter of the end point's foot on the other segment.
    const auto foot = [](glm::dvec2 point, const Bezier& on, double t, bool is_first, const Note& to) {
        const glm::dvec2 along = on[3] - on[0];
        const double s = std::clamp(scalar_product(point - on[0], along) / scalar_product(along, along), 0.0, 1.0);
        const glm::dvec2 gap = point - (on[0] + s * along);
        if (length(gap) > on_segment) return false;
        is_first ? to(t, s) : to(s, t);
        return true;
    };
    bool is_end = foot(a[0], b, 0.0, true, note);
    is_end |= foot(a[3], b, 1.0, true, note);
    is_end |= foot(b[0], a, 0.0, false, note);
    is_end |= foot(b[3], a, 1.0, false, note);
    if (is_end || std::fabs(area) <= 1e-12 * length_a * length_b) return;
    const double t = determinant(between, along_b) / area;
    const double s = determinant(between, along_a) / area;
    if (t >= 0 && t <= 1 && s >= 0 && s <= 1) note(t, s);
}

}  // namespace sikku
