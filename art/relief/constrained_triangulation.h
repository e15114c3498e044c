// art/relief/constrained_triangulation.h: a constrained Delaunay triangulation of points in whole micrometres.
#pragma once

#include "art/print/micrometres.h"
#include "art/relief/most_triangles.h"
#include "art/relief/windings.h"
#include "engine/base/monitor.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

namespace sikku {

/// Triangles whose edges carry windings. Edges that cross are divided where they cross, at the nearest whole
/// micrometre, and edges that pass near a point are led through it; since outlines stay closed, the windings of the
/// triangles stay consistent however little the edges move. All decisions are exact. y grows upwards. Debian does not
/// contain a library for this that the web build could also use: CGAL needs GMP and has another licence. Source:
/// Lawson 1977 (flips); Sloan 1993, "A fast algorithm for generating constrained Delaunay triangulations".
class ConstrainedTriangulation {
public:
    using Point = std::uint32_t;
    static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();
    static constexpr std::int32_t largest_coordinate = 1 << 28;
    /// A point gives two triangles of a face and, at a wall, two of the wall.
    static constexpr std::size_t most_points = most_relief_triangles / 4;
    /// Maximum number of flips that clear the way for edges: long edges that cross very many would take hours.
    static constexpr std::size_t most_turns = 4 * most_points;

    /// The three corners run anticlockwise; edge i leads from corner i to the next one.
    struct Triangle {
        std::array<Point, 3> corners{none, none, none};
        std::array<std::uint32_t, 3> neighbours{none, none, none};  ///< beyond each edge
        std::array<Windings::Id, 3>
            windings{};  ///< windings of each edge, inside minus outside; 0: not an edge of an outline
    };

    /// @param low,high  a box with all points in its interior
    /// @param tolerance  edges are led through points nearer than this, in micrometres
    ConstrainedTriangulation(Micrometres low, Micrometres high, double tolerance, Windings& windings,
                             const Monitor& monitor);

    /// Adds a point, or finds it. Cost: constant if the last one was near. @throws BudgetError beyond most_points
    Point add(Micrometres point);
    /// Adds an edge with the windings of its left minus those of its right. Cost: proportional to the triangles that
    /// it crosses; each crossing adds a point. @throws BudgetError beyond most_points or most_turns
    void connect(Point from, Point to, Windings::Id winding);

    const std::vector<Micrometres>& points() const { return points_; }
    const std::vector<Triangle>& triangles() const { return triangles_; }

private:
    struct Place {
        std::uint32_t triangle = 0;
        std::optional<int> corner, edge;  ///< the corner or edge on which it lies
    };
    struct Edge {
        std::uint32_t triangle = 0;
        int number = 0;
    };
    struct Piece {
        Point from, to;
        Windings::Id winding;
    };
    using Pair = std::pair<Point, Point>;

    /// Positive if `point` lies on the left.
    std::int64_t side(Point from, Point to, Micrometres point) const;
    std::int64_t side(Point from, Point to, Point point) const { return side(from, to, points_[point]); }
    bool is_in_circle(Point a, Point b, Point c, Point point) const;
    bool is_near(Point from, Point to, Point point) const;
    Place locate(Micrometres point);
    void place(std::uint32_t triangle, const Triangle& contents);
    void relink(std::uint32_t triangle, std::uint32_t from, std::uint32_t to);
    int edge_towards(std::uint32_t triangle, std::uint32_t neighbour) const;
    int corner_of(std::uint32_t triangle, Point point) const;
    void divide_triangle(std::uint32_t triangle, Point point);
    void divide_edge(Edge edge, Point point);
    void legalise();
    void flip(Edge edge);
    std::optional<Edge> find(Point from, Point to) const;
    void add_winding(Edge edge, Windings::Id winding);
    void trace(const Piece& piece);
    std::optional<Edge> first_crossing(const Piece& piece);
    void pass_through(const Piece& piece, Point point);
    void cross(const Piece& piece, Edge edge);
    void clear_way(const Piece& piece, const std::vector<Pair>& crossed);
    void improve(std::vector<Pair>& made, const Piece& piece);

    std::vector<Micrometres> points_;
    std::vector<std::uint32_t> triangle_of_;  ///< one of the triangles around each point
    std::vector<Triangle> triangles_;
    std::vector<std::uint32_t> unsettled_;  ///< triangles whose edge 0 may have to be flipped
    std::vector<Piece> pending_;
    double tolerance_;
    Windings& windings_;
    Pulse pulse_;
    std::size_t turns_ = 0;
    std::uint32_t last_ = 0;    ///< triangle of the last point
    std::uint32_t random_ = 1;  ///< state of random choices, which keep walks from circling
};

}  // namespace sikku
