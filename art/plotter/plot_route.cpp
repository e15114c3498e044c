#include "art/plotter/plot_route.h"

#include "engine/geometry/point_tree.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

namespace sikku {
namespace {

/// Strokes in the order in which they are drawn, each by the end at which it is entered: 2 i, or 2 i + 1 for the
/// other way round.
class PlotRoute {
public:
    /// @param points  ends of the strokes, two each
    /// @param start   position of the pen before the first one
    PlotRoute(std::vector<glm::dvec2> points, std::vector<PlotEnd> order, glm::dvec2 start)
        : points_(std::move(points)), order_(std::move(order)), place_(order_.size()), start_(start) {
        for (std::uint32_t i = 0; i < order_.size(); ++i) place_[order_[i] / 2] = i;
    }

    /// Length of all travel between the strokes.
    double length() const {
        double sum = 0;
        for (std::uint32_t i = 0; i < order_.size(); ++i) sum += glm::distance(leave(i), points_[order_[i]]);
        return sum;
    }

    /// 2-opt: travels a → b and c → d become a → c and b → d, and the strokes between them are reversed, as long as
    /// that shortens them, in at most 10 passes. Examines only c near a, or d near b.
    void improve(const Monitor& monitor) {
        const PointTree tree(points_, monitor);
        // Long ranges are reversed only if there are few strokes, so that this stays fast.
        const std::size_t longest = std::max<std::size_t>(1000, 3'000'000'000 / (order_.size() + 1));
        std::vector<bool> settled(order_.size());
        std::vector<PointTree::Near> near;
        for (int pass = 0; pass < 10; ++pass) {
            bool changed = false;
            for (std::uint32_t i = 0; i < order_.size(); ++i) {
                if (settled[order_[i] / 2]) continue;
                monitor.check();
                const Change best = best_change(i, tree, near, longest);
                if (best.gain <= 0) {
                    settled[order_[i] / 2] = true;
                    continue;
                }
                changed = true;
                for (const std::uint32_t k : {best.first, best.last, best.last + 1}) {
                    if (k < order_.size()) settled[order_[k] / 2] = false;
                }
                turn_round(best.first, best.last);
            }
            if (!changed) break;
        }
    }

    const std::vector<PlotEnd>& order() const { return order_; }

private:
    struct Change {
        double gain = 0;
        std::uint32_t first = 0, last = 0;  // the range that is reversed
    };

    /// Position of the pen before it travels to the i-th stroke.
    glm::dvec2 leave(std::uint32_t i) const { return i == 0 ? start_ : points_[order_[i - 1] ^ 1U]; }
    Change best_change(std::uint32_t i, const PointTree& tree, std::vector<PointTree::Near>& near,
                       std::size_t longest) const {
        constexpr std::size_t neighbours = 10;
        Change best;
        const double way = glm::distance(leave(i), points_[order_[i]]);
        // A change that gains has a new travel that is shorter than one it replaces, at the same end.
        const auto consider = [&](std::uint32_t k) {  // travels to stroke i and to stroke k
            if (i == k || std::max(i, k) - std::min(i, k) > longest) return;
            const std::uint32_t first = std::min(i, k);
            const std::uint32_t last = std::max(i, k);
            double gain = way - glm::distance(leave(first), leave(last));
            if (k < order_.size()) gain += glm::distance(leave(k), points_[order_[k]]);
            if (last < order_.size()) gain -= glm::distance(points_[order_[first]], points_[order_[last]]);
            // Smaller gains are rounding errors.
            if (gain > best.gain + 1e-9 * way) best = {gain, first, last - 1};
        };
        tree.nearest(leave(i), way, neighbours, near);
        for (const auto& [distance, end] : near) {
            const std::uint32_t place = place_[end / 2];
            if (order_[place] == (end ^ 1U)) consider(place + 1);
        }
        tree.nearest(points_[order_[i]], way, neighbours, near);
        for (const auto& [distance, end] : near) {
            const std::uint32_t place = place_[end / 2];
            if (order_[place] == end) consider(place);
        }
        return best;
    }
    void turn_round(std::uint32_t first, std::uint32_t last) {
        std::reverse(order_.begin() + first, order_.begin() + last + 1);
        for (std::uint32_t i = first; i <= last; ++i) {
            order_[i] ^= 1U;
            place_[order_[i] / 2] = i;
        }
    }

    std::vector<glm::dvec2> points_;
    std::vector<PlotEnd> order_;
    std::vector<std::uint32_t> place_;  // place of each stroke in the order
    glm::dvec2 start_;
};

}  // namespace

PlotStrokes sort_strokes(const PlotGraph& graph, const PlotStrokes& given, glm::dvec2 start, double drawn,
                         const Monitor& monitor) {
    const std::vector<PlotStroke>& strokes = given.strokes;
    // Points where each stroke may begin: its two ends, or anywhere if it is closed.
    std::vector<glm::dvec2> entries;
    std::vector<std::uint32_t> stroke_of;
    std::vector<std::uint32_t> first_entry;
    Pulse pulse(monitor);
    for (std::uint32_t i = 0; i < strokes.size(); ++i) {
        pulse();
        first_entry.push_back(static_cast<std::uint32_t>(entries.size()));
        const auto in_order = given.ends(strokes[i]);
        if (strokes[i].closed) {
            for (const PlotEnd end : in_order) {
                pulse();
                entries.push_back(graph.point(end));
            }
        } else {
            entries.push_back(graph.point(in_order.front()));
            entries.push_back(graph.point(in_order.back() ^ 1U));
        }
        stroke_of.resize(entries.size(), i);
    }
    first_entry.push_back(static_cast<std::uint32_t>(entries.size()));

    // Always goes to the nearest stroke.
    std::vector<glm::dvec2> points(2 * strokes.size());
    std::vector<PlotEnd> nearest_first;
    std::vector<PlotEnd> as_drawn;
    std::vector<std::uint32_t> begin(strokes.size());  // of closed strokes: the segment at which they begin
    PointTree tree(entries, monitor);
    std::vector<PointTree::Near> near;
    glm::dvec2 here = start;
    for (std::size_t done = 0; done < strokes.size(); ++done) {
        tree.nearest(here, std::numeric_limits<double>::infinity(), 1, near);
        const std::uint32_t entry = near.front().id;
        const std::uint32_t i = stroke_of[entry];
        const std::uint32_t which = entry - first_entry[i];
        for (std::uint32_t k = first_entry[i]; k < first_entry[i + 1]; ++k) {
            pulse();
            tree.remove(k);
        }
        if (strokes[i].closed) {
            begin[i] = which;
            points[2 * i] = points[2 * i + 1] = entries[entry];
            nearest_first.push_back(2 * i);
        } else {
            points[2 * i] = entries[first_entry[i]];
            points[2 * i + 1] = entries[first_entry[i] + 1];
            nearest_first.push_back(2 * i + which);
        }
        here = points[nearest_first.back() ^ 1U];
    }
    PlotRoute route(points, std::move(nearest_first), start);
    route.improve(monitor);
    if (route.length() > drawn) {
        for (std::uint32_t i = 0; i < strokes.size(); ++i) as_drawn.push_back(2 * i);
        PlotRoute other(points, std::move(as_drawn), start);
        other.improve(monitor);
        if (other.length() < route.length()) route = std::move(other);
    }

    PlotStrokes result;
    std::vector<PlotEnd>& order = result.order;
    order.reserve(given.order.size());
    for (std::size_t at = 0; at < strokes.size(); ++at) {
        pulse();
        const PlotEnd enter = route.order()[at];
        const PlotStroke& stroke = strokes[enter / 2];
        const auto in_order = given.ends(stroke);
        result.strokes.push_back({static_cast<std::uint32_t>(order.size()), stroke.count, stroke.closed});
        if (stroke.closed) {
            // Finds a better beginning, now that the next stroke is known.
            const glm::dvec2 from = at == 0 ? start : points[route.order()[at - 1] ^ 1U];
            const auto detour = [&](std::uint32_t k) {
                const glm::dvec2 way = graph.point(in_order[k]);
                const bool is_last = at + 1 == strokes.size();
                return glm::distance(from, way) + (is_last ? 0.0 : glm::distance(way, points[route.order()[at + 1]]));
            };
            std::uint32_t best = begin[enter / 2];
            double least = detour(best);
            for (std::uint32_t k = 0; k < stroke.count; ++k) {
                pulse();
                if (const double length = detour(k); length < least) {
                    least = length;
                    best = k;
                }
            }
            points[enter] = points[enter ^ 1U] = graph.point(in_order[best]);
            order.insert(order.end(), in_order.begin() + best, in_order.end());
            order.insert(order.end(), in_order.begin(), in_order.begin() + best);
        } else if (enter % 2 == 0) {
            order.insert(order.end(), in_order.begin(), in_order.end());
        } else {
            for (std::size_t k = in_order.size(); k-- > 0;) order.push_back(in_order[k] ^ 1U);
        }
    }
    return result;
}

}  // namespace sikku
