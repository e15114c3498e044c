// tests/engine/placement_test.cpp: positions of the vertices of maps: straight, by gravity, by pressure.
#include "engine/map/placement.h"
#include "tests/checks.h"
#include "tests/maps.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <numeric>

namespace sikku::placement_test {

using Settings = std::vector<Setting>;

const Settings straight = {{"--set", "place", "straight"}};
const Settings gravity = {{"--set", "place", "gravity"}};
const Settings circle = {{"--set", "place", "gravity"}, {"--set", "outline", "circle"}};
const Settings pressure = {{"--set", "place", "pressure"}};

/// A map with its positions. Keeps the document alive.
struct Placed {
    Placed(const std::string& text, std::int64_t steps, const Settings& settings)
        : document(maps::document(text, steps, settings)), map(document.grammar()) {
        while (map.next()) {
        }
        vertices = map.vertices();
    }
    std::vector<double> areas() const {
        std::vector<double> list;
        for (std::size_t i = 0; i < map.map().cells(); ++i) list.push_back(area_of_cell(map.map(), i, vertices));
        return list;
    }
    double smallest() const {
        const auto list = areas();
        return *std::min_element(list.begin(), list.end());
    }
    double sum() const {
        const auto list = areas();
        return std::accumulate(list.begin(), list.end(), 0.0);
    }
    Document document;
    PlacedMap map;
    std::vector<glm::dvec2> vertices;
};

void expect_at(const glm::dvec2& found, double x, double y) {
    EXPECT_NEAR(found.x, x, 1e-6);
    EXPECT_NEAR(found.y, y, 1e-6);
}

/// Energies at rest after 0, 1, 2 … steps.
std::vector<double> energies_of(const std::string& text, std::int64_t steps, const Settings& settings) {
    const Document document = maps::document(text, steps, settings);
    PlacedMap map(document.grammar());
    std::vector<double> energies;
    do {
        energies.push_back(map.pressed()->energy(map.map()));
    } while (map.next());
    return energies;
}

TEST(Placement, StraightVerticesAreThoseOfTheText) {
    const Placed layer(maps::layer, 1, straight);
    expect_at(layer.vertices[0], 0, -1);
    expect_at(layer.vertices[1], -.866025, .5);
    expect_at(layer.vertices[2], .866025, .5);
    expect_at(layer.vertices[3], -.433013, -.25);
    expect_at(layer.vertices[4], .577350, 0);
    expect_at(layer.vertices[5], .288675, -.5);
    EXPECT_NEAR(Placed(maps::layer, 5, straight).smallest(), .012696, 1e-6);
    EXPECT_NEAR(Placed(maps::leaf, 10, straight).smallest(), 1.2389e-6, 1e-10);
}

TEST(Placement, GravityIsThatOfTheText) {
    const Placed polygon(maps::layer, 2, gravity);
    expect_at(polygon.vertices[10], -.072169, -.3125);
    expect_at(polygon.vertices[11], .072169, .0625);
    const Placed round(maps::layer, 2, circle);
    expect_at(round.vertices[10], .045409, -.467008);
    expect_at(round.vertices[11], .136227, .217008);
    EXPECT_NEAR(Placed(maps::layer, 5, gravity).smallest(), .005487, 1e-6);
    EXPECT_NEAR(Placed(maps::layer, 5, circle).smallest(), .012055, 1e-6);
    EXPECT_NEAR(Placed(maps::leaf, 10, gravity).smallest(), 9.6866e-7, 1e-11);
    EXPECT_NEAR(Placed(maps::leaf, 10, circle).smallest(), 1.57833e-3, 1e-8);
}

TEST(Placement, PressureIsThatOfTheText) {
    const std::vector<double> layer = {2.242453,  3.049822,  4.524893,  7.796345,
                                       13.139936, 24.113459, 43.046424, 82.515800};
    const std::vector<double> found = energies_of(maps::layer, 7, pressure);
    ASSERT_EQ(found.size(), layer.size());
    for (std::size_t i = 0; i < layer.size(); ++i) EXPECT_NEAR(found[i], layer[i], 1e-6) << i;

    const std::vector<double> leaf = {2.242453,  3.254668,  3.948150,  5.398155,  7.089919,  8.257365,  10.010525,
                                      11.914316, 13.240701, 15.108159, 17.063044, 18.418968, 20.301953, 22.234302};
    const std::vector<double> grown = energies_of(maps::leaf, 13, {});
    ASSERT_EQ(grown.size(), leaf.size());
    for (std::size_t i = 0; i < leaf.size(); ++i) EXPECT_NEAR(grown[i], leaf[i], 1e-6) << i;
    EXPECT_NEAR(energies_of(maps::leaf, 10, {{"--set", "growth", "1"}}).back(), 57.063200, 1e-6);

    const Placed five(maps::layer, 5, pressure);
    const auto areas = five.areas();
    EXPECT_NEAR(*std::min_element(areas.begin(), areas.end()), .571827, 1e-6);
    EXPECT_NEAR(*std::max_element(areas.begin(), areas.end()), 2.110088, 1e-6);
    EXPECT_NEAR(five.sum(), 43.387526, 1e-6);
}

TEST(Placement, PressureOfOneCellByHand) {
    EXPECT_NEAR(energies_of("map: clockwise\nplace: pressure\naxiom: abc\n", 0, {})[0],
                1 - std::log(1 / (2 * std::numbers::sqrt3)), 1e-12);
    EXPECT_NEAR(energies_of("map: clockwise\nplace: pressure\naxiom: abcd\n", 0, {})[0], 1 + std::numbers::ln2,
                1e-12);
    EXPECT_NEAR(energies_of("map: anticlockwise\nplace: pressure\naxiom: abcd\n", 0, {})[0], 1 + std::numbers::ln2,
                1e-12);
}

TEST(Placement, VertexZeroKeepsItsDirectionUnderPressure) {
    for (const std::int64_t steps : {0, 5, 10}) {
        const Placed leaf(maps::leaf, steps, {});
        EXPECT_NEAR(leaf.vertices[0].x, 0, 1e-9);
        EXPECT_LT(leaf.vertices[0].y, 0);
    }
}

TEST(Placement, StretchMultipliesTheHeight) {
    const Placed plain(maps::leaf, 6, {});
    const Placed tall(maps::leaf, 6, {{"--set", "stretch", "2.2"}});
    for (std::size_t i = 0; i < plain.vertices.size(); ++i) {
        EXPECT_EQ(tall.vertices[i].x, plain.vertices[i].x);
        EXPECT_EQ(tall.vertices[i].y, plain.vertices[i].y * 2.2);
    }
}

TEST(Placement, CheckersAreEqualRectangles) {
    const Placed board(maps::checkers, 5, straight);
    // A square in the circle of radius 1, in 4 columns and 8 rows.
    for (const double area : board.areas()) EXPECT_NEAR(area, 2.0 / 32, 1e-12);
    expect_at(board.vertices[0], -std::numbers::sqrt2 / 2, -std::numbers::sqrt2 / 2);
}

TEST(Placement, WhatCannotBePlacedIsRefused) {
    const auto error_of = [](const std::string& text, std::int64_t steps) -> std::string {
        return sikku::error_of<PlacementError>([&] { const Placed placed("map: clockwise\n" + text, steps, {}); });
    };
    EXPECT_EQ(error_of("axiom: ab\n", 0),
              "a map is drawn from a polygon, and this axiom has 2 edges; expected 3 or more");
    const std::string two_edges = "axiom: abc\na --> e[-d]f[-~d]e\n";
    EXPECT_EQ(error_of("place: pressure\n" + two_edges, 1),
              "pressure cannot open cell 1 in step 1: it has 2 edges; `place: straight` and `place: gravity` draw it "
              "flat");
    EXPECT_EQ(error_of(two_edges, 1), "");
    // A wall between two vertices of one straight edge opens under gravity on the circle.
    EXPECT_EQ(error_of("place: pressure\naxiom: abc\na --> e[-d]f\nb --> f[-~d]f\ne --> e[-g]e[-~g]e\n", 1), "");
}

/// Sorts the edges around each vertex by their angle and checks that this yields the walls of the map.
void expect_same_walls(const Map& map, const std::vector<glm::dvec2>& vertices) {
    std::vector<std::vector<std::pair<double, std::uint32_t>>> around(map.vertices());  // by angle, the half-edge
    const auto number = [](HalfEdge half) { return 2 * half.edge() + (half.is_reversed() ? 1 : 0); };
    for (std::uint32_t i = 0; i < 2 * map.edges().size(); ++i) {
        const HalfEdge half(i / 2, i % 2 == 1);
        const glm::dvec2 along = vertices[map.end(half)] - vertices[map.start(half)];
        around[map.start(half)].push_back({std::atan2(along.y, along.x), i});
    }
    std::vector<std::uint32_t> next(2 * map.edges().size());
    for (auto& list : around) {
        std::sort(list.begin(), list.end());
        for (std::size_t i = 0; i < list.size(); ++i) {
            // Coming in along the opposite of a half-edge, a clockwise wall leaves by the next one anticlockwise.
            next[list[i].second ^ 1] = list[(i + 1) % list.size()].second;
        }
    }
    for (std::size_t i = 0; i <= map.cells(); ++i) {
        const auto wall = map.cell(i);
        for (std::size_t k = 0; k < wall.size(); ++k) {
            ASSERT_EQ(next[number(wall[k])], number(wall[(k + 1) % wall.size()])) << "cell " << i;
        }
    }
}

/// How far the sharpest corner of a cell is from convex; 0 if it is convex.
double concavity(const Map& map, std::size_t cell, const std::vector<glm::dvec2>& vertices) {
    const auto wall = map.cell(cell);
    double worst = 0;
    for (std::size_t k = 0; k < wall.size(); ++k) {
        const glm::dvec2 a = vertices[map.end(wall[k])] - vertices[map.start(wall[k])];
        const HalfEdge after = wall[(k + 1) % wall.size()];
        const glm::dvec2 b = vertices[map.end(after)] - vertices[map.start(after)];
        worst = std::max(worst, a.x * b.y - a.y * b.x);  // clockwise: not to the left
    }
    return worst;
}

TEST(Placement, RandomMapsKeepTheirWalls) {
    int placed = 0;
    int pressed = 0;
    for (std::uint32_t seed = 0; seed < 1500; ++seed) {
        const std::string text = maps::random_system(seed);
        SCOPED_TRACE(text);
        const Document document = maps::document(text, 4);
        if (document.map()->axiom.size() < 3) continue;
        const Map last = derive_map(document.grammar());
        if (last.edges().size() > 400 || last.cells() == 1) continue;
        const Placed flat(text, 4, straight);
        const Map& map = flat.map.map();
        const double whole = Placed(text, 0, straight).sum();
        EXPECT_NEAR(flat.sum(), whole, 1e-9);
        for (std::size_t i = 0; i < map.cells(); ++i) EXPECT_LT(concavity(map, i, flat.vertices), 1e-12);
        if (flat.smallest() < 1e-9) continue;
        ++placed;
        expect_same_walls(map, flat.vertices);
        for (const Settings& settings : {gravity, circle}) {
            const Placed drawn(text, 4, settings);
            EXPECT_GT(drawn.smallest(), -1e-12);
            for (std::size_t i = 0; i < map.cells(); ++i) EXPECT_LT(concavity(map, i, drawn.vertices), 1e-9);
        }
        try {
            const Placed at_rest(text, 4, {{"--set", "place", "pressure"}, {"--set", "growth", "0.5"}});
            const PressedMap& forces = *at_rest.map.pressed();
            double springs = 0;
            for (std::size_t i = 0; i < map.edges().size(); ++i) {
                const glm::dvec2 span = at_rest.vertices[map.edges()[i].head] - at_rest.vertices[map.edges()[i].tail];
                springs += forces.stiffness()[i] * glm::dot(span, span);
            }
            const double contents = std::accumulate(forces.contents().begin(), forces.contents().end(), 0.0);
            EXPECT_NEAR(springs, 2 * contents, 1e-6 * contents);
            EXPECT_GT(at_rest.smallest(), 0);
            ++pressed;
        } catch (const PlacementError&) {  // a cell of two edges on the way
        }
    }
    EXPECT_GT(placed, 30);
    EXPECT_GT(pressed, 20);
}

TEST(Placement, StopsOnRequest) {
    const Document document = maps::document(maps::leaf, 13);
    EXPECT_THROW(PlacedMap(document.grammar(), {}, Monitor([](void*) { return true; })), Stopped);
}

}  // namespace sikku::placement_test
