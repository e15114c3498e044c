// Windows into tilings: tile for tile against the whole word, and without gaps far out in words too long to be read.
#include "art/deep/window_drawing.h"
#include "art/writer/draw_options.h"
#include "art/writer/make_drawing.h"

#include "art/prints.h"
#include "engine/derivation/derivation.h"
#include "engine/geometry/turtle.h"
#include "tests/checks.h"
#include "tests/files.h"
#include "tests/print_tools.h"
#include "tests/reference.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <pugixml.hpp>

#include <algorithm>
#include <cmath>
#include <memory>
#include <set>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

namespace sikku::window_drawing_test {

struct Tile {
    std::vector<glm::dvec2> corners;
    int colour = 0;
};

/// Polygons of a drawing that overlap a box.
struct Tiles : PathSink {
    explicit Tiles(const Box& seen) : box(seen) {}
    void begin_stroke(glm::dvec2 start, const Pen&) override { at = start; }
    void lines(std::span<const glm::dvec2> ends) override {
        for (const glm::dvec2 end : ends) {
            const glm::dvec2 low = glm::min(at, end), high = glm::max(at, end);
            if (low.x < box.high.x && high.x > box.low.x && low.y < box.high.y && high.y > box.low.y) {
                length += glm::distance(at, end);
            }
            at = end;
        }
    }
    void curves(std::span<const glm::dvec2>) override { FAIL(); }
    void change_pen(const Pen&) override {}
    void end_stroke(bool) override {}
    void polygon(std::span<const glm::dvec2> vertices, const Pen& pen) override {
        glm::dvec2 low = vertices[0], high = vertices[0];
        for (const glm::dvec2 vertex : vertices) {
            low = glm::min(low, vertex);
            high = glm::max(high, vertex);
        }
        if (low.x < box.high.x && high.x > box.low.x && low.y < box.high.y && high.y > box.low.y) {
            all.push_back({{vertices.begin(), vertices.end()}, pen.colour});
        }
    }
    void disc(glm::dvec2, double, const Pen&) override { FAIL(); }

    Box box;
    std::vector<Tile> all;
    double length = 0;  ///< of lines near the box
    glm::dvec2 at{0.0};
};

std::shared_ptr<const Grammar> tiling(const std::string& name, const std::string& steps) {
    return std::make_shared<const Grammar>(
        reference::grammar_of(contents(bundled("tilings/" + name)), {{"-n", "derivation length", steps}}));
}

DrawOptions window_options(const std::string& window) {
    DrawOptions options;
    options.window = parse_window(window);
    return options;
}

/// What the window shows, from its lower left corner.
Tiles shown(std::shared_ptr<const Grammar> grammar, const std::string& text) {
    std::string why;
    const DrawOptions options = window_options(text);
    const auto drawing =
        WindowDrawing::make(std::move(grammar), plain_print().style, options, options.reading(), why);
    EXPECT_TRUE(drawing) << why;
    Print print = plain_print();
    drawing->place(print);
    Box box;
    box.add({0, 0});
    box.add({static_cast<double>(options.window->x1 - options.window->x0),
             static_cast<double>(options.window->y1 - options.window->y0)});
    Tiles tiles(box);
    drawing->read(print, tiles);
    return tiles;
}

/// Area of the part of a polygon within a box: it is cut at each side.
double area_inside(std::vector<glm::dvec2> polygon, const Box& box) {
    for (int side = 0; side < 4; ++side) {
        const int axis = side % 2;
        const auto depth = [&](glm::dvec2 at) {
            return side < 2 ? at[axis] - box.low[axis] : box.high[axis] - at[axis];
        };
        std::vector<glm::dvec2> kept;
        for (std::size_t i = 0; i < polygon.size(); ++i) {
            const glm::dvec2 a = polygon[i], b = polygon[(i + 1) % polygon.size()];
            if (depth(a) >= 0) kept.push_back(a);
            if ((depth(a) >= 0) != (depth(b) >= 0)) kept.push_back(a + (b - a) * (depth(a) / (depth(a) - depth(b))));
        }
        polygon = std::move(kept);
    }
    double twice = 0;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const glm::dvec2 a = polygon[i], b = polygon[(i + 1) % polygon.size()];
        twice += a.x * b.y - a.y * b.x;
    }
    return std::fabs(twice) / 2;
}

TEST(WindowDrawing, ShowsTheTilesOfTheWholeWord) {
    const std::vector<std::pair<const char*, const char*>> tilings{{"penrose-rhombs", "9"},
                                                                   {"penrose-kite-dart", "9"},
                                                                   {"ammann-beenker", "6"},
                                                                   {"chair", "8"},
                                                                   {"sphinx", "7"},
                                                                   {"half-hex", "8"},
                                                                   {"gosper-islands", "6"},
                                                                   {"fibonacci-squares", "10"},
                                                                   {"hat", "5"},
                                                                   {"spectre", "5"},
                                                                   {"danzer", "5"},
                                                                   {"socolar", "4"},
                                                                   {"shield", "7"},
                                                                   {"ammann-a3", "10"},
                                                                   {"golden-bee", "23"},
                                                                   {"pinwheel", "7"},
                                                                   {"pinwheel-13", "4"},
                                                                   {"snub-square", "200"}};
    for (const auto& [name, steps] : tilings) {
        const auto grammar = tiling(name, steps);
        Box everything;
        everything.add({-1e9, -1e9});
        everything.add({1e9, 1e9});
        Tiles whole(everything);
        derive(*grammar, *Turtle::drawing(*grammar, whole, false), {.interpreted = true});
        // Around a tile in the middle of the word.
        const glm::dvec2 low = glm::round(whole.all.at(whole.all.size() / 2).corners[0]) - glm::dvec2(7.25, 5.25);
        const glm::dvec2 high = low + glm::dvec2(16, 12);
        const Tiles seen = shown(grammar, fmt::format("{},{},{},{}", low.x, low.y, high.x, high.y));
        Tiles expected(Box{low, high});
        derive(*grammar, *Turtle::drawing(*grammar, expected, false), {.interpreted = true});
        ASSERT_EQ(seen.all.size(), expected.all.size()) << name;
        EXPECT_GT(seen.all.size(), 5u) << name;
        for (std::size_t i = 0; i < seen.all.size(); ++i) {
            ASSERT_EQ(seen.all[i].corners.size(), expected.all[i].corners.size()) << name;
            EXPECT_EQ(seen.all[i].colour, expected.all[i].colour) << name;
            for (std::size_t k = 0; k < seen.all[i].corners.size(); ++k) {
                EXPECT_LT(glm::distance(seen.all[i].corners[k] + low, expected.all[i].corners[k]), 1e-8) << name;
            }
        }
        EXPECT_NEAR(seen.length, expected.length, 1e-6) << name;
    }
}

/// Fifteen places, up to half way to the border, in tilings of up to 10^33 tiles.
TEST(WindowDrawing, LeavesNoGapsFarOut) {
    const std::vector<std::tuple<const char*, const char*, double>> tilings{
        {"penrose-rhombs", "40", 1e8},  {"penrose-rhombs", "80", 1e16}, {"penrose-kite-dart", "40", 1e7},
        {"ammann-beenker", "40", 1e14}, {"pinwheel", "20", 1e6},        {"chair", "40", 1e12}};
    for (const auto& [name, steps, reach] : tilings) {
        const auto grammar = tiling(name, steps);
        for (const double direction : {0.3, 1.9, 4.0}) {
            const double x = std::round(reach * 0.3 * std::cos(direction));
            const double y = std::round(reach * 0.3 * std::sin(direction));
            const bool is_in_a_corner = std::string_view(name) == "chair" || std::string_view(name) == "pinwheel";
            if (is_in_a_corner && direction > 1) continue;
            const Tiles seen = shown(grammar, fmt::format("{:.0f},{:.0f},{:.0f},{:.0f}", x, y, x + 30, y + 20));
            double area = 0;
            for (const Tile& tile : seen.all) area += area_inside(tile.corners, seen.box);
            EXPECT_NEAR(area, 600, 1e-5) << name << " " << steps << " at " << x << " " << y;
        }
    }
}

TEST(WindowDrawing, FillsPages) {
    const auto filled = [](const std::string& name, glm::dvec2 size, std::string& why) {
        return find_filled_page(*tiling(name, "3"), plain_print().style, size, 2, {}, why);
    };
    std::string why;
    for (const char* name :
         {"penrose-rhombs", "chair", "hat", "spectre", "snub-square", "rauzy", "danzer", "pinwheel"}) {
        const auto found = filled(name, {30, 20}, why);
        ASSERT_TRUE(found) << name << ": " << why;
        const auto number = [](Quad value) { return fmt::format("{:.0f}", static_cast<double>(value)); };
        const ViewWindow& at = found->window;
        const auto grammar = tiling(name, std::to_string(found->steps));
        // Read whole, as a second way.
        Box box;
        box.add({static_cast<double>(at.x0) - 2, static_cast<double>(at.y0) - 2});
        box.add({static_cast<double>(at.x1) + 2, static_cast<double>(at.y1) + 2});
        Tiles tiles(box);
        derive(*grammar, *Turtle::drawing(*grammar, tiles, false), {.interpreted = true});
        double area = 0;
        for (const Tile& tile : tiles.all) area += area_inside(tile.corners, box);
        EXPECT_NEAR(area, 34 * 24, 1e-5) << name << " at " << number(at.x0) << ' ' << number(at.y0);
    }
    EXPECT_FALSE(filled("chair", {3e4, 2e4}, why));
    EXPECT_TRUE(has(why, "square steps"));
    // Unit squares in the places of chairs leave gaps.
    std::string squares = contents(bundled("tilings/chair"));
    for (std::size_t at; (at = squares.find("{FF+F+F-F+F+FF;")) != std::string::npos;) {
        squares.replace(at, 15, "{F+F+F+F;");
    }
    EXPECT_FALSE(
        find_filled_page(parse("squares.lsys", squares).grammar(), plain_print().style, {30, 20}, 2, {}, why));
    EXPECT_TRUE(has(why, "cover no place of this size up to a derivation length of 93; beyond it, at n = 103"));
    for (const char* name : {"curves/hilbert", "kolams/snake-kolam"}) {
        const auto grammar = load(bundled(name)).grammar();
        EXPECT_FALSE(find_filled_page(grammar, plain_print().style, {30, 20}, 2, {}, why)) << name;
        EXPECT_EQ(why, "this drawing has no tiles, which are polygons between { and }");
    }
}

TEST(WindowDrawing, IsDrawnInColoursAndWithEdgesOnce) {
    const auto svg = [](const OptionValues& more) {
        OptionValues values{
            {"derivation length", "40"}, {"window", "100000000,3,100000040,43"}, {"size", "100x100mm"}};
        values.insert(values.end(), more.begin(), more.end());
        return draw(load(bundled("tilings/penrose-rhombs")), "svg", values);
    };
    const auto fills = [](const std::string& text) {
        pugi::xml_document document;
        EXPECT_TRUE(document.load_string(text.c_str()));
        std::set<std::string> colours;
        for (const auto& group : document.select_nodes("//g[@fill and not(@fill='none')]")) {
            colours.insert(group.node().attribute("fill").value());
        }
        return colours.size();
    };
    EXPECT_EQ(fills(svg({})), 2u);
    EXPECT_EQ(fills(svg({{"tile-colours", "by neighbours"}})), 3u);
    EXPECT_LT(svg({{"tile-edges", "once"}}).size(), svg({}).size());
    EXPECT_EQ(svg({}), svg({}));
}

/// Tiles of one direction have one colour in all windows of a tiling.
TEST(WindowDrawing, HasTheSameColoursEverywhere) {
    Style style = plain_print().style;
    style.tile_colours = TileColours::direction;
    std::map<std::vector<std::pair<long, long>>, int> colours;  // of the sides of a tile
    for (const char* window : {"100000000,3,100000030,23", "-3000000,7000000,-2999970,7000020", "5,5,25,25"}) {
        const auto drawing = make_drawing(*tiling("penrose-rhombs", "40"), style, window_options(window));
        Print print = plain_print();
        drawing->place(print);
        Box box;
        box.add({0, 0});
        box.add({30, 20});
        Tiles tiles(box);
        drawing->read(print, tiles);
        EXPECT_GT(tiles.all.size(), 100u);
        for (const Tile& tile : tiles.all) {
            std::vector<std::pair<long, long>> sides;
            for (std::size_t i = 0; i < tile.corners.size(); ++i) {
                const glm::dvec2 side = tile.corners[(i + 1) % tile.corners.size()] - tile.corners[i];
                sides.emplace_back(std::lround(side.x * 1e4), std::lround(side.y * 1e4));
            }
            std::rotate(sides.begin(), std::min_element(sides.begin(), sides.end()), sides.end());
            EXPECT_EQ(colours.try_emplace(sides, tile.colour).first->second, tile.colour);
        }
    }
    EXPECT_EQ(colours.size(), 10u);
}

/// Errors of computed lengths add up; windows are refused before gaps appear between tiles.
TEST(WindowDrawing, RefusesPlacesThatAreNotPrecise) {
    std::string why;
    EXPECT_FALSE(WindowDrawing::make(tiling("pinwheel", "40"), plain_print().style,
                                     window_options("10000000,5,10000030,25"), Reading{}, why));
    EXPECT_TRUE(has(why, "decimal lengths"));
    EXPECT_TRUE(has(
        error_of([&] {
            draw(load(bundled("tilings/pinwheel")), "svg", {{"derivation length", "40"}, {"window", "5,5,25,25"}});
        }),
        "a smaller derivation length"));
}

TEST(WindowDrawing, SaysWhyPartsCannotBeFound) {
    const auto message = [](const std::string& text) {
        return error_of([&] { draw(parse("test.lsys", text), "svg", {{"window", "0,0,10,10"}}); });
    };
    const std::string square = "derivation length: 60\nangle increment: 90\n";
    EXPECT_TRUE(has(message("axiom: {A}\nA --> AF+A\n" + square), "10,000 symbols"));
    EXPECT_TRUE(has(message("axiom: A\nA --> A;A{F+F+F}\n" + square), "10,000 symbols"));
    EXPECT_TRUE(has(message("axiom: A\nA --> A{F+F+F}A\nline: spline\n" + square), "need the whole drawing"));
    // Nothing is there.
    EXPECT_EQ(message("axiom: A\nA --> [{F+F+F}]fA\n" + square), "");
}

}  // namespace sikku::window_drawing_test
