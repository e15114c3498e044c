#include "art/relief/constrained_triangulation.h"

#include "engine/base/numbers.h"
#include "engine/derivation/forecast.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <stdexcept>

namespace sikku {
namespace {

constexpr int next_of(int i) {
    return i == 2 ? 0 : i + 1;
}
constexpr int before(int i) {
    return i == 0 ? 2 : i - 1;
}

std::size_t at(int i) {
    return static_cast<std::size_t>(i);
}

double distance_squared(Micrometres a, Micrometres b) {
    const double x = a.x - b.x, y = a.y - b.y;
    return x * x + y * y;
}

}  // namespace

ConstrainedTriangulation::ConstrainedTriangulation(Micrometres low, Micrometres high, double tolerance,
                                                   Windings& windings, const Monitor& monitor)
    : tolerance_(tolerance), windings_(windings), pulse_(monitor) {
    points_ = {low, {high.x, low.y}, high, {low.x, high.y}};
    triangle_of_ = {0, 0, 0, 1};
    triangles_.push_back({{0, 1, 2}, {none, none, 1}, {}});
    triangles_.push_back({{0, 2, 3}, {0, none, none}, {}});
}

std::int64_t ConstrainedTriangulation::side(Point from, Point to, Micrometres point) const {
    const Micrometres a = points_[from], b = points_[to];
    return std::int64_t{b.x - a.x} * (point.y - a.y) - std::int64_t{b.y - a.y} * (point.x - a.x);
}

bool ConstrainedTriangulation::is_in_circle(Point a, Point b, Point c, Point point) const {
    const Micrometres origin = points_[point];
    const auto difference = [&](Point other) {
        return Micrometres{points_[other].x - origin.x, points_[other].y - origin.y};
    };
    const std::array<Micrometres, 3> to = {difference(a), difference(b), difference(c)};
    // The determinant, and the sum of the sizes of its terms.
    const auto determinant = [&to]<class Number>(Number sum, Number size) {
        const auto absolute = [](Number value) { return value < 0 ? -value : value; };
        const auto add = [&](Micrometres one, Micrometres two, Micrometres three) {
            const Number lift = Number(one.x) * one.x + Number(one.y) * one.y;
            const Number left = Number(two.x) * three.y, right = Number(two.y) * three.x;
            sum += lift * (left - right);
            size += lift * (absolute(left) + absolute(right));
        };
        add(to[0], to[1], to[2]);
        add(to[1], to[2], to[0]);
        add(to[2], to[0], to[1]);
        return std::pair(sum, size);
    };
    const auto [rough, size] = determinant(0.0, 0.0);
    if (std::fabs(rough) > 1e-14 * size) return rough > 0;
    return determinant(Int128(0), Int128(0)).first > 0;
}

bool ConstrainedTriangulation::is_near(Point from, Point to, Point point) const {
    const Micrometres a = points_[from], b = points_[to], p = points_[point];
    const double length = distance_squared(a, b);
    if (!(distance_squared(a, p) < length && distance_squared(p, b) < length)) return false;
    const double across = static_cast<double>(side(from, to, point));
    return across == 0 || across * across <= tolerance_ * tolerance_ * length;
}

int ConstrainedTriangulation::edge_towards(std::uint32_t triangle, std::uint32_t neighbour) const {
    const auto& neighbours = triangles_[triangle].neighbours;
    return neighbours[0] == neighbour ? 0 : neighbours[1] == neighbour ? 1 : 2;
}

int ConstrainedTriangulation::corner_of(std::uint32_t triangle, Point point) const {
    const auto& corners = triangles_[triangle].corners;
    return corners[0] == point ? 0 : corners[1] == point ? 1 : 2;
}

void ConstrainedTriangulation::place(std::uint32_t triangle, const Triangle& contents) {
    triangles_[triangle] = contents;
    for (const Point corner : contents.corners) triangle_of_[corner] = triangle;
}

void ConstrainedTriangulation::relink(std::uint32_t triangle, std::uint32_t from, std::uint32_t to) {
    if (triangle == none) return;
    triangles_[triangle].neighbours[at(edge_towards(triangle, from))] = to;
}

/// Walks to a point. Source: Devillers, Pion and Teillaud 2001, "Walking in a triangulation".
ConstrainedTriangulation::Place ConstrainedTriangulation::locate(Micrometres point) {
    std::uint32_t here = last_, previous = none;
    for (bool is_inside = false; !is_inside;) {
        const Triangle& triangle = triangles_[here];
        random_ = random_ * 1664525U + 1013904223U;
        int edge = static_cast<int>((random_ >> 16) % 3);
        is_inside = true;
        for (int tried = 0; tried < 3 && is_inside; ++tried, edge = next_of(edge)) {
            const std::uint32_t beyond = triangle.neighbours[at(edge)];
            if (beyond == previous ||
                side(triangle.corners[at(edge)], triangle.corners[at(next_of(edge))], point) >= 0)
                continue;
            if (beyond == none) throw std::logic_error("a point lies outside its triangulation");
            previous = here;
            here = beyond;
            is_inside = false;
        }
    }
    last_ = here;
    Place place{here, {}, {}};
    const Triangle& triangle = triangles_[here];
    for (int i = 0; i < 3; ++i) {
        if (points_[triangle.corners[at(i)]] == point) place.corner = i;
        if (side(triangle.corners[at(i)], triangle.corners[at(next_of(i))], point) == 0) place.edge = i;
    }
    return place;
}

ConstrainedTriangulation::Point ConstrainedTriangulation::add(Micrometres point) {
    pulse_();
    const Place place = locate(point);
    if (place.corner) return triangles_[place.triangle].corners[at(*place.corner)];
    if (points_.size() >= most_points) {
        throw BudgetError(fmt::format(
            "with its crossings the relief has more than {} million points; choose a shorter derivation or a window",
            most_points / 1'000'000));
    }
    const Point added = static_cast<Point>(points_.size());
    points_.push_back(point);
    triangle_of_.push_back(place.triangle);
    if (place.edge) {
        divide_edge({place.triangle, *place.edge}, added);
    } else {
        divide_triangle(place.triangle, added);
    }
    legalise();
    return added;
}

/// The new triangles begin with the edge opposite the point.
void ConstrainedTriangulation::divide_triangle(std::uint32_t triangle, Point point) {
    const Triangle old = triangles_[triangle];
    const std::uint32_t first = static_cast<std::uint32_t>(triangles_.size());
    const std::array<std::uint32_t, 3> parts = {triangle, first, first + 1};
    triangles_.resize(triangles_.size() + 2);
    for (int i = 0; i < 3; ++i) {
        const std::uint32_t beyond = old.neighbours[at(i)];
        place(parts[at(i)], {{old.corners[at(i)], old.corners[at(next_of(i))], point},
                             {beyond, parts[at(next_of(i))], parts[at(before(i))]},
                             {old.windings[at(i)], 0, 0}});
        if (i > 0) relink(beyond, triangle, parts[at(i)]);
        unsettled_.push_back(parts[at(i)]);
    }
}

/// Divides the triangles on both sides: (a, b, c) and (b, a, d) become four around the point.
void ConstrainedTriangulation::divide_edge(Edge edge, Point point) {
    const std::uint32_t one = edge.triangle;
    const Triangle upper = triangles_[one];
    const int i = edge.number, j = next_of(i), k = before(i);
    const std::uint32_t two = upper.neighbours[at(i)];
    if (two == none) throw std::logic_error("a point lies on the frame of its triangulation");
    const Triangle lower = triangles_[two];
    const int u = edge_towards(two, one), v = next_of(u), w = before(u);
    const Point a = upper.corners[at(i)], b = upper.corners[at(j)], c = upper.corners[at(k)],
                d = lower.corners[at(w)];
    const Windings::Id along = upper.windings[at(i)], back = lower.windings[at(u)];
    const std::uint32_t three = static_cast<std::uint32_t>(triangles_.size()), four = three + 1;
    triangles_.resize(triangles_.size() + 2);
    place(one, {{c, a, point}, {upper.neighbours[at(k)], four, three}, {upper.windings[at(k)], along, 0}});
    place(two, {{d, b, point}, {lower.neighbours[at(w)], three, four}, {lower.windings[at(w)], back, 0}});
    place(three, {{b, c, point}, {upper.neighbours[at(j)], one, two}, {upper.windings[at(j)], 0, along}});
    place(four, {{a, d, point}, {lower.neighbours[at(v)], two, one}, {lower.windings[at(v)], 0, back}});
    relink(upper.neighbours[at(j)], one, three);
    relink(lower.neighbours[at(v)], two, four);
    unsettled_.insert(unsettled_.end(), {one, two, three, four});
}

/// Flips edges until those opposite the last point are Delaunay or edges of outlines.
void ConstrainedTriangulation::legalise() {
    while (!unsettled_.empty()) {
        const std::uint32_t triangle = unsettled_.back();
        unsettled_.pop_back();
        const Triangle& here = triangles_[triangle];
        const std::uint32_t beyond = here.neighbours[0];
        if (beyond == none || here.windings[0] != 0) continue;
        const Point apex = triangles_[beyond].corners[at(before(edge_towards(beyond, triangle)))];
        if (!is_in_circle(here.corners[0], here.corners[1], here.corners[2], apex)) continue;
        flip({triangle, 0});
        unsettled_.insert(unsettled_.end(), {triangle, beyond});
    }
}

/// (a, b, p) and (b, a, d) become (a, d, p) and (d, b, p), with p last.
void ConstrainedTriangulation::flip(Edge edge) {
    const std::uint32_t one = edge.triangle;
    const Triangle upper = triangles_[one];
    const int i = edge.number, j = next_of(i), k = before(i);
    const std::uint32_t two = upper.neighbours[at(i)];
    const Triangle lower = triangles_[two];
    const int u = edge_towards(two, one), v = next_of(u), w = before(u);
    const Point a = upper.corners[at(i)], b = upper.corners[at(j)], p = upper.corners[at(k)],
                d = lower.corners[at(w)];
    place(one, {{a, d, p},
                {lower.neighbours[at(v)], two, upper.neighbours[at(k)]},
                {lower.windings[at(v)], 0, upper.windings[at(k)]}});
    place(two, {{d, b, p},
                {lower.neighbours[at(w)], upper.neighbours[at(j)], one},
                {lower.windings[at(w)], upper.windings[at(j)], 0}});
    relink(lower.neighbours[at(v)], two, one);
    relink(upper.neighbours[at(j)], one, two);
}

/// The triangle on the left of an edge, if there is such an edge.
std::optional<ConstrainedTriangulation::Edge> ConstrainedTriangulation::find(Point from, Point to) const {
    const std::uint32_t first = triangle_of_[from];
    // Around the point anticlockwise, and from the frame back.
    for (const bool is_back : {false, true}) {
        std::uint32_t here = first;
        do {
            const int corner = corner_of(here, from);
            if (triangles_[here].corners[at(next_of(corner))] == to) return Edge{here, corner};
            here = triangles_[here].neighbours[at(is_back ? corner : before(corner))];
        } while (here != first && here != none);
        if (here == first) break;
    }
    return std::nullopt;
}

void ConstrainedTriangulation::add_winding(Edge edge, Windings::Id winding) {
    Triangle& here = triangles_[edge.triangle];
    const std::uint32_t beyond = here.neighbours[at(edge.number)];
    Windings::Id& own = here.windings[at(edge.number)];
    own = windings_.sum(own, winding);
    triangles_[beyond].windings[at(edge_towards(beyond, edge.triangle))] = windings_.negative(own);
}

void ConstrainedTriangulation::connect(Point from, Point to, Windings::Id winding) {
    pending_.push_back({from, to, winding});
    while (!pending_.empty()) {
        pulse_();
        const Piece piece = pending_.back();
        pending_.pop_back();
        if (piece.from != piece.to && piece.winding != 0) trace(piece);
    }
}

/// Divides a piece. Both parts are shorter, so this terminates.
void ConstrainedTriangulation::pass_through(const Piece& piece, Point point) {
    pending_.push_back({point, piece.to, piece.winding});
    pending_.push_back({piece.from, point, piece.winding});
}

/// The first edge that a piece crosses. Nullopt if it is an edge already, or is divided.
std::optional<ConstrainedTriangulation::Edge> ConstrainedTriangulation::first_crossing(const Piece& piece) {
    const std::uint32_t first = triangle_of_[piece.from];
    std::optional<Edge> found;
    std::uint32_t here = first;
    do {
        const int corner = corner_of(here, piece.from);
        const Point right = triangles_[here].corners[at(next_of(corner))];
        const Point left = triangles_[here].corners[at(before(corner))];
        if (right == piece.to) {
            add_winding({here, corner}, piece.winding);
            return std::nullopt;
        }
        if (is_near(piece.from, piece.to, right)) {
            pass_through(piece, right);
            return std::nullopt;
        }
        if (side(piece.from, piece.to, right) < 0 && side(piece.from, piece.to, left) > 0) {
            found = Edge{here, next_of(corner)};
        }
        here = triangles_[here].neighbours[at(before(corner))];
    } while (here != first);
    return found;
}

/// Turns a piece into an edge; where it meets points or other edges of outlines, its parts are left pending.
void ConstrainedTriangulation::trace(const Piece& piece) {
    std::optional<Edge> edge = first_crossing(piece);
    if (!edge) return;
    std::vector<Pair> crossed;
    for (;;) {
        const Triangle& here = triangles_[edge->triangle];
        const int number = edge->number;
        if (here.windings[at(number)] != 0) return cross(piece, *edge);
        crossed.emplace_back(here.corners[at(number)], here.corners[at(next_of(number))]);
        const std::uint32_t beyond = here.neighbours[at(number)];
        const int entry = edge_towards(beyond, edge->triangle);
        const Point apex = triangles_[beyond].corners[at(before(entry))];
        if (apex == piece.to) break;
        if (is_near(piece.from, piece.to, apex)) return pass_through(piece, apex);
        edge = Edge{beyond, side(piece.from, piece.to, apex) > 0 ? next_of(entry) : before(entry)};
    }
    clear_way(piece, crossed);
}

/// Divides a piece and an edge where they cross. Both parts of either lie in its box, and are shorter.
void ConstrainedTriangulation::cross(const Piece& piece, Edge edge) {
    const Triangle here = triangles_[edge.triangle];
    const Piece other{here.corners[at(edge.number)], here.corners[at(next_of(edge.number))],
                      here.windings[at(edge.number)]};
    const double right = -static_cast<double>(side(piece.from, piece.to, other.from));
    const double left = static_cast<double>(side(piece.from, piece.to, other.to));
    const double share = right / (right + left);
    const auto coordinate = [&](auto member) {
        const double from = points_[other.from].*member, to = points_[other.to].*member;
        const auto range = std::minmax(points_[piece.from].*member, points_[piece.to].*member);
        const auto own = std::minmax(points_[other.from].*member, points_[other.to].*member);
        return std::clamp(to_whole(from + share * (to - from)), std::max(range.first, own.first),
                          std::min(range.second, own.second));
    };
    const Micrometres place{coordinate(&Micrometres::x), coordinate(&Micrometres::y)};
    add_winding(edge, windings_.negative(other.winding));
    last_ = edge.triangle;
    const Point point = add(place);
    pass_through(other, point);
    pass_through(piece, point);
}

/// Flips all edges that a piece crosses, so that it becomes an edge itself.
void ConstrainedTriangulation::clear_way(const Piece& piece, const std::vector<Pair>& crossed) {
    const auto strictly_between = [&](Point a, Point b) {
        const std::int64_t one = side(piece.from, piece.to, a), two = side(piece.from, piece.to, b);
        return (one < 0 && two > 0) || (one > 0 && two < 0);
    };
    std::deque<Pair> queue(crossed.begin(), crossed.end());
    std::vector<Pair> made;
    while (!queue.empty()) {
        pulse_();
        if (++turns_ > most_turns) {
            throw BudgetError("lines of the relief cross too many others; choose a shorter derivation or a window");
        }
        const auto [from, to] = queue.front();
        queue.pop_front();
        const std::optional<Edge> edge = find(from, to);
        if (!edge) throw std::logic_error("an edge of a triangulation is missing");
        const std::uint32_t beyond = triangles_[edge->triangle].neighbours[at(edge->number)];
        const Point left = triangles_[edge->triangle].corners[at(before(edge->number))];
        const Point right = triangles_[beyond].corners[at(before(edge_towards(beyond, edge->triangle)))];
        const std::int64_t one = side(right, left, from), two = side(right, left, to);
        if (!((one < 0 && two > 0) || (one > 0 && two < 0))) {
            queue.emplace_back(from, to);
            continue;
        }
        flip(*edge);
        if (strictly_between(left, right)) {
            queue.emplace_back(right, left);
        } else {
            made.emplace_back(right, left);
        }
    }
    const std::optional<Edge> edge = find(piece.from, piece.to);
    if (!edge) throw std::logic_error("an outline is missing from its triangulation");
    add_winding(*edge, piece.winding);
    improve(made, piece);
}

/// Flips new edges until they are Delaunay, as far as the outlines permit it.
void ConstrainedTriangulation::improve(std::vector<Pair>& made, const Piece& piece) {
    constexpr int most_rounds = 20;
    bool is_changed = true;
    for (int round = 0; is_changed && round < most_rounds; ++round) {
        is_changed = false;
        for (auto& [from, to] : made) {
            if ((from == piece.from && to == piece.to) || (from == piece.to && to == piece.from)) continue;
            const std::optional<Edge> edge = find(from, to);
            if (!edge) continue;
            const Triangle& here = triangles_[edge->triangle];
            const std::uint32_t beyond = here.neighbours[at(edge->number)];
            if (beyond == none || here.windings[at(edge->number)] != 0) continue;
            const Point left = here.corners[at(before(edge->number))];
            const Point right = triangles_[beyond].corners[at(before(edge_towards(beyond, edge->triangle)))];
            if (!is_in_circle(here.corners[0], here.corners[1], here.corners[2], right)) continue;
            flip(*edge);
            from = right;
            to = left;
            is_changed = true;
        }
    }
}

}  // namespace sikku
