#include "art/plotter/plot_join.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

namespace sikku {
namespace {

using Index = std::uint32_t;
constexpr Index none = PlotSegment::none;
constexpr double smooth = -0.984807753012208;  // cosine of 170 degrees between the ways out of a point
constexpr std::size_t crowd = 64;              // ends at one point that are all compared with each other

/// Chooses the segments that follow each other where several meet.
class Joiner {
public:
    Joiner(const PlotGraph& graph, const Monitor& monitor)
        : monitor_(monitor),
          graph_(graph),
          segments_(graph.segments),
          begin_(graph.points.size() + 1, 0),
          ends_(2 * segments_.size()),
          partner_(ends_.size(), none) {
        Pulse pulse(monitor_);
        for (const PlotSegment& segment : segments_) {
            pulse();
            ++begin_[segment.from];
            ++begin_[segment.to];
        }
        Index sum = 0;
        for (Index& place : begin_) sum += std::exchange(place, sum);
        for (PlotEnd end = 0; end < ends_.size(); ++end) {
            pulse();
            ends_[begin_[end % 2 == 0 ? segments_[end / 2].from : segments_[end / 2].to]++] = end;
        }
        std::copy_backward(begin_.begin(), begin_.end() - 1, begin_.end());
        begin_[0] = 0;
    }

    /// Joins segments first at each point by itself, then trails that only cross or touch.
    void join() {
        for_each_node(2, [this] { pair_here(); });
        find_trails();
        for_each_node(3, [this] { merge_here(); });
    }

    PlotStrokes strokes() const {
        PlotStrokes result;
        std::vector<std::pair<Index, PlotStroke>> found;  // with their first segments
        for_each_trail([&](PlotEnd start, bool closed) {
            const auto begin = static_cast<Index>(result.order.size());
            Index first = none;
            follow(start, [&](PlotEnd end) {
                result.order.push_back(end);
                first = std::min(first, end / 2);
            });
            found.push_back({first, {begin, static_cast<Index>(result.order.size()) - begin, closed}});
        });
        std::sort(found.begin(), found.end(),
                  stoppable(monitor_, [](const auto& a, const auto& b) { return a.first < b.first; }));
        for (const auto& [first, stroke] : found) result.strokes.push_back(stroke);
        return result;
    }

private:
    /// An end at the current point.
    struct Spoke {
        PlotEnd end;
        glm::dvec2 direction;
    };
    /// Two spokes that follow each other, by their place in spokes_; `second` may be missing.
    struct Joint {
        std::size_t first, second;
    };
    static constexpr std::size_t missing = std::numeric_limits<std::size_t>::max();

    /// Calls visit() with the spokes of each point that has at least this many, sorted by their ends.
    template <class Visit>
    void for_each_node(std::size_t least, const Visit& visit) {
        Pulse pulse(monitor_);
        for (std::size_t node = 0; node + 1 < begin_.size(); ++node) {
            pulse();
            const auto ends = std::span(ends_).subspan(begin_[node], begin_[node + 1] - begin_[node]);
            if (ends.size() < least) continue;
            spokes_.clear();
            for (const PlotEnd end : ends) {
                spokes_.push_back({end, ends.size() > 2 ? graph_.direction(end) : glm::dvec2(0.0)});
            }
            visit();
        }
    }

    /// Cosine between the ways out: -1 is straight on.
    double turn(const Joint& joint) const {
        if (joint.second == missing) return 0.0;
        return glm::dot(spokes_[joint.first].direction, spokes_[joint.second].direction);
    }
    bool is_curve(std::size_t spoke) const {
        return spoke != missing && segments_[spokes_[spoke].end / 2].is_curve();
    }

    void connect(const Joint& joint) {
        const PlotEnd first = spokes_[joint.first].end;
        const PlotEnd second = joint.second == missing ? none : spokes_[joint.second].end;
        partner_[first] = second;
        if (second != none) partner_[second] = first;
    }

    void pair_here() {
        const std::size_t count = spokes_.size();
        if (count == 2) return connect({0, 1});
        if (count > crowd) {
            // Pairs opposite spokes.
            std::stable_sort(spokes_.begin(), spokes_.end(), [](const Spoke& a, const Spoke& b) {
                return std::atan2(a.direction.y, a.direction.x) < std::atan2(b.direction.y, b.direction.x);
            });
            for (std::size_t i = 0; i < count / 2; ++i) connect({i, i + count / 2});
            return;
        }
        std::vector<std::pair<double, Joint>> possible;
        for (std::size_t i = 0; i < count; ++i) {
            for (std::size_t k = i + 1; k < count; ++k) {
                // Between two equally good joints, take the one that was drawn.
                const PlotEnd low = std::min(spokes_[i].end, spokes_[k].end);
                const bool drawn = low % 2 == 1 && std::max(spokes_[i].end, spokes_[k].end) == low + 1;
                possible.emplace_back(turn({i, k}) - (drawn ? 1e-9 : 0.0), Joint{i, k});
            }
        }
        std::stable_sort(possible.begin(), possible.end(),
                         [](const auto& a, const auto& b) { return a.first < b.first; });
        std::array<bool, crowd> taken{};
        for (const auto& [unused, joint] : possible) {
            if (taken[joint.first] || taken[joint.second]) continue;
            taken[joint.first] = taken[joint.second] = true;
            connect(joint);
        }
    }

    /// Calls visit(end) for each end of a trail at which a segment is entered.
    template <class Visit>
    void follow(PlotEnd start, const Visit& visit) const {
        Pulse pulse(monitor_);
        PlotEnd end = start;
        do {
            pulse();
            visit(end);
            end = partner_[end ^ 1U];
        } while (end != none && end != start);
    }

    /// Calls visit(first end, closed) for each trail, open ones first.
    template <class Visit>
    void for_each_trail(const Visit& visit) const {
        std::vector<bool> seen(segments_.size());
        const auto take = [&](PlotEnd start, bool closed) {
            if (seen[start / 2]) return;
            follow(start, [&](PlotEnd end) { seen[end / 2] = true; });
            visit(start, closed);
        };
        Pulse pulse(monitor_);
        for (PlotEnd end = 0; end < partner_.size(); ++end) {
            pulse();
            if (partner_[end] == none) take(end, false);
        }
        for (PlotEnd end = 0; end < partner_.size(); end += 2) {
            pulse();
            take(end, true);
        }
    }

    void find_trails() {
        trail_.resize(segments_.size());
        for_each_trail([&](PlotEnd start, bool closed) {
            const auto trail = static_cast<Index>(trails_.size());
            trails_.push_back({trail, closed});
            follow(start, [&](PlotEnd end) { trail_[end / 2] = trail; });
        });
    }
    struct Trail {
        Index into;  // the trail that it was merged into, or itself
        bool closed;
    };
    Index trail_of(const Joint& joint) {
        Index trail = trail_[spokes_[joint.first].end / 2];
        while (trails_[trail].into != trail) {
            trails_[trail].into = trails_[trails_[trail].into].into;
            trail = trails_[trail].into;
        }
        return trail;
    }

    /// Exchanging the partners of two joints merges a closed trail with any other one. Afterwards closed trails of
    /// straight lines do not meet others here. Once is enough for each point: trails only grow.
    void merge_here() {
        joints_.clear();
        for (std::size_t i = 0; i < spokes_.size(); ++i) {
            const PlotEnd partner = partner_[spokes_[i].end];
            std::size_t k = missing;
            if (partner != none) {
                const auto found = std::lower_bound(spokes_.begin(), spokes_.end(), partner,
                                                    [](const Spoke& spoke, PlotEnd end) { return spoke.end < end; });
                k = static_cast<std::size_t>(found - spokes_.begin());
            }
            if (k == missing || i < k) joints_.push_back({i, k});
        }
        for (std::size_t i = 1; i < joints_.size(); ++i) {
            while (merge(i)) {
            }
        }
    }

    /// Merges the trail of joint i with that of an earlier joint, with the least turn.
    bool merge(std::size_t i) {
        const Index trail = trail_of(joints_[i]);
        double least = std::numeric_limits<double>::infinity();
        std::size_t with = missing;
        std::pair<Joint, Joint> best;
        for (std::size_t k = spokes_.size() > crowd ? i - 1 : 0; k < i; ++k) {
            const Index other = trail_of(joints_[k]);
            if (other == trail || !(trails_[other].closed || trails_[trail].closed)) continue;
            const auto [a, b] = joints_[i];
            const auto [c, d] = joints_[k];
            for (const auto& [second, fourth] : {std::pair{c, d}, std::pair{d, c}}) {
                // Missing spokes come second.
                Joint one{a, second};
                Joint two{b, fourth};
                if (two.first == missing) std::swap(two.first, two.second);
                if (bends(one) + bends(two) > bends(joints_[i]) + bends(joints_[k]) &&
                    (is_curve(a) || is_curve(b) || is_curve(c) || is_curve(d))) {
                    continue;
                }
                const double turns = turn(one) + turn(two) - turn(joints_[k]);
                if (turns < least) {
                    least = turns;
                    with = k;
                    best = {one, two};
                }
            }
        }
        if (with == missing) return false;
        const Index other = trail_of(joints_[with]);
        trails_[other].closed = trails_[other].closed && trails_[trail].closed;
        trails_[trail].into = other;
        std::tie(joints_[i], joints_[with]) = best;
        connect(best.first);
        connect(best.second);
        return true;
    }
    int bends(const Joint& joint) const { return joint.second != missing && turn(joint) > smooth ? 1 : 0; }

    const Monitor& monitor_;
    const PlotGraph& graph_;
    const std::vector<PlotSegment>& segments_;
    std::vector<Index> begin_;      // begin of the ends at each node
    std::vector<PlotEnd> ends_;     // by node
    std::vector<PlotEnd> partner_;  // the end that each end is joined with, or none
    std::vector<Index> trail_;      // trail of each segment
    std::vector<Trail> trails_;
    std::vector<Spoke> spokes_;  // spokes of the current node
    std::vector<Joint> joints_;
};

}  // namespace

PlotStrokes join_segments(const PlotGraph& graph, const Monitor& monitor) {
    Joiner joiner(graph, monitor);
    joiner.join();
    return joiner.strokes();
}

double bezier_length(const CubicBezier& b) {
    // Gauss's rule with five points on each half.
    constexpr std::array<double, 5> place = {0.0, -0.538469310105683, 0.538469310105683, -0.906179845938664,
                                             0.906179845938664};
    constexpr std::array<double, 5> weight = {0.568888888888889, 0.478628670499366, 0.478628670499366,
                                              0.236926885056189, 0.236926885056189};
    double sum = 0;
    for (const double middle : {0.25, 0.75}) {
        for (std::size_t i = 0; i < 5; ++i) {
            const double t = middle + 0.25 * place[i];
            const double s = 1 - t;
            sum += weight[i] * glm::length(s * s * (b[1] - b[0]) + 2 * s * t * (b[2] - b[1]) + t * t * (b[3] - b[2]));
        }
    }
    return 3 * 0.25 * sum;
}

CubicBezier PlotGraph::bezier(PlotEnd end) const {
    const PlotSegment& segment = segments[end / 2];
    const PlotSegment s = end % 2 == 0 ? segment : segment.backwards();
    return {points[s.from], points[s.first], points[s.second], points[s.to]};
}

double PlotGraph::length(PlotEnd end) const {
    return segments[end / 2].is_curve() ? bezier_length(bezier(end)) : glm::distance(point(end), point(end ^ 1U));
}

glm::dvec2 PlotGraph::direction(PlotEnd end) const {
    if (segments[end / 2].is_curve()) {
        const CubicBezier b = bezier(end);
        for (const glm::dvec2 control : {b[1], b[2]}) {
            if (control != b[0]) return glm::normalize(control - b[0]);
        }
    }
    const glm::dvec2 way = point(end ^ 1U) - point(end);
    return way == glm::dvec2(0.0) ? way : glm::normalize(way);
}

}  // namespace sikku
