#include "art/hand/hand_line.h"

#include "engine/derivation/derivation.h"
#include "engine/geometry/box.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <tuple>
#include <utility>

namespace sikku {
namespace {

constexpr double corner = 0.94;          // cosine of the angle from which a bend is a corner
constexpr double nodes_of_loop = 16;     // samples for each loop diameter
constexpr double least_loop_widths = 3;  // smallest loop, in widths of the line
constexpr double most_loop_widths = 40;
constexpr double least_seen_width = 0.02;  // millimetres; the wavering of thinner lines is invisible

double length_of(const Bezier& b) {
    double length = 0;
    glm::dvec2 from = b[0];
    for (int k = 1; k <= 8; ++k) {
        const glm::dvec2 to = point_of(b, k / 8.0);
        length += glm::length(to - from);
        from = to;
    }
    return length;
}

glm::dvec2 unit(glm::dvec2 way) {
    const double length = glm::length(way);
    return length > 0 ? way / length : glm::dvec2(0.0);
}

/// Directions at the two ends; where control points coincide, that of the chord.
glm::dvec2 start_of(const Bezier& b) {
    const glm::dvec2 way = b[1] - b[0];
    return unit(glm::length(way) > 1e-12 ? way : b[3] - b[0]);
}
glm::dvec2 end_of(const Bezier& b) {
    const glm::dvec2 way = b[3] - b[2];
    return unit(glm::length(way) > 1e-12 ? way : b[3] - b[0]);
}

double turn_between(glm::dvec2 a, glm::dvec2 b) {
    return std::fabs(std::atan2(determinant(a, b), glm::dot(a, b)));
}

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
std::size_t start_node(const HandLine& line, const Box& box) {
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

glm::dvec2 hand_direction(const HandLine& line, std::size_t i) {
    const std::size_t before = line.previous(i), after = line.next(i);
    const glm::dvec2 at = line.nodes[i].at;
    const double h0 = before == i ? 0 : line.step(before), h1 = after == i ? 0 : line.step(i);
    if (!(h0 + h1 > 0)) return {1.0, 0.0};
    const glm::dvec2 in = h0 > 0 ? (at - line.nodes[before].at) / h0 : glm::dvec2(0.0);
    const glm::dvec2 out = h1 > 0 ? (line.nodes[after].at - at) / h1 : glm::dvec2(0.0);
    return (h0 > 0 && h1 > 0) ? (h1 * in + h0 * out) / (h0 + h1) : in + out;
}

glm::dvec2 hand_unit_direction(const HandLine& line, std::size_t i) {
    const glm::dvec2 way = hand_direction(line, i);
    const double length = glm::length(way);
    return length > 0 ? way / length : glm::dvec2(1.0, 0.0);
}

double hand_turn(const HandLine& line, std::size_t i) {
    const glm::dvec2 at = line.nodes[i].at;
    const glm::dvec2 in = at - line.nodes[line.previous(i)].at, out = line.nodes[line.next(i)].at - at;
    return std::atan2(determinant(in, out), glm::dot(in, out));
}

void measure_again(HandLine& line) {
    double along = 0;
    for (std::size_t i = 0; i < line.size(); ++i) {
        line.nodes[i].along = along;
        const std::size_t next = line.next(i);
        if (next != i) along += glm::length(line.nodes[next].at - line.nodes[i].at);
    }
    line.length = along;
}

void order_by_hand(std::vector<HandLine>& lines) {
    Box whole;
    for (HandLine& line : lines) {
        const Box box = box_of(line);
        whole.add(box.low);
        whole.add(box.high);
        if (line.closed) {
            if (area_of(line) < 0) turn_around(line);
            const auto start = static_cast<std::ptrdiff_t>(start_node(line, box));
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

void HandGatherer::begin_stroke(glm::dvec2 start, const Pen& pen) {
    at_ = start_ = start;
    pen_ = first_pen_ = pen;
    is_whole_ = true;
}

void HandGatherer::lines(std::span<const glm::dvec2> ends) {
    for (const glm::dvec2 end : ends) add({at_, (2.0 * at_ + end) / 3.0, (at_ + 2.0 * end) / 3.0, end});
}

void HandGatherer::curves(std::span<const glm::dvec2> controls) {
    for (std::size_t i = 0; i + 2 < controls.size(); i += 3) {
        add({at_, controls[i], controls[i + 1], controls[i + 2]});
    }
}

void HandGatherer::add(const Bezier& curve) {
    at_ = curve[3];
    if (!style_.draws(pen_)) {
        is_whole_ = false;
        return;
    }
    const double length = length_of(curve);
    if (!(length > 0) || !std::isfinite(length)) return;
    if (++count_ > most_) {
        throw BudgetError(
            fmt::format("hand-drawn lines are held in memory, and this drawing has more than {:.0f} "
                        "curves; use a shorter derivation or a larger budget",
                        most_));
    }
    pieces_.push_back({curve, length, half_width()});
}

void HandGatherer::change_pen(const Pen& pen) {
    const bool goes_on = style_.draws(pen) == style_.draws(pen_) &&
                         style_.line_colour(pen) == style_.line_colour(pen_) &&
                         style_.index(pen) == style_.index(pen_);
    if (!goes_on) {
        is_whole_ = is_whole_ && pieces_.empty();
        finish(false);
        first_pen_ = pen;
    }
    pen_ = pen;
}

void HandGatherer::end_stroke(bool closed) {
    if (pieces_.empty() && is_whole_ && style_.draws(pen_)) {
        dots.push_back({at_, half_width(), pen_});
    }
    finish(closed && is_whole_);
}

void HandGatherer::disc(glm::dvec2 centre, double radius, const Pen& pen) {
    if (style_.fill_colour(pen).alpha == 0) return;
    const double drawn = style_.disc_radius(radius, pen, step_) / step_;
    if (drawn > 0) dots.push_back({centre, drawn, pen});
}

/// Diameter of the circle that bends as much as the line does where it bends: the mean over its turning. A corner
/// turns within half of the two pieces that meet there.
double HandGatherer::loop_of(const std::vector<Piece>& pieces, bool closed) {
    double turn = 0, bend = 0;
    const auto add_turn = [&](double angle, double length) {
        turn += angle;
        bend += angle * angle / length;
    };
    for (std::size_t i = 0; i < pieces.size(); ++i) {
        const Piece& piece = pieces[i];
        const glm::dvec2 middle = unit(point_of(piece.curve, 0.6) - point_of(piece.curve, 0.4));
        add_turn(turn_between(start_of(piece.curve), middle) + turn_between(middle, end_of(piece.curve)),
                 piece.length);
        if (i + 1 == pieces.size() && !closed) break;
        const Piece& next = pieces[(i + 1) % pieces.size()];
        add_turn(turn_between(end_of(piece.curve), start_of(next.curve)), (piece.length + next.length) / 2);
    }
    return bend > 0 ? 2 * turn / bend : 1e300;
}

void HandGatherer::polygon(std::span<const glm::dvec2> vertices, const Pen& pen) {
    if (!fills_with(pen)) return;
    count_points(static_cast<double>(vertices.size()));
    fills.push_back({{vertices.begin(), vertices.end()}, true, pen});
}

void HandGatherer::area(std::span<const glm::dvec2> outline, const Pen& pen) {
    if (!fills_with(pen) || outline.empty()) return;
    count_points(static_cast<double>(outline.size()));
    fills.push_back({{outline.begin(), outline.end()}, false, pen});
}

void HandGatherer::count_points(double more) {
    points_ += more;
    if (points_ > most_points_) {
        throw BudgetError(fmt::format(
            "{} take more than {:.0f} points, 16 for each loop; a shorter derivation, fewer copies or a "
            "wider stroke helps",
            most_lines_ ? "the lines of this lesson" : "the hand-drawn lines of this drawing", most_points_));
    }
}

/// Makes a line of the pieces: bends at the corners, then nodes.
void HandGatherer::finish(bool closed) {
    std::vector<Piece> pieces = std::exchange(pieces_, {});
    if (pieces.empty()) return;
    closed = closed && pieces.size() > 1;
    const double loop = loop_of(pieces, closed);
    // Cuts both sides of each corner, and joins them by a bend.
    std::vector<Piece> bent;
    const auto bend = [&](Piece& before, Piece& after) -> bool {
        if (glm::dot(end_of(before.curve), start_of(after.curve)) > corner) return false;
        const double cut =
            std::min({0.3 * before.length, 0.3 * after.length, 1.5 * std::min(before.half, after.half)});
        const glm::dvec2 at = after.curve[0];
        before.curve = part_of(before.curve, 0, 1 - cut / before.length);
        after.curve = part_of(after.curve, cut / after.length, 1);
        before.length -= cut;
        after.length -= cut;
        const glm::dvec2 from = before.curve[3], to = after.curve[0];
        const Bezier curve = {from, (from + 2.0 * at) / 3.0, (to + 2.0 * at) / 3.0, to};
        bent.push_back({curve, length_of(curve), before.half});
        return true;
    };
    const bool has_last = closed && bend(pieces.back(), pieces.front());
    std::vector<Piece> last = std::exchange(bent, {});
    for (std::size_t i = 0; i < pieces.size(); ++i) {
        // A bend is added while its neighbours are cut, and belongs between them.
        const std::size_t at = bent.size();
        const bool is_bent = i + 1 < pieces.size() && bend(pieces[i], pieces[i + 1]);
        bent.insert(bent.begin() + static_cast<std::ptrdiff_t>(at), pieces[i]);
        static_cast<void>(is_bent);
    }
    if (has_last) bent.push_back(last.front());

    if (most_lines_ && gathered.size() >= *most_lines_) {
        throw BudgetError(fmt::format(
            "a lesson has at most {} lines, and this drawing has more; a shorter derivation or fewer copies "
            "helps",
            *most_lines_));
    }
    HandLine line;
    line.closed = closed;
    line.pen = first_pen_;
    line.number = gathered.size();
    double widths = 0;
    for (const Piece& piece : bent) {
        line.length += piece.length;
        widths += 2 * piece.half * piece.length;
    }
    const double width = std::max(widths / line.length, least_seen_width / step_);
    line.loop = std::clamp(loop, least_loop_widths * width, most_loop_widths * width);
    double along = 0;
    for (const Piece& piece : bent) {
        const int parts = static_cast<int>(std::clamp(std::ceil(piece.length * nodes_of_loop / line.loop), 1.0, 1e5));
        count_points(parts);
        glm::dvec2 from = piece.curve[0];
        for (int k = 0; k < parts; ++k) {
            line.nodes.push_back({from, along, piece.half});
            const glm::dvec2 to = point_of(piece.curve, (k + 1.0) / parts);
            along += glm::length(to - from);
            from = to;
        }
    }
    if (!closed) line.nodes.push_back({bent.back().curve[3], along, bent.back().half});
    line.length = along;
    gathered.push_back(std::move(line));
}

}  // namespace sikku
