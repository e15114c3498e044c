// engine/geometry/curve_tree.h: finds the nearest points of each of many points.
#pragma once

#include "engine/base/monitor.h"
#include "engine/base/threads.h"
#include "engine/geometry/box.h"

#include <glm/vec2.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

namespace sikku {

/// Indices of points in their order along a curve that fills the plane: points near each other in it are near in the
/// plane. Cost: O(n), and O(n log n) for points that are far denser in some places than in others. Source: Morton, A
/// computer oriented geodetic data base, 1966.
inline std::vector<std::uint32_t> order_along_curve(std::span<const glm::dvec2> points, const Monitor& monitor = {}) {
    struct PlaceOnCurve {
        std::uint32_t high, low, index;
    };
    Box box;
    for (const glm::dvec2 point : points) box.add(point);
    const double scale = points.empty() || !(box.longest() > 0) ? 0.0 : 0x1p32 / box.longest();
    // The bits of x and y alternate.
    const auto spread = [](std::uint64_t value) {
        value = (value | value << 16) & 0x0000ffff0000ffffU;
        value = (value | value << 8) & 0x00ff00ff00ff00ffU;
        value = (value | value << 4) & 0x0f0f0f0f0f0f0f0fU;
        value = (value | value << 2) & 0x3333333333333333U;
        return (value | value << 1) & 0x5555555555555555U;
    };
    const auto bits = [&](double offset) {
        return spread(static_cast<std::uint64_t>(offset * scale < 4294967295.0 ? offset * scale : 4294967295.0));
    };
    std::vector<PlaceOnCurve> keys, sorted(points.size());
    keys.reserve(points.size());
    for (std::uint32_t i = 0; i < points.size(); ++i) {
        const std::uint64_t code = bits(points[i].x - box.low.x) | bits(points[i].y - box.low.y) << 1;
        keys.push_back({static_cast<std::uint32_t>(code >> 32), static_cast<std::uint32_t>(code), i});
    }
    constexpr int digit = 11;
    for (int shift = 0; shift < 32; shift += digit) {
        monitor.check();
        std::array<std::uint32_t, std::size_t{1} << digit> begins{};
        const auto bucket = [&](const PlaceOnCurve& key) { return key.high >> shift & (begins.size() - 1); };
        for (const PlaceOnCurve& key : keys) ++begins[bucket(key)];
        std::uint32_t sum = 0;
        for (std::uint32_t& begin : begins) sum += std::exchange(begin, sum);
        for (const PlaceOnCurve& key : keys) sorted[begins[bucket(key)]++] = key;
        keys.swap(sorted);
    }
    constexpr std::size_t few = 8;  // whose order does not matter
    for (std::size_t begin = 0; begin < keys.size();) {
        std::size_t end = begin + 1;
        while (end < keys.size() && keys[end].high == keys[begin].high) ++end;
        if (end - begin > few) {
            const auto at = [&](std::size_t i) { return keys.begin() + static_cast<std::ptrdiff_t>(i); };
            std::sort(at(begin), at(end), stoppable(monitor, [](const PlaceOnCurve& a, const PlaceOnCurve& b) {
                          return a.low != b.low ? a.low < b.low : a.index < b.index;
                      }));
        }
        begin = end;
    }
    std::vector<std::uint32_t> order;
    order.reserve(keys.size());
    for (const PlaceOnCurve& key : keys) order.push_back(key.index);
    return order;
}

/// A tree of boxes over points of the plane, in the order along a curve. A point is identified by its index. Each
/// point has an owner: only points of other owners are near it. Of points equally far away, that with the lower rank
/// is nearer. Points can be removed. Memory: about 40 bytes a point. It is fastest if the points are given roughly
/// along the curve.
/// Source: Karras, Maximizing parallelism in the construction of BVHs, octrees, and k-d trees, 2012.
class CurveTree {
public:
    static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

    /// @param owner  returns the owner of the point of an index
    /// @param rank   returns its rank
    template <class Owner, class Rank>
    CurveTree(std::span<const glm::dvec2> points, const Owner& owner, const Rank& rank, const Monitor& monitor = {})
        : ids_(order_along_curve(points, monitor)), places_(points.size()), is_there_(points.size(), 1) {
        size_ = points.size();
        entries_.resize((size_ + leaf_size - 1) / leaf_size);
        for (std::uint32_t place = 0; place < ids_.size(); ++place) {
            const std::uint32_t id = ids_[place];
            Leaf& leaf = entries_[place / leaf_size];
            leaf.x[place % leaf_size] = points[id].x;
            leaf.y[place % leaf_size] = points[id].y;
            leaf.owner[place % leaf_size] = owner(id);
            leaf.rank[place % leaf_size] = rank(id);
            places_[id] = place;
        }
        while (leaf_size * leaves_ < points.size()) leaves_ *= 2;
        boxes_.resize(2 * leaves_);
        counts_.resize(2 * leaves_);
        for (std::size_t place = 0; place < size_; ++place) {
            const std::size_t leaf = leaves_ + place / leaf_size;
            boxes_[leaf].add(points[ids_[place]]);
            ++counts_[leaf];
        }
        for (std::size_t node = leaves_; node-- > 1;) {
            for (const std::size_t child : {2 * node, 2 * node + 1}) {
                if (counts_[child] == 0) continue;
                ++counts_[node];
                boxes_[node].add(boxes_[child].low);
                boxes_[node].add(boxes_[child].high);
            }
        }
    }

    std::size_t size() const { return size_; }
    bool is_there(std::uint32_t id) const { return is_there_[id] != 0; }

    /// Removes a point that is in the tree. Cost: O(1) on average.
    void remove(std::uint32_t id) {
        is_there_[id] = 0;
        for (std::size_t node = leaves_ + places_[id] / leaf_size; node > 0 && --counts_[node] == 0; node /= 2) {
        }
    }

    /// The point nearest to `centre` that was not removed; `none` if all were. Fastest if the point `beside` is near.
    std::uint32_t nearest(glm::dvec2 centre, std::uint32_t beside) const {
        Group<1> group;
        group.size = 1;
        group.points.x[0] = centre.x;
        group.points.y[0] = centre.y;
        group.points.owner[0] = none;
        group.box.add(centre);
        search(group, leaves_ + places_[beside] / leaf_size);
        return group.found[0][0] == none ? none : ids_[group.found[0][0]];
    }

    /// Calls take(point, near) for each point whose place along the curve is in a range: the `count` points nearest
    /// to it, the nearest first, and then `none`. The range begins at a multiple of 8, and ends at one or at size().
    /// No point may have been removed.
    template <std::size_t count, class Take>
    void nearest_of_each(std::size_t begin, std::size_t end, const Take& take) const {
        for (std::size_t first = begin; first < end; first += leaf_size) {
            Group<count> group;
            const std::size_t leaf = leaves_ + first / leaf_size;
            group.size = std::min(leaf_size, end - first);
            group.points = entries_[first / leaf_size];
            group.box = boxes_[leaf];
            search(group, leaf);
            for (std::size_t i = 0; i < group.size; ++i) {
                for (std::uint32_t& found : group.found[i]) {
                    if (found != none) found = ids_[found];
                }
                take(ids_[first + i], group.found[i]);
            }
        }
    }

private:
    static constexpr std::size_t leaf_size = 8;

    struct Leaf {
        std::array<double, leaf_size> x{}, y{};
        std::array<std::uint32_t, leaf_size> owner{}, rank{};
    };
    /// Points near each other whose neighbours are searched at once.
    template <std::size_t count>
    struct Group {
        std::size_t size = 0;
        Box box;
        double reach = std::numeric_limits<double>::infinity();  // square of the largest distance of a near point
        Leaf points;
        std::array<std::array<double, count>, leaf_size> squares;       // of distances
        std::array<std::array<std::uint32_t, count>, leaf_size> found;  // places

        Group() {
            for (auto& each : squares) each.fill(std::numeric_limits<double>::infinity());
            for (auto& each : found) each.fill(none);
        }
    };

    static double square_from(glm::dvec2 point, const Box& box) {
        const double x = std::max({box.low.x - point.x, point.x - box.high.x, 0.0});
        const double y = std::max({box.low.y - point.y, point.y - box.high.y, 0.0});
        return x * x + y * y;
    }
    static double square_between(const Box& a, const Box& b) {
        const double x = std::max({a.low.x - b.high.x, b.low.x - a.high.x, 0.0});
        const double y = std::max({a.low.y - b.high.y, b.low.y - a.high.y, 0.0});
        return x * x + y * y;
    }

    template <std::size_t count>
    void search(Group<count>& group, std::size_t node) const {
        if (counts_[node] > 0) visit(group, node);
        for (; node > 1; node /= 2) {
            const std::size_t sibling = node ^ 1U;
            if (counts_[sibling] > 0 && square_between(group.box, boxes_[sibling]) <= group.reach) {
                visit(group, sibling);
            }
        }
    }

    template <std::size_t count>
    void visit(Group<count>& group, std::size_t node) const {
        if (node >= leaves_) return compare(group, node);
        std::size_t near = 2 * node, far = 2 * node + 1;
        constexpr double nowhere = std::numeric_limits<double>::infinity();
        double to_near = counts_[near] > 0 ? square_between(group.box, boxes_[near]) : nowhere;
        double to_far = counts_[far] > 0 ? square_between(group.box, boxes_[far]) : nowhere;
        if (to_far < to_near) {
            std::swap(near, far);
            std::swap(to_near, to_far);
        }
        if (counts_[near] > 0 && to_near <= group.reach) visit(group, near);
        if (counts_[far] > 0 && to_far <= group.reach) visit(group, far);
    }

    template <std::size_t count>
    void compare(Group<count>& group, std::size_t leaf) const {
        const std::size_t begin = (leaf - leaves_) * leaf_size;
        const std::size_t size = std::min(leaf_size, size_ - begin);
        const Leaf& others = entries_[leaf - leaves_];
        constexpr bool all_there = count > 1;
        double reach = 0;
        for (std::size_t i = 0; i < group.size; ++i) {
            const glm::dvec2 own(group.points.x[i], group.points.y[i]);
            const std::uint32_t owner = group.points.owner[i];
            auto& squares = group.squares[i];
            auto& found = group.found[i];
            if (square_from(own, boxes_[leaf]) > squares[count - 1]) {
                reach = std::max(reach, squares[count - 1]);
                continue;
            }
            std::array<double, leaf_size> to_others;
            for (std::size_t k = 0; k < leaf_size; ++k) {
                const double x = others.x[k] - own.x, y = others.y[k] - own.y;
                to_others[k] = x * x + y * y;
            }
            for (std::size_t other = 0; other < size; ++other) {
                const std::size_t at = begin + other;
                const double square = to_others[other];
                if (square > squares[count - 1] || others.owner[other] == owner) continue;
                if (!all_there && is_there_[ids_[at]] == 0) continue;
                const auto before = [&](std::size_t k) {
                    if (square != squares[k]) return square < squares[k];
                    return found[k] == none ||
                           others.rank[other] < entries_[found[k] / leaf_size].rank[found[k] % leaf_size];
                };
                if (!before(count - 1)) continue;
                std::size_t k = count - 1;
                for (; k > 0 && before(k - 1); --k) {
                    squares[k] = squares[k - 1];
                    found[k] = found[k - 1];
                }
                squares[k] = square;
                found[k] = static_cast<std::uint32_t>(at);
            }
            reach = std::max(reach, squares[count - 1]);
        }
        group.reach = reach;
    }

    std::size_t leaves_ = 1;
    std::vector<std::uint32_t> ids_;     // by place
    std::vector<std::uint32_t> places_;  // by index
    std::vector<char> is_there_;         // by index
    std::size_t size_ = 0;
    std::vector<Leaf> entries_;         // by place
    std::vector<Box> boxes_;            // children of n are 2 n and 2 n + 1; leaves from leaves_ on
    std::vector<std::uint8_t> counts_;  // of leaves: their points; of others: their children that have points
};

}  // namespace sikku
