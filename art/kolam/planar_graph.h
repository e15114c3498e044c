// art/kolam/planar_graph.h: represents a drawing as a planar graph, with vertices where lines meet.
#pragma once

#include "art/kolam/kolam.h"
#include "art/kolam/segment_grid.h"
#include "art/kolam/strokes.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace sikku::kolam_plane {

/// Polls both the watch function and the monitor, at the end of a stage.
inline void breathe(const KolamOptions& options) {
    options.monitor.check();
    if (options.watch) options.watch(0);
}

/// std::sort() that can be stopped.
template <class Range, class Less = std::less<>>
void sort(const KolamOptions& options, Range& range, Less less = {}) {
    std::sort(range.begin(), range.end(), stoppable(options.monitor, less));
}

/// Half-edge 2e runs along edge e in the direction of its segment, half-edge 2e+1 the other way. Each vertex is the
/// tail of the half-edges around it.
struct PlanarGraph {
    bool is_exact = false;
    double turn = 0.0;                        ///< a full turn, in the unit of directions
    double rounding = 0.0;                    ///< upper bound of the error of coordinates
    std::span<const glm::dvec2> node_places;  ///< positions of nodes in the plane, which must outlive the graph

    std::vector<Segment> segments;    ///< sorted by nodes
    std::optional<SegmentGrid> grid;  ///< grid over the segments

    std::vector<glm::dvec2> places;                              ///< positions of vertices
    std::vector<std::uint32_t> node;                             ///< node of each vertex, or none
    std::vector<std::pair<std::uint32_t, std::uint32_t>> edges;  ///< vertices, in the direction of the segment
    std::vector<std::uint32_t> edge_segment;
    std::vector<std::uint32_t> piece_begins;  ///< first index of each segment in piece_half
    std::vector<std::uint32_t> piece_half;    ///< half-edges along each segment
    std::vector<std::uint32_t> around_begins;
    std::vector<std::uint32_t> around_half;  ///< half-edges sorted by tail, anticlockwise
    std::vector<std::uint32_t> rank;         ///< index of each half-edge in around_half

    bool same_direction(double a, double b) const {
        return is_exact ? a == b : std::fabs(std::remainder(a - b, turn)) <= steps_are_one;
    }
    std::uint32_t edge_count() const { return static_cast<std::uint32_t>(edges.size()); }
    std::uint32_t tail(std::uint32_t half) const {
        return half % 2 == 0 ? edges[half / 2].first : edges[half / 2].second;
    }
    std::uint32_t head(std::uint32_t half) const { return tail(half ^ 1); }
    double direction(std::uint32_t half) const {
        const double along = segments[edge_segment[half / 2]].direction;
        return half % 2 == 0 ? along : reversed(along);
    }
    double reversed(double direction) const {
        const double turned = direction + turn / 2;
        return turned >= turn ? turned - turn : turned;
    }
    bool are_opposite(std::uint32_t a, std::uint32_t b) const {
        return same_direction(direction(a), reversed(direction(b)));
    }
    /// True if the lines of two half-edges meet at that angle, a part of a full turn.
    bool are_at(std::uint32_t a, std::uint32_t b, double angle) const {
        const auto is_at = [&](double way) {
            const double turned = std::fmod(direction(a) + way, turn);
            return same_direction(turned, direction(b)) || same_direction(reversed(turned), direction(b));
        };
        return is_at(angle) || is_at(turn - angle);
    }
    std::span<const std::uint32_t> around(std::uint32_t vertex) const {
        return {around_half.data() + around_begins[vertex], around_begins[vertex + 1] - around_begins[vertex]};
    }
    /// The half-edge that continues `half` straight beyond its tail; or none.
    std::uint32_t behind(std::uint32_t half) const {
        const auto list = around(tail(half));
        const double wanted = reversed(direction(half));
        const double margin = is_exact ? 0.5 : steps_are_one;
        auto found = std::lower_bound(list.begin(), list.end(), wanted - margin,
                                      [this](std::uint32_t a, double value) { return direction(a) < value; });
        if (found == list.end()) found = list.begin();
        return same_direction(direction(*found), wanted) ? *found : none;
    }
    /// The next half-edge along the face on the left.
    std::uint32_t next(std::uint32_t half) const {
        const auto list = around(head(half));
        const std::uint32_t back = rank[half ^ 1];
        return list[back == 0 ? list.size() - 1 : back - 1];
    }
    std::uint32_t segment_between(std::uint32_t a, std::uint32_t b) const {
        const std::pair<std::uint32_t, std::uint32_t> key = std::minmax(a, b);
        return static_cast<std::uint32_t>(std::lower_bound(segments.begin(), segments.end(), key,
                                                           [](const Segment& segment, const auto& wanted) {
                                                               return std::pair(segment.from, segment.to) < wanted;
                                                           }) -
                                          segments.begin());
    }
    /// The half-edges along a segment, in its direction.
    std::span<const std::uint32_t> pieces(std::uint32_t segment) const {
        return {piece_half.data() + piece_begins[segment], piece_begins[segment + 1] - piece_begins[segment]};
    }
};

/// Builds the graph of all strokes. Plane is ExactPlane or RoughPlane.
/// @throws BudgetError
template <class Plane>
PlanarGraph make_graph(const Plane& plane, const Strokes& strokes, const KolamOptions& options);

}  // namespace sikku::kolam_plane
