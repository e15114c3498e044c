// Tilings: each bundled tiling covers a region without gaps and overlaps, and has the numbers of tiles, edges and
// border edges that a script which derives and walks the pattern by itself found; the numbers of tiles by colour for
// several derivation lengths follow recurrences of the literature.
#include "engine/derivation/derivation.h"
#include "engine/geometry/turtle.h"
#include "tests/files.h"
#include "tests/module_reference.h"

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <map>
#include <numeric>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace sikku::tilings_test {

using Counts = std::vector<int>;  ///< tiles by colour index, from 1 on
using Corners = std::vector<int>;
using Piece = std::pair<int, int>;

struct Tile {
    Corners corners;  ///< numbers of points, anticlockwise, from the smallest
    int colour;
};

double cross(glm::dvec2 a, glm::dvec2 b) {
    return a.x * b.y - a.y * b.x;
}

/// Numbers points; points closer than a millionth of a step are one.
class Points {
public:
    int number(glm::dvec2 at) {
        const std::int64_t x = cell(at.x, width), y = cell(at.y, width);
        for (std::int64_t i = x - 1; i <= x + 1; ++i) {
            for (std::int64_t j = y - 1; j <= y + 1; ++j) {
                const auto found = cells_.find({i, j});
                if (found == cells_.end()) continue;
                for (const int known : found->second) {
                    if (glm::length(places[static_cast<std::size_t>(known)] - at) < 1e-6) return known;
                }
            }
        }
        places.push_back(at);
        cells_[{x, y}].push_back(static_cast<int>(places.size()) - 1);
        return static_cast<int>(places.size()) - 1;
    }
    static std::int64_t cell(double value, double width) {
        return static_cast<std::int64_t>(std::floor(value / width));
    }
    glm::dvec2 at(int number) const { return places[static_cast<std::size_t>(number)]; }

    std::vector<glm::dvec2> places;

private:
    static constexpr double width = 1e-5;
    std::map<std::pair<std::int64_t, std::int64_t>, std::vector<int>> cells_;
};

/// The polygons of a pattern as tiles, and the edges between them.
class Patch {
public:
    explicit Patch(const std::vector<reference::Polygon>& polygons) {
        std::set<Corners> seen;
        for (const auto& polygon : polygons) {
            tiles_.push_back(tile(polygon));
            EXPECT_TRUE(seen.insert(tiles_.back().corners).second) << "a tile is drawn twice";
        }
        find_corners();
        for (const Tile& one : tiles_) add(one);
    }

    Counts counts() const {
        Counts result;
        for (const Tile& one : tiles_) {
            const auto at = static_cast<std::size_t>(std::max(one.colour, 1));
            if (result.size() < at) result.resize(at);
            ++result[at - 1];
        }
        return result;
    }
    int edges() const {
        return static_cast<int>(std::count_if(pieces_.begin(), pieces_.end(), [&](const auto& piece) {
            const auto [from, to] = piece.first;
            return from < to || !pieces_.contains({to, from});
        }));
    }
    int border() const {
        return static_cast<int>(std::count_if(pieces_.begin(), pieces_.end(), [&](const auto& piece) {
            return !pieces_.contains({piece.first.second, piece.first.first});
        }));
    }
    /// Every piece once in each direction at most, the angles around a point inside fill it, and there are no gaps:
    /// one region whose border is one loop has V - E + F = 1.
    void expect_tiling() const {
        std::set<int> outer;
        std::map<int, int> next;
        for (const auto& [piece, times] : pieces_) {
            EXPECT_EQ(times, 1) << "two tiles overlap along an edge";
            if (pieces_.contains({piece.second, piece.first})) continue;
            outer.insert(piece.first);
            EXPECT_TRUE(next.emplace(piece).second) << "the border touches itself";
        }
        for (const auto& [corner, degrees] : degrees_) {
            if (outer.contains(corner)) {
                EXPECT_LT(degrees, 360.0);
            } else {
                EXPECT_NEAR(degrees, 360.0, 1e-4);
            }
        }
        EXPECT_EQ(static_cast<int>(degrees_.size()) - edges() + static_cast<int>(tiles_.size()), 1);
        std::size_t length = 0;
        ASSERT_FALSE(next.empty());
        for (int at = next.begin()->first; length <= next.size();) {
            ++length;
            at = next.at(at);
            if (at == next.begin()->first) break;
        }
        EXPECT_EQ(length, next.size()) << "the border has several loops";
    }

private:
    Tile tile(const reference::Polygon& polygon) {
        Corners all;
        for (const glm::dvec2 vertex : polygon.vertices) {
            const int number = points_.number(vertex);
            if (all.empty() || all.back() != number) all.push_back(number);
        }
        if (all.front() == all.back()) all.pop_back();
        Corners corners;
        double area = 0.0;
        for (std::size_t i = 0; i < all.size(); ++i) {
            const glm::dvec2 before = points_.at(all[(i + all.size() - 1) % all.size()]), here = points_.at(all[i]),
                             after = points_.at(all[(i + 1) % all.size()]);
            area += cross(here, after);
            if (std::fabs(cross(here - before, after - here)) > 1e-6) corners.push_back(all[i]);
        }
        if (area < 0.0) std::reverse(corners.begin(), corners.end());
        std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
        return {corners, polygon.pen.colour};
    }
    void find_corners() {
        std::set<int> corners;
        for (const Tile& one : tiles_) {
            for (std::size_t i = 0; i < one.corners.size(); ++i) {
                corners.insert(one.corners[i]);
                const glm::dvec2 side =
                    points_.at(one.corners[(i + 1) % one.corners.size()]) - points_.at(one.corners[i]);
                longest_ = std::max(longest_, glm::length(side));
            }
        }
        for (const int corner : corners) by_place_[place(points_.at(corner))].push_back(corner);
    }
    std::pair<std::int64_t, std::int64_t> place(glm::dvec2 at) const {
        return {Points::cell(at.x, longest_), Points::cell(at.y, longest_)};
    }
    /// The corners on a side, from its start to before its end.
    Corners along(int from, int to) const {
        const glm::dvec2 start = points_.at(from), side = points_.at(to) - start;
        const double length = glm::length(side);
        std::map<double, int> found = {{0.0, from}};
        const auto [x, y] = place(start);
        for (std::int64_t i = x - 1; i <= x + 1; ++i) {
            for (std::int64_t j = y - 1; j <= y + 1; ++j) {
                const auto near = by_place_.find({i, j});
                if (near == by_place_.end()) continue;
                for (const int corner : near->second) {
                    const glm::dvec2 offset = points_.at(corner) - start;
                    const double ahead = glm::dot(offset, side) / length;
                    if (std::fabs(cross(side, offset)) / length < 1e-6 && ahead > 1e-6 && ahead < length - 1e-6) {
                        found[ahead] = corner;
                    }
                }
            }
        }
        Corners result;
        for (const auto& [ahead, corner] : found) result.push_back(corner);
        return result;
    }
    void add(const Tile& one) {
        Corners outline;
        for (std::size_t i = 0; i < one.corners.size(); ++i) {
            const Corners side = along(one.corners[i], one.corners[(i + 1) % one.corners.size()]);
            outline.insert(outline.end(), side.begin(), side.end());
        }
        for (std::size_t i = 0; i < outline.size(); ++i) {
            const int before = outline[(i + outline.size() - 1) % outline.size()], here = outline[i],
                      after = outline[(i + 1) % outline.size()];
            ++pieces_[{here, after}];
            const glm::dvec2 back = points_.at(before) - points_.at(here),
                             ahead = points_.at(after) - points_.at(here);
            const double turn = std::atan2(cross(ahead, back), glm::dot(ahead, back)) * 180.0 / std::acos(-1.0);
            degrees_[here] += turn < 0.0 ? turn + 360.0 : turn;
        }
    }

    Points points_;
    std::vector<Tile> tiles_;
    double longest_ = 0.0;
    std::map<std::pair<std::int64_t, std::int64_t>, Corners> by_place_;
    std::map<Piece, int> pieces_;    ///< how often a piece of an edge is used in its direction
    std::map<int, double> degrees_;  ///< sum of the angles of the tiles at a corner
};

std::vector<reference::Polygon> polygons_of(const std::string& name, const std::string& variant, int n) {
    const Grammar grammar = reference::grammar_of(
        contents(std::filesystem::path(SIKKU_SOURCE_DIR) / "patterns/tilings" / (name + ".lsys")),
        {{"-n", "derivation length", std::to_string(n)}}, variant);
    reference::Recorder recorder;
    const auto turtle = Turtle::drawing(grammar, recorder, false);
    derive(grammar, *turtle, {.interpreted = true});
    return recorder.polygons;
}

struct Tiling {
    const char* name;
    const char* variant;
    int n;
    Counts tiles;  ///< by colour
    int edges, border;
};

// clang-format off
const std::vector<Tiling> tilings = {
    {"ammann-a3", "", 5, {105, 39, 25}, 728, 65},
    {"ammann-beenker", "", 2, {96, 136}, 520, 112},
    {"basket-weave", "", 10, {100, 100}, 520, 60},
    {"cairo", "", 12, {72, 72}, 396, 72},
    {"chair-of-nine", "", 2, {31, 14, 22, 14}, 298, 38},
    {"chair", "", 4, {72, 64, 56, 64}, 928, 66},
    {"crosses", "", 4, {125, 500}, 1412, 324},
    {"danzer", "", 2, {364, 308, 182}, 1316, 70},
    {"deltoidal-trihexagonal", "", 12, {72, 72, 72}, 478, 92},
    {"domino-of-nine", "", 2, {41, 40}, 212, 36},
    {"elongated-triangular", "", 18, {81, 81, 81}, 436, 62},
    {"equithirds", "", 6, {183, 546}, 1134, 81},
    {"fibonacci-spiral", "", 11, {4, 4, 4}, 37, 8},
    {"fibonacci-squares", "", 5, {64, 80, 25}, 364, 52},
    {"floret-pentagonal", "", 10, {50, 50, 50}, 432, 114},
    {"fudgeflake", "", 6, {243, 243, 243}, 2379, 384},
    {"golden-bee", "", 10, {89, 55}, 513, 52},
    {"golden-triangles", "", 4, {65, 65, 105, 105}, 530, 40},
    {"gosper-islands", "", 3, {49, 294}, 1110, 162},
    {"half-hex", "", 4, {172, 170, 170}, 1057, 66},
    {"hat-equal", "", 3, {281, 48, 48}, 2774, 463},
    {"hat", "", 3, {281, 48, 48}, 2774, 463},
    {"hat", "turtle", 3, {281, 48, 48}, 2774, 463},
    {"hat", "narrow", 3, {281, 48, 48}, 2774, 463},
    {"herringbone", "", 16, {64, 64}, 414, 77},
    {"honeycomb", "", 12, {36, 36, 36}, 370, 92},
    {"kisrhombille", "", 10, {150, 150}, 488, 76},
    {"l-tetromino", "", 4, {64, 64, 64, 64}, 972, 81},
    {"p-pentomino", "", 4, {72, 64, 56, 64}, 960, 57},
    {"padovan-spiral", "", 15, {6, 5, 5}, 33, 6},
    {"penrose-kite-dart", "", 4, {170, 105}, 585, 70},
    {"penrose-pentagons", "", 3, {41, 75, 185, 60, 55, 25}, 1350, 320},
    {"penrose-rhombs", "", 5, {170, 275}, 935, 90},
    {"pinwheel-10", "", 2, {104, 96}, 354, 32},
    {"pinwheel-13", "", 2, {178, 160}, 603, 50},
    {"pinwheel", "", 4, {626, 624}, 2177, 90},
    {"pythagorean", "", 14, {49, 49}, 320, 67},
    {"rauzy", "", 8, {149, 125, 81}, 753, 86},
    {"rhombic-rosette", "", 11, {24, 24, 24, 24, 24, 24, 24, 24, 24, 24, 24}, 552, 48},
    {"rhombitrihexagonal", "", 14, {49, 147, 98}, 632, 88},
    {"robinson-triangles", "", 4, {170, 170, 105, 105}, 850, 50},
    {"running-bond", "", 14, {49, 49}, 321, 68},
    {"shield", "", 3, {500, 159, 74}, 1338, 96},
    {"snub-square", "", 16, {64, 64, 128, 128}, 679, 78},
    {"snub-trihexagonal", "", 12, {36, 216, 72}, 595, 110},
    {"socolar", "", 1, {63, 54, 26}, 342, 60},
    {"socolar", "", 2, {699, 726, 434}, 4302, 300},
    {"spectre", "", 3, {496, 63}, 4121, 669},
    {"sphinx", "", 3, {28, 36}, 190, 23},
    {"spiral-of-triangles", "", 8, {294, 294}, 925, 86},
    {"square-triangle", "", 2, {264, 120}, 672, 72},
    {"square", "", 12, {72, 72}, 312, 48},
    {"table", "", 4, {128, 128}, 687, 64},
    {"terdragon", "", 6, {225, 252, 252}, 1586, 256},
    {"tetrakis-square", "", 12, {144, 144}, 456, 48},
    {"triakis-triangular", "", 14, {147, 147}, 458, 34},
    {"triangular", "", 18, {81, 81}, 265, 44},
    {"trihexagonal", "", 16, {64, 64, 64}, 426, 84},
    {"truncated-hexagonal", "", 12, {36, 36, 36}, 379, 110},
    {"truncated-square", "", 14, {49, 49}, 335, 82},
    {"truncated-trihexagonal", "", 8, {16, 48, 32}, 333, 90},
    {"tumbling-blocks", "", 16, {64, 64, 64}, 415, 62},
    {"twin-dragon", "", 9, {256, 256}, 1233, 418},
    {"voderberg-spiral", "", 4, {225, 150, 225, 150}, 3455, 160},
    {"windmill", "", 12, {72, 72, 36}, 516, 48},
};
// clang-format on

class Tilings : public ::testing::TestWithParam<Tiling> {};

TEST_P(Tilings, CoverARegionOnce) {
    const Tiling& fact = GetParam();
    const Patch patch(polygons_of(fact.name, fact.variant, fact.n));
    patch.expect_tiling();
    EXPECT_EQ(patch.counts(), fact.tiles);
    EXPECT_EQ(patch.edges(), fact.edges);
    EXPECT_EQ(patch.border(), fact.border);
}

std::string name_of(const ::testing::TestParamInfo<Tiling>& info) {
    std::string name = std::string(info.param.name) + (*info.param.variant ? "-" : "") + info.param.variant + "-" +
                       std::to_string(info.param.n);
    std::replace(name.begin(), name.end(), '-', '_');
    return name;
}
INSTANTIATE_TEST_SUITE_P(Patterns, Tilings, ::testing::ValuesIn(tilings), name_of);

/// At its own derivation length, without exception.
TEST(BundledTilings, FillEveryTile) {
    const std::filesystem::path folder = std::filesystem::path(SIKKU_SOURCE_DIR) / "patterns/tilings";
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
        const std::string name = entry.path().stem();
        SCOPED_TRACE(name);
        const std::int64_t n = reference::grammar_of(contents(entry.path())).steps();
        const auto polygons = polygons_of(name, "", static_cast<int>(n));
        ASSERT_FALSE(polygons.empty());
        Patch(polygons).expect_tiling();
    }
}

TEST(BundledTilings, HaveAsManyTilesAsTheirFigures) {
    // Rows of 1, 2, 3 … hexagons; rings of 24, 48, 72 … tiles, and a mirror image above each tile but the outermost.
    for (int n = 1; n <= 10; ++n) {
        EXPECT_EQ(polygons_of("hexagonal-tiling", "", n).size(), static_cast<std::size_t>(n * (n + 1) / 2));
    }
    for (int n = 2; n <= 6; ++n) {
        const int rings = n - 1;
        EXPECT_EQ(polygons_of("spiral-tiling", "", n).size(),
                  static_cast<std::size_t>(24 * (rings * (rings + 1) / 2 + rings * (rings - 1) / 2)));
    }
}

/// Tiles by colour after 0, 1, 2 … steps.
Counts counts_of(const std::string& name, int n) {
    Counts result;
    for (const auto& polygon : polygons_of(name, "", n)) {
        const auto at = static_cast<std::size_t>(std::max(polygon.pen.colour, 1));
        if (result.size() < at) result.resize(at);
        ++result[at - 1];
    }
    return result;
}

TEST(TilingCounts, FollowTheirRecurrences) {
    const std::map<std::string, std::vector<Counts>> published = {
        {"penrose-rhombs", {{5}, {5, 5}, {10, 15}, {25, 40}, {65, 105}, {170, 275}, {445, 720}, {1165, 1885}}},
        {"penrose-kite-dart", {{5}, {10, 5}, {25, 15}, {65, 40}, {170, 105}, {445, 275}, {1165, 720}}},
        {"ammann-a3", {{0, 1}, {3, 0, 1}, {5, 3, 1}, {16, 5, 4}, {39, 16, 9}, {105, 39, 25}}},
        {"ammann-beenker", {{0, 8}, {16, 24}, {96, 136}, {560, 792}, {3264, 4616}}},
        {"chair", {{1}, {2, 1, 0, 1}, {6, 4, 2, 4}, {20, 16, 12, 16}, {72, 64, 56, 64}, {272, 256, 240, 256}}},
        {"sphinx", {{1}, {1, 3}, {10, 6}, {28, 36}, {136, 120}}},
        {"table", {{1}, {2, 2}, {8, 8}, {32, 32}, {128, 128}}},
        {"twin-dragon", {{1}, {1, 1}, {2, 2}, {4, 4}, {8, 8}, {16, 16}}},
        {"gosper-islands", {{1}, {1, 6}, {7, 42}, {49, 294}}},
        {"fibonacci-squares", {{1}, {1, 2, 1}, {4, 4, 1}, {9, 12, 4}, {25, 30, 9}, {64, 80, 25}}},
    };
    for (const auto& [name, counts] : published) {
        for (std::size_t n = 0; n < counts.size(); ++n) {
            EXPECT_EQ(counts_of(name, static_cast<int>(n)), counts[n]) << name << ' ' << n;
        }
    }
}

TEST(TilingCounts, OfHatsAndSpectres) {
    const auto total = [](const Counts& counts) { return std::accumulate(counts.begin(), counts.end(), 0); };
    int before = 0, hats = 1;
    for (int n = 0; n <= 4; ++n) {
        const Counts found = counts_of("hat", n);
        EXPECT_EQ(total(found), hats) << n;
        EXPECT_EQ(found.size() < 3 ? 0 : found[2], std::vector<int>({0, 1, 7, 48, 329})[static_cast<std::size_t>(n)]);
        before = std::exchange(hats, 7 * hats - before + (n == 0 ? 1 : 0));
    }
    before = 0;
    int spectres = 1;
    for (int n = 0; n <= 4; ++n) {
        const Counts found = counts_of("spectre", n);
        EXPECT_EQ(total(found), spectres) << n;
        EXPECT_EQ(found.size() < 2 ? 0 : found[1], std::vector<int>({0, 1, 8, 63, 496})[static_cast<std::size_t>(n)]);
        before = std::exchange(spectres, 8 * spectres - before + (n == 0 ? 1 : 0));
    }
}

/// Stars come from stars, boats and diamonds; boats are five, three and one in them; pentagons also six in a
/// pentagon.
TEST(TilingCounts, OfPenrosesPentagons) {
    for (int n = 2; n <= 4; ++n) {
        const Counts from = counts_of("penrose-pentagons", n - 1), to = counts_of("penrose-pentagons", n);
        const auto number = [](const Counts& counts, std::size_t colour) {
            return counts.size() < colour ? 0 : counts[colour - 1];
        };
        const auto pentagons = [&](const Counts& counts) {
            return number(counts, 1) + number(counts, 2) + number(counts, 3);
        };
        const int diamonds = number(from, 4), boats = number(from, 5), stars = number(from, 6);
        EXPECT_EQ(number(to, 6), stars + boats + diamonds) << n;
        EXPECT_EQ(number(to, 5), 5 * stars + 3 * boats + diamonds) << n;
        EXPECT_EQ(pentagons(to), 6 * pentagons(from) + 5 * stars + 3 * boats + diamonds) << n;
    }
}

TEST(TilingCounts, GrowByTheAreaOfTheStep) {
    const std::map<std::string, std::vector<std::size_t>> factors = {
        {"chair", {4, 1}},          {"chair-of-nine", {9, 1}}, {"domino-of-nine", {9, 1}}, {"half-hex", {4, 2}},
        {"l-tetromino", {4, 1}},    {"p-pentomino", {4, 1}},   {"sphinx", {4, 1}},         {"crosses", {5, 1}},
        {"gosper-islands", {7, 1}}, {"fudgeflake", {3, 1}},    {"terdragon", {3, 1}},      {"pinwheel", {5, 2}},
        {"pinwheel-10", {10, 2}},   {"pinwheel-13", {13, 2}},  {"table", {4, 1}},          {"twin-dragon", {2, 1}},
    };
    for (const auto& [name, factor] : factors) {
        std::size_t expected = factor[1];
        for (int n = 0; expected < 1500; ++n, expected *= factor[0]) {
            EXPECT_EQ(polygons_of(name, "", n).size(), expected) << name << ' ' << n;
        }
    }
}

TEST(TilingCounts, OfRowsAndCells) {
    const std::map<std::string, int> cells = {
        {"basket-weave", 8},
        {"cairo", 4},
        {"deltoidal-trihexagonal", 6},
        {"elongated-triangular", 3},
        {"floret-pentagonal", 6},
        {"herringbone", 2},
        {"honeycomb", 3},
        {"kisrhombille", 12},
        {"pythagorean", 2},
        {"rhombitrihexagonal", 6},
        {"running-bond", 2},
        {"snub-square", 6},
        {"snub-trihexagonal", 9},
        {"square", 4},
        {"tetrakis-square", 8},
        {"triakis-triangular", 6},
        {"triangular", 2},
        {"trihexagonal", 3},
        {"truncated-hexagonal", 3},
        {"truncated-square", 2},
        {"truncated-trihexagonal", 6},
        {"tumbling-blocks", 3},
        {"windmill", 5},
    };
    for (const auto& [name, tiles] : cells) {
        for (const int n : {2, 3, 6, 7}) {
            EXPECT_EQ(polygons_of(name, "", n).size(), static_cast<std::size_t>((n + 1) / 2 * (n / 2) * tiles))
                << name << ' ' << n;
        }
    }
}

}  // namespace sikku::tilings_test
