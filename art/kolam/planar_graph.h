// art/kolam/planar_graph.h: a drawing as a graph in the plane: vertices where lines meet, edges between them.
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

/// Polls both ways to stop an examination: for the ends of stages.
inline void breathe(const KolamOptions& options) {
    options.monitor.check();
    if (options.watch) options.watch(0);
}

/// std::sort() that can be stopped.
template <class Range, class Less = std::less<>>
void sort(const KolamOptions& options, Range& range, Less less = {}) {
    std::sort(range.begin(), range.end(), stoppable(options.monitor, less));
}

/// Half-edges 2e and 2e+1 run along edge e, the one as its segment does, the other back. Each vertex is the tail of
/// the half-edges around it.
struct PlanarGraph {
    bool is_exact = false;
    double turn = 0.0;                        ///< a full turn, in the unit of directions
    double rounding = 0.0;                    ///< how far coordinates may be off, with a margin
    std::span<const glm::dvec2> node_places;  ///< of the plane, which must outlive the graph

    std::vector<Segment> segments;    ///< by nodes
    std::optional<SegmentGrid> grid;  ///< over the segments

    std::vector<glm::dvec2> places;                              ///< of vertices
    std::vector<std::uint32_t> node;                             ///< of a vertex, or none
    std::vector<std::pair<std::uint32_t, std::uint32_t>> edges;  ///< vertices, as the edge's segment runs
    std::vector<std::uint32_t> edge_segment;
    std::vector<std::uint32_t> piece_begins;  ///< for each segment, into piece_half
    std::vector<std::uint32_t> piece_half;    ///< along the segment
    std::vector<std::uint32_t> around_begins;
    std::vector<std::uint32_t> around_half;  ///< half-edges by the vertex that they leave, anticlockwise
    std::vector<std::uint32_t> rank;         ///< of a half-edge among those

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
    bool are_perpendicular(std::uint32_t a, std::uint32_t b) const {
        const double first = std::fmod(direction(a) + turn / 4, turn);
        return same_direction(first, direction(b)) || same_direction(reversed(first), direction(b));
    }
    std::span<const std::uint32_t> around(std::uint32_t vertex) const {
        return {around_half.data() + around_begins[vertex], around_begins[vertex + 1] - around_begins[vertex]};
    }
    /// The half-edge that goes on straight behind the tail of `half`; or none.
    std::uint32_t behind(std::uint32_t half) const {
        const auto list = around(tail(half));
        const double wanted = reversed(direction(half));
        const double margin = is_exact ? 0.5 : steps_are_one;
        auto found = std::lower_bound(list.begin(), list.end(), wanted - margin,
                                      [this](std::uint32_t a, double value) { return direction(a) < value; });
        if (found == list.end()) found = list.begin();
        return same_direction(direction(*found), wanted) ? *found : none;
    }
    /// The half-edge that follows with the same face on its left.
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
    /// The half-edges of a segment, in its direction.
    std::span<const std::uint32_t> pieces(std::uint32_t segment) const {
        return {piece_half.data() + piece_begins[segment], piece_begins[segment + 1] - piece_begins[segment]};
    }
};

/// Finds the graph of all that is drawn. Plane is ExactPlane or RoughPlane.
/// @throws BudgetError
template <class Plane>
PlanarGraph make_graph(const Plane& plane, const Strokes& strokes, const KolamOptions& options);

}  // namespace sikku::kolam_plane
