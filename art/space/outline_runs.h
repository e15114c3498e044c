// art/space/outline_runs.h: the rows of samples within a polygon that may cross itself.
#pragma once

#include <glm/vec2.hpp>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

namespace sikku {

/// Range in which the middle of a row meets a triangle; if it does not, the first number is larger than the second.
template <class Point, class Number = typename Point::value_type>
std::pair<Number, Number> triangle_run(const Point& a, const Point& b, const Point& c, Number middle) {
    Number left = std::numeric_limits<Number>::infinity(), right = -left;
    const auto cut = [&](const Point& p, const Point& q) {
        if ((p.y <= middle) == (q.y <= middle)) return;
        const Number x = p.x + (q.x - p.x) * ((middle - p.y) / (q.y - p.y));
        left = std::min(left, x);
        right = std::max(right, x);
    };
    cut(a, b);
    cut(b, c);
    cut(c, a);
    return {left, right};
}

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
