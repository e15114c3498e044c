#include "art/kolam/curve_meetings.h"

#include "art/kolam/curve_intersections.h"
#include "art/kolam/kolam_plane.h"
#include "engine/derivation/forecast.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

namespace sikku {
namespace {

constexpr double one_place = 1e-6;  // points as near as this are one
constexpr std::uint32_t no_meeting = std::numeric_limits<std::uint32_t>::max();

/// Pairs of pieces whose boxes overlap, found through the cells of a grid.
class PiecePairs {
public:
    PiecePairs(const std::vector<CurvePiece>& pieces, const Monitor& monitor) : pulse_(monitor) {
        if (pieces.empty()) return;
        double sides = 0;
        Box whole;
        for (const CurvePiece& piece : pieces) {
            pulse_();
            Box box = box_of(piece.curve);
            box.low -= glm::dvec2(one_place);
            box.high += glm::dvec2(one_place);
            boxes_.push_back(box);
            sides += box.longest();
            whole.add(box.low);
        }
        low_ = whole.low;
        cell_ = sides / static_cast<double>(pieces.size());
        while (cells() > 16 * static_cast<double>(pieces.size())) cell_ *= 2;
        for (std::uint32_t i = 0; i < boxes_.size(); ++i) {
            pulse_();
            const auto [x0, y0, x1, y1] = reach(boxes_[i]);
            for (std::uint64_t x = x0; x <= x1; ++x) {
                for (std::uint64_t y = y0; y <= y1; ++y) entries_.emplace_back(x << 32 | y, i);
            }
        }
        std::sort(entries_.begin(), entries_.end(), stoppable(monitor, std::less<>()));
    }

    /// Calls `visit(a, b)` once for each pair, a < b.
    template <class Visit>
    void visit(Visit&& visit) {
        for (std::size_t begin = 0, end = 0; begin < entries_.size(); begin = end) {
            while (end < entries_.size() && entries_[end].first == entries_[begin].first) ++end;
            for (std::size_t i = begin; i < end; ++i) {
                for (std::size_t j = i + 1; j < end; ++j) {
                    pulse_();
                    const auto [a, b] = std::pair(entries_[i].second, entries_[j].second);
                    if (is_first_cell(entries_[begin].first, boxes_[a], boxes_[b])) visit(a, b);
                }
            }
        }
    }

private:
    std::array<std::uint64_t, 4> reach(const Box& box) const {
        const auto place = [&](double value, double low) {
            return static_cast<std::uint64_t>(std::clamp((value - low) / cell_, 0.0, 4e9));
        };
        return {place(box.low.x, low_.x), place(box.low.y, low_.y), place(box.high.x, low_.x),
                place(box.high.y, low_.y)};
    }
    double cells() {
        double sum = 0;
        for (const Box& box : boxes_) {
            pulse_();
            const auto [x0, y0, x1, y1] = reach(box);
            sum += static_cast<double>(x1 - x0 + 1) * static_cast<double>(y1 - y0 + 1);
        }
        return sum;
    }
    /// A pair is visited in the cell of the lower left corner of the intersection of its boxes.
    bool is_first_cell(std::uint64_t key, const Box& a, const Box& b) const {
        const glm::dvec2 low(std::max(a.low.x, b.low.x), std::max(a.low.y, b.low.y));
        if (low.x > std::min(a.high.x, b.high.x) || low.y > std::min(a.high.y, b.high.y)) return false;
        const auto [x, y, x1, y1] = reach({low, low});
        return key == (x << 32 | y);
    }

    Pulse pulse_;
    std::vector<Box> boxes_;
    std::vector<std::pair<std::uint64_t, std::uint32_t>> entries_;
    glm::dvec2 low_{0.0};
    double cell_ = 1;
};

class MeetingFinder {
public:
    MeetingFinder(const CurvedLines& lines, std::size_t most, const Monitor& monitor)
        : lines_(lines), most_(most), monitor_(monitor) {
        line_of_.reserve(lines.pieces.size());
        for (std::uint32_t line = 0; line < lines.lines.size(); ++line) {
            line_of_.resize(lines.lines[line].end, line);
        }
    }

    CurveMeetings find() {
        for (std::uint32_t i = 0; i < lines_.pieces.size(); ++i) {
            if (!lines_.pieces[i].is_straight) intersections_.of_one(lines_.pieces[i].curve, note(i, i));
        }
        PiecePairs(lines_.pieces, monitor_).visit([&](std::uint32_t a, std::uint32_t b) { meet(a, b); });
        found_.places.assign(vertices_.places().begin(), vertices_.places().end());
        sort_marks();
        return std::move(found_);
    }

private:
    const CurveIntersections::Note& note(std::uint32_t a, std::uint32_t b) {
        noted_ = {a, b};
        return note_;
    }
    void add(double t, double s) {
        const std::uint32_t vertex = vertices_.node({}, point_of(lines_.pieces[noted_[0]].curve, t));
        mark(noted_[0], t, vertex);
        mark(noted_[1], s, vertex);
    }
    void mark(std::uint32_t piece, double t, std::uint32_t vertex) {
        const std::uint32_t line = line_of_[piece];
        if (found_.marks.size() >= 2 * most_) {
            throw BudgetError(
                fmt::format("the lines meet more than {} times, which exceeds the budget; use a shorter derivation "
                            "or a larger budget",
                            most_));
        }
        found_.marks.push_back({line, static_cast<double>(piece - lines_.lines[line].begin) + t, vertex});
    }
    bool follows(std::uint32_t a, std::uint32_t b) const {
        if (line_of_[a] != line_of_[b]) return false;
        const CurvedLines::Line& line = lines_.lines[line_of_[a]];
        return a + 1 == b || (line.is_closed && a + 1 == line.end && b == line.begin);
    }
    void meet(std::uint32_t a, std::uint32_t b) {
        const CurvePiece& first = lines_.pieces[a];
        const CurvePiece& second = lines_.pieces[b];
        const bool is_next = follows(a, b);
        const bool is_previous = follows(b, a);
        if (first.is_straight && second.is_straight) {
            if (is_next && !is_reversal(first, second)) return;
            if (is_previous && !is_reversal(second, first)) return;
            return intersections_.of_segments(first.curve, second.curve, note(a, b));
        }
        if (is_next && is_previous) return;  // two curves that close
        if (is_next) return intersections_.of_neighbours(first.curve, second.curve, note(a, b));
        if (is_previous) return intersections_.of_neighbours(second.curve, first.curve, note(b, a));
        intersections_.of_two(first.curve, second.curve, note(a, b));
    }
    static bool is_reversal(const CurvePiece& first, const CurvePiece& second) {
        const glm::dvec2 a = first.curve[3] - first.curve[0];
        const glm::dvec2 b = second.curve[3] - second.curve[0];
        return scalar_product(a, b) < 0 &&
               std::fabs(determinant(a, b)) <= 1e-9 * std::hypot(a.x, a.y) * std::hypot(b.x, b.y);
    }

    /// Merges visits of one line to one vertex at one place of the line into one mark.
    void sort_marks() {
        std::vector<CurveMark>& marks = found_.marks;
        std::sort(marks.begin(), marks.end(), stoppable(monitor_, [](const CurveMark& a, const CurveMark& b) {
                      return std::tuple(a.line, a.position, a.vertex) < std::tuple(b.line, b.position, b.vertex);
                  }));
        std::vector<CurveMark> kept;
        for (std::uint32_t line = 0, at = 0; line < lines_.lines.size(); ++line) {
            found_.begins.push_back(kept.size());
            const std::size_t first = kept.size();
            for (; at < marks.size() && marks[at].line == line; ++at) {
                if (kept.size() > first && is_one_visit(kept.back(), marks[at].position, marks[at].vertex)) continue;
                kept.push_back(marks[at]);
            }
            const CurvedLines::Line& whole = lines_.lines[line];
            while (whole.is_closed && kept.size() > first + 1 &&
                   is_one_visit(kept.back(), kept[first].position + whole.count(), kept[first].vertex)) {
                kept.pop_back();
            }
        }
        found_.begins.push_back(kept.size());
        marks = std::move(kept);
    }
    bool is_one_visit(const CurveMark& mark, double position, std::uint32_t vertex) const {
        if (mark.vertex != vertex || position - mark.position > 0.5) return false;
        const glm::dvec2 between =
            lines_.at(lines_.lines[mark.line], (mark.position + position) / 2) - found_.places[vertex];
        return std::hypot(between.x, between.y) <= 4 * one_place;
    }

    const CurvedLines& lines_;
    std::size_t most_;
    const Monitor& monitor_;
    std::vector<std::uint32_t> line_of_;  // line of each piece
    kolam_plane::RoughPlane vertices_;
    CurveIntersections intersections_;
    std::array<std::uint32_t, 2> noted_{};  // the pieces being intersected
    CurveIntersections::Note note_ = [this](double t, double s) { add(t, s); };
    CurveMeetings found_;
};

}  // namespace

CurveMeetings find_meetings(const CurvedLines& lines, std::size_t most, const Monitor& monitor) {
    return MeetingFinder(lines, most, monitor).find();
}

VertexHeadings::VertexHeadings(const CurvedLines& lines, const CurveMeetings& meetings)
    : lines_(lines), meetings_(meetings), radius_(meetings.places.size(), std::numeric_limits<double>::max()) {
    for (std::size_t mark = 0; mark < meetings.marks.size(); ++mark) {
        for (const bool is_forward : {false, true}) {
            const double reach = room(mark, is_forward);
            if (!(reach > 0)) continue;
            const CurveMark& at = meetings.marks[mark];
            const CurvedLines::Line& line = lines.lines[at.line];
            const glm::dvec2 away =
                lines.at(line, at.position + (is_forward ? reach : -reach)) - meetings.places[at.vertex];
            radius_[at.vertex] = std::min(radius_[at.vertex], 0.2 * std::hypot(away.x, away.y));
        }
    }
}

/// The distance along its line over which a direction may be measured: a quarter of a piece, or of the way to the
/// next mark.
double VertexHeadings::room(std::size_t mark, bool is_forward) const {
    const CurveMark& at = meetings_.marks[mark];
    const CurvedLines::Line& line = lines_.lines[at.line];
    const std::size_t begin = meetings_.begins[at.line];
    const std::size_t end = meetings_.begins[at.line + 1];
    const double count = line.count();
    double way = 0;
    if (is_forward) {
        const bool is_last = mark + 1 == end;
        way = (is_last ? (line.is_closed ? meetings_.marks[begin].position + count : count)
                       : meetings_.marks[mark + 1].position) -
              at.position;
    } else {
        const bool is_first = mark == begin;
        way = at.position - (is_first ? (line.is_closed ? meetings_.marks[end - 1].position - count : 0.0)
                                      : meetings_.marks[mark - 1].position);
    }
    return way > 1e-6 ? std::min(way / 4, 0.25) : 0;
}

double VertexHeadings::heading(std::size_t mark, bool is_forward) const {
    const double reach = room(mark, is_forward);
    if (!(reach > 0)) return std::numeric_limits<double>::quiet_NaN();
    const CurveMark& at = meetings_.marks[mark];
    const CurvedLines::Line& line = lines_.lines[at.line];
    const auto away = [&](double way) {
        return lines_.at(line, at.position + (is_forward ? way : -way)) - meetings_.places[at.vertex];
    };
    double low = 0;
    double high = reach;
    constexpr int halvings = 40;
    for (int i = 0; i < halvings; ++i) {
        const double middle = (low + high) / 2;
        const glm::dvec2 found = away(middle);
        (std::hypot(found.x, found.y) < radius_[at.vertex] ? low : high) = middle;
    }
    const glm::dvec2 found = away(high);
    return std::atan2(found.y, found.x);
}

CurveDiagram make_curve_diagram(const CurvedLines& lines, const CurveMeetings& meetings) {
    const VertexHeadings headings(lines, meetings);
    CurveDiagram result;
    std::vector<std::array<std::size_t, 2>> visits(meetings.places.size());
    std::vector<std::uint32_t> count(meetings.places.size(), 0);
    for (std::size_t mark = 0; mark < meetings.marks.size(); ++mark) {
        std::uint32_t& known = count[meetings.marks[mark].vertex];
        if (known < 2) visits[meetings.marks[mark].vertex][known] = mark;
        ++known;
    }
    std::vector<std::uint32_t> crossing(meetings.places.size(), no_meeting);
    for (std::uint32_t vertex = 0; vertex < meetings.places.size(); ++vertex) {
        result.multiple += count[vertex] > 2 ? 1 : 0;
        if (count[vertex] != 2) continue;
        const auto [a, b] = visits[vertex];
        const double out = headings.heading(a, true);
        const double back = headings.heading(a, false);
        const auto turned = [&](double angle) {
            const double from = std::fmod(angle - out, 2 * std::numbers::pi);
            return from < 0 ? from + 2 * std::numbers::pi : from;
        };
        const double other = turned(headings.heading(b, true));
        const double other_back = turned(headings.heading(b, false));
        // Comparisons with NaN are false.
        const bool is_left = other < turned(back) && other_back > turned(back);
        const bool is_right = other > turned(back) && other_back < turned(back);
        if (!is_left && !is_right) continue;
        crossing[vertex] = static_cast<std::uint32_t>(result.diagram.turns_left.size());
        result.diagram.turns_left.push_back(is_left);
    }
    for (std::size_t line = 0; line < lines.lines.size(); ++line) {
        LinkDiagram::Line& passes = result.diagram.lines.emplace_back();
        passes.is_closed = lines.lines[line].is_closed;
        result.marks.emplace_back();
        for (std::size_t mark = meetings.begins[line]; mark < meetings.begins[line + 1]; ++mark) {
            const std::uint32_t vertex = meetings.marks[mark].vertex;
            if (crossing[vertex] == no_meeting) continue;
            passes.passes.push_back({crossing[vertex], static_cast<std::uint8_t>(visits[vertex][0] == mark ? 0 : 1)});
            result.marks.back().push_back(mark);
        }
    }
    return result;
}

}  // namespace sikku
