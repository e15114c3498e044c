// Colours and edges of tiles: against sums over a grid, facts of the literature, and the SVG that is drawn.
#include "art/prints.h"
#include "art/tiles/tile_colours.h"
#include "art/tiles/united_lines.h"
#include "engine/base/diagnostic.h"
#include "engine/derivation/derivation.h"
#include "engine/geometry/polygon_classes.h"
#include "engine/geometry/turtle.h"
#include "tests/checks.h"
#include "tests/files.h"
#include "tests/reference.h"

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <map>
#include <pugixml.hpp>
#include <random>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace sikku::tile_drawing_test {

using Kept = UnitedLines::Kept;

/// The lines and polygons of a drawing.
struct Gathered : PathSink {
    void begin_stroke(glm::dvec2 start, const Pen& pen) override {
        at = start;
        now = pen;
    }
    void lines(std::span<const glm::dvec2> ends) override {
        for (const glm::dvec2 end : ends) {
            united.add_line(at, end, now);
            at = end;
        }
    }
    void curves(std::span<const glm::dvec2>) override {}
    void change_pen(const Pen& pen) override { now = pen; }
    void end_stroke(bool) override {}
    void polygon(std::span<const glm::dvec2> vertices, const Pen&) override {
        united.add_tile(vertices);
        tiles.emplace_back(vertices.begin(), vertices.end());
    }
    void disc(glm::dvec2, double, const Pen&) override {}

    UnitedLines united{1e7};
    std::vector<std::vector<glm::dvec2>> tiles;
    glm::dvec2 at{0.0};
    Pen now;
};

Gathered gathered(const std::string& tiling, const std::string& steps) {
    const Grammar grammar =
        reference::grammar_of(contents(bundled("tilings/" + tiling)), {{"-n", "derivation length", steps}});
    Gathered result;
    derive(grammar, *Turtle::drawing(grammar, result, false), {.interpreted = true});
    return result;
}

double length_of(const std::vector<UnitedLines::Line>& lines) {
    double length = 0;
    for (const auto& line : lines) length += glm::distance(line.from, line.to);
    return length;
}

TEST(UnitedLines, CoverEachUnitOfAGridOnce) {
    std::mt19937 chance(1);
    const auto any = [&](int below) { return static_cast<int>(chance() % static_cast<unsigned>(below)); };
    const std::vector<glm::dvec2> directions{{1, 0}, {0, 1}, {1, 1}, {-1, 2}};
    for (int round = 0; round < 200; ++round) {
        UnitedLines united(1e6);
        // Pairs of points a unit apart, and the pen that covered them first.
        std::map<std::vector<int>, int> covered;
        for (int i = 0; i < 40; ++i) {
            const glm::dvec2 direction = directions[static_cast<std::size_t>(any(4))];
            const glm::dvec2 from(any(8), any(8));
            const int length = 1 + any(4);
            const Pen pen{.colour = any(3)};
            const glm::dvec2 to = from + direction * static_cast<double>(length);
            if (any(2) == 0) {
                united.add_line(from, to, pen);
            } else {
                united.add_line(to, from, pen);
            }
            for (int k = 0; k < length; ++k) {
                const glm::dvec2 a = from + direction * static_cast<double>(k), b = a + direction;
                covered.try_emplace(
                    {static_cast<int>(a.x), static_cast<int>(a.y), static_cast<int>(b.x), static_cast<int>(b.y)},
                    pen.colour);
            }
        }
        std::map<std::vector<int>, int> found;
        for (const auto& line : united.unite(Kept::all, {}).lines) {
            for (const glm::dvec2 direction : directions) {
                const glm::dvec2 way = line.to - line.from;
                const double count = glm::dot(way, direction) / glm::dot(direction, direction);
                if (glm::distance(way, direction * count) > 1e-9) continue;
                const glm::dvec2 first = count > 0 ? line.from : line.to;
                for (int k = 0; k < std::lround(std::fabs(count)); ++k) {
                    const glm::dvec2 a = first + direction * static_cast<double>(k), b = a + direction;
                    const bool is_new = found
                                            .try_emplace({static_cast<int>(a.x), static_cast<int>(a.y),
                                                          static_cast<int>(b.x), static_cast<int>(b.y)},
                                                         line.pen.colour)
                                            .second;
                    EXPECT_TRUE(is_new) << "drawn twice";
                }
            }
        }
        EXPECT_EQ(found, covered) << round;
    }
}

/// Edges and border edges in units: Penrose's rhombs, Ammann's and Beenker's tiles, and rows of squares and triangles
/// have edges of length 1. The pinwheel's edges partly overlap; their length is that of the sides of its triangles
/// without what is shared.
TEST(UnitedLines, EdgesOfTilingsHaveTheirKnownLengths) {
    const auto lengths = [](const std::string& tiling, const std::string& steps) {
        const Gathered drawing = gathered(tiling, steps);
        return std::pair(length_of(drawing.united.unite(Kept::all, {}).lines),
                         length_of(drawing.united.unite(Kept::border, {}).lines));
    };
    const auto expect = [&](const std::string& tiling, const std::string& steps, double edges, double border) {
        const auto [all, outer] = lengths(tiling, steps);
        EXPECT_NEAR(all, edges, 1e-6 * edges) << tiling;
        EXPECT_NEAR(outer, border, 1e-6 * border) << tiling;
    };
    expect("penrose-rhombs", "5", 935, 90);
    expect("ammann-beenker", "2", 520, 112);
    expect("snub-square", "16", 679, 78);
    expect("elongated-triangular", "18", 436, 62);
    expect("tumbling-blocks", "16", 415, 62);
    expect("twin-dragon", "9", 1233, 418);
    // A rectangle of 50 by 25: each inner edge belongs to two of 1250 triangles with sides 1, 2 and the root of 5.
    const double border = 2 * (50 + 25);
    expect("pinwheel", "4", (1250 * (3 + std::sqrt(5.0)) + border) / 2, border);
}

TEST(UnitedLines, NothingIsLeftBetweenOrWithoutTiles) {
    UnitedLines united(1e3);
    const std::vector<glm::dvec2> left{{0, 0}, {2, 0}, {2, 2}, {0, 2}};
    const std::vector<glm::dvec2> right{{2, 1}, {4, 1}, {4, 3}, {2, 3}};  // shares half of an edge
    for (const auto& tile : {left, right}) {
        for (std::size_t i = 0; i < 4; ++i) united.add_line(tile[i], tile[(i + 1) % 4], {});
        united.add_tile(tile);
    }
    united.add_line({5, 0}, {6, 0}, {});
    const auto all = united.unite(Kept::all, {});
    EXPECT_DOUBLE_EQ(length_of(all.lines), 16);
    EXPECT_EQ(all.neighbours, (std::vector<UnitedLines::Pair>{{0, 1}}));
    EXPECT_EQ(all.border, (std::vector<std::uint32_t>{0, 1}));
    EXPECT_DOUBLE_EQ(length_of(united.unite(Kept::border, {}).lines), 15);
    EXPECT_TRUE(united.unite(Kept::none, {}).lines.empty());
    UnitedLines small(2);
    small.add_line({0, 0}, {1, 0}, {});
    small.add_line({0, 0}, {0, 0}, {});  // has no length
    small.add_line({0, 0}, {0, 1}, {});
    EXPECT_THROW(small.add_line({0, 0}, {1, 1}, {}), BudgetError);
}

/// Two colours for hexagons and triangles, three for Penrose's rhombs (Sibley and Wagon 2000) and most others,
/// never more than four.
/// Twice the area to the left of the border.
double area_within(const std::vector<UnitedLines::Line>& lines) {
    double area = 0;
    for (const auto& line : lines) {
        if (line.is_border) area += line.from.x * line.to.y - line.from.y * line.to.x;
    }
    return area / 2;
}

/// A region with right angles grows by its border times the distance, and by four squares at its corners in all.
TEST(BorderCuts, RegionsGrowByTheirBorder) {
    constexpr double distance = 0.01;
    for (const auto& [tiling, steps] : {std::pair("chair", "4"), {"twin-dragon", "9"}, {"herringbone", "8"}}) {
        const Gathered drawing = gathered(tiling, steps);
        const auto lines = drawing.united.unite(Kept::cuts, {}).lines;
        const auto moved = with_wider_border(lines, distance);
        const double border = length_of(drawing.united.unite(Kept::border, {}).lines);
        EXPECT_NEAR(length_of(lines), length_of(drawing.united.unite(Kept::all, {}).lines), 1e-6);
        EXPECT_NEAR(area_within(moved), area_within(lines) + border * distance + 4 * distance * distance, 1e-6)
            << tiling;
        EXPECT_NEAR(length_of(moved), length_of(lines) + 8 * distance, 1e-6) << tiling;
    }
}

TEST(BorderCuts, GapsShrinkAndTilesThatTouchAtACornerStayApart) {
    Gathered drawing;
    const auto add = [&](double x, double y) {
        const std::vector<glm::dvec2> square = {{x, y}, {x + 1, y}, {x + 1, y + 1}, {x, y + 1}};
        drawing.polygon(square, {});
        drawing.begin_stroke(square[3], {});
        drawing.lines(square);
    };
    for (int i = 0; i < 9; ++i) {
        if (i != 4) add(i % 3, i / 3);
    }
    add(3, 3);
    const auto moved = with_wider_border(drawing.united.unite(Kept::cuts, {}).lines, 0.1);
    std::map<bool, double> lengths;
    for (const auto& line : moved) lengths[line.is_border] += glm::distance(line.from, line.to);
    EXPECT_NEAR(lengths[true], 4 * 3.2 + 4 * 0.8 + 4 * 1.2, 1e-9);
    EXPECT_NEAR(lengths[false], 8, 1e-9);
    EXPECT_NEAR(area_within(moved), 3.2 * 3.2 - 0.8 * 0.8 + 1.2 * 1.2, 1e-9);
    // The gap is a unit wide.
    EXPECT_THROW(with_wider_border(drawing.united.unite(Kept::cuts, {}).lines, 0.6), std::runtime_error);
}

TEST(TileColours, NeighboursDifferInFewColours) {
    const std::map<std::string, std::pair<const char*, std::uint32_t>> tilings{{"penrose-rhombs", {"6", 3}},
                                                                               {"penrose-kite-dart", {"5", 4}},
                                                                               {"twin-dragon", {"9", 2}},
                                                                               {"ammann-beenker", {"3", 3}},
                                                                               {"trihexagonal", {"16", 2}},
                                                                               {"pythagorean", {"14", 3}},
                                                                               {"truncated-hexagonal", {"12", 4}},
                                                                               {"hat", {"3", 4}},
                                                                               {"spectre", {"3", 4}},
                                                                               {"pinwheel", {"4", 4}},
                                                                               {"chair", {"5", 3}},
                                                                               {"p-pentomino", {"4", 4}}};
    for (const auto& [name, expected] : tilings) {
        const Gathered drawing = gathered(name, expected.first);
        const auto found = drawing.united.unite(Kept::none, {});
        const auto colours = colours_of_neighbours(drawing.united.tiles(), found.neighbours);
        ASSERT_EQ(colours.size(), drawing.tiles.size());
        EXPECT_FALSE(found.neighbours.empty());
        for (const auto& [a, b] : found.neighbours) EXPECT_NE(colours[a], colours[b]) << name;
        EXPECT_LE(*std::max_element(colours.begin(), colours.end()) + 1, expected.second) << name;
    }
    // A complete graph of five, which is not planar, needs five.
    std::vector<UnitedLines::Pair> all;
    for (std::uint32_t a = 0; a < 5; ++a) {
        for (std::uint32_t b = a + 1; b < 5; ++b) all.push_back({a, b});
    }
    const auto five = colours_of_neighbours(5, all);
    EXPECT_EQ(std::set<std::uint32_t>(five.begin(), five.end()).size(), 5u);
}

TEST(TileColours, DistancesCountTheTilesToTheBorder) {
    // Five by five squares.
    std::vector<UnitedLines::Pair> pairs;
    std::vector<std::uint32_t> border;
    for (std::uint32_t i = 0; i < 25; ++i) {
        if (i % 5 < 4) pairs.push_back({i, i + 1});
        if (i < 20) pairs.push_back({i, i + 5});
        if (i % 5 == 0 || i % 5 == 4 || i < 5 || i >= 20) border.push_back(i);
    }
    const auto found = distances_from_border(25, pairs, border);
    for (std::uint32_t i = 0; i < 25; ++i) {
        EXPECT_EQ(found[i], std::min({i % 5, 4 - i % 5, i / 5, 4 - i / 5})) << i;
    }
}

/// Numbers of shapes, of shapes by hand, and of orientations: Penrose's tiles have 5 or 10, hats and spectres 12, the
/// sphinx 11 in this patch, the pinwheel's after four steps 30.
TEST(PolygonClasses, CountShapesHandsAndDirections) {
    const auto expect = [](const std::string& tiling, const std::string& steps, std::size_t shapes, std::size_t hands,
                           std::size_t directions) {
        PolygonClasses classes;
        std::set<std::uint32_t> shape, hand, direction;
        for (const auto& tile : gathered(tiling, steps).tiles) {
            const PolygonClass found = classes.classify(tile);
            shape.insert(found.shape);
            hand.insert(found.hand);
            direction.insert(found.direction);
        }
        EXPECT_EQ(shape.size(), shapes) << tiling;
        EXPECT_EQ(hand.size(), hands) << tiling;
        EXPECT_EQ(direction.size(), directions) << tiling;
        EXPECT_EQ(classes.shapes(), shapes);
    };
    expect("penrose-rhombs", "5", 2, 2, 10);
    expect("penrose-kite-dart", "4", 2, 2, 20);
    expect("ammann-beenker", "2", 2, 2, 6);
    expect("chair", "4", 1, 1, 4);
    expect("sphinx", "3", 1, 2, 11);
    expect("half-hex", "4", 1, 1, 6);
    expect("p-pentomino", "4", 1, 2, 8);
    expect("pinwheel", "4", 1, 2, 30);
    expect("hat", "3", 1, 2, 12);
    expect("trihexagonal", "16", 2, 2, 3);
    expect("rhombitrihexagonal", "14", 3, 3, 6);
    expect("fibonacci-squares", "5", 3, 3, 4);
}

TEST(PolygonClasses, IgnoreSenseStartAndStraightCorners) {
    PolygonClasses classes;
    const std::vector<glm::dvec2> ell{{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 3}, {0, 3}};
    const PolygonClass first = classes.classify(ell);
    const std::vector<glm::dvec2> backwards(ell.rbegin(), ell.rend());
    EXPECT_EQ(classes.classify(backwards), first);
    EXPECT_EQ(classes.classify(std::vector<glm::dvec2>{{5, 3}, {5, 2}, {5, 0}, {7, 0}, {7, 1}, {6, 1}, {6, 3}}),
              first);
    std::vector<glm::dvec2> mirror;
    for (const glm::dvec2 at : ell) mirror.emplace_back(-at.x, at.y);
    const PolygonClass other = classes.classify(mirror);
    EXPECT_EQ(other.shape, first.shape);
    EXPECT_NE(other.hand, first.hand);
    EXPECT_TRUE(other.is_reflected);
    EXPECT_FALSE(first.is_reflected);
}

std::string svg_of(const std::string& tiling, OptionValues values) {
    values.push_back({"size", "100x100mm"});
    return draw(load(bundled("tilings/" + tiling)), "svg", values);
}

TEST(TileDrawing, SvgHasTheColoursOfTilesAndLongStrokes) {
    const auto fills = [](const std::string& svg) {
        pugi::xml_document document;
        EXPECT_TRUE(document.load_string(svg.c_str()));
        std::set<std::string> colours;
        for (const auto& path : document.select_nodes("//*[@fill and not(@fill='none')]")) {
            colours.insert(path.node().attribute("fill").value());
        }
        colours.erase("#f6f0e4");  // the ground
        return colours;
    };
    const auto strokes = [](const std::string& svg) { return std::count(svg.begin(), svg.end(), 'M'); };
    const std::string plain = svg_of("penrose-rhombs", {{"derivation length", "4"}});
    const std::string three = svg_of(
        "penrose-rhombs", {{"derivation length", "4"}, {"tile-colours", "by neighbours"}, {"tile-edges", "once"}});
    EXPECT_EQ(fills(three).size(), 3u);
    EXPECT_LT(three.size(), plain.size());
    EXPECT_GT(strokes(plain), 0);
    const std::string direction = svg_of(
        "penrose-rhombs",
        {{"derivation length", "4"}, {"tile-colours", "direction"}, {"powders", "#111111 #222222 #333333 #444444"}});
    EXPECT_EQ(fills(direction), (std::set<std::string>{"#111111", "#222222", "#333333", "#444444"}));
}

/// Fills of the tiles in drawing order.
std::vector<std::string> fills_of_tiles(const std::string& tiling, OptionValues values) {
    values.push_back({"name-tiles", "true"});
    pugi::xml_document document;
    EXPECT_TRUE(document.load_string(svg_of(tiling, values).c_str()));
    std::vector<std::string> fills;
    for (const auto& path : document.select_nodes("//*[@id]")) {
        pugi::xml_node node = path.node();
        while (node.attribute("fill").empty()) node = node.parent();
        fills.emplace_back(node.attribute("fill").value());
    }
    return fills;
}

/// Each chair of the step before becomes four chairs of one colour.
TEST(TileDrawing, TilesOfOneAncestorHaveOneColour) {
    for (const auto& [steps, tiles] : {std::pair("1", 4), std::pair("2", 16), std::pair("3", 64)}) {
        const auto fills = fills_of_tiles(
            "chair", {{"derivation length", "4"}, {"tile-colours", std::string("by generation ") + steps}});
        ASSERT_EQ(fills.size(), 256u);
        std::set<std::string> colours;
        for (std::size_t i = 0; i < fills.size(); ++i) {
            EXPECT_EQ(fills[i], fills[i / static_cast<std::size_t>(tiles) * static_cast<std::size_t>(tiles)]) << i;
            colours.insert(fills[i]);
        }
        // Four chairs around a corner touch each other.
        EXPECT_GE(colours.size(), 2u) << steps;
        EXPECT_LE(colours.size(), 4u) << steps;
    }
    EXPECT_EQ(fills_of_tiles("chair", {{"derivation length", "3"}, {"tile-colours", "by generation"}}),
              fills_of_tiles("chair", {{"derivation length", "3"}, {"tile-colours", "generation 1"}}));
    const auto one = fills_of_tiles("chair", {{"derivation length", "2"}, {"tile-colours", "by generation 9"}});
    EXPECT_EQ(std::set<std::string>(one.begin(), one.end()).size(), 1u) << "all come from the axiom";
    // Several symbols of the axiom: each has its own colour; halves without tiles do not count.
    const auto star =
        fills_of_tiles("ammann-beenker", {{"derivation length", "1"}, {"tile-colours", "by generation"}});
    EXPECT_EQ(std::set<std::string>(star.begin(), star.end()).size(), 2u);
}

/// Numbers of elements by class: 170 thin and 275 thick rhombs in five directions each; the sphinx in both hands.
TEST(TileDrawing, SvgNamesEachTile) {
    const auto classes = [](const std::string& tiling, const std::string& steps) {
        pugi::xml_document document;
        const std::string svg = svg_of(tiling, {{"derivation length", steps}, {"name-tiles", "true"}});
        EXPECT_TRUE(document.load_string(svg.c_str()));
        std::map<std::string, int> counts;
        int number = 0;
        for (const auto& path : document.select_nodes("//*[@id]")) {
            EXPECT_EQ(path.node().attribute("id").value(), "t" + std::to_string(++number));
            std::istringstream names(path.node().attribute("class").value());
            for (std::string name; names >> name;) ++counts[name];
        }
        counts["all"] = number;
        return counts;
    };
    const auto rhombs = classes("penrose-rhombs", "5");
    EXPECT_EQ(rhombs.at("all"), 445);
    EXPECT_EQ(std::min(rhombs.at("shape-1"), rhombs.at("shape-2")), 170);
    EXPECT_EQ(std::max(rhombs.at("shape-1"), rhombs.at("shape-2")), 275);
    EXPECT_EQ(rhombs.count("direction-10"), 1u);
    EXPECT_EQ(rhombs.count("direction-11"), 0u);
    EXPECT_EQ(rhombs.at("colour-1") + rhombs.at("colour-2"), 445);
    EXPECT_EQ(rhombs.count("reflected"), 0u);
    const auto sphinxes = classes("sphinx", "3");
    EXPECT_EQ(sphinxes.at("reflected"), 36) << "the first is one of the 28";
    EXPECT_EQ(sphinxes.at("shape-1"), 64);
}

TEST(TileDrawing, WhatHasNoTilesIsRefused) {
    const auto message = [](const std::string& name, const OptionValues& values) {
        return error_of([&] { draw(load(bundled(name)), "svg", values); });
    };
    EXPECT_TRUE(has(message("kolams/snake-kolam", {{"tile-edges", "once"}}), "splines"));
    EXPECT_TRUE(has(message("plants/bush-3d", {{"tile-edges", "once"}}), "drawings in space have no edges of tiles"));
    EXPECT_TRUE(has(message("tilings/chair", {{"tile-colours", "by shapes"}}), "did you mean 'shape'?"));
    EXPECT_TRUE(has(message("tilings/chair", {{"tile-colours", "by generation 0"}}), "expected a number of steps"));
    EXPECT_TRUE(has(message("tilings/chair", {{"tile-colours", "by generation 1 2"}}), "expected a number of steps"));
    EXPECT_TRUE(has(message("tilings/chair", {{"tile-edges", "twice"}}), "each, once, border or none"));
}

}  // namespace sikku::tile_drawing_test
