// tests/art/relief_plane_test.cpp: triangulations, regions and solids of reliefs, compared with slow and simple
// methods.
#include "art/relief/constrained_triangulation.h"
#include "art/relief/outlines.h"
#include "art/relief/regions.h"
#include "art/relief/solid.h"
#include "engine/base/numbers.h"
#include "tests/solid_reader.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>
#include <random>
#include <set>

namespace sikku::relief_plane_test {

std::int64_t twice_area(Micrometres a, Micrometres b, Micrometres c) {
    return std::int64_t{b.x - a.x} * (c.y - a.y) - std::int64_t{b.y - a.y} * (c.x - a.x);
}

/// A ring of corners as edges of a layer.
void add_ring(const std::vector<Micrometres>& corners, std::uint32_t layer, std::vector<LayerEdge>& edges) {
    for (std::size_t i = 0; i < corners.size(); ++i) {
        edges.push_back({corners[i], corners[(i + 1) % corners.size()], layer});
    }
}

std::int32_t covered(std::span<const Winding> windings) {
    return windings.empty() ? PlaneRegions::outside : 0;
}
std::int32_t last_layer(std::span<const Winding> windings) {
    return windings.empty() ? PlaneRegions::outside : static_cast<std::int32_t>(windings.back().layer);
}
std::int32_t same(std::int32_t region) {
    return region;
}

/// Anticlockwise triangles, neighbours of each other, without overlaps or gaps within their box.
void expect_valid(const PlaneRegions& plane) {
    std::int64_t sum = 0;
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> sides;
    for (std::uint32_t t = 0; t < plane.triangles.size(); ++t) {
        const auto& corners = plane.triangles[t].corners;
        const std::int64_t area =
            twice_area(plane.points[corners[0]], plane.points[corners[1]], plane.points[corners[2]]);
        ASSERT_GT(area, 0);
        sum += area;
        for (std::size_t i = 0; i < 3; ++i)
            ASSERT_TRUE(sides.emplace(std::pair(corners[i], corners[(i + 1) % 3]), t).second);
    }
    for (const auto& [side, t] : sides) {
        const auto beyond = sides.find({side.second, side.first});
        const auto& triangle = plane.triangles[t];
        const std::size_t i = triangle.corners[0] == side.first ? 0 : triangle.corners[1] == side.first ? 1 : 2;
        EXPECT_EQ(triangle.neighbours[i], beyond == sides.end() ? PlaneRegions::none : beyond->second);
    }
    const Micrometres low = plane.points[0], high = plane.points[2];
    EXPECT_EQ(sum, 2 * std::int64_t{high.x - low.x} * (high.y - low.y));
}

std::int64_t twice_area_of(const PlaneRegions& plane, std::int32_t region) {
    std::int64_t sum = 0;
    for (const auto& triangle : plane.triangles) {
        if (triangle.region != region) continue;
        sum += twice_area(plane.points[triangle.corners[0]], plane.points[triangle.corners[1]],
                          plane.points[triangle.corners[2]]);
    }
    return sum;
}

TEST(ConstrainedTriangulation, IsDelaunayWithoutEdges) {
    std::mt19937 random(1);
    for (const std::int32_t size : {5, 40, 1000, 200'000'000}) {
        Windings windings;
        const Monitor monitor;
        ConstrainedTriangulation plane({-size - 1, -size - 1}, {size + 1, size + 1}, 0, windings, monitor);
        std::set<std::pair<std::int32_t, std::int32_t>> places;
        for (int i = 0; i < 60; ++i) {
            const auto coordinate = [&] {
                return static_cast<std::int32_t>(random() % (2U * static_cast<unsigned>(size) + 1)) - size;
            };
            const Micrometres point{coordinate(), coordinate()};
            places.emplace(point.x, point.y);
            const auto number = plane.add(point);
            EXPECT_EQ(plane.points()[number], point);
        }
        EXPECT_EQ(plane.points().size(), places.size() + 4) << "points are added once";
        for (const auto& triangle : plane.triangles()) {
            for (const Micrometres point : plane.points()) {
                std::array<std::array<Int128, 3>, 3> rows;
                for (std::size_t i = 0; i < 3; ++i) {
                    const Micrometres corner = plane.points()[triangle.corners[i]];
                    const Int128 x = corner.x - point.x, y = corner.y - point.y;
                    rows[i] = {x, y, x * x + y * y};
                }
                const Int128 determinant = rows[0][0] * (rows[1][1] * rows[2][2] - rows[1][2] * rows[2][1]) -
                                           rows[0][1] * (rows[1][0] * rows[2][2] - rows[1][2] * rows[2][0]) +
                                           rows[0][2] * (rows[1][0] * rows[2][1] - rows[1][1] * rows[2][0]);
                EXPECT_TRUE(determinant <= 0) << "a point lies in the circle around a triangle";
            }
        }
    }
}

TEST(PlaneRegions, UnionsOfRectanglesHaveTheirExactArea) {
    std::mt19937 random(2);
    for (int round = 0; round < 40; ++round) {
        // Few different coordinates, so that many sides and corners coincide.
        const std::int32_t places = round % 2 == 0 ? 6 : 40;
        std::vector<std::vector<bool>> cells(40, std::vector<bool>(40));
        std::vector<LayerEdge> edges;
        for (int i = 0; i < 15; ++i) {
            const auto range = [&] {
                const auto a = static_cast<std::int32_t>(random() % static_cast<unsigned>(places));
                const auto b = static_cast<std::int32_t>(random() % static_cast<unsigned>(places));
                return std::minmax({a, b});
            };
            const auto [left, right] = range();
            const auto [low, high] = range();
            for (std::int32_t x = left; x < right; ++x) {
                for (std::int32_t y = low; y < high; ++y)
                    cells[static_cast<std::size_t>(x)][static_cast<std::size_t>(y)] = true;
            }
            add_ring({{100 * left, 100 * low},
                      {100 * right, 100 * low},
                      {100 * right, 100 * high},
                      {100 * left, 100 * high}},
                     0, edges);
        }
        std::int64_t area = 0;
        for (const auto& row : cells) area += 10'000 * std::count(row.begin(), row.end(), true);
        const PlaneRegions plane = divide_plane(edges, 0, covered, {});
        expect_valid(plane);
        EXPECT_EQ(twice_area_of(plane, 0), 2 * area);
        // Its outlines enclose the same area, with as few edges as possible.
        const auto outlines = outlines_of(plane, same);
        EXPECT_EQ(twice_area_of(divide_plane(outlines, 0, covered, {}), 0), 2 * area);
        std::set<std::pair<std::int32_t, std::int32_t>> starts;
        for (const LayerEdge& edge : outlines) starts.emplace(edge.from.x, edge.from.y);
        for (const LayerEdge& edge : outlines)
            EXPECT_TRUE(starts.contains({edge.to.x, edge.to.y})) << "outlines are closed";
    }
}

/// How often a ring winds around a place, by the crossings of a ray.
int winding(const std::vector<Micrometres>& ring, Micrometres point) {
    int count = 0;
    for (std::size_t i = 0; i < ring.size(); ++i) {
        const Micrometres a = ring[i], b = ring[(i + 1) % ring.size()];
        const std::int64_t side = twice_area(a, b, point);
        if (a.y <= point.y && b.y > point.y && side > 0) ++count;
        if (a.y > point.y && b.y <= point.y && side < 0) --count;
    }
    return count;
}

double distance_to(const std::vector<Micrometres>& ring, Micrometres point) {
    double least = 1e300;
    for (std::size_t i = 0; i < ring.size(); ++i) {
        const Micrometres a = ring[i], b = ring[(i + 1) % ring.size()];
        const glm::dvec2 from(a.x, a.y), along = glm::dvec2(b.x, b.y) - from,
                                         to = glm::dvec2(point.x, point.y) - from;
        const double length = glm::dot(along, along);
        const double part = length > 0 ? std::clamp(glm::dot(to, along) / length, 0.0, 1.0) : 0;
        least = std::min(least, glm::length(to - part * along));
    }
    return least;
}

/// The region of a triangle that contains a place.
std::int32_t region_at(const PlaneRegions& plane, Micrometres point) {
    for (const auto& [corners, neighbours, region] : plane.triangles) {
        bool is_inside = true;
        for (std::size_t k = 0; k < 3; ++k) {
            is_inside =
                is_inside && twice_area(plane.points[corners[k]], plane.points[corners[(k + 1) % 3]], point) >= 0;
        }
        if (is_inside) return region;
    }
    return PlaneRegions::outside;
}

TEST(PlaneRegions, PlacesBelongToTheLayersThatWindAroundThem) {
    std::mt19937 random(3);
    for (int round = 0; round < 30; ++round) {
        const unsigned size = round % 3 == 0 ? 60 : round % 3 == 1 ? 3000 : 400'000;
        const auto any = [&] {
            return Micrometres{static_cast<std::int32_t>(random() % size),
                               static_cast<std::int32_t>(random() % size)};
        };
        std::vector<std::vector<Micrometres>> rings(8);
        std::vector<LayerEdge> edges;
        for (std::uint32_t layer = 0; layer < rings.size(); ++layer) {
            for (int k = 0; k < 9; ++k) rings[layer].push_back(any());
            add_ring(rings[layer], layer, edges);
        }
        const PlaneRegions plane = divide_plane(edges, 1.5, last_layer, {});
        expect_valid(plane);
        for (int i = 0; i < 300; ++i) {
            const Micrometres point = any();
            std::int32_t expected = PlaneRegions::outside;
            double nearest = 1e300;
            for (std::size_t layer = 0; layer < rings.size(); ++layer) {
                if (winding(rings[layer], point) != 0) expected = static_cast<std::int32_t>(layer);
                nearest = std::min(nearest, distance_to(rings[layer], point));
            }
            // Edges move by a few micrometres where they cross.
            if (nearest < 6) continue;
            EXPECT_EQ(region_at(plane, point), expected);
        }
    }
}

TEST(PlaneRegions, EdgesPassThroughPointsNearby) {
    // A corner one micrometre off the side of a neighbour leaves no gap.
    std::vector<LayerEdge> edges;
    add_ring({{0, 0}, {1000, 0}, {1000, 1000}, {0, 1000}}, 0, edges);
    add_ring({{1001, 333}, {2000, 333}, {2000, 800}, {1001, 800}}, 0, edges);
    const PlaneRegions plane = divide_plane(edges, 1.5, covered, {});
    expect_valid(plane);
    EXPECT_NEAR(static_cast<double>(twice_area_of(plane, 0)) / 2, 1'000'000 + 999.5 * 467, 1000);
    EXPECT_EQ(outlines_of(plane, same).size(), 8u) << "one outline";
}

TEST(PlaneRegions, KeepsOutlinesThatCancelOut) {
    std::vector<LayerEdge> edges;
    add_ring({{0, 0}, {10, 0}, {10, 10}, {0, 10}}, 0, edges);
    add_ring({{0, 10}, {10, 10}, {10, 0}, {0, 0}}, 0, edges);
    EXPECT_TRUE(divide_plane(edges, 0, covered, {}).triangles.empty());
    EXPECT_TRUE(divide_plane({}, 0, covered, {}).triangles.empty());
}

ReadMesh mesh_of(const Solid& solid) {
    ReadMesh mesh;
    std::map<std::tuple<std::int32_t, std::int32_t, std::int32_t>, std::uint32_t> numbers;
    solid.visit([&](std::uint32_t, const SolidTriangle& triangle) {
        auto& added = mesh.triangles.emplace_back();
        for (std::size_t i = 0; i < 3; ++i) {
            const auto [known, is_new] = numbers.emplace(std::tuple(triangle[i].x, triangle[i].y, triangle[i].z),
                                                         static_cast<std::uint32_t>(mesh.points.size()));
            if (is_new) mesh.points.emplace_back(triangle[i].x, triangle[i].y, triangle[i].z);
            added[i] = known->second;
        }
    });
    return mesh;
}

TEST(Solid, IsClosedWhereverPrismsTouch) {
    std::mt19937 random(4);
    for (int round = 0; round < 60; ++round) {
        // Squares of a grid with random heights, most of whose corners touch; without a base, there are holes.
        const bool has_base = round % 2 == 0;
        std::vector<ReliefRegion> regions;
        for (std::int32_t height = 1; height <= 4; ++height) regions.push_back({1000 * height, {}});
        std::vector<LayerEdge> edges;
        constexpr std::int32_t side = 1000, count = 7;
        double volume = 0;
        if (has_base) {
            add_ring({{-side, -side},
                      {side * (count + 1), -side},
                      {side * (count + 1), side * (count + 1)},
                      {-side, side * (count + 1)}},
                     0, edges);
            volume += 1000.0 * side * side * ((count + 2) * (count + 2) - count * count);
        }
        for (std::int32_t x = 0; x < count; ++x) {
            for (std::int32_t y = 0; y < count; ++y) {
                const auto region = static_cast<std::uint32_t>(random() % 4);
                const bool is_left_out = !has_base && random() % 3 == 0;
                volume += is_left_out ? 0 : 1000.0 * (region + 1) * side * side;
                if (is_left_out) continue;
                add_ring({{side * x, side * y},
                          {side * (x + 1), side * y},
                          {side * (x + 1), side * (y + 1)},
                          {side * x, side * (y + 1)}},
                         region, edges);
            }
        }
        const PlaneRegions plane = divide_plane(edges, 0, last_layer, {});
        const Solid solid(divide_plane(outlines_of(plane, same), 0, last_layer, {}), regions, {});
        const ReadMesh mesh = mesh_of(solid);
        ASSERT_NO_FATAL_FAILURE(expect_closed(mesh));
        EXPECT_NEAR(mesh.volume() * 1e-9, solid.volume(), 1e-6 * solid.volume());
        // Joints are small.
        EXPECT_GE(solid.volume(), volume * 1e-9 - 1e-9);
        EXPECT_LE(solid.volume(), volume * 1e-9 + count * count * 0.05 * 0.05 * 4);
    }
}

TEST(Solid, HasAHoleWhereOutlinesLeaveOne) {
    std::vector<LayerEdge> edges;
    add_ring({{0, 0}, {3000, 0}, {3000, 3000}, {0, 3000}}, 0, edges);
    add_ring({{1000, 1000}, {1000, 2000}, {2000, 2000}, {2000, 1000}}, 0, edges);
    const Solid solid(divide_plane(edges, 0, last_layer, {}), {{500, {}}}, {});
    const ReadMesh mesh = mesh_of(solid);
    expect_closed(mesh);
    EXPECT_DOUBLE_EQ(mesh.volume(), 500.0 * (9'000'000 - 1'000'000));
    EXPECT_EQ(mesh.triangles.size(), 4u * 8u) << "eight walls, eight triangles above and below";
    EXPECT_EQ(solid.size(), glm::dvec3(3, 3, 0.5));
}

double area_of(const Outlines& outlines) {
    return static_cast<double>(twice_area_of(divide_plane(outlines.edges(), 0, covered, {}), 0)) * 0.5e-6;
}

TEST(Outlines, StrokesHaveTheAreaOfTheirInk) {
    constexpr double pi = std::numbers::pi, tolerance = 0.001;
    const Monitor monitor;
    const auto area = [&](const std::vector<glm::dvec2>& points, bool is_closed, double radius) {
        Outlines outlines(tolerance, monitor);
        outlines.add_stroke(points, is_closed, radius, 0);
        return area_of(outlines);
    };
    EXPECT_NEAR(area({{0, 0}, {10, 3}}, false, 1), 2 * std::hypot(10, 3) + pi, 0.02);
    EXPECT_NEAR(area({{0, 0}, {10, 0}, {10, 7}}, false, 1), 2 * 17 - 1 + pi / 4 + pi, 0.02) << "a bend";
    EXPECT_NEAR(area({{0, 0}, {10, 0}, {3, 0}}, false, 1), 20 + pi, 0.02) << "back on itself";
    EXPECT_NEAR(area({{0, 0}, {8, 0}, {8, 8}, {0, 8}, {0, 0}}, true, 1), 4 * 8 + 64 + pi - 36, 0.02) << "a frame";
    EXPECT_NEAR(area({{0, 0}, {10, 0}, {10, 10}, {5, 10}, {5, -5}}, false, 0.5),
                40 + pi / 4 + 3 * (pi / 16 - 0.25) - 1, 0.01)
        << "a crossing";
    EXPECT_NEAR(area({{4, 4}}, false, 2), 4 * pi, 0.02) << "a dot";
    EXPECT_NEAR(area({{4, 4}, {4, 4}}, false, 2), 4 * pi, 0.02);
    // A circle of many short parts, also one that is narrower than its pen.
    for (const double size : {20.0, 3.0, 1.1, 0.7}) {
        std::vector<glm::dvec2> circle;
        for (int i = 0; i <= 360; ++i)
            circle.push_back(size * glm::dvec2(std::cos(i * pi / 180), std::sin(i * pi / 180)));
        circle.back() = circle.front();
        const double inner = std::max(0.0, size - 1);
        EXPECT_NEAR(area(circle, true, 1), pi * ((size + 1) * (size + 1) - inner * inner), 0.02 * size + 0.02);
    }
}

TEST(Outlines, PolygonsFollowTheNonZeroRule) {
    const Monitor monitor;
    const auto area = [&](const std::vector<glm::dvec2>& corners) {
        Outlines outlines(0.001, monitor);
        outlines.add_polygon(corners, 0);
        return area_of(outlines);
    };
    EXPECT_NEAR(area({{0, 0}, {0, 4}, {4, 4}, {4, 0}}), 16, 1e-6) << "clockwise";
    EXPECT_NEAR(area({{0, 0}, {4, 4}, {4, 0}, {0, 4}}), 8, 1e-6) << "like a bow tie";
    EXPECT_NEAR(area({{0, 0}, {4, 0}, {4, 4}, {0, 4}, {0, 0}, {4, 0}, {4, 4}, {0, 4}}), 16, 1e-6) << "twice around";
    EXPECT_NEAR(area({{0, 0}, {4, 0}}), 0, 0);
    // Opposite windings of two polygons do not cancel.
    Outlines outlines(0.001, monitor);
    outlines.add_polygon(std::vector<glm::dvec2>{{0, 0}, {4, 4}, {4, 0}, {0, 4}}, 0);
    outlines.add_polygon(std::vector<glm::dvec2>{{0, 0}, {4, 0}, {4, 4}, {0, 4}}, 0);
    EXPECT_NEAR(area_of(outlines), 16, 1e-6);
}

TEST(Outlines, PolygonsShrink) {
    const Monitor monitor;
    const auto area = [&](const std::vector<glm::dvec2>& corners, double distance) {
        Outlines outlines(0.001, monitor);
        const bool is_left = outlines.add_inside(corners, distance, 0);
        EXPECT_EQ(is_left, !outlines.edges().empty());
        return is_left ? area_of(outlines) : 0;
    };
    const std::vector<glm::dvec2> square = {{0, 0}, {10, 0}, {10, 10}, {0, 10}};
    EXPECT_NEAR(area(square, 1), 64, 1e-3);
    EXPECT_NEAR(area({square.rbegin(), square.rend()}, 1), 64, 1e-3);
    EXPECT_NEAR(area(square, 4.999), 0.002 * 0.002, 1e-5);
    EXPECT_NEAR(area(square, 5.1), 0, 0);
    // The corner of an L that points inwards becomes an arc where its tip would be too long, else a tip.
    const std::vector<glm::dvec2> angle = {{0, 0}, {10, 0}, {10, 4}, {4, 4}, {4, 10}, {0, 10}};
    EXPECT_NEAR(area(angle, 1), 2 * 8 * 2 - 4, 1e-3);
    EXPECT_NEAR(area(angle, 3), 0, 0);
    // A dumbbell falls apart.
    const std::vector<glm::dvec2> dumbbell = {{0, 0},  {6, 0},  {6, 2.5},  {10, 2.5}, {10, 0}, {16, 0},
                                              {16, 6}, {10, 6}, {10, 3.5}, {6, 3.5},  {6, 6},  {0, 6}};
    EXPECT_NEAR(area(dumbbell, 1), 32, 0.3) << "and a little towards the neck";
    EXPECT_NEAR(area(dumbbell, 0.25), 2 * 5.5 * 5.5 + 4.5 * 0.5, 0.05);
    // A polygon that crosses itself: the rest of both triangles.
    const double radius = 16 / (4 + 4 * std::numbers::sqrt2);  // of the circle within each
    EXPECT_NEAR(area({{0, 0}, {8, 8}, {8, 0}, {0, 8}}, 0.5), 2 * 16 * std::pow(1 - 0.5 / radius, 2), 0.02);
}

TEST(Outlines, PolygonsKeepWhatIsFarFromTheirOutline) {
    std::mt19937 random(5);
    const Monitor monitor;
    for (int round = 0; round < 40; ++round) {
        // A star with random rays: convex and sharp corners, notches and necks.
        std::vector<glm::dvec2> star;
        std::vector<Micrometres> ring;
        const auto share = [&] { return 1e-6 * static_cast<double>(random() % 1'000'000); };
        const int rays = 4 + static_cast<int>(random() % 100);
        for (int i = 0; i < rays; ++i) {
            const double angle = 2 * std::numbers::pi * i / rays, length = 3 + 7 * share();
            star.push_back(length * glm::dvec2(std::cos(angle), std::sin(angle)));
            ring.push_back({to_whole(star.back().x * 1000), to_whole(star.back().y * 1000)});
        }
        const double distance = 0.1 + share();
        Outlines outlines(0.001, monitor);
        outlines.add_inside(star, distance, 0);
        const PlaneRegions plane = divide_plane(outlines.edges(), 0, covered, {});
        for (int i = 0; i < 200; ++i) {
            const auto coordinate = [&] { return static_cast<std::int32_t>(random() % 20'000) - 10'000; };
            const Micrometres point{coordinate(), coordinate()};
            const double away = distance_to(ring, point) * 0.001;
            double corner = 1e300;  // distance to a corner that may be mitred
            for (std::size_t k = 0; k < ring.size(); ++k) {
                const Micrometres a = ring[(k + ring.size() - 1) % ring.size()], b = ring[(k + 1) % ring.size()];
                if (twice_area(a, ring[k], b) < 0) corner = std::min(corner, distance_to({ring[k]}, point) * 0.001);
            }
            if (std::fabs(away - distance) < 0.005 || (away > distance && corner < 2 * distance + 0.005)) continue;
            EXPECT_EQ(region_at(plane, point) == 0, winding(ring, point) != 0 && away > distance)
                << distance << ' ' << away;
        }
    }
}

}  // namespace sikku::relief_plane_test
