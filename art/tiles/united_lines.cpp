#include "art/tiles/united_lines.h"

#include "art/plotter/plot_join.h"
#include "art/plotter/plot_layer.h"
#include "art/print/outline.h"
#include "engine/derivation/derivation.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <stdexcept>

namespace sikku {
namespace {

constexpr double direction_tolerance = 1e-8;  // radians
constexpr double place_tolerance = 1e-9;      // share of the drawing's size

/// A piece as an interval of the infinite line on which it lies.
struct CoveredInterval {
    double direction = 0;  ///< radians, 0 to pi, later the number of its line
    double offset = 0;     ///< distance of the line from the origin, to the left of its direction
    double begin = 0, end = 0;
    std::uint32_t piece = 0;
    bool is_reversed = false;
};

CoveredInterval interval_of(glm::dvec2 from, glm::dvec2 to, std::uint32_t piece) {
    CoveredInterval interval;
    glm::dvec2 along = glm::normalize(to - from);
    double direction = std::atan2(along.y, along.x);
    if (direction < -direction_tolerance) {
        direction += std::numbers::pi;
        interval.is_reversed = true;
    } else if (direction > std::numbers::pi - direction_tolerance) {
        direction -= std::numbers::pi;
        interval.is_reversed = true;
    }
    if (interval.is_reversed) along = -along;
    interval.direction = direction;
    interval.offset = along.x * from.y - along.y * from.x;
    interval.begin = glm::dot(along, interval.is_reversed ? to : from);
    interval.end = glm::dot(along, interval.is_reversed ? from : to);
    interval.piece = piece;
    return interval;
}

/// Sorts by a value and replaces it by the number of its group: values within the tolerance of the least one.
template <class Iterator>
void group(Iterator begin, Iterator end, double CoveredInterval::*value, double tolerance) {
    std::sort(begin, end, [value](const CoveredInterval& a, const CoveredInterval& b) {
        return a.*value != b.*value ? a.*value < b.*value : a.piece < b.piece;
    });
    double least = 0;
    double number = -1;
    for (auto at = begin; at != end; ++at) {
        if (at == begin || (*at).*value - least > tolerance) {
            ++number;
            least = (*at).*value;
        }
        (*at).*value = number;
    }
}

template <class Iterator, class Visit>
void for_each_group(Iterator begin, Iterator end, double CoveredInterval::*value, Visit&& visit) {
    while (begin != end) {
        auto next =
            std::find_if(begin, end, [&](const CoveredInterval& other) { return other.*value != (*begin).*value; });
        visit(begin, next);
        begin = next;
    }
}

struct Event {
    double at = 0;
    bool ends = false;
    const CoveredInterval* interval = nullptr;
};

/// A united piece, numbered by the line that drew it first.
struct Drawn {
    std::uint32_t first = 0;
    UnitedLines::Line line;
};

}  // namespace

void UnitedLines::add(const Piece& piece) {
    if (piece.from == piece.to) return;
    if (static_cast<double>(pieces_.size()) >= most_) {
        throw BudgetError(
            fmt::format("the drawing has more than {:.0f} lines and edges of tiles, the limit of the "
                        "budget for uniting them",
                        most_));
    }
    pieces_.push_back(piece);
}

void UnitedLines::add_line(glm::dvec2 from, glm::dvec2 to, const Pen& pen) {
    auto found = std::find(pens_.begin(), pens_.end(), pen);
    if (found == pens_.end()) found = pens_.insert(found, pen);
    add({from, to, static_cast<std::uint32_t>(found - pens_.begin()), false});
}

void UnitedLines::add_tile(std::span<const glm::dvec2> corners) {
    double area = 0;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const glm::dvec2 a = corners[i] - corners[0];
        const glm::dvec2 b = corners[(i + 1) % corners.size()] - corners[0];
        area += a.x * b.y - a.y * b.x;
    }
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const glm::dvec2 from = corners[i];
        const glm::dvec2 to = corners[(i + 1) % corners.size()];
        add(area < 0 ? Piece{to, from, tiles_, true} : Piece{from, to, tiles_, true});
    }
    ++tiles_;
}

UnitedLines::Result UnitedLines::unite(Kept kept, const Monitor& monitor) const {
    Pulse pulse(monitor);
    double size = 0;
    std::vector<CoveredInterval> intervals;
    intervals.reserve(pieces_.size());
    for (std::uint32_t i = 0; i < pieces_.size(); ++i) {
        pulse();
        const auto& [from, to, owner, is_edge] = pieces_[i];
        size = std::max({size, std::fabs(from.x), std::fabs(from.y), std::fabs(to.x), std::fabs(to.y)});
        intervals.push_back(interval_of(from, to, i));
    }
    const double tolerance = place_tolerance * size;

    Result result;
    std::vector<Drawn> drawn;
    std::vector<Event> events;
    // Pieces over the place of the sweep: lines, edges of tiles to the left, edges of tiles to the right.
    std::set<std::uint32_t> lines, left, right;
    const auto take = [&](const Event& event) {
        const CoveredInterval& interval = *event.interval;
        auto& over = !pieces_[interval.piece].is_edge ? lines : interval.is_reversed ? right : left;
        if (event.ends) {
            over.erase(interval.piece);
        } else {
            over.insert(interval.piece);
        }
    };
    const auto point = [&](const Event& event) {
        const Piece& piece = pieces_[event.interval->piece];
        return event.ends == event.interval->is_reversed ? piece.from : piece.to;
    };
    const auto owner = [&](std::uint32_t piece) { return pieces_[piece].owner; };
    // Returns whether a line was drawn. `touches`: the last one ends where this part begins.
    const auto emit = [&](const Event& from, const Event& to, bool touches) {
        for (const std::uint32_t a : left) {
            for (const std::uint32_t b : right) result.neighbours.push_back(std::minmax(owner(a), owner(b)));
        }
        if (left.empty() != right.empty()) result.border.push_back(owner(*(left.empty() ? right : left).begin()));
        const bool is_inner = !left.empty() && !right.empty();
        if (kept == Kept::sides && !(left.empty() && right.empty())) {
            const auto tile = [&](const std::set<std::uint32_t>& over) {
                return over.empty() ? std::nullopt : std::optional(owner(*over.begin()));
            };
            result.sides.push_back({point(from), point(to), tile(left), tile(right)});
        }
        if (lines.empty() || kept == Kept::none || kept == Kept::sides || (kept == Kept::border && is_inner))
            return false;
        const std::uint32_t first = *lines.begin();
        const Pen& pen = pens_[owner(first)];
        if (kept == Kept::cuts && left.empty() != right.empty()) {
            const bool runs_on = right.empty();
            drawn.push_back({first, {point(runs_on ? from : to), point(runs_on ? to : from), pen, false, true}});
            return false;
        }
        if (touches && drawn.back().line.pen == pen &&
            ((kept != Kept::apart && kept != Kept::cuts) || drawn.back().line.is_inner == is_inner)) {
            drawn.back().first = std::min(drawn.back().first, first);
            drawn.back().line.to = point(to);
        } else {
            drawn.push_back({first, {point(from), point(to), pen, is_inner}});
        }
        return true;
    };
    const auto sweep = [&](auto begin, auto end) {
        pulse();
        events.clear();
        for (auto at = begin; at != end; ++at) {
            events.push_back({at->begin, false, &*at});
            events.push_back({at->end, true, &*at});
        }
        std::sort(events.begin(), events.end(), [](const Event& a, const Event& b) {
            return a.at != b.at ? a.at < b.at : a.interval->piece < b.interval->piece;
        });
        bool touches = false;
        for (std::size_t i = 0, next = 0; i < events.size(); i = next) {
            while (next < events.size() && events[next].at - events[i].at <= tolerance) take(events[next++]);
            if (next < events.size()) touches = emit(events[i], events[next], touches);
        }
        lines.clear();
        left.clear();
        right.clear();
    };
    group(intervals.begin(), intervals.end(), &CoveredInterval::direction, direction_tolerance);
    for_each_group(intervals.begin(), intervals.end(), &CoveredInterval::direction, [&](auto begin, auto end) {
        group(begin, end, &CoveredInterval::offset, tolerance);
        for_each_group(begin, end, &CoveredInterval::offset, sweep);
    });

    const auto make_set = [](auto& values) {
        std::sort(values.begin(), values.end());
        values.erase(std::unique(values.begin(), values.end()), values.end());
    };
    make_set(result.neighbours);
    make_set(result.border);
    std::stable_sort(drawn.begin(), drawn.end(), [](const Drawn& a, const Drawn& b) { return a.first < b.first; });
    for (Drawn& piece : drawn) result.lines.push_back(piece.line);
    return result;
}

namespace {

/// Pieces of a border as loops, each with its tiles on the left.
class BorderLoops {
public:
    explicit BorderLoops(const std::vector<UnitedLines::Line>& lines) : lines_(lines), nodes_(tolerance(lines)) {
        for (const UnitedLines::Line& line : lines) {
            from_.push_back(line.is_border ? nodes_.at(line.from) : none);
            to_.push_back(line.is_border ? nodes_.at(line.to) : none);
        }
        out_.resize(nodes_.points.size());
        for (std::uint32_t i = 0; i < lines.size(); ++i) {
            if (from_[i] != none) out_[from_[i]].push_back(i);
        }
        is_used_.assign(lines.size(), false);
    }

    /// The indices of the pieces of a loop that begins with a piece; empty if they do not close.
    std::vector<std::uint32_t> loop(std::uint32_t first) {
        std::vector<std::uint32_t> pieces;
        std::uint32_t at = first;
        while (at != none && !is_used_[at]) {
            is_used_[at] = true;
            pieces.push_back(at);
            at = next(at);
            if (at == first) return pieces;
        }
        return {};
    }
    bool is_used(std::uint32_t piece) const { return is_used_[piece]; }
    /// The corners of a loop, without those on straight stretches.
    std::vector<glm::dvec2> corners(const std::vector<std::uint32_t>& loop) const {
        std::vector<glm::dvec2> corners;
        for (std::size_t i = 0; i < loop.size(); ++i) {
            const glm::dvec2 before = way(loop[(i + loop.size() - 1) % loop.size()]), after = way(loop[i]);
            const double sine = before.x * after.y - before.y * after.x;
            constexpr double straight = 1e-9;
            if (std::fabs(sine) > straight * glm::length(before) * glm::length(after) ||
                glm::dot(before, after) < 0) {
                corners.push_back(nodes_.points[from_[loop[i]]]);
            }
        }
        return corners;
    }

private:
    static constexpr std::uint32_t none = PlotSegment::none;

    static double tolerance(const std::vector<UnitedLines::Line>& lines) {
        double size = 1e-300;
        for (const auto& line : lines) size = std::max({size, std::fabs(line.from.x), std::fabs(line.from.y)});
        return 1e-9 * size;
    }
    glm::dvec2 way(std::uint32_t piece) const { return lines_[piece].to - lines_[piece].from; }

    /// The next piece around the same tiles: the first one clockwise from the reversed piece, as tiles lie on the
    /// left.
    std::uint32_t next(std::uint32_t piece) const {
        const glm::dvec2 back = -way(piece);
        std::uint32_t best = none;
        double least = 0;
        for (const std::uint32_t other : out_[to_[piece]]) {
            const glm::dvec2 on = way(other);
            double turn = std::atan2(back.y, back.x) - std::atan2(on.y, on.x);
            if (turn <= 1e-9) turn += 2 * std::numbers::pi;
            if (best != none && turn >= least) continue;
            best = other;
            least = turn;
        }
        return best;
    }

    const std::vector<UnitedLines::Line>& lines_;
    PlotNodes nodes_;
    std::vector<std::uint32_t> from_, to_;  // nodes of pieces
    std::vector<std::vector<std::uint32_t>> out_;
    std::vector<bool> is_used_;
};

}  // namespace

std::vector<UnitedLines::Line> with_wider_border(const std::vector<UnitedLines::Line>& lines, double distance) {
    BorderLoops loops(lines);
    std::vector<UnitedLines::Line> result;
    std::vector<bool> is_moved(lines.size(), false);
    std::vector<UnitedLines::Line> moved;
    for (std::uint32_t i = 0; i < lines.size(); ++i) {
        if (!lines[i].is_border || loops.is_used(i)) continue;
        const std::vector<std::uint32_t> loop = loops.loop(i);
        const std::vector<glm::dvec2> corners = loops.corners(loop);
        if (corners.size() < 3) continue;
        const auto outline = offset_sides(corners, distance);
        if (!outline) {
            throw std::runtime_error("the kerf is wider than a notch of the tiling's border; expected longer steps");
        }
        for (const std::uint32_t piece : loop) is_moved[piece] = true;
        for (std::size_t k = 0; k < outline->size(); ++k) {
            moved.push_back({(*outline)[k], (*outline)[(k + 1) % outline->size()], lines[i].pen, false, true});
        }
    }
    for (std::size_t i = 0; i < lines.size(); ++i) {
        if (!is_moved[i]) result.push_back(lines[i]);
    }
    result.insert(result.end(), moved.begin(), moved.end());
    return result;
}

void draw_lines(const std::vector<UnitedLines::Line>& lines, PathSink& sink, const Monitor& monitor) {
    double size = 0;
    std::vector<Pen> pens;
    for (const UnitedLines::Line& line : lines) {
        size = std::max({size, std::fabs(line.from.x), std::fabs(line.from.y)});
        if (std::find(pens.begin(), pens.end(), line.pen) == pens.end()) pens.push_back(line.pen);
    }
    std::vector<glm::dvec2> ends;
    for (const Pen& pen : pens) {
        PlotNodes nodes(std::max(1e-9 * size, 1e-300));
        PlotGraph graph;
        for (const UnitedLines::Line& line : lines) {
            if (line.pen == pen) graph.segments.push_back({nodes.at(line.from), nodes.at(line.to)});
        }
        graph.points = std::move(nodes.points);
        const PlotStrokes strokes = join_segments(graph, monitor);
        for (const PlotStroke& stroke : strokes.strokes) {
            ends.clear();
            for (const PlotEnd end : strokes.ends(stroke)) ends.push_back(graph.point(end ^ 1U));
            sink.begin_stroke(graph.point(strokes.ends(stroke).front()), pen);
            sink.lines(ends);
            sink.end_stroke(stroke.closed);
        }
    }
}

}  // namespace sikku
