// The examination of tilings: numbers of tiles, edges, figures and so on that the literature or a script by itself
// found, and polygons that are no tiling, made on purpose.
#include "engine/tiling/tiling.h"
#include "engine/derivation/derivation.h"
#include "engine/tiling/tile_growth.h"
#include "engine/tiling/tiling_text.h"
#include "tests/checks.h"
#include "tests/files.h"
#include "tests/module_reference.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <map>
#include <random>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace sikku::tiling_test {

std::string report(const std::string& title, std::int64_t n, const TilingExamination& t) {
    return tiling_text(title, n, t, TileGrowth());
}

TilingResult examined(const std::string& text, const std::vector<Setting>& settings = {},
                      std::string_view variant = {}) {
    return examine_tiling(reference::grammar_of(text, settings, variant), {});
}
TilingResult bundled(const std::string& name, int n, std::string_view variant = {}) {
    return examined(contents(std::filesystem::path(SIKKU_SOURCE_DIR) / "patterns/tilings" / (name + ".lsys")),
                    {{"-n", "derivation length", std::to_string(n)}}, variant);
}
/// A pattern whose word is `axiom`, with turns by 360 / k degrees.
TilingExamination word(const std::string& axiom, int k = 4, const std::string& more = {}) {
    return examined("derivation length: 0\nangle factor: " + std::to_string(k) +
                    "\nturn: left\nheading: 0\naxiom: " + axiom + "\n" + more)
        .examination;
}

/// Names and numbers of shapes, with orientations: `170 rhomb 5`.
std::vector<std::string> shapes(const TilingExamination& t) {
    std::vector<std::string> list;
    for (const TileShape& shape : t.shapes) {
        list.push_back(std::to_string(shape.tiles) + ' ' + shape_name(shape) + ' ' +
                       std::to_string(shape.orientations));
    }
    std::sort(list.begin(), list.end());
    return list;
}

struct Fact {
    const char* name;
    int n;
    std::vector<std::string> shapes;
    std::uint64_t edges, border;
    std::size_t figures;
    bool exact;
    const char* symmetry;
    int colours;  ///< 0: beyond the search of the script that found the other facts
};

// clang-format off
const std::vector<Fact> facts = {
    {"penrose-rhombs", 5, {"170 rhomb 5", "275 rhomb 5"}, 935, 90, 7, true, "C5", 3},
    {"penrose-kite-dart", 4, {"105 dart 10", "170 kite 10"}, 585, 70, 7, true, "C5", 3},
    {"ammann-a3", 5, {"105 hexagon 4", "25 decagon 4", "39 octagon 4"}, 728, 65, 19, true, "C1", 4},
    {"ammann-beenker", 2, {"136 rhomb 4", "96 square 2"}, 520, 112, 5, true, "C8", 3},
    {"ammann-beenker", 3, {"560 square 2", "792 rhomb 4"}, 2840, 272, 6, true, "C8", 3},
    {"chair", 4, {"256 hexagon 4"}, 928, 66, 3, true, "D1", 3},
    {"sphinx", 3, {"64 pentagon 11"}, 190, 23, 6, true, "C1", 3},
    {"half-hex", 4, {"512 trapezoid 6"}, 1057, 66, 3, true, "D2", 3},
    {"table", 4, {"256 rectangle 2"}, 687, 64, 2, true, "D2", 4},
    {"p-pentomino", 4, {"256 hexagon 8"}, 960, 57, 3, true, "C1", 0},
    {"twin-dragon", 9, {"512 square 1"}, 1233, 418, 1, true, "C2", 2},
    {"gosper-islands", 3, {"343 hexagon 1"}, 1110, 162, 1, true, "C6", 3},
    {"fibonacci-squares", 5, {"25 square 1", "64 square 1", "80 rectangle 2"}, 364, 52, 3, true, "D1", 2},
    {"pinwheel", 4, {"1250 triangle 30"}, 2177, 90, 8, false, "C2", 0},
    {"hat", 3, {"377 13-gon 12"}, 2774, 463, 5, true, "C1", 4},
    {"hat-equal", 3, {"377 13-gon 12"}, 2774, 463, 5, true, "C1", 4},
    {"spectre", 3, {"559 13-gon 12"}, 4121, 669, 5, true, "C1", 4},
    {"trihexagonal", 16, {"128 triangle 2", "64 hexagon 1"}, 426, 84, 1, true, "C1", 2},
    {"rhombitrihexagonal", 14, {"147 square 3", "49 hexagon 1", "98 triangle 2"}, 632, 88, 1, true, "C1", 2},
    {"truncated-square", 14, {"49 octagon 1", "49 square 1"}, 335, 82, 1, true, "D1", 3},
    {"truncated-hexagonal", 12, {"36 dodecagon 1", "72 triangle 2"}, 379, 110, 1, true, "C1", 4},
    {"snub-square", 16, {"128 square 2", "256 triangle 4"}, 679, 78, 1, true, "C1", 3},
    {"elongated-triangular", 18, {"162 triangle 2", "81 square 1"}, 436, 62, 1, true, "C1", 3},
    {"socolar", 2, {"434 hexagon 2", "699 square 3", "726 rhomb 6"}, 4302, 300, 5, true, "D1", 3},
    {"shield", 4, {"1700 triangle 4", "338 hexagon 4", "543 square 3"}, 4746, 192, 4, true, "D1", 3},
    {"voderberg-spiral", 4, {"750 enneagon 30"}, 3455, 160, 5, true, "C2", 2},
    {"tumbling-blocks", 16, {"192 rhomb 3"}, 415, 62, 2, true, "C1", 3},
    {"herringbone", 16, {"128 rectangle 2"}, 414, 77, 1, true, "C1", 3},
    {"pythagorean", 14, {"49 square 1", "49 square 1"}, 320, 67, 1, true, "C1", 3},
};
// clang-format on

class TilingFacts : public ::testing::TestWithParam<Fact> {};

TEST_P(TilingFacts, AreFound) {
    const Fact& fact = GetParam();
    const TilingResult result = bundled(fact.name, fact.n);
    const TilingExamination& t = result.examination;
    EXPECT_TRUE(t.is_tiling()) << report(fact.name, fact.n, t);
    EXPECT_EQ(t.is_exact, fact.exact);
    EXPECT_EQ(t.regions, 1U);
    EXPECT_EQ(t.loops, 1U);
    EXPECT_EQ(shapes(t), fact.shapes);
    EXPECT_EQ(t.edges, fact.edges);
    EXPECT_EQ(t.border_edges, fact.border);
    EXPECT_EQ(t.inner_edges, fact.edges - fact.border);
    EXPECT_EQ(t.figures.size(), fact.figures) << report(fact.name, fact.n, t);
    std::uint64_t vertices = 0, tiles = 0, ends = 0;
    for (const VertexFigure& figure : t.figures) {
        double sum = 0;
        for (const double angle : figure.angles) sum += angle;
        EXPECT_NEAR(sum, 360, 1e-6);
        vertices += figure.count;
    }
    EXPECT_EQ(vertices, t.inner_vertices);
    for (const auto& [neighbours, count] : t.neighbour_counts) {
        tiles += count;
        ends += neighbours * count;
    }
    EXPECT_EQ(tiles, t.tiles);
    EXPECT_EQ(ends, 2 * t.neighbours);
    EXPECT_EQ(t.symmetry.name(), fact.symmetry);
    if (fact.colours > 0) {
        EXPECT_EQ(t.least_colours, fact.colours);
        EXPECT_EQ(t.most_colours, fact.colours);
    }
    const std::vector<std::uint32_t>& colours = result.patch.colours;
    ASSERT_EQ(colours.size(), t.tiles);
    for (std::uint32_t tile = 0; tile < colours.size(); ++tile) {
        EXPECT_LT(colours[tile], static_cast<std::uint32_t>(t.most_colours));
        for (const std::uint32_t other : result.patch.neighbours.of(tile)) EXPECT_NE(colours[tile], colours[other]);
    }
}
std::string name_of(const ::testing::TestParamInfo<Fact>& info) {
    std::string name = info.param.name + std::string("_") + std::to_string(info.param.n);
    std::replace(name.begin(), name.end(), '-', '_');
    return name;
}
INSTANTIATE_TEST_SUITE_P(Patterns, TilingFacts, ::testing::ValuesIn(facts), name_of);

/// At its own derivation length, without exception.
TEST(TilingExamination, CertifiesAllBundledTilings) {
    const std::filesystem::path folder = std::filesystem::path(SIKKU_SOURCE_DIR) / "patterns/tilings";
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
        const TilingExamination t = examined(contents(entry.path())).examination;
        EXPECT_TRUE(t.is_tiling()) << entry.path() << '\n' << report("", 0, t);
        EXPECT_EQ(t.regions, 1U) << entry.path();
    }
}

/// Angles of each figure and the number of such vertices; figures of equal angles together.
std::map<std::string, std::vector<std::uint64_t>> figures_of(const std::string& name, int n) {
    std::map<std::string, std::vector<std::uint64_t>> result;
    for (const VertexFigure& figure : bundled(name, n).examination.figures) {
        std::string angles;
        for (const double angle : figure.angles) {
            angles += (angles.empty() ? "" : ".") + std::to_string(std::lround(angle));
        }
        result[angles].push_back(figure.count);
    }
    return result;
}

/// The least rotation or reflection of angles.
std::string normal(const std::string& angles) {
    std::vector<int> list;
    std::istringstream words(angles);
    for (std::string word; std::getline(words, word, '.');) list.push_back(std::stoi(word));
    std::vector<int> least = list;
    for (int reflection = 0; reflection < 2; ++reflection) {
        for (std::size_t i = 0; i < list.size(); ++i) {
            std::rotate(list.begin(), list.begin() + 1, list.end());
            least = std::min(least, list);
        }
        std::reverse(list.begin(), list.end());
    }
    std::string text;
    for (const int angle : least) text += (text.empty() ? "" : ".") + std::to_string(angle);
    return text;
}

TEST(TilingVertices, HaveThePublishedFigures) {
    using Figures = std::map<std::string, std::vector<std::uint64_t>>;
    const std::map<std::pair<std::string, int>, Figures> published = {
        {{"penrose-rhombs", 7},
         {{"108.108.144", {1130}},
          {"36.72.36.108.108", {685}},
          {"72.144.144", {440}},
          {"72.72.72.144", {265}},
          {"36.36.72.36.36.72.72", {165}},
          {"72.72.72.72.72", {151}},
          {"36.36.72.72.72.72", {100}}}},
        {{"penrose-kite-dart", 7},
         {{"72.72.216", {1835}},
          {"36.36.144.144", {1130}},
          {"36.72.72.36.144", {695}},
          {"72.72.72.72.72", {440, 305, 265, 111}}}},
        {{"ammann-beenker", 4},
         {{"90.135.135", {3168}},
          {"45.90.135.90", {2608}},
          {"45.90.45.90.90", {1040}},
          {"45.45.45.90.45.90", {464}},
          {"45.45.45.45.45.45.45.45", {193}},
          {"45.45.45.45.45.45.90", {80}}}},
        {{"hat", 4},
         {{"120.240", {5166}},
          {"90.270", {4806}},
          {"120.120.120", {2091}},
          {"90.90.180", {1267}},
          {"90.90.90.90", {658}}}},
        {{"spectre", 4},
         {{"120.240", {8800}},
          {"90.270", {8192}},
          {"120.120.120", {3604}},
          {"90.90.180", {2416}},
          {"90.90.90.90", {992}}}},
        {{"half-hex", 6}, {{"120.120.120", {4096}}, {"60.60.60.60.60.60", {1986}}, {"60.60.120.120", {1982}}}},
        {{"chair", 6}, {{"90.270", {4095}}, {"90.90.180", {4094}}, {"90.90.90.90", {1922}}}},
    };
    for (const auto& [pattern, expected] : published) {
        Figures found, wanted;
        for (const auto& [angles, counts] : figures_of(pattern.first, pattern.second)) {
            auto& list = found[normal(angles)];
            list.insert(list.end(), counts.begin(), counts.end());
        }
        for (const auto& [angles, counts] : expected) wanted[normal(angles)] = counts;
        EXPECT_EQ(found, wanted) << pattern.first;
    }
}

const std::string square = "{F+F+F+F}";

TEST(TilingExamination, FindsASingleTile) {
    const TilingExamination t = word(square);
    EXPECT_TRUE(t.is_tiling());
    EXPECT_TRUE(t.is_exact);
    EXPECT_EQ(t.tiles, 1U);
    EXPECT_EQ(t.edges, 4U);
    EXPECT_EQ(t.border_edges, 4U);
    EXPECT_EQ(t.vertices, 4U);
    EXPECT_EQ(t.inner_vertices, 0U);
    EXPECT_EQ(t.neighbours, 0U);
    EXPECT_DOUBLE_EQ(t.area, 1);
    EXPECT_TRUE(word("{F-F-F-F}").is_tiling()) << "clockwise";
    EXPECT_TRUE(word("{FF+FFF+FF+FFF}").is_tiling()) << "points on straight stretches";
    EXPECT_EQ(word("{FF+FFF+FF+FFF}").edges, 4U);
}

/// Polygons, each drawn after a way from the origin.
std::string drawn(const std::vector<std::pair<std::string, std::string>>& polygons) {
    std::string text;
    for (const auto& [way, polygon] : polygons) text += "[" + way + "{" + polygon + "}]";
    return text;
}
/// Unit squares with these columns and rows.
std::string squares(const std::vector<std::pair<int, int>>& places) {
    std::string text;
    for (const auto& [x, y] : places) {
        text += "[" + std::string(static_cast<std::size_t>(x), 'f') + "+" +
                std::string(static_cast<std::size_t>(y), 'f') + "-{F+F+F+F}]";
    }
    return text;
}

TEST(TilingExamination, CutsEdgesAtCornersOfOthers) {
    const TilingExamination t = word(drawn({{"", "FF+FF+FF+FF"}, {"ff", "F+F+F+F"}}));
    EXPECT_TRUE(t.is_tiling());
    EXPECT_EQ(t.edges_cut, 1U);
    EXPECT_EQ(t.edges, 8U);
    EXPECT_EQ(t.inner_edges, 1U);
    EXPECT_EQ(t.neighbours, 1U);
}

void expect_overlap(const std::vector<std::pair<std::string, std::string>>& polygons, std::uint32_t first,
                    std::uint32_t second, int k = 4) {
    const std::string axiom = drawn(polygons);
    const TilingExamination t = word(axiom, k);
    EXPECT_FALSE(t.is_tiling()) << axiom;
    EXPECT_GE(t.violations.count, t.violations.list.size());
    bool is_named = false;
    for (const TileViolation& violation : t.violations.list) {
        EXPECT_EQ(violation.fault, TileFault::overlap) << axiom;
        is_named = is_named || (violation.other == first && violation.tile == second);
    }
    EXPECT_TRUE(is_named) << axiom << '\n' << report("", 0, t);
}

TEST(TilingExamination, FindsOverlaps) {
    const std::string one = "F+F+F+F", two = "FF+FF+FF+FF", three = "FFF+FFF+FFF+FFF";
    expect_overlap({{"", two}, {"f", one}}, 1, 2);       // inside, at an edge
    expect_overlap({{"", two}, {"", one}}, 1, 2);        // inside, at a corner
    expect_overlap({{"", two}, {"f+f-", two}}, 1, 2);    // edges cross
    expect_overlap({{"", three}, {"f+f-", one}}, 1, 2);  // inside, without touching
    expect_overlap({{"f+f-", one}, {"", three}}, 1, 2);  // around, without touching
    // A cross: no corner lies in the other tile.
    expect_overlap({{"+f-", "FFF+F+FFF+F"}, {"f", "F+FFF+F+FFF"}}, 1, 2);
    // The same border, twice covered.
    expect_overlap({{"", one}, {"f", one}, {"", "FF+F+FF+F"}}, 1, 3);
    expect_overlap({{"", one}, {"f", one}, {"", "FF+F+FF+F"}}, 2, 3);
    expect_overlap({{"", "F++F++F"}, {"", "F+F++F+F"}}, 1, 2, 6);  // one angle within another
    // Two tiles inside: they are a region where a gap would have to be.
    expect_overlap({{"", "FFFF+FFF+FFFF+FFF"}, {"f+f-", one}, {"ff+f-", one}}, 1, 2);
    // A tile in a gap, and one around it.
    expect_overlap({{"", "FFFFF+FFFFF+FFFFF+FFFFF"}, {"f+f-", three}, {"ff+ff-", one}}, 1, 2);
}

TEST(TilingExamination, CountsRegionsThatTouchInACornerAsTwo) {
    const TilingExamination t = word(squares({{0, 0}, {1, 1}}));
    EXPECT_TRUE(t.is_tiling()) << report("", 0, t);
    EXPECT_EQ(t.regions, 2U);
    EXPECT_EQ(t.components, 1U);
    EXPECT_EQ(t.loops, 1U) << "around both";
    EXPECT_TRUE(has(report("", 0, t), "yes: 2 tiles, 2 regions joined at corners, no gap"));
    EXPECT_EQ(t.vertices, 7U);
    EXPECT_EQ(t.neighbours, 0U);
    EXPECT_TRUE(t.euler_agrees);
    // A corner in the middle of another tile's edge: a rhomb on a square.
    const TilingExamination wedge = word("[{FF+++FF+++FF+++FF}][ff+++f----{F++F++++F++F}]", 12);
    EXPECT_TRUE(wedge.is_tiling()) << report("", 0, wedge);
    EXPECT_EQ(wedge.regions, 2U);
    EXPECT_EQ(wedge.edges_cut, 1U);
    EXPECT_EQ(wedge.edges, 9U);
}

const std::vector<std::pair<int, int>> ring = {{0, 0}, {1, 0}, {2, 0}, {0, 1}, {2, 1}, {0, 2}, {1, 2}, {2, 2}};

TEST(TilingExamination, FindsGaps) {
    const TilingExamination t = word(squares(ring));
    EXPECT_FALSE(t.is_tiling());
    EXPECT_EQ(t.violations.count, 0U);
    ASSERT_EQ(t.gaps.size(), 1U);
    EXPECT_NEAR(t.gaps[0].area, 1, 1e-12);
    EXPECT_NEAR(t.gaps[0].centre.x, 1.5, 1e-12);
    EXPECT_NEAR(t.gaps[0].centre.y, 1.5, 1e-12);
    EXPECT_EQ(t.regions, 1U);
    EXPECT_TRUE(t.euler_agrees);
    EXPECT_TRUE(t.areas_agree);
    EXPECT_TRUE(has(report("", 0, t), "of area 1 around 1.5 1.5"));
    // A small square in the gap: a region within a gap within a region.
    const TilingExamination island = word(squares(ring) + "[f(1.25)+f(1.25)-{F(0.5)+F(0.5)+F(0.5)+F(0.5)}]");
    EXPECT_TRUE(island.is_exact);
    EXPECT_EQ(island.violations.count, 0U) << report("", 0, island);
    EXPECT_EQ(island.regions, 2U);
    ASSERT_EQ(island.gaps.size(), 1U);
    EXPECT_NEAR(island.gaps[0].area, 0.75, 1e-12) << "without the island";
    EXPECT_EQ(island.components, 2U);
    EXPECT_TRUE(island.euler_agrees);
    EXPECT_TRUE(island.areas_agree);
}

TEST(TilingExamination, FindsGapsThatTouchInACorner) {
    // A square of 4 x 4 without (1, 1) and (2, 2).
    std::vector<std::pair<int, int>> places;
    for (int x = 0; x < 4; ++x) {
        for (int y = 0; y < 4; ++y) {
            if (x != y || x == 0 || x == 3) places.emplace_back(x, y);
        }
    }
    const TilingExamination t = word(squares(places));
    EXPECT_EQ(t.violations.count, 0U) << report("", 0, t);
    EXPECT_TRUE(t.euler_agrees);
    EXPECT_TRUE(t.areas_agree);
    ASSERT_EQ(t.gaps.size(), 2U);
    for (const TileGap& gap : t.gaps) EXPECT_NEAR(gap.area, 1, 1e-12);
    // A gap that touches the outside at a corner is one.
    places.erase(std::find(places.begin(), places.end(), std::pair(3, 3)));
    EXPECT_EQ(word(squares(places)).gaps.size(), 2U);
}

/// Random unit squares on a grid: facts by counting cells.
TEST(TilingExamination, AgreesWithCellsOfAGrid) {
    std::mt19937 random(7);
    for (int round = 0; round < 60; ++round) {
        const int size = 3 + round % 8;
        std::set<std::pair<int, int>> cells;
        for (int i = 0; i < size * size * (1 + round % 3) / 3; ++i) {
            cells.emplace(static_cast<int>(random() % static_cast<unsigned>(size)),
                          static_cast<int>(random() % static_cast<unsigned>(size)));
        }
        const TilingExamination t = word(squares({cells.begin(), cells.end()}));
        // Components of cells along edges, or along edges and corners.
        const auto components = [&](bool full, bool corners) {
            std::set<std::pair<int, int>> left;
            for (int x = -1; x <= size; ++x) {
                for (int y = -1; y <= size; ++y) {
                    if (cells.contains({x, y}) == full) left.emplace(x, y);
                }
            }
            int count = 0;
            while (!left.empty()) {
                ++count;
                std::vector<std::pair<int, int>> reached = {*left.begin()};
                left.erase(left.begin());
                while (!reached.empty()) {
                    const auto [x, y] = reached.back();
                    reached.pop_back();
                    for (int i = -1; i <= 1; ++i) {
                        for (int j = -1; j <= 1; ++j) {
                            if (!corners && i != 0 && j != 0) continue;
                            if (left.erase({x + i, y + j}) > 0) reached.emplace_back(x + i, y + j);
                        }
                    }
                }
            }
            return static_cast<std::uint64_t>(count);
        };
        ASSERT_EQ(t.violations.count, 0U) << report("", 0, t);
        EXPECT_EQ(t.tiles, cells.size());
        EXPECT_EQ(t.components, components(true, true));
        EXPECT_EQ(t.regions, components(true, false)) << squares({cells.begin(), cells.end()});
        EXPECT_TRUE(t.euler_agrees);
        EXPECT_TRUE(t.areas_agree);
        EXPECT_EQ(t.gaps.size() + 1, components(false, false)) << report("", 0, t);
    }
}

glm::dvec2 place_of_crossing(const std::string& polygon, int k) {
    const TilingExamination t = word("{" + polygon + "}", k);
    EXPECT_EQ(t.violations.list.at(0).fault, TileFault::crossing) << polygon;
    return t.violations.list.at(0).at;
}

TEST(TilingExamination, ReportsCrossingsWhereTheyAre) {
    const auto expect_at = [](const std::string& polygon, int k, double x, double y) {
        const glm::dvec2 at = place_of_crossing(polygon, k);
        EXPECT_NEAR(at.x, x, 1e-9) << polygon;
        EXPECT_NEAR(at.y, y, 1e-9) << polygon;
    };
    expect_at("F++++F++++F++++F++++F", 10, 0.3819660112501051, 0);  // a pentagram: 1/τ² along its first edge
    expect_at("FFF+FF+FF+FFF-F-F", 4, 1, 0);                        // the fourth edge crosses the first
    expect_at("FFFF++FF++FF--FF++FF", 6, 2, 0);                     // a corner on the first edge
    expect_at("FFFF+F+F+F-F+F-FF-F", 4, 2, 0);                      // edges upon each other
}

void expect_fault(const std::string& polygon, TileFault fault, int k = 4) {
    const TilingExamination t = word("[{F+F+F+F}][ff{" + polygon + "}]", k);
    ASSERT_EQ(t.violations.list.size(), 1U) << polygon << '\n' << report("", 0, t);
    EXPECT_EQ(t.violations.list[0].fault, fault) << polygon;
    EXPECT_EQ(t.violations.list[0].tile, 2U) << polygon;
    EXPECT_EQ(t.tiles, 1U);
    EXPECT_FALSE(t.is_tiling());
}

TEST(TilingExamination, LeavesOutPolygonsThatAreNoTiles) {
    expect_fault("F+F+F", TileFault::open);
    expect_fault("FF+F+F+FF-F-F", TileFault::crossing);
    expect_fault("F+F+F+FF-F-F-F", TileFault::crossing);     // two squares that meet in a corner
    expect_fault("FFF+F+F+F-F-F+F+F", TileFault::crossing);  // a corner on its own edge
    expect_fault("F+F+F+FF|F", TileFault::crossing);         // it goes back on its own edge
    expect_fault("FF|FF", TileFault::empty);
}

TEST(TilingExamination, FindsDuplicates) {
    const TilingExamination t = word("[{F+F+F+F}][f+{F-F-F-F}][{F+F+F+F}][f{F+F+F+F}][f+f+{F+F+F+F}]");
    // The second is another one, drawn clockwise; the fifth is the first, from another corner.
    EXPECT_EQ(t.polygons, 5U);
    EXPECT_EQ(t.tiles, 2U);
    ASSERT_EQ(t.violations.list.size(), 3U);
    const std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs = {{3, 1}, {4, 2}, {5, 1}};
    for (std::size_t i = 0; i < pairs.size(); ++i) {
        EXPECT_EQ(t.violations.list[i].fault, TileFault::duplicate);
        EXPECT_EQ(t.violations.list[i].tile, pairs[i].first);
        EXPECT_EQ(t.violations.list[i].other, pairs[i].second);
    }
}

TEST(TilingExamination, HasNothingToExamineWithoutPolygons) {
    const TilingExamination t = word("F+F+F+F");
    EXPECT_FALSE(t.is_tiling());
    EXPECT_EQ(t.polygons, 0U);
    EXPECT_TRUE(has(report("", 0, t), "no: the word contains no polygon"));
}

TEST(TilingExamination, RefusesTooManyTilesBeforeDeriving) {
    EXPECT_THROW(bundled("chair", 40), BudgetError);
    TilingOptions few;
    few.limits.tiles = 100;
    const Grammar grammar =
        reference::grammar_of(contents(std::filesystem::path(SIKKU_SOURCE_DIR) / "patterns/tilings/chair.lsys"));
    EXPECT_THROW(examine_tiling(grammar, few), BudgetError);
    few.limits = {};
    few.limits.bytes = 10'000;
    EXPECT_THROW(examine_tiling(grammar, few), BudgetError);
}

/// Shapes that differ by less than the tolerance of doubles, and tiles that are smaller than it.
TEST(TilingExamination, DistinguishesShapesExactly) {
    const TilingExamination near = word("[{F+F+F+F}][f(2){F(1.000001)+F(1.000001)+F(1.000001)+F(1.000001)}]");
    EXPECT_TRUE(near.is_exact);
    EXPECT_EQ(near.shapes.size(), 2U);
    const TilingExamination small = word(
        "[{F(0.000001)+F(0.000001)+F(0.000001)+F(0.000001)}][f(0.000001){F(0.000001)+"
        "F(0.000002)+F(0.000001)+F(0.000002)}]");
    EXPECT_TRUE(small.is_exact);
    EXPECT_TRUE(small.is_tiling());
    EXPECT_EQ(small.shapes.size(), 2U);
    // The same in doubles: the tolerance follows the edges.
    TilingOptions options;
    options.exact = false;
    const TilingExamination rough =
        examine_tiling(
            reference::grammar_of(
                "derivation length: 0\nangle factor: 4\nturn: left\naxiom: [{F(0.000001)+F(0.000001)+"
                "F(0.000001)+F(0.000001)}][f(0.000001){F(0.000001)+F(0.000001)+F(0.000001)+F(0.000001)}]\n"),
            options)
            .examination;
    EXPECT_TRUE(rough.is_tiling());
    EXPECT_LE(rough.tolerance, 1e-8);
    EXPECT_EQ(rough.tiles, 2U);
}

/// Doubles cannot distinguish positions that are much larger than edges; then nothing is claimed.
TEST(TilingExamination, RefusesPositionsThatAreTooLarge) {
    EXPECT_TRUE(bundled("fibonacci-spiral", 50).examination.is_tiling());
    for (const char* name : {"fibonacci-spiral", "padovan-spiral"}) {
        try {
            bundled(name, 200);
            ADD_FAILURE() << name;
        } catch (const BudgetError& error) {
            EXPECT_EQ(std::string(error.what()).substr(0, 19), "positions of up to ") << error.what();
        }
    }
}

TEST(TilingExamination, SaysWhatIsNotExact) {
    EXPECT_EQ(word(square).inexact, "");
    EXPECT_EQ(bundled("pinwheel", 2).examination.inexact, "the parameters of 'f' are computed");
    EXPECT_EQ(word("{F+(26.56505117707799)F+F}").inexact,
              "'+(26.56505117707799)' does not turn by a simple fraction of 360 degrees");
    EXPECT_EQ(word("{F+F+F+F}", 22).inexact, "turns by 360/22 degrees lead to places with more than 8 coordinates");
    const std::string golden = word("{F(1.618033988749895)+++F+F+++F(1.618033988749895)}", 10).inexact;
    EXPECT_EQ(golden,
              "the length of 'F(1.618033988749895)' is not a short decimal; 'edge SYMBOL:' states lengths "
              "exactly");
    const TilingExamination far = word("[f(1000000000){F+F+F+F}]f(0.000001)");
    EXPECT_FALSE(far.is_exact);
    EXPECT_FALSE(far.inexact.empty());
}

TEST(TilingExamination, StopsOnRequest) {
    TilingOptions options;
    options.monitor = Monitor([](void*) { return true; });
    const Grammar grammar =
        reference::grammar_of(contents(std::filesystem::path(SIKKU_SOURCE_DIR) / "patterns/tilings/chair.lsys"));
    EXPECT_THROW(examine_tiling(grammar, options), Stopped);
}

/// Random graphs: whether three colours suffice, by trying all colourings.
TEST(TileColours, AgreeWithTryingAll) {
    std::mt19937 random(11);
    int impossible = 0;
    for (int round = 0; round < 400; ++round) {
        const std::uint32_t tiles = 4 + round % 7;
        std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
        const int count = static_cast<int>(tiles * (1 + random() % 3)) - 2;
        for (int i = 0; i < count; ++i) {
            const std::uint32_t a = static_cast<std::uint32_t>(random() % tiles),
                                b = static_cast<std::uint32_t>(random() % tiles);
            if (a != b) edges.insert(std::minmax(a, b));
        }
        const std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs(edges.begin(), edges.end());
        const TileNeighbours neighbours(tiles, pairs);
        const TileColouring found = find_colours(neighbours, {}, {});
        int fewest = 4;
        for (std::uint32_t colours = 3; colours >= 1; --colours) {
            std::uint32_t all = 1;
            for (std::uint32_t i = 0; i < tiles; ++i) all *= colours;
            for (std::uint32_t code = 0; code < all; ++code) {
                std::vector<std::uint32_t> colour(tiles);
                for (std::uint32_t i = 0, rest = code; i < tiles; ++i, rest /= colours) colour[i] = rest % colours;
                if (std::none_of(pairs.begin(), pairs.end(),
                                 [&](const auto& pair) { return colour[pair.first] == colour[pair.second]; })) {
                    fewest = static_cast<int>(colours);
                    break;
                }
            }
        }
        impossible += fewest == 4 ? 1 : 0;
        EXPECT_EQ(found.at_least, fewest);
        // Some of these graphs are not planar.
        EXPECT_GE(found.at_most, fewest);
        EXPECT_TRUE(fewest == 4 || found.at_most == fewest);
        for (const auto& [a, b] : pairs) {
            EXPECT_NE(found.colours[a], found.colours[b]);
        }
    }
    EXPECT_GT(impossible, 20);
}

/// Polygons on a lattice and the same in doubles have the same facts.
TEST(TilingExamination, FindsTheSameInDoubles) {
    for (const char* name : {"penrose-rhombs", "chair", "sphinx", "gosper-islands", "spectre"}) {
        const std::string text =
            contents(std::filesystem::path(SIKKU_SOURCE_DIR) / "patterns/tilings" / (std::string(name) + ".lsys"));
        const Grammar grammar = reference::grammar_of(text, {{"-n", "derivation length", "3"}});
        const TilingExamination exact = examine_tiling(grammar, {}).examination;
        TilingOptions options;
        options.exact = false;
        const TilingExamination rough = examine_tiling(grammar, options).examination;
        EXPECT_TRUE(exact.is_exact);
        EXPECT_FALSE(rough.is_exact);
        EXPECT_EQ(exact.is_tiling(), rough.is_tiling()) << name;
        EXPECT_EQ(shapes(exact), shapes(rough)) << name;
        EXPECT_EQ(exact.edges, rough.edges) << name;
        EXPECT_EQ(exact.border_edges, rough.border_edges) << name;
        EXPECT_EQ(exact.edges_cut, rough.edges_cut) << name;
        EXPECT_EQ(exact.neighbours, rough.neighbours) << name;
        EXPECT_EQ(exact.symmetry.name(), rough.symmetry.name()) << name;
        ASSERT_EQ(exact.figures.size(), rough.figures.size()) << name;
        for (std::size_t i = 0; i < exact.figures.size(); ++i)
            EXPECT_EQ(exact.figures[i].count, rough.figures[i].count);
    }
}

}  // namespace sikku::tiling_test
