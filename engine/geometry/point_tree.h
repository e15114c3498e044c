// engine/geometry/point_tree.h: finds the nearest of many points; points can be removed.
#pragma once

#include "engine/base/monitor.h"
#include "engine/geometry/box.h"

#include <glm/vec2.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

namespace sikku {

/// A k-d tree over points of the plane, which are identified by their index. Memory: about 24 bytes a point.
/// Source: Bentley, Multidimensional binary search trees used for associative searching, 1975.
class PointTree {
public:
    struct Near {
        double square;  ///< of the distance
        std::uint32_t id;
    };

    /// Cost: O(n log n).
    explicit PointTree(std::span<const glm::dvec2> points, const Monitor& monitor = {}) : place_(points.size()) {
        std::vector<std::uint32_t> ids(points.size());
        std::iota(ids.begin(), ids.end(), 0U);
        while (leaf_size * leaves_ < points.size()) leaves_ *= 2;
        nodes_.resize(2 * leaves_);
        build(1, points, ids, monitor);
        for (std::uint32_t i = 0; i < ids.size(); ++i) {
            entries_.push_back({points[ids[i]], ids[i], true});
            place_[ids[i]] = i;
        }
    }

    /// Removes a point that is in the tree. Cost: O(log n).
    void remove(std::uint32_t id) {
        const std::uint32_t place = place_[id];
        entries_[place].there = false;
        std::size_t low = 0;
        std::size_t high = entries_.size();
        for (std::size_t node = 1;;) {
            --nodes_[node].count;
            if (node >= leaves_) return;
            const std::size_t middle = (low + high) / 2;
            node = 2 * node + (place < middle ? 0 : 1);
            (place < middle ? high : low) = middle;
        }
    }

    /// Up to `most` points within `radius` of `centre`, the nearest first.
    void nearest(glm::dvec2 centre, double radius, std::size_t most, std::vector<Near>& found) const {
        found.clear();
        Search search{centre, radius * radius, most, found};
        visit(search, 1, 0, entries_.size());
    }

private:
    static constexpr std::size_t leaf_size = 8;
    struct Node {
        double split = 0;
        std::uint32_t count = 0;  // of points not removed
        int axis = 0;
    };
    struct Entry {
        glm::dvec2 point;
        std::uint32_t id;
        bool there;
    };
    struct Search {
        glm::dvec2 centre;
        double reach;  // square of the distance within which a point counts
        std::size_t most;
        std::vector<Near>& found;
    };

    void build(std::size_t node, std::span<const glm::dvec2> points, std::span<std::uint32_t> ids,
               const Monitor& monitor) {
        monitor.check();
        nodes_[node].count = static_cast<std::uint32_t>(ids.size());
        if (node >= leaves_) return;
        Box box;
        for (const std::uint32_t id : ids) box.add(points[id]);
        const int axis = box.size().x >= box.size().y ? 0 : 1;
        const std::size_t middle = ids.size() / 2;
        // Equal points are ordered by index, so that the order is the same everywhere.
        std::nth_element(ids.begin(), ids.begin() + static_cast<std::ptrdiff_t>(middle), ids.end(),
                         stoppable(monitor, [&](std::uint32_t a, std::uint32_t b) {
                             const double left = points[a][axis];
                             const double right = points[b][axis];
                             return left != right ? left < right : a < b;
                         }));
        nodes_[node].axis = axis;
        if (middle < ids.size()) nodes_[node].split = points[ids[middle]][axis];
        build(2 * node, points, ids.first(middle), monitor);
        build(2 * node + 1, points, ids.subspan(middle), monitor);
    }

    void visit(Search& search, std::size_t node, std::size_t low, std::size_t high) const {
        if (nodes_[node].count == 0) return;
        if (node >= leaves_) {
            for (std::size_t i = low; i < high; ++i) consider(search, entries_[i]);
            return;
        }
        const std::size_t middle = (low + high) / 2;
        const double beyond = search.centre[nodes_[node].axis] - nodes_[node].split;
        const bool right = beyond >= 0;
        visit(search, 2 * node + (right ? 1 : 0), right ? middle : low, right ? high : middle);
        if (beyond * beyond > search.reach) return;
        visit(search, 2 * node + (right ? 0 : 1), right ? low : middle, right ? middle : high);
    }

    static void consider(Search& search, const Entry& entry) {
        if (!entry.there) return;
        const glm::dvec2 gap = entry.point - search.centre;
        const Near near{gap.x * gap.x + gap.y * gap.y, entry.id};
        if (near.square > search.reach) return;
        const auto closer = [](const Near& a, const Near& b) {
            return a.square != b.square ? a.square < b.square : a.id < b.id;
        };
        auto& found = search.found;
        found.insert(std::upper_bound(found.begin(), found.end(), near, closer), near);
        if (found.size() > search.most) found.pop_back();
        if (found.size() == search.most) search.reach = found.back().square;
    }

    std::size_t leaves_ = 1;
    std::vector<Node> nodes_;     // children of n are 2 n and 2 n + 1; leaves from leaves_ on
    std::vector<Entry> entries_;  // by leaf
    std::vector<std::uint32_t> place_;
};

}  // namespace sikku
