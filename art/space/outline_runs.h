// art/space/outline_runs.h: the rows of samples within a polygon that may cross itself.
#pragma once

#include <glm/vec2.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

namespace sikku {

/// The ranges in which the middles of rows meet a triangle.
template <class Point, class Number = typename Point::value_type>
class TriangleRuns {
public:
    TriangleRuns(const Point& a, const Point& b, const Point& c) : edges_{Edge(a, b), Edge(b, c), Edge(c, a)} {}

    /// From and to; if the row does not meet the triangle, the first number is larger than the second.
    std::pair<Number, Number> at(Number middle) const {
        Number left = std::numeric_limits<Number>::infinity(), right = -left;
        for (const Edge& edge : edges_) {
            if ((edge.from <= middle) == (edge.to <= middle)) continue;
            const Number x = edge.x + (middle - edge.from) * edge.slope;
            left = std::min(left, x);
            right = std::max(right, x);
        }
        return {left, right};
    }

private:
    struct Edge {
        Edge(const Point& p, const Point& q) : from(p.y), to(q.y), x(p.x), slope((q.x - p.x) / (q.y - p.y)) {}
        Number from, to;  ///< y of its ends
        Number x, slope;
    };
    std::array<Edge, 3> edges_;
};

/// Calls `visit(y, from, to)` for each stretch that the outline runs around (non-zero winding rule), along the
/// middles of the rows from `first` up to `end`. @param outline  points with x and y
template <class Outline, class Visit>
void each_outline_run(const Outline& outline, int first, int end, Visit&& visit) {
    struct Edge {
        glm::dvec2 from, to;
    };
    std::vector<Edge> edges;  // edges that reach these rows
    for (std::size_t i = 0; i < outline.size(); ++i) {
        const auto& next = outline[i + 1 < outline.size() ? i + 1 : 0];
        const Edge edge{{outline[i].x, outline[i].y}, {next.x, next.y}};
        if (std::max(edge.from.y, edge.to.y) >= first && std::min(edge.from.y, edge.to.y) <= end) {
            edges.push_back(edge);
        }
    }
    std::vector<std::pair<double, int>> cuts;  // x, and 1 where the edge goes up or -1
    for (int y = first; y < end; ++y) {
        const double centre = y + 0.5;
        cuts.clear();
        for (const Edge& edge : edges) {
            if ((edge.from.y <= centre) == (edge.to.y <= centre)) continue;
            const double part = (centre - edge.from.y) / (edge.to.y - edge.from.y);
            cuts.emplace_back(edge.from.x + (edge.to.x - edge.from.x) * part, edge.from.y < edge.to.y ? 1 : -1);
        }
        std::sort(cuts.begin(), cuts.end());
        int winding = 0;
        for (std::size_t i = 0; i + 1 < cuts.size(); ++i) {
            winding += cuts[i].second;
            if (winding != 0) visit(y, cuts[i].first, cuts[i + 1].first);
        }
    }
}

}  // namespace sikku
