#include "art/drawing/line_tips.h"

#include "engine/geometry/box.h"
#include "engine/geometry/parallel_curve.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <span>

namespace sikku {
namespace {

constexpr double least_turn_cosine = 0.7071;  // of 45 degrees

/// A parallel to a line, by positions on the line.
class Parallel {
public:
    Parallel(const CurvedLines& lines, const CurvedLines::Line& line, double offset)
        : lines_(lines), line_(line), offset_(offset) {}

    glm::dvec2 at(double position) const {
        const LinePlace place = lines_.place(line_, position);
        const Bezier& curve = lines_.piece(line_, place.piece).curve;
        return point_of(curve, place.t) + offset_ * left_of(tangent_of(curve, place.t));
    }
    glm::dvec2 derivative(double position) const {
        const LinePlace place = lines_.place(line_, position);
        const Bezier& curve = lines_.piece(line_, place.piece).curve;
        return (1 - offset_ * curvature_of(curve, place.t)) * derivative_of(curve, place.t);
    }
    /// Whether the line turns too tightly for the parallel here.
    bool turns_back(double position) const {
        const LinePlace place = lines_.place(line_, position);
        return offset_ * curvature_of(lines_.piece(line_, place.piece).curve, place.t) > tightest_inside;
    }

private:
    const CurvedLines& lines_;
    const CurvedLines::Line& line_;
    double offset_;
};

/// Positions and points of a parallel from one position to another.
struct ParallelPoints {
    std::vector<double> positions;
    std::vector<glm::dvec2> points;

    ParallelPoints(const Parallel& parallel, double from, double to) {
        constexpr int least = 32;
        constexpr int most = 256;
        const int count = std::clamp(static_cast<int>(16 * std::fabs(to - from)), least, most);
        for (int i = 0; i <= count; ++i) {
            positions.push_back(from + (to - from) * i / count);
            points.push_back(parallel.at(positions.back()));
        }
    }
    bool turns_back(const Parallel& parallel, std::size_t first) const {
        return std::any_of(positions.begin() + static_cast<std::ptrdiff_t>(first), positions.end(),
                           [&](double position) { return parallel.turns_back(position); });
    }
};

bool segments_cross(glm::dvec2 a, glm::dvec2 b, glm::dvec2 c, glm::dvec2 d) {
    return determinant(b - a, c - a) * determinant(b - a, d - a) <= 0 &&
           determinant(d - c, a - c) * determinant(d - c, b - c) <= 0;
}

/// Refines two positions by Newton's method. Returns false if they do not become one point.
bool refine(const Parallel& parallel, double& before, double& behind) {
    constexpr int steps = 12;
    constexpr double exact = 1e-10;
    for (int i = 0; i < steps; ++i) {
        const glm::dvec2 gap = parallel.at(behind) - parallel.at(before);
        if (glm::length(gap) < exact) return true;
        const glm::dvec2 in = parallel.derivative(before);
        const glm::dvec2 out = parallel.derivative(behind);
        const double both = determinant(in, out);
        if (both == 0) return false;
        before += determinant(gap, out) / both;
        behind += determinant(gap, in) / both;
    }
    return false;
}

/// Whether a line turns more sharply than `radius`, to the left (1) or right (-1), at each place.
std::vector<int> sharp_places(const CurvedLines& lines, const CurvedLines::Line& line, double radius, Pulse& pulse) {
    std::vector<int> turns_at;
    turns_at.reserve(std::size_t{places_of_piece} * line.count());
    for (std::uint32_t i = 0; i < line.count(); ++i) {
        pulse();
        const CurvePiece& piece = lines.piece(line, i);
        for (int k = 0; k < places_of_piece; ++k) {
            const double bend = piece.is_straight ? 0.0 : curvature_of(piece.curve, (k + 0.5) / places_of_piece);
            turns_at.push_back(std::fabs(bend) * radius <= 1 ? 0 : bend > 0 ? 1 : -1);
        }
    }
    return turns_at;
}

glm::dvec2 tangent(const CurvedLines& lines, const CurvedLines::Line& line, double position) {
    const LinePlace place = lines.place(line, position);
    return tangent_of(lines.piece(line, place.piece).curve, place.t);
}

/// Limits a tip by marks of its line beside it, halfway to the tips before and behind, by six pieces, and by half a
/// round. Returns false if a mark lies on it.
bool limit(LineTip& tip, std::span<const CurveMark> marks, const LineTip& before, const LineTip& behind,
           const CurvedLines::Line& line) {
    constexpr double farthest = 6;
    const double count = line.count();
    const double middle = (tip.begin + tip.end) / 2;
    const double reach = line.is_closed ? std::min(farthest, count / 2) : farthest;
    tip.from = line.is_closed ? middle - reach : std::max(0.0, middle - reach);
    tip.to = line.is_closed ? middle + reach : std::min(count, middle + reach);
    for (const double round : {-count, 0.0, count}) {
        if (!line.is_closed && round != 0) continue;
        if (before.end + round <= tip.begin) tip.from = std::max(tip.from, (before.end + round + tip.begin) / 2);
        if (behind.begin + round >= tip.end) tip.to = std::min(tip.to, (behind.begin + round + tip.end) / 2);
        auto mark = std::lower_bound(marks.begin(), marks.end(), tip.begin - round,
                                     [](const CurveMark& one, double position) { return one.position < position; });
        if (mark != marks.begin()) tip.from = std::max(tip.from, std::prev(mark)->position + round);
        if (mark != marks.end() && mark->position + round <= tip.end) return false;
        if (mark != marks.end()) tip.to = std::min(tip.to, mark->position + round);
    }
    return tip.from < tip.begin && tip.end < tip.to;
}

/// Finds the sharp turns of a line, without limits.
std::vector<LineTip> sharp_turns(const CurvedLines& lines, std::size_t number, double radius, Pulse& pulse) {
    const CurvedLines::Line& line = lines.lines[number];
    const std::vector<int> turns_at = sharp_places(lines, line, radius, pulse);
    const std::size_t count = turns_at.size();
    // Once around closed lines, from a place that is not sharp.
    const std::size_t first =
        line.is_closed ? static_cast<std::size_t>(std::find(turns_at.begin(), turns_at.end(), 0) - turns_at.begin())
                       : 0;
    std::vector<LineTip> turns;
    for (std::size_t i = first; first < count && i < first + count;) {
        const int side = turns_at[i % count];
        std::size_t end = i + 1;
        while (end < first + count && turns_at[end % count] == side) ++end;
        const double round = i >= count ? line.count() : 0.0;
        const LineTip turn{number,
                           static_cast<double>(i) / places_of_piece - round,
                           static_cast<double>(end) / places_of_piece - round,
                           0,
                           0,
                           side};
        if (side != 0 &&
            glm::dot(tangent(lines, line, turn.begin), tangent(lines, line, turn.end)) < least_turn_cosine) {
            turns.push_back(turn);
        }
        i = end;
    }
    return turns;
}

}  // namespace

std::vector<LineTip> find_tips(const CurvedLines& lines, const CurveMeetings& meetings, double radius,
                               const Monitor& monitor) {
    std::vector<LineTip> tips;
    Pulse pulse(monitor);
    for (std::size_t number = 0; number < lines.lines.size(); ++number) {
        const auto marks = meetings.begins.empty() ? std::span<const CurveMark>() : meetings.along(number);
        const std::vector<LineTip> turns = sharp_turns(lines, number, radius, pulse);
        for (std::size_t i = 0; i < turns.size(); ++i) {
            pulse();
            LineTip tip = turns[i];
            const LineTip& before = turns[(i + turns.size() - 1) % turns.size()];
            if (limit(tip, marks, before, turns[(i + 1) % turns.size()], lines.lines[number])) tips.push_back(tip);
        }
    }
    return tips;
}

std::optional<std::pair<double, double>> crossing_inside(const CurvedLines& lines, const LineTip& tip,
                                                         double distance) {
    const Parallel parallel(lines, lines.lines[tip.line], tip.side * distance);
    const ParallelPoints before(parallel, tip.begin, tip.from);
    const ParallelPoints behind(parallel, tip.end, tip.to);
    for (std::size_t i = 0; i + 1 < before.points.size(); ++i) {
        for (std::size_t k = 0; k + 1 < behind.points.size(); ++k) {
            if (!segments_cross(before.points[i], before.points[i + 1], behind.points[k], behind.points[k + 1]))
                continue;
            if (before.turns_back(parallel, i + 1) || behind.turns_back(parallel, k + 1)) return std::nullopt;
            double from = (before.positions[i] + before.positions[i + 1]) / 2;
            double to = (behind.positions[k] + behind.positions[k + 1]) / 2;
            if (!refine(parallel, from, to) || from < tip.from || to > tip.to) return std::nullopt;
            return std::pair(from, to);
        }
    }
    return std::nullopt;
}

}  // namespace sikku
