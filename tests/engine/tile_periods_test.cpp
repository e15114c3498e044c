// Periods of tilings: against areas of cells, norms on lattices and translated tiles; rectangles of lattices against
// divisors.
#include "engine/tiling/tile_periods.h"
#include "engine/language/document.h"

#include <gtest/gtest.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <cmath>
#include <map>
#include <numeric>
#include <random>
#include <set>
#include <string>
#include <tuple>
#include <vector>

namespace sikku::tile_periods_test {

TilingResult examined(const std::string& name, std::int64_t steps) {
    TilingOptions options;
    options.colours = {100, 1000};
    return examine_tiling(*load(name).grammar().with_steps(steps), options);
}

TilePeriods periods(const TilingResult& result) {
    const auto& colour = result.patch.tiles.colour;
    return find_periods(result.patch, std::vector<std::uint32_t>(colour.begin(), colour.end()), {});
}

double area(const TilePeriods& found) {
    return std::fabs(determinant(found.vectors[0], found.vectors[1]));
}

/// Corners, rounded and sorted, and the colour of a tile that is moved.
std::tuple<std::set<std::pair<long, long>>, int> moved(const TilingPatch& patch, std::uint32_t tile, glm::dvec2 way) {
    std::set<std::pair<long, long>> corners;
    for (const std::uint32_t corner : patch.tiles.corners(tile)) {
        const glm::dvec2 at = patch.plane.at(corner) + way;
        corners.emplace(std::lround(at.x * 1e4), std::lround(at.y * 1e4));
    }
    return {corners, patch.tiles.colour[tile]};
}

TEST(TilePeriods, SpanTheCellsOfUniformTilings) {
    // The area of hexagon, square, triangle and so on with unit sides, in one cell of each.
    const double triangle = std::sqrt(3.0) / 4, hexagon = 6 * triangle, octagon = 2 * (1 + std::sqrt(2.0)),
                 dodecagon = 3 * (2 + std::sqrt(3.0));
    const std::map<std::string, double> cells = {{"triangular", 2 * triangle},
                                                 {"trihexagonal", hexagon + 2 * triangle},
                                                 {"rhombitrihexagonal", hexagon + 3 + 2 * triangle},
                                                 {"truncated-square", octagon + 1},
                                                 {"truncated-hexagonal", dodecagon + 2 * triangle},
                                                 {"truncated-trihexagonal", dodecagon + 3 + 2 * hexagon},
                                                 {"snub-square", 2 + 4 * triangle},
                                                 {"snub-trihexagonal", hexagon + 8 * triangle},
                                                 {"elongated-triangular", 1 + 2 * triangle},
                                                 {"tumbling-blocks", 3 * 2 * triangle},
                                                 {"honeycomb", 3 * hexagon},  // in three colours
                                                 {"herringbone", 4},
                                                 {"pythagorean", 5},
                                                 {"windmill", 9}};
    for (const auto& [name, cell] : cells) {
        const TilingResult result = examined(name, 30);
        const TilePeriods found = periods(result);
        ASSERT_EQ(found.count, 2) << name;
        EXPECT_NEAR(area(found), cell, 1e-6) << name;
        // Another way to compare: tiles around the middle lie on tiles.
        const TilingPatch& patch = result.patch;
        std::set<std::tuple<std::set<std::pair<long, long>>, int>> all;
        for (std::uint32_t tile = 0; tile < patch.tiles.tiles(); ++tile) all.insert(moved(patch, tile, {}));
        const glm::dvec2 middle = patch.plane.at(patch.tiles.corner[patch.tiles.begin[found.middle]]);
        int compared = 0;
        for (std::uint32_t tile = 0; tile < patch.tiles.tiles(); ++tile) {
            if (glm::distance(patch.plane.at(patch.tiles.corners(tile)[0]), middle) > found.radius / 2) continue;
            for (const glm::dvec2 way : found.vectors) EXPECT_TRUE(all.contains(moved(patch, tile, way))) << name;
            ++compared;
        }
        EXPECT_GT(compared, 10) << name;
    }
}

TEST(TilePeriods, AreFoundInSubstitutionsThatRepeat) {
    // The colour of a hexagon is its last digit in base 2 + zeta, whose norm is 7; hexagons lie root 3 apart.
    const TilePeriods gosper = periods(examined("gosper-islands", 4));
    ASSERT_EQ(gosper.count, 2);
    for (const glm::dvec2 way : gosper.vectors) EXPECT_NEAR(scalar_product(way, way), 21, 1e-9);
    // The last digit in base 1 + i is the parity.
    const TilePeriods dragon = periods(examined("twin-dragon", 10));
    ASSERT_EQ(dragon.count, 2);
    EXPECT_NEAR(area(dragon), 2, 1e-9);
    EXPECT_EQ(dragon.exact[0][0], dragon.vectors[0].x);
    EXPECT_EQ(dragon.exact[0][1], dragon.vectors[0].y);
}

TEST(TilePeriods, AreNotFoundInAperiodicTilings) {
    const std::map<std::string, std::int64_t> steps = {{"penrose-rhombs", 8},  {"penrose-kite-dart", 7},
                                                       {"ammann-beenker", 4},  {"hat", 4},
                                                       {"spectre", 4},         {"pinwheel", 5},
                                                       {"chair", 6},           {"table", 6},
                                                       {"half-hex", 6},        {"sphinx", 6},
                                                       {"square-triangle", 3}, {"danzer", 3}};
    for (const auto& [name, n] : steps) {
        const TilePeriods found = periods(examined(name, n));
        EXPECT_EQ(found.count, 0) << name;
        EXPECT_GT(found.reach, 4) << name;
    }
}

TEST(TilePeriods, HaveOneDirectionInStrips) {
    // Squares in rows, of which each other row has another colour, and the middle one a third.
    std::string text = "angle factor: 4\nturn: left\nheading: 0\nderivation length: 0\naxiom: ";
    for (int row = 0; row < 21; ++row) {
        text += "[";
        for (int column = 0; column < 21; ++column) {
            text += "[{F+F+F+F;(" + std::to_string(row * row % 13) + ")}]f";
        }
        text += "]+f-";
    }
    const TilePeriods found = periods(examine_tiling(parse("strips.lsys", text + "\n").grammar(), {}));
    EXPECT_EQ(found.count, 1);
    EXPECT_NEAR(found.vectors[0].x, 1, 1e-9);
    EXPECT_NEAR(found.vectors[0].y, 0, 1e-9);
}

TEST(LatticeRectangles, AreThoseOfDivisors) {
    // x of the vectors m a + n b with y = 0 are multiples of the determinant over the divisor of both y.
    std::mt19937 random(7);
    std::uniform_int_distribution<int> number(-9, 9);
    int tried = 0;
    while (tried < 200) {
        const int ax = number(random), ay = number(random), bx = number(random), by = number(random);
        const int size = std::abs(ax * by - ay * bx);
        if (size == 0) continue;
        ++tried;
        const auto found = upright_rectangle(glm::dvec2(ax, ay), glm::dvec2(bx, by));
        ASSERT_TRUE(found);
        EXPECT_NEAR(found->across.x, static_cast<double>(size) / std::gcd(ay, by), 1e-9);
        EXPECT_NEAR(found->up.y, static_cast<double>(size) / std::gcd(ax, bx), 1e-9);
        EXPECT_EQ(found->across.y, 0);
        EXPECT_EQ(found->up.x, 0);
        const auto least = least_rectangle(glm::dvec2(ax, ay), glm::dvec2(bx, by));
        ASSERT_TRUE(least);
        EXPECT_LE(least->area(), found->area() * (1 + 1e-9));
        EXPECT_NEAR(std::fmod(least->area() + 1e-6, size), 0, 2e-6) << "whole cells";
        EXPECT_NEAR(glm::dot(least->across, least->up), 0, 1e-6);
    }
}

TEST(LatticeRectangles, AreOneByRootThreeInHexagonalLattices) {
    const auto found = upright_rectangle({1, 0}, {-0.5, std::sqrt(0.75)});
    ASSERT_TRUE(found);
    EXPECT_NEAR(found->across.x, 1, 1e-9);
    EXPECT_NEAR(found->up.y, std::sqrt(3.0), 1e-9);
    // Turned by any angle there are none along the axes, but the least one is as large.
    const glm::dvec2 a(std::cos(0.3), std::sin(0.3));
    const glm::dvec2 b(std::cos(0.3 + 2.0943951023931953), std::sin(0.3 + 2.0943951023931953));
    EXPECT_FALSE(upright_rectangle(a, b));
    const auto least = least_rectangle(a, b);
    ASSERT_TRUE(least);
    EXPECT_NEAR(least->area(), std::sqrt(3.0), 1e-9);
    EXPECT_NEAR(std::fabs(std::atan2(least->across.y, least->across.x)), std::min(0.3, 0.5235987755982988 - 0.3),
                1e-9)
        << "turned least";
}

TEST(LatticeRectangles, DoNotExistInObliqueLattices) {
    const glm::dvec2 a(1, 0), b(std::cbrt(2.0) * std::cos(0.7), std::cbrt(2.0) * std::sin(0.7));
    EXPECT_FALSE(upright_rectangle(a, b));
    EXPECT_FALSE(least_rectangle(a, b));
}

}  // namespace sikku::tile_periods_test
