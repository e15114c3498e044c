#include "art/kolam/fields.h"

#include "art/kolam/kolam_plane.h"
#include "engine/base/union_find.h"
#include "engine/geometry/parallel_curve.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <optional>
#include <tuple>
#include <utility>

namespace sikku {
namespace {

constexpr std::uint32_t no_number = std::numeric_limits<std::uint32_t>::max();
constexpr std::size_t no_mark = std::numeric_limits<std::size_t>::max();
constexpr double least_area = 1e-9;  // in square steps: smaller fields are rounding

/// A piece of a closed line between two vertices.
struct Edge {
    std::uint32_t line = 0;
    double from = 0.0, to = 0.0;  ///< positions on the line
    std::uint32_t tail = 0, head = 0;
    std::size_t first_mark = 0, last_mark = 0;  ///< or no_mark at an added vertex
    bool is_segment = false;                    ///< one straight line
    bool is_odd = true;                         ///< drawn an odd number of times
};

/// Area, first moments and length of the curve from `curve[0]` to its end, seen from `origin`.
struct Moments {
    double area = 0.0;
    glm::dvec2 first{0.0};
    double length = 0.0;

    /// Gauss-Legendre with 5 nodes: exact for polynomials of degree 9; the moments have degree 8.
    void add(const Bezier& curve, glm::dvec2 origin) {
        constexpr double a = 0.5384693101056831, b = 0.9061798459386640;
        constexpr double wa = 0.4786286704993665, wb = 0.2369268850561891, wc = 0.5688888888888889;
        constexpr std::array<std::pair<double, double>, 5> nodes = {
            {{-b, wb}, {-a, wa}, {0.0, wc}, {a, wa}, {b, wb}}};
        for (const auto& [node, weight] : nodes) {
            const double t = (1 + node) / 2;
            const glm::dvec2 at = point_of(curve, t) - origin;
            const glm::dvec2 along = derivative_of(curve, t);
            const double swept = determinant(at, along) * weight / 4;
            area += swept;
            first += swept * at * (2.0 / 3.0);
            length += std::hypot(along.x, along.y) * weight / 2;
        }
    }
};

/// The first edge that a ray downwards from a point meets.
struct Below {
    std::uint32_t half = no_number;  ///< the side that faces upwards
    double position = 0.0;           ///< on the line
    double y = -std::numeric_limits<double>::max();
    glm::dvec2 at{0.0};
};

/// A component that lies in a field: its outer cycle is entered over a line from the edge below it.
struct Hole {
    double position = 0.0;           ///< on the line of the edge
    glm::dvec2 from{0.0};            ///< a point of that edge
    std::uint32_t half = no_number;  ///< half-edge of the outer cycle that begins at the component's lowest vertex
};

/// Half-edge 2e runs along edge e, half-edge 2e + 1 the other way; cycles of half-edges have a face on their left.
class FieldFinder {
public:
    FieldFinder(const CurvedLines& lines, const CurveMeetings& meetings, const Monitor& monitor)
        : lines_(lines), meetings_(meetings), monitor_(monitor), pulse_(monitor) {}

    std::vector<Field> find() {
        list_edges();
        if (edges_.empty()) return {};
        sort_around();
        find_cycles();
        find_components();
        place_components();
        return make_fields();
    }

private:
    void list_edges();
    double lowest_position(const CurvedLines::Line& line);
    void drop_repeated();
    void sort_around();
    void find_cycles();
    void find_components();
    void place_components();
    std::vector<Field> make_fields();
    void measure(std::uint32_t cycle, Field& field);
    void trace(std::uint32_t first, std::vector<glm::dvec2>& outline, bool& is_straight, int depth) const;
    void find_distances(std::vector<Field>& fields, const std::vector<std::uint32_t>& field_of_cycle);
    void bucket_edges();
    Below below(glm::dvec2 point, std::uint32_t component);

    std::uint32_t count() const { return 2 * static_cast<std::uint32_t>(edges_.size()); }
    std::uint32_t tail(std::uint32_t half) const {
        return half % 2 == 0 ? edges_[half / 2].tail : edges_[half / 2].head;
    }
    std::uint32_t next(std::uint32_t half) const { return next_[half]; }
    /// Calls `visit(curve, piece)` along a half-edge, in its direction, from one position of its line to another.
    template <class Visit>
    void along(std::uint32_t half, double from, double to, Visit&& visit) const {
        const CurvedLines::Line& line = lines_.lines[edges_[half / 2].line];
        if (half % 2 == 0) return lines_.visit_between(line, from, to, visit);
        std::vector<std::pair<Bezier, const CurvePiece*>> parts;
        lines_.visit_between(
            line, to, from, [&](const Bezier& curve, const CurvePiece& piece) { parts.emplace_back(curve, &piece); });
        for (auto part = parts.rbegin(); part != parts.rend(); ++part) {
            std::reverse(part->first.begin(), part->first.end());
            visit(part->first, *part->second);
        }
    }
    double begin_of(std::uint32_t half) const { return half % 2 == 0 ? edges_[half / 2].from : edges_[half / 2].to; }
    double end_of(std::uint32_t half) const { return begin_of(half ^ 1); }
    glm::dvec2 place(std::uint32_t vertex) const {
        return vertex < meetings_.places.size() ? meetings_.places[vertex]
                                                : added_places_[vertex - meetings_.places.size()];
    }
    std::uint32_t vertex_count() const {
        return static_cast<std::uint32_t>(meetings_.places.size() + added_places_.size());
    }

    const CurvedLines& lines_;
    const CurveMeetings& meetings_;
    const Monitor& monitor_;
    Pulse pulse_;
    std::vector<Edge> edges_;
    std::vector<glm::dvec2> added_places_;      // added vertices, where lines are lowest
    std::vector<std::uint32_t> next_;           // half-edge along the face on the left
    std::vector<std::uint32_t> cycle_;          // cycle of each half-edge
    std::vector<std::uint32_t> begins_;         // one half-edge of each cycle
    std::vector<double> areas_;                 // areas of cycles
    std::vector<std::uint32_t> component_;      // component of each vertex
    std::vector<std::uint32_t> outer_;          // cycle around each component
    std::vector<std::uint32_t> container_;      // cycle of the field in which a component lies, or none
    std::vector<char> odd_;                     // parity of each cycle's face
    std::multimap<std::uint32_t, Hole> holes_;  // by half-edge
    std::vector<std::pair<std::uint32_t, std::uint32_t>> buckets_;  // column and edge, sorted
    double left_ = 0, column_ = 1;
};

/// The position at which a line is lowest.
double FieldFinder::lowest_position(const CurvedLines::Line& line) {
    double lowest = std::numeric_limits<double>::max();
    double found = 0;
    for (std::uint32_t i = 0; i < line.count(); ++i) {
        pulse_();
        const Bezier& b = lines_.piece(line, i).curve;
        const auto look = [&](double t) {
            const double y = t == 0 ? b[0].y : point_of(b, t).y;
            if (y >= lowest) return;
            lowest = y;
            found = i + t;
        };
        look(0);
        if (std::min({b[0].y, b[1].y, b[2].y, b[3].y}) >= lowest) continue;
        // Where the derivative vanishes.
        const double p = b[1].y - b[0].y, q = b[2].y - b[1].y, r = b[3].y - b[2].y;
        const double square = p - 2 * q + r;
        const double root = std::sqrt(std::max(0.0, (q - p) * (q - p) - square * p));
        for (const double t : {square == 0 ? p / (2 * (p - q)) : (p - q + root) / square,
                               square == 0 ? -1.0 : (p - q - root) / square}) {
            if (t > 0 && t < 1) look(t);
        }
    }
    return found;
}

/// Cuts each closed line at its marks, and where it is lowest.
void FieldFinder::list_edges() {
    struct Cut {
        double position;
        std::uint32_t vertex;
        std::size_t mark;
    };
    std::vector<Cut> cuts;
    for (std::uint32_t number = 0; number < lines_.lines.size(); ++number) {
        const CurvedLines::Line& line = lines_.lines[number];
        if (!line.is_closed) continue;
        cuts.clear();
        const std::size_t first = meetings_.begins[number];
        for (std::size_t mark = first; mark < meetings_.begins[number + 1]; ++mark) {
            cuts.push_back({meetings_.marks[mark].position, meetings_.marks[mark].vertex, mark});
        }
        const double lowest = lowest_position(line);
        const auto is_there = [&](const Cut& cut) {
            const glm::dvec2 gap = place(cut.vertex) - lines_.at(line, lowest);
            return std::hypot(gap.x, gap.y) <= 1e-4;
        };
        if (std::none_of(cuts.begin(), cuts.end(), is_there)) {
            const Cut cut{lowest, vertex_count(), no_mark};
            added_places_.push_back(lines_.at(line, lowest));
            cuts.insert(std::upper_bound(cuts.begin(), cuts.end(), cut,
                                         [](const Cut& a, const Cut& b) { return a.position < b.position; }),
                        cut);
        }
        for (std::size_t i = 0; i < cuts.size(); ++i) {
            pulse_();
            const bool is_last = i + 1 == cuts.size();
            const Cut& from = cuts[i];
            const Cut& after = cuts[is_last ? 0 : i + 1];
            const double to = after.position + (is_last ? line.count() : 0);
            const LinePlace middle = lines_.place(line, (from.position + to) / 2);
            const bool is_segment = to - from.position <= 1 + 1e-9 && lines_.piece(line, middle.piece).is_straight;
            edges_.push_back(
                {number, from.position, to, from.vertex, after.vertex, from.mark, after.mark, is_segment});
        }
    }
    drop_repeated();
}

/// Keeps one of several straight edges between the same vertices.
void FieldFinder::drop_repeated() {
    std::vector<std::uint32_t> order;
    for (std::uint32_t i = 0; i < edges_.size(); ++i) {
        if (edges_[i].is_segment) order.push_back(i);
    }
    const auto ends = [&](std::uint32_t i) { return std::minmax(edges_[i].tail, edges_[i].head); };
    std::sort(order.begin(), order.end(), stoppable(monitor_, [&](std::uint32_t a, std::uint32_t b) {
                  return std::tuple(ends(a), a) < std::tuple(ends(b), b);
              }));
    std::vector<bool> is_dropped(edges_.size(), false);
    for (std::size_t begin = 0, end = 0; begin < order.size(); begin = end) {
        while (end < order.size() && ends(order[end]) == ends(order[begin])) ++end;
        for (std::size_t i = begin + 1; i < end; ++i) is_dropped[order[i]] = true;
        edges_[order[begin]].is_odd = (end - begin) % 2 == 1;
    }
    std::vector<Edge> kept;
    for (std::size_t i = 0; i < edges_.size(); ++i) {
        const bool is_point = edges_[i].is_segment && edges_[i].tail == edges_[i].head;
        if (!is_dropped[i] && !is_point) kept.push_back(edges_[i]);
    }
    edges_ = std::move(kept);
}

void FieldFinder::sort_around() {
    struct Spoke {
        std::uint32_t vertex;
        double angle;
        std::uint32_t half;
    };
    const VertexHeadings headings(lines_, meetings_);
    std::vector<Spoke> spokes;
    for (std::uint32_t half = 0; half < count(); ++half) {
        pulse_();
        const std::uint32_t vertex = tail(half);
        double angle = half % 2;  // two spokes of an added vertex, in any order
        const Edge& edge = edges_[half / 2];
        const std::size_t mark = half % 2 == 0 ? edge.first_mark : edge.last_mark;
        if (mark != no_mark) angle = headings.heading(mark, half % 2 == 0);
        if (std::isnan(angle)) angle = 0;
        spokes.push_back({vertex, angle, half});
    }
    std::sort(spokes.begin(), spokes.end(), stoppable(monitor_, [](const Spoke& a, const Spoke& b) {
                  return std::tuple(a.vertex, a.angle, a.half) < std::tuple(b.vertex, b.angle, b.half);
              }));
    next_.resize(count());
    for (std::size_t begin = 0, end = 0; begin < spokes.size(); begin = end) {
        while (end < spokes.size() && spokes[end].vertex == spokes[begin].vertex) ++end;
        // After the twin of a half-edge, the face on the left continues along the half-edge clockwise of the twin.
        for (std::size_t i = begin; i < end; ++i) {
            next_[spokes[i].half ^ 1] = spokes[i == begin ? end - 1 : i - 1].half;
        }
    }
}

void FieldFinder::find_cycles() {
    cycle_.assign(count(), no_number);
    for (std::uint32_t first = 0; first < count(); ++first) {
        if (cycle_[first] != no_number) continue;
        Moments moments;
        const glm::dvec2 origin = place(tail(first));
        std::uint32_t half = first;
        do {
            pulse_();
            cycle_[half] = static_cast<std::uint32_t>(begins_.size());
            along(half, begin_of(half), end_of(half),
                  [&](const Bezier& curve, const CurvePiece&) { moments.add(curve, origin); });
            half = next(half);
        } while (half != first);
        begins_.push_back(first);
        areas_.push_back(moments.area);
    }
}

void FieldFinder::find_components() {
    UnionFind joined(vertex_count());
    for (const Edge& edge : edges_) joined.join(edge.tail, edge.head);
    component_.assign(vertex_count(), no_number);
    std::vector<std::uint32_t> number(vertex_count(), no_number);
    for (const Edge& edge : edges_) {
        for (const std::uint32_t vertex : {edge.tail, edge.head}) {
            std::uint32_t& own = number[joined.find(vertex)];
            if (own == no_number) {
                own = static_cast<std::uint32_t>(outer_.size());
                outer_.push_back(no_number);
            }
            component_[vertex] = own;
        }
    }
    for (std::uint32_t cycle = 0; cycle < begins_.size(); ++cycle) {
        std::uint32_t& outer = outer_[component_[tail(begins_[cycle])]];
        if (outer == no_number || areas_[cycle] < areas_[outer]) outer = cycle;
    }
}

/// Sorts the edges into columns, for rays.
void FieldFinder::bucket_edges() {
    double right = -std::numeric_limits<double>::max();
    left_ = -right;
    std::vector<std::pair<double, double>> reach(edges_.size(), {-right, right});
    for (std::uint32_t i = 0; i < edges_.size(); ++i) {
        pulse_();
        along(2 * i, edges_[i].from, edges_[i].to, [&](const Bezier& curve, const CurvePiece&) {
            for (const glm::dvec2 point : curve) {
                reach[i] = {std::min(reach[i].first, point.x), std::max(reach[i].second, point.x)};
            }
        });
        left_ = std::min(left_, reach[i].first);
        right = std::max(right, reach[i].second);
    }
    column_ = std::max((right - left_) / std::ceil(std::sqrt(static_cast<double>(edges_.size()))), 1e-9);
    const auto column = [&](double x) { return static_cast<std::uint32_t>((x - left_) / column_); };
    for (std::uint32_t i = 0; i < edges_.size(); ++i) {
        for (std::uint32_t x = column(reach[i].first); x <= column(reach[i].second); ++x) {
            pulse_();
            buckets_.emplace_back(x, i);
        }
    }
    std::sort(buckets_.begin(), buckets_.end(), stoppable(monitor_, std::less<>()));
}

/// The edge of another component that lies nearest below a point.
Below FieldFinder::below(glm::dvec2 point, std::uint32_t component) {
    Below found;
    const auto column = static_cast<std::uint32_t>(std::max(0.0, (point.x - left_) / column_));
    auto entry = std::lower_bound(buckets_.begin(), buckets_.end(), std::pair(column, std::uint32_t{0}));
    for (; entry != buckets_.end() && entry->first == column; ++entry) {
        pulse_();
        const Edge& edge = edges_[entry->second];
        if (component_[edge.tail] == component) continue;
        double position = edge.from;
        along(2 * entry->second, edge.from, edge.to, [&](const Bezier& curve, const CurvePiece&) {
            const double begin = position;
            const double share = std::min(edge.to, std::floor(begin + 1e-9) + 1) - begin;
            position = begin + share;
            // In monotone parts; a part includes its left end but not its right one.
            constexpr int parts = 8;
            for (int i = 0; i < parts; ++i) {
                double low = static_cast<double>(i) / parts;
                double high = static_cast<double>(i + 1) / parts;
                const double x0 = i == 0 ? curve[0].x : point_of(curve, low).x;
                const double x1 = i + 1 == parts ? curve[3].x : point_of(curve, high).x;
                const bool is_rightward = x0 < x1;
                if (!(std::min(x0, x1) <= point.x && point.x < std::max(x0, x1))) continue;
                for (int step = 0; step < 60; ++step) {
                    const double middle = (low + high) / 2;
                    ((point_of(curve, middle).x <= point.x) == is_rightward ? low : high) = middle;
                }
                const glm::dvec2 at = point_of(curve, low);
                if (at.y >= point.y || at.y <= found.y) continue;
                found = {2 * entry->second + (is_rightward ? 0U : 1U), begin + low * share, at.y, at};
            }
        });
    }
    return found;
}

/// Finds the field in which each component lies and the parity of all faces, from below.
void FieldFinder::place_components() {
    std::vector<std::uint32_t> lowest(outer_.size(),
                                      no_number);  // half-edge of the outer cycle from the lowest vertex
    for (std::uint32_t component = 0; component < outer_.size(); ++component) {
        std::uint32_t half = begins_[outer_[component]];
        do {
            const auto key = [&](std::uint32_t of) { return std::pair(place(tail(of)).y, place(tail(of)).x); };
            if (lowest[component] == no_number || key(half) < key(lowest[component])) lowest[component] = half;
            half = next(half);
        } while (half != begins_[outer_[component]]);
    }
    std::vector<std::uint32_t> order(outer_.size());
    for (std::uint32_t i = 0; i < order.size(); ++i) order[i] = i;
    std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
        return std::tuple(place(tail(lowest[a])).y, a) < std::tuple(place(tail(lowest[b])).y, b);
    });
    container_.assign(outer_.size(), no_number);
    odd_.assign(begins_.size(), 0);
    if (outer_.size() > 1) bucket_edges();
    std::vector<char> is_reached(begins_.size(), 0);
    for (const std::uint32_t component : order) {
        const glm::dvec2 from = place(tail(lowest[component]));
        if (outer_.size() > 1) {
            const Below found = below(from, component);
            if (found.half != no_number) {
                const std::uint32_t cycle = cycle_[found.half];
                const std::uint32_t other = component_[tail(found.half)];
                container_[component] = cycle == outer_[other] ? container_[other] : cycle;
                if (container_[component] != no_number) {
                    holes_.insert({found.half, {found.position, found.at, lowest[component]}});
                }
            }
        }
        std::vector<std::uint32_t> front = {outer_[component]};
        is_reached[outer_[component]] = 1;
        odd_[outer_[component]] = container_[component] == no_number ? 0 : odd_[container_[component]];
        while (!front.empty()) {
            const std::uint32_t cycle = front.back();
            front.pop_back();
            std::uint32_t half = begins_[cycle];
            do {
                pulse_();
                const std::uint32_t beyond = cycle_[half ^ 1];
                if (!is_reached[beyond]) {
                    is_reached[beyond] = 1;
                    odd_[beyond] = static_cast<char>(odd_[cycle] ^ (edges_[half / 2].is_odd ? 1 : 0));
                    front.push_back(beyond);
                }
                half = next(half);
            } while (half != begins_[cycle]);
        }
    }
}

/// Adds the outline from a half-edge round its cycle, with the holes whose lines begin on it.
void FieldFinder::trace(std::uint32_t first, std::vector<glm::dvec2>& outline, bool& is_straight, int depth) const {
    const auto line_to = [&](glm::dvec2 to) {
        const Bezier straight = straight_curve(outline.back(), to);
        outline.insert(outline.end(), straight.begin() + 1, straight.end());
    };
    constexpr int deepest = 10'000;
    std::uint32_t half = first;
    do {
        const auto [begin, end] = holes_.equal_range(half);
        std::vector<Hole> holes;
        for (auto hole = begin; hole != end && depth < deepest; ++hole) holes.push_back(hole->second);
        std::sort(holes.begin(), holes.end(), [&](const Hole& a, const Hole& b) {
            return half % 2 == 0 ? a.position < b.position : a.position > b.position;
        });
        double at = begin_of(half);
        const auto go_to = [&](double position) {
            along(half, at, position, [&](const Bezier& curve, const CurvePiece& piece) {
                outline.insert(outline.end(), curve.begin() + 1, curve.end());
                is_straight = is_straight && piece.is_straight;
            });
            at = position;
        };
        for (const Hole& hole : holes) {
            go_to(hole.position);
            outline.back() = hole.from;
            line_to(place(tail(hole.half)));
            trace(hole.half, outline, is_straight, depth + 1);
            line_to(hole.from);
        }
        go_to(end_of(half));
        // Neighbours share their corners exactly.
        outline.back() = place(tail(half ^ 1));
        half = next(half);
    } while (half != first);
}

void FieldFinder::measure(std::uint32_t cycle, Field& field) {
    std::map<std::uint32_t, double> lengths;  // length of each orbit of lines
    glm::dvec2 first(0.0), before(0.0);
    const auto turn_to = [&](glm::dvec2 tangent) {
        constexpr double bend = 0.05;  // sine of the turn of a corner
        if (first == glm::dvec2(0.0)) first = tangent;
        const bool is_first = before == glm::dvec2(0.0);
        field.corners +=
            !is_first && (std::fabs(determinant(before, tangent)) > bend || scalar_product(before, tangent) < 0) ? 1
                                                                                                                 : 0;
    };
    std::uint32_t half = begins_[cycle];
    do {
        pulse_();
        Moments own;
        along(half, begin_of(half), end_of(half), [&](const Bezier& curve, const CurvePiece&) {
            own.add(curve, curve[0]);
            turn_to(tangent_of(curve, 0));
            before = tangent_of(curve, 1);
        });
        lengths[lines_.lines[edges_[half / 2].line].orbit] += own.length;
        half = next(half);
    } while (half != begins_[cycle]);
    turn_to(first);
    double longest = 0;
    for (const auto& [orbit, length] : lengths) {
        if (length > longest * (1 + 1e-9)) std::tie(field.orbit, longest) = std::pair(orbit, length);
    }
    Moments moments;
    for (std::size_t i = 0; i + 3 < field.outline.size(); i += 3) {
        moments.add({field.outline[i], field.outline[i + 1], field.outline[i + 2], field.outline[i + 3]},
                    field.outline[0]);
    }
    field.area = moments.area;
    field.centroid = moments.area == 0 ? field.outline[0] : field.outline[0] + moments.first / moments.area;
}

std::vector<Field> FieldFinder::make_fields() {
    std::vector<Field> fields;
    std::vector<std::uint32_t> field_of_cycle(begins_.size(), no_number);
    for (std::uint32_t cycle = 0; cycle < begins_.size(); ++cycle) {
        const std::uint32_t first = begins_[cycle];
        if (cycle == outer_[component_[tail(first)]] || areas_[cycle] < least_area) continue;
        Field field;
        field.is_odd = odd_[cycle] != 0;
        field.is_straight = true;
        field.outline.push_back(place(tail(first)));
        trace(first, field.outline, field.is_straight, 0);
        measure(cycle, field);
        field_of_cycle[cycle] = static_cast<std::uint32_t>(fields.size());
        fields.push_back(std::move(field));
    }
    for (std::uint32_t component = 0; component < outer_.size(); ++component) {
        if (container_[component] != no_number)
            field_of_cycle[outer_[component]] = field_of_cycle[container_[component]];
    }
    find_distances(fields, field_of_cycle);
    return fields;
}

void FieldFinder::find_distances(std::vector<Field>& fields, const std::vector<std::uint32_t>& field_of_cycle) {
    std::vector<std::uint32_t> front;
    for (std::uint32_t half = 0; half < count(); ++half) {
        pulse_();
        const std::uint32_t own = field_of_cycle[cycle_[half]];
        const std::uint32_t other = field_of_cycle[cycle_[half ^ 1]];
        if (own == no_number || own == other) continue;
        if (other != no_number) {
            fields[own].beside.push_back(other);
        } else if (fields[own].distance == 0) {
            fields[own].distance = 1;
            front.push_back(own);
        }
    }
    for (Field& field : fields) {
        std::sort(field.beside.begin(), field.beside.end());
        field.beside.erase(std::unique(field.beside.begin(), field.beside.end()), field.beside.end());
    }
    for (std::size_t i = 0; i < front.size(); ++i) {
        pulse_();
        for (const std::uint32_t other : fields[front[i]].beside) {
            if (fields[other].distance > 0) continue;
            fields[other].distance = fields[front[i]].distance + 1;
            front.push_back(other);
        }
    }
}

}  // namespace

std::vector<Field> find_fields(const CurvedLines& lines, const CurveMeetings& meetings, const Monitor& monitor) {
    return FieldFinder(lines, meetings, monitor).find();
}

}  // namespace sikku
