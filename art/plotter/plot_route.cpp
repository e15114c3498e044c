#include "art/plotter/plot_route.h"

#include "engine/base/chance.h"
#include "engine/base/memory.h"
#include "engine/base/threads.h"
#include "engine/geometry/curve_tree.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

namespace sikku {
namespace {

constexpr std::uint32_t no_end = CurveTree::none;
constexpr std::size_t most_near = 6;
constexpr std::size_t most_near_closed = 10;  // each point twice
constexpr std::size_t few = 1000;             // strokes whose order is searched for longer
constexpr std::size_t many = 20'000;          // longer routes are improved from one order only
// Number of strokes of a long route that are improved together, for Walk::order and Walk::chain:
constexpr std::size_t part_of_walk = 50'000;
constexpr std::size_t part_of_chain = 12'500;
constexpr int most_rounds = 8;

/// For each of many points, the points nearest to it, the nearest first, and then `no_end`.
class NearLists {
public:
    NearLists() = default;
    NearLists(std::size_t points, std::size_t most) : most_(most) {
        resize_in_large_pages(near_, points * most, no_end);
    }
    std::span<const std::uint32_t> of(std::uint32_t point) const {
        return std::span(near_).subspan(point * most_, most_);
    }
    std::span<std::uint32_t> of(std::uint32_t point) { return std::span(near_).subspan(point * most_, most_); }

private:
    std::size_t most_ = 0;
    std::vector<std::uint32_t> near_;
};

template <std::size_t most>
NearLists find_near(const CurveTree& tree, const Monitor& monitor) {
    NearLists near(tree.size() + 1, most);  // the last one is for the start
    constexpr std::size_t block = 8192;
    for_each_index((tree.size() + block - 1) / block, [&](std::size_t index) {
        monitor.check();
        const std::size_t begin = index * block;
        tree.nearest_of_each<most>(begin, std::min(begin + block, tree.size()),
                                   [&](std::uint32_t point, const std::array<std::uint32_t, most>& found) {
                                       std::copy(found.begin(), found.end(), near.of(point).begin());
                                   });
    });
    return near;
}

/// Strokes in the order in which they are drawn, each by the end at which it is entered: 2 i, or 2 i + 1 for the
/// other way round.
class PlotRoute {
public:
    /// @param points  ends of the strokes, two each
    /// @param start   position of the pen before the first one
    /// @param returns  the pen travels back to its start
    /// @param longest_part  number of strokes of a long route that are improved together
    PlotRoute(std::vector<glm::dvec2> points, std::vector<PlotEnd> order, glm::dvec2 start, bool returns,
              std::size_t longest_part = part_of_walk)
        : points_(std::move(points)),
          order_(std::move(order)),
          place_(order_.size()),
          start_(static_cast<PlotEnd>(points_.size())),
          returns_(returns),
          longest_part_(longest_part) {
        for (std::uint32_t i = 0; i < order_.size(); ++i) place_[order_[i] / 2] = i;
        points_.push_back(start);
    }

    /// Length of all travel between the strokes.
    double length() const {
        double sum = 0;
        for (std::uint32_t i = 0; i <= order_.size(); ++i) sum += distance(left(i), right(i));
        return sum;
    }

    /// Exchanges two travels (2-opt), or moves up to three strokes elsewhere (Or-opt), as long as that shortens the
    /// travel. A new travel leads to one of the nearest ends. Parts of long routes are improved in parallel, and then
    /// parts that overlap them; their bounds do not depend on the number of threads. Short routes are also shaken.
    /// Source: Bentley, Fast algorithms for geometric traveling salesman problems, 1992.
    void improve(const NearLists& near, const Monitor& monitor) {
        const std::size_t size = order_.size();
        part_of_.assign(size, 0);
        is_queued_.assign(2 * size + 1, 0);
        if (size <= longest_part_) {
            Part whole(0, 0, size, size);
            settle_all(near, whole, monitor);
            if (size <= few) shake(near, whole, monitor);
            return;
        }
        for (const std::size_t first : {longest_part_, longest_part_ / 2}) {
            std::vector<Part> parts;
            for (std::size_t begin = 0; begin < size;) {
                const std::size_t end = std::min(begin == 0 ? first : begin + longest_part_, size);
                for (std::size_t i = begin; i < end; ++i)
                    part_of_[order_[i] / 2] = static_cast<std::uint32_t>(parts.size());
                parts.emplace_back(static_cast<std::uint32_t>(parts.size()), begin, end, size);
                begin = end;
            }
            for_each_index(parts.size(), [&](std::size_t i) { settle_all(near, parts[i], monitor); });
        }
    }

    const std::vector<PlotEnd>& order() const { return order_; }

private:
    static constexpr std::uint32_t most_moved = 3;
    static constexpr std::uint64_t most_work = 5000;  // for each stroke

    /// Strokes whose travels are improved together. The strokes at both bounds stay, except at those of the route.
    struct Part {
        Part(std::uint32_t part, std::size_t begin, std::size_t end, std::size_t size)
            : number(part),
              lowest(static_cast<std::uint32_t>(begin == 0 ? 0 : begin + 1)),
              highest(static_cast<std::uint32_t>(end == size ? end : end - 1)),
              work(most_work * (end - begin + 1000)) {}
        std::uint32_t number;
        std::uint32_t lowest, highest;  // travels
        std::uint64_t work;             // places in the order that may still be changed
        std::vector<PlotEnd> due;       // ends whose travels may be improved
    };
    /// Strokes first to last are reversed, or, if `to` differs from first, moved before stroke `to` of the order.
    struct Change {
        double gain = 0;
        std::uint32_t first = 0, last = 0, to = 0;
        bool turns = true;
    };

    // Travel i leads to the i-th stroke; the last one to `no_end`: back to the start, or nowhere at no cost.
    PlotEnd left(std::uint32_t i) const { return i == 0 ? start_ : order_[i - 1] ^ 1U; }
    PlotEnd right(std::uint32_t i) const { return i == order_.size() ? no_end : order_[i]; }
    /// The travel at an end.
    std::uint32_t travel(PlotEnd end) const {
        if (end == start_) return 0;
        const std::uint32_t at = place_[end / 2];
        return order_[at] == end ? at : at + 1;
    }
    double distance(PlotEnd a, PlotEnd b) const {
        if (a != no_end && b != no_end) return glm::distance(points_[a], points_[b]);
        return returns_ ? glm::distance(points_[a == no_end ? b : a], points_[start_]) : 0.0;
    }

    void enter(Part& part, std::uint32_t travel) {
        for (const PlotEnd end : {left(travel), right(travel)}) {
            if (end == no_end || is_queued_[end] != 0) continue;
            is_queued_[end] = 1;
            part.due.push_back(end);
        }
    }

    void settle_all(const NearLists& near, Part& part, const Monitor& monitor) {
        for (std::uint32_t i = part.lowest; i <= part.highest; ++i) enter(part, i);
        settle(near, part, monitor);
    }

    /// Improves the travels that are due, and those next to every change. Returns the length saved.
    double settle(const NearLists& near, Part& part, const Monitor& monitor) {
        double gained = 0;
        Pulse pulse(monitor);
        std::vector<PlotEnd> queue;
        while (!part.due.empty()) {
            queue.swap(part.due);
            part.due.clear();
            for (const PlotEnd end : queue) {
                pulse();
                is_queued_[end] = 0;
                for (;;) {
                    const Change change = best_change(end, near, part);
                    const std::uint32_t size =
                        std::max(change.last + 1, change.to) - std::min(change.first, change.to);
                    if (change.gain <= 0 || size > part.work) break;
                    part.work -= size;
                    gained += change.gain;
                    for (const std::uint32_t i : {change.first, change.last + 1, change.to}) enter(part, i);
                    apply(change);
                }
            }
        }
        return gained;
    }

    /// Exchanges random neighbouring ranges of strokes, improves the result, and keeps it if it is shorter.
    /// Source: Martin, Otto & Felten, Large-step Markov chains for the traveling salesman problem, 1991.
    void shake(const NearLists& near, Part& part, const Monitor& monitor) {
        const std::size_t size = order_.size();
        if (size < 3) return;
        constexpr std::size_t longest_range = 30;
        SplitMix random(size);
        std::vector<PlotEnd> before;
        for (std::size_t i = 0; i < 5 * size; ++i) {
            monitor.check();
            const std::uint32_t first = static_cast<std::uint32_t>(random.below(size - 1));
            const std::uint32_t middle =
                first + 1 + static_cast<std::uint32_t>(random.below(std::min(longest_range, size - 1 - first)));
            const std::uint32_t end =
                middle + 1 + static_cast<std::uint32_t>(random.below(std::min(longest_range, size - middle)));
            before = order_;
            const double old_way = distance(left(first), right(first)) + distance(left(middle), right(middle)) +
                                   distance(left(end), right(end));
            for (const std::uint32_t travel : {first, middle, end}) enter(part, travel);
            apply({0, first, middle - 1, end, false});
            const std::uint32_t moved = first + end - middle;
            const double new_way = distance(left(first), right(first)) + distance(left(moved), right(moved)) +
                                   distance(left(end), right(end));
            if (settle(near, part, monitor) > new_way - old_way) continue;
            order_ = before;
            for (std::uint32_t k = 0; k < size; ++k) place_[order_[k] / 2] = k;
        }
    }

    Change best_change(PlotEnd end, const NearLists& near, const Part& part) const {
        Change best;
        const std::uint32_t here = travel(end);
        const auto is_inside = [&](std::uint32_t i) { return i >= part.lowest && i <= part.highest; };
        if (!is_inside(here)) return best;
        const bool is_left = left(here) == end;
        const PlotEnd partner = is_left ? right(here) : left(here);
        const double way = distance(end, partner);
        // Smaller gains are rounding errors.
        best.gain = 1e-9 * way;
        const double least = best.gain;
        for (const PlotEnd other : near.of(end)) {
            if (other == no_end) break;
            if (other / 2 == end / 2 && end != start_) continue;
            const double new_way = distance(end, other);
            if (!(new_way < way)) break;
            if (part_of_[other / 2] != part.number) continue;
            const std::uint32_t there = travel(other);
            if (!is_inside(there) || here == there) continue;
            const bool other_is_left = left(there) == other;
            const PlotEnd other_partner = other_is_left ? right(there) : left(there);
            const double saved = way + distance(other, other_partner) - new_way;
            if (is_left == other_is_left) {
                const double gain = saved - distance(partner, other_partner);
                if (gain > best.gain) {
                    const std::uint32_t low = std::min(here, there);
                    best = {gain, low, std::max(here, there) - 1, low, true};
                }
            }
            // Moves strokes from `other` on to `end`, or from `end` on to `other`.
            for (const bool forth : {true, false}) {
                const PlotEnd first = forth ? other : end;
                if (first == start_) continue;
                const PlotEnd next_to_first = forth ? other_partner : partner;
                const PlotEnd beyond = forth ? partner : other_partner;
                const std::uint32_t to = forth ? here : there;
                const bool target_is_left = forth ? is_left : other_is_left;
                const bool runs_up = order_[place_[first / 2]] == first;
                std::uint32_t low = place_[first / 2], high = low;
                for (std::uint32_t count = 1; count <= most_moved; ++count) {
                    if (count > 1) {
                        if (runs_up) {
                            ++high;
                        } else {
                            if (low == 0) break;
                            --low;
                        }
                    }
                    // The travels on both sides of the strokes have to be inside, and the target off them.
                    if (!is_inside(low) || !is_inside(high + 1) || (to >= low && to <= high + 1)) break;
                    const PlotEnd last = runs_up ? order_[high] ^ 1U : order_[low];
                    const PlotEnd after = runs_up ? right(high + 1) : left(low);
                    const double gain =
                        saved + distance(last, after) - distance(last, beyond) - distance(next_to_first, after);
                    if (gain > best.gain) best = {gain, low, high, to, runs_up != target_is_left};
                }
            }
        }
        if (best.gain <= least) best.gain = 0;
        return best;
    }

    void apply(const Change& change) {
        std::uint32_t low = change.first;
        std::uint32_t high = change.last + 1;
        std::uint32_t moved = low;
        const auto at = [&](std::uint32_t i) { return order_.begin() + static_cast<std::ptrdiff_t>(i); };
        if (change.to < low) {
            std::rotate(at(change.to), at(low), at(high));
            moved = low = change.to;
        } else if (change.to > high) {
            std::rotate(at(low), at(high), at(change.to));
            moved = change.to - (high - low);
            high = change.to;
        }
        if (change.turns) {
            const std::uint32_t end = moved + (change.last - change.first) + 1;
            std::reverse(at(moved), at(end));
            for (std::uint32_t i = moved; i < end; ++i) order_[i] ^= 1U;
        }
        for (std::uint32_t i = low; i < high; ++i) place_[order_[i] / 2] = i;
    }

    std::vector<glm::dvec2> points_;
    std::vector<PlotEnd> order_;
    std::vector<std::uint32_t> place_;  // place of each stroke in the order
    PlotEnd start_;                     // a point, not an end of a stroke
    bool returns_;
    std::size_t longest_part_;
    std::vector<std::uint32_t> part_of_;  // by stroke
    std::vector<char> is_queued_;         // by end
};

/// The points where strokes may begin: both ends, or any point of closed ones. Strokes are numbered along a curve, so
/// that neighbours in the plane are neighbours in memory.
struct Entries {
    Entries(const PlotGraph& graph, const PlotStrokes& given, const Monitor& monitor) {
        const auto count = given.strokes.size();
        points.reserve(2 * count);
        Pulse pulse(monitor);
        for (const PlotStroke& stroke : given.strokes) {
            pulse();
            points.push_back(graph.point(given.ends(stroke).front()));
            has_closed = has_closed || stroke.closed;
        }
        number = order_along_curve(points, monitor);
        points.clear();
        for (const std::uint32_t i : number) {
            pulse();
            const PlotStroke& stroke = given.strokes[i];
            const auto in_order = given.ends(stroke);
            const auto begin = static_cast<std::uint32_t>(points.size());
            if (stroke.closed) {
                for (const PlotEnd end : in_order) {
                    pulse();
                    points.push_back(graph.point(end));
                }
            } else {
                points.push_back(graph.point(in_order.front()));
                points.push_back(graph.point(in_order.back() ^ 1U));
            }
            if (!has_closed) continue;
            is_closed.push_back(stroke.closed ? 1 : 0);
            owners.resize(points.size(), static_cast<std::uint32_t>(firsts.size()));
            firsts.push_back(begin);
        }
        if (has_closed) firsts.push_back(static_cast<std::uint32_t>(points.size()));
    }
    /// The stroke of an entry.
    std::uint32_t owner(std::uint32_t entry) const { return has_closed ? owners[entry] : entry / 2; }
    /// The first entry of a stroke.
    std::uint32_t first(std::uint32_t stroke) const { return has_closed ? firsts[stroke] : 2 * stroke; }
    /// The entry at which a stroke is left.
    std::uint32_t leave(std::uint32_t entry) const {
        return has_closed ? is_closed[owners[entry]] ? entry : 2 * firsts[owners[entry]] + 1 - entry : entry ^ 1U;
    }

    std::vector<std::uint32_t> number;  // of each stroke, as given
    std::vector<glm::dvec2> points;
    bool has_closed = false;

private:
    // If any stroke is closed:
    std::vector<std::uint32_t> owners, firsts;
    std::vector<char> is_closed;
};

/// The entries of strokes in an order that always goes to the nearest one.
std::vector<std::uint32_t> nearest_first(const Entries& entries, CurveTree& tree, const NearLists& near,
                                         glm::dvec2 start, const Monitor& monitor) {
    std::vector<std::uint32_t> order;
    order.reserve(entries.number.size());
    Pulse pulse(monitor);
    std::uint32_t at = no_end;
    std::uint32_t left_over = 0;
    while (order.size() < entries.number.size()) {
        std::uint32_t found = no_end;
        if (at != no_end) {
            const auto list = near.of(at);
            const auto there = std::find_if(list.begin(), list.end(), [&](std::uint32_t other) {
                return other == no_end || tree.is_there(other);
            });
            if (there != list.end()) found = *there;
        }
        if (found == no_end) found = tree.nearest(at == no_end ? start : entries.points[at], at == no_end ? 0 : at);
        if (found == no_end) {  // only if coordinates are not numbers
            while (!tree.is_there(left_over)) ++left_over;
            found = left_over;
        }
        const std::uint32_t stroke = entries.owner(found);
        for (std::uint32_t k = entries.first(stroke); k < entries.first(stroke + 1); ++k) {
            pulse();
            tree.remove(k);
        }
        order.push_back(found);
        at = entries.leave(found);
    }
    return order;
}

/// Strokes joined into chains by pen-up travel between their ends.
class Chains {
public:
    /// @param points  ends of the strokes, two each
    explicit Chains(const std::vector<glm::dvec2>& points)
        : points_(points), partner_(points.size(), no_end), far_(points.size()), index_(points.size()) {
        for (PlotEnd end = 0; end < far_.size(); ++end) far_[end] = end ^ 1U;
    }

    /// Repeatedly joins the two nearest ends of different chains until there is one chain. Returns the ends at which
    /// its strokes are entered, from the end of the chain that is nearer to `start`. Ends that are nearer to
    /// each other than to any others are joined at once; that gives nearly the same chains as trying all pairs in the
    /// order of their distance. Source: Bentley, Fast algorithms for geometric traveling salesman problems, 1992
    /// (greedy heuristic). @param near  of all ends
    std::vector<PlotEnd> join(const NearLists& near, glm::dvec2 start, const Monitor& monitor) {
        std::vector<PlotEnd> ends(points_.size());
        std::iota(ends.begin(), ends.end(), 0U);
        join_near(ends, near, monitor);
        for (;;) {
            const std::size_t before = ends.size();
            std::erase_if(ends, [&](PlotEnd end) { return partner_[end] != no_end; });
            if (ends.size() <= 2) break;
            // Happens only if coordinates are not numbers.
            if (ends.size() == before) {
                const auto other = std::find_if(ends.begin(), ends.end(), [&](PlotEnd end) {
                    return end != ends.front() && end != far_[ends.front()];
                });
                link(ends.front(), *other);
                continue;
            }
            std::vector<glm::dvec2> places;
            for (const PlotEnd end : ends) places.push_back(points_[end]);
            const CurveTree tree(
                places, [&](std::uint32_t i) { return std::min(ends[i], far_[ends[i]]); },
                [](std::uint32_t i) { return i; }, monitor);
            join_near(ends, find_near<most_near>(tree, monitor), monitor);
        }
        return in_order(ends, start, monitor);
    }

private:
    /// Joins free ends of different chains with near ones. @param near  lists of indices of `ends`
    void join_near(std::span<const PlotEnd> ends, const NearLists& near, const Monitor& monitor) {
        Pulse pulse(monitor);
        for (std::uint32_t i = 0; i < ends.size(); ++i) index_[ends[i]] = i;
        std::vector<std::uint8_t> next(ends.size(), 0);  // entries before are joined, or end the same chain
        const auto nearest = [&](std::uint32_t i) {
            const auto list = near.of(i);
            for (; next[i] < list.size() && list[next[i]] != no_end; ++next[i]) {
                const PlotEnd end = ends[list[next[i]]];
                if (partner_[end] == no_end && far_[ends[i]] != end) return list[next[i]];
            }
            return no_end;
        };
        const auto distance = [&](std::uint32_t i, std::uint32_t k) {
            return glm::distance(points_[ends[i]], points_[ends[k]]);
        };
        std::vector<std::uint32_t> way;
        for (std::uint32_t first = 0; first < ends.size(); ++first) {
            way.assign(1, first);
            while (!way.empty()) {
                pulse();
                const std::uint32_t here = way.back();
                const std::uint32_t there = partner_[ends[here]] == no_end ? nearest(here) : no_end;
                if (there == no_end) {
                    way.pop_back();
                    continue;
                }
                const std::uint32_t back = nearest(there);
                // Smaller differences are rounding errors.
                if (back != no_end && distance(there, back) < (1 - 1e-9) * distance(here, there)) {
                    way.push_back(there);
                } else {
                    // Among ends equally far away, those next to each other then continue the chain.
                    way.back() = index_[far_[ends[there]]];
                    link(ends[here], ends[there]);
                }
            }
        }
    }

    void link(PlotEnd a, PlotEnd b) {
        partner_[a] = b;
        partner_[b] = a;
        const PlotEnd first = far_[a], last = far_[b];
        far_[first] = last;
        far_[last] = first;
    }

    /// @param ends  both ends of the only chain
    std::vector<PlotEnd> in_order(std::span<const PlotEnd> ends, glm::dvec2 start, const Monitor& monitor) const {
        std::vector<PlotEnd> order;
        order.reserve(points_.size() / 2);
        Pulse pulse(monitor);
        const bool from_back =
            glm::distance(start, points_[ends.back()]) < glm::distance(start, points_[ends.front()]);
        for (PlotEnd end = from_back ? ends.back() : ends.front(); end != no_end; end = partner_[end ^ 1U]) {
            pulse();
            order.push_back(end);
        }
        return order;
    }

    const std::vector<glm::dvec2>& points_;
    std::vector<PlotEnd> partner_;      // of ends: the end that it is joined with, or no_end
    std::vector<PlotEnd> far_;          // of free ends: the other end of the chain
    std::vector<std::uint32_t> index_;  // of free ends: their indices in join_near()
};

/// Initial routes.
struct Walk {
    std::vector<std::uint32_t> number;  // of strokes, as given
    std::vector<std::uint32_t> begin;   // of strokes: the first segment, if any is closed
    std::vector<glm::dvec2> points;     // ends of strokes, two each
    std::vector<PlotEnd> order;         // always to the nearest stroke; may be empty if there is a chain
    std::vector<PlotEnd> chain;         // strokes joined to one chain; empty for few strokes, and if any is closed
    NearLists near;                     // of these points, and of the start
};

NearLists near_ends(const std::vector<glm::dvec2>& points, const Monitor& monitor) {
    const CurveTree tree(
        points, [](std::uint32_t end) { return end / 2; }, [](std::uint32_t end) { return end; }, monitor);
    return find_near<most_near_closed>(tree, monitor);
}

/// The list of the start, which is the last one.
void add_start(NearLists& near, const std::vector<glm::dvec2>& points, glm::dvec2 start) {
    std::vector<std::pair<double, PlotEnd>> nearest;
    for (PlotEnd end = 0; end < points.size(); ++end) {
        const std::pair<double, PlotEnd> one(glm::distance(start, points[end]), end);
        if (nearest.size() == most_near && !(one < nearest.back())) continue;
        nearest.insert(std::upper_bound(nearest.begin(), nearest.end(), one), one);
        if (nearest.size() > most_near) nearest.pop_back();
    }
    const auto out = near.of(static_cast<PlotEnd>(points.size()));
    for (std::size_t k = 0; k < nearest.size(); ++k) out[k] = nearest[k].second;
}

bool chain_is_shorter(const PlotGraph& graph, const PlotStrokes& given, std::span<const std::uint32_t> number,
                      const Monitor& monitor);

Walk first_walk(const PlotGraph& graph, const PlotStrokes& given, glm::dvec2 start, const Monitor& monitor) {
    Walk walk;
    Entries entries(graph, given, monitor);
    {
        CurveTree tree(
            entries.points, [&](std::uint32_t id) { return entries.owner(id); },
            [&](std::uint32_t id) {
                return 2 * entries.number[entries.owner(id)] + (entries.has_closed ? 0 : id % 2);
            },
            monitor);
        walk.near = find_near<most_near>(tree, monitor);
        const bool is_long = given.strokes.size() > many;
        const bool has_chain = given.strokes.size() > few && !entries.has_closed &&
                               (!is_long || chain_is_shorter(graph, given, entries.number, monitor));
        if (!has_chain || !is_long) walk.order = nearest_first(entries, tree, walk.near, start, monitor);
        if (has_chain) walk.chain = Chains(entries.points).join(walk.near, start, monitor);
    }
    walk.number = std::move(entries.number);
    if (!entries.has_closed) {
        walk.points = std::move(entries.points);
    } else {
        walk.begin.resize(walk.order.size());
        walk.points.resize(2 * walk.order.size());
        for (PlotEnd& end : walk.order) {
            const std::uint32_t stroke = entries.owner(end);
            const std::uint32_t leave = entries.leave(end);
            const std::uint32_t which = end - entries.first(stroke);
            walk.begin[stroke] = which;
            const PlotEnd enter = 2 * stroke + (leave == end ? 0 : which);
            walk.points[enter] = entries.points[end];
            walk.points[enter ^ 1U] = entries.points[leave];
            end = enter;
        }
        walk.near = near_ends(walk.points, monitor);
    }
    add_start(walk.near, walk.points, start);
    return walk;
}

PlotRoute improved(const Walk& walk, std::vector<PlotEnd> order, std::size_t longest_part, glm::dvec2 start,
                   bool returns, const Monitor& monitor) {
    PlotRoute route(walk.points, std::move(order), start, returns, longest_part);
    route.improve(walk.near, monitor);
    return route;
}

/// True if the improved chain is shorter than the improved walk in both of two samples of neighbouring strokes. If
/// strokes are arranged regularly, the walk is shorter. @param number  Entries::number
bool chain_is_shorter(const PlotGraph& graph, const PlotStrokes& given, std::span<const std::uint32_t> number,
                      const Monitor& monitor) {
    constexpr std::size_t size = many / 2;
    for (const std::size_t begin : {(number.size() - size) / 3, (number.size() - size) * 2 / 3}) {
        PlotStrokes sample;
        for (const std::uint32_t i : number.subspan(begin, size)) {
            const auto ends = given.ends(given.strokes[i]);
            sample.strokes.push_back(
                {static_cast<std::uint32_t>(sample.order.size()), given.strokes[i].count, given.strokes[i].closed});
            sample.order.insert(sample.order.end(), ends.begin(), ends.end());
        }
        const glm::dvec2 start = graph.point(sample.order.front());
        Walk walk = first_walk(graph, sample, start, monitor);
        const double chain =
            improved(walk, std::exchange(walk.chain, {}), part_of_chain, start, false, monitor).length();
        const double order =
            improved(walk, std::exchange(walk.order, {}), part_of_walk, start, false, monitor).length();
        if (chain >= (1 - 1e-9) * order) return false;
    }
    return true;
}

/// Lets each closed stroke begin where the detour between its neighbours in the order is least.
void choose_beginnings(const PlotGraph& graph, const PlotStrokes& given, const std::vector<PlotEnd>& order,
                       glm::dvec2 start, bool returns, Walk& walk, const Monitor& monitor) {
    if (walk.begin.empty()) return;
    Pulse pulse(monitor);
    for (std::size_t at = 0; at < order.size(); ++at) {
        const PlotEnd enter = order[at];
        const PlotStroke& stroke = given.strokes[walk.number[enter / 2]];
        if (!stroke.closed) continue;
        const auto in_order = given.ends(stroke);
        const glm::dvec2 from = at == 0 ? start : walk.points[order[at - 1] ^ 1U];
        const auto detour = [&](std::uint32_t k) {
            const glm::dvec2 way = graph.point(in_order[k]);
            const bool is_last = at + 1 == order.size();
            if (is_last) return glm::distance(from, way) + (returns ? glm::distance(way, start) : 0.0);
            return glm::distance(from, way) + glm::distance(way, walk.points[order[at + 1]]);
        };
        std::uint32_t& best = walk.begin[enter / 2];
        double least = detour(best);
        for (std::uint32_t k = 0; k < stroke.count; ++k) {
            pulse();
            if (const double length = detour(k); length < least) {
                least = length;
                best = k;
            }
        }
        walk.points[enter] = walk.points[enter ^ 1U] = graph.point(in_order[best]);
    }
}

}  // namespace

PlotStrokes sort_strokes(const PlotGraph& graph, const PlotStrokes& given, glm::dvec2 start, bool returns,
                         double drawn, const Monitor& monitor) {
    const std::vector<PlotStroke>& strokes = given.strokes;
    Walk walk = first_walk(graph, given, start, monitor);
    const auto improve = [&](std::vector<PlotEnd> order, std::size_t longest_part) {
        return improved(walk, std::move(order), longest_part, start, returns, monitor);
    };
    PlotRoute best = walk.chain.empty() ? improve(std::exchange(walk.order, {}), part_of_walk)
                                        : improve(std::exchange(walk.chain, {}), part_of_chain);
    if (!walk.order.empty()) {
        PlotRoute other = improve(std::exchange(walk.order, {}), part_of_walk);
        if (other.length() < best.length()) best = std::move(other);
    }
    if (best.length() > drawn || strokes.size() <= few) {
        std::vector<PlotEnd> order(strokes.size());
        for (std::uint32_t i = 0; i < order.size(); ++i) order[walk.number[i]] = 2 * i;
        PlotRoute other = improve(std::move(order), part_of_walk);
        if (other.length() < best.length()) best = std::move(other);
    }
    choose_beginnings(graph, given, best.order(), start, returns, walk, monitor);
    // Other beginnings may make another order shorter, and the reverse.
    for (int round = 0; round < most_rounds && !walk.begin.empty() && strokes.size() <= few; ++round) {
        Walk next = walk;
        next.near = near_ends(next.points, monitor);
        add_start(next.near, next.points, start);
        PlotRoute route(next.points, best.order(), start, returns);
        const double before = route.length();
        route.improve(next.near, monitor);
        choose_beginnings(graph, given, route.order(), start, returns, next, monitor);
        route = PlotRoute(next.points, route.order(), start, returns);
        if (!(route.length() < before)) break;
        best = std::move(route);
        walk = std::move(next);
    }

    PlotStrokes result;
    std::vector<PlotEnd>& ends = result.order;
    ends.reserve(given.order.size());
    result.strokes.reserve(strokes.size());
    Pulse pulse(monitor);
    for (const PlotEnd enter : best.order()) {
        pulse();
        const PlotStroke& stroke = strokes[walk.number[enter / 2]];
        const auto in_order = given.ends(stroke);
        result.strokes.push_back({static_cast<std::uint32_t>(ends.size()), stroke.count, stroke.closed});
        if (stroke.closed) {
            const auto begin = in_order.begin() + walk.begin[enter / 2];
            ends.insert(ends.end(), begin, in_order.end());
            ends.insert(ends.end(), in_order.begin(), begin);
        } else if (enter % 2 == 0) {
            ends.insert(ends.end(), in_order.begin(), in_order.end());
        } else {
            for (std::size_t k = in_order.size(); k-- > 0;) ends.push_back(in_order[k] ^ 1U);
        }
    }
    return result;
}

}  // namespace sikku
