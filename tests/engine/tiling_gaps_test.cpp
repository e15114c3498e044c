// tests/engine/tiling_gaps_test.cpp: places that tiles leave open: a few by hand, and thousands of random patches
// compared with counting cells.
#include "engine/derivation/derivation.h"
#include "engine/tiling/tiling.h"
#include "engine/tiling/tiling_text.h"
#include "tests/checks.h"
#include "tests/module_reference.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <random>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace sikku::tiling_gaps_test {

using Cell = std::pair<int, int>;

/// A polygon along the edges of a grid, anticlockwise, with the cells that it covers.
struct Polyomino {
    std::vector<Cell> corners, cells;
};

Polyomino rectangle(int x, int y, int width, int height) {
    Polyomino made{{{x, y}, {x + width, y}, {x + width, y + height}, {x, y + height}}, {}};
    for (int i = 0; i < width; ++i) {
        for (int j = 0; j < height; ++j) made.cells.emplace_back(x + i, y + j);
    }
    return made;
}
/// The frame of a square without one side: open upwards.
Polyomino bay(int x, int y, int size) {
    Polyomino made{{{x, y},
                    {x + size, y},
                    {x + size, y + size},
                    {x + size - 1, y + size},
                    {x + size - 1, y + 1},
                    {x + 1, y + 1},
                    {x + 1, y + size},
                    {x, y + size}},
                   {}};
    for (int i = 0; i < size; ++i) {
        for (int j = 0; j < size; ++j) {
            if (j == 0 || i == 0 || i == size - 1) made.cells.emplace_back(x + i, y + j);
        }
    }
    return made;
}

using Patch = std::vector<Polyomino>;

TilingExamination in_doubles(const Patch& patch, double angle) {
    PolygonList list;
    const double size = 0.37;
    for (const Polyomino& tile : patch) {
        for (const auto& [x, y] : tile.corners) {
            list.corners.emplace_back(size * (x * std::cos(angle) - y * std::sin(angle)),
                                      size * (x * std::sin(angle) + y * std::cos(angle)));
        }
        list.end_polygon(0);
    }
    return examine_polygons(list, usual_tolerance(list), {}).examination;
}

/// Steps by whole numbers along the axes, from one point to another.
std::string steps(Cell from, Cell to, const std::string& letter) {
    const auto line = [&](int count) {
        return count == 0 ? std::string() : letter + "(" + std::to_string(count) + ")";
    };
    const int x = to.first - from.first, y = to.second - from.second;
    return (x < 0 ? "|" + line(-x) + "|" : line(x)) + (y < 0 ? "-" + line(-y) + "+" : "+" + line(y) + "-");
}
TilingExamination on_a_lattice(const Patch& patch) {
    std::string axiom;
    for (const Polyomino& tile : patch) {
        axiom += "[" + steps({0, 0}, tile.corners.front(), "f") + "{";
        for (std::size_t i = 0; i < tile.corners.size(); ++i) {
            axiom += steps(tile.corners[i], tile.corners[(i + 1) % tile.corners.size()], "F");
        }
        axiom += "}]";
    }
    return examine_tiling(
               reference::grammar_of(
                   "derivation length: 0\nangle factor: 4\nturn: left\nheading: 0\naxiom: " + axiom + "\n", {}, {}),
               {})
        .examination;
}

/// Cells in groups that are joined by edges, or also at corners.
std::vector<std::set<Cell>> groups(std::set<Cell> left, bool corners) {
    std::vector<std::set<Cell>> result;
    while (!left.empty()) {
        std::set<Cell>& group = result.emplace_back();
        std::vector<Cell> reached = {*left.begin()};
        left.erase(left.begin());
        while (!reached.empty()) {
            const auto [x, y] = reached.back();
            reached.pop_back();
            group.emplace(x, y);
            for (int i = -1; i <= 1; ++i) {
                for (int j = -1; j <= 1; ++j) {
                    if (!corners && i != 0 && j != 0) continue;
                    if (left.erase({x + i, y + j}) > 0) reached.emplace_back(x + i, y + j);
                }
            }
        }
    }
    return result;
}

/// The result of counting cells.
struct Counted {
    bool overlaps = false;
    std::vector<std::set<Cell>> gaps;
    std::size_t components = 0;
};
Counted count(const Patch& patch) {
    std::map<Cell, int> times;
    for (const Polyomino& tile : patch) {
        for (const Cell& cell : tile.cells) ++times[cell];
    }
    Counted result;
    std::set<Cell> full, empty;
    for (const auto& [cell, number] : times) {
        result.overlaps = result.overlaps || number > 1;
        full.insert(cell);
    }
    const auto [low, high] = std::minmax_element(full.begin(), full.end());
    for (int x = low->first - 1; x <= high->first + 1; ++x) {
        for (int y = -10; y <= 30; ++y) {
            if (!full.contains({x, y})) empty.emplace(x, y);
        }
    }
    for (std::set<Cell>& group : groups(empty, false)) {
        if (!group.contains({low->first - 1, -10})) result.gaps.push_back(std::move(group));
    }
    result.components = groups(full, true).size();
    return result;
}

/// @param angle  by which the patch was turned, @param size  of its cells
void expect_as_counted(const TilingExamination& t, const Counted& counted, double angle, double size) {
    const std::string report = tiling_text("", 0, t, {});
    EXPECT_EQ(t.is_tiling(), !counted.overlaps && counted.gaps.empty()) << report;
    if (counted.overlaps) {
        EXPECT_GT(t.violations.count, 0U) << report;
        EXPECT_FALSE(t.has_border) << report;
        return;
    }
    ASSERT_EQ(t.violations.count, 0U) << report;
    EXPECT_TRUE(t.euler_agrees) << report;
    EXPECT_TRUE(t.areas_agree) << report;
    EXPECT_EQ(t.components, counted.components) << report;
    ASSERT_EQ(t.gaps.size(), counted.gaps.size()) << report;
    // Each gap is reported by a point within it, and with its area.
    std::set<std::size_t> found;
    for (const TileGap& gap : t.gaps) {
        const double x = (gap.centre.x * std::cos(angle) + gap.centre.y * std::sin(angle)) / size;
        const double y = (gap.centre.y * std::cos(angle) - gap.centre.x * std::sin(angle)) / size;
        bool is_inside = false;
        for (const double dx : {-1e-3, 1e-3}) {
            for (const double dy : {-1e-3, 1e-3}) {
                const Cell cell(static_cast<int>(std::floor(x + dx)), static_cast<int>(std::floor(y + dy)));
                for (std::size_t i = 0; i < counted.gaps.size(); ++i) {
                    if (!counted.gaps[i].contains(cell)) continue;
                    is_inside = true;
                    found.insert(i);
                    EXPECT_NEAR(gap.area / size / size, static_cast<double>(counted.gaps[i].size()), 1e-6);
                }
            }
        }
        EXPECT_TRUE(is_inside) << x << ' ' << y << '\n' << report;
    }
    EXPECT_EQ(found.size(), counted.gaps.size());
}

void expect_gaps(const Patch& patch, std::size_t gaps, std::size_t components) {
    const Counted counted = count(patch);
    ASSERT_EQ(counted.gaps.size(), gaps);
    ASSERT_EQ(counted.components, components);
    const TilingExamination exact = on_a_lattice(patch);
    EXPECT_TRUE(exact.is_exact);
    expect_as_counted(exact, counted, 0, 1);
    for (const double angle : {0.0, 0.7, 2.0}) expect_as_counted(in_doubles(patch, angle), counted, angle, 0.37);
}

Patch squares(const std::vector<Cell>& cells) {
    Patch patch;
    for (const auto& [x, y] : cells) patch.push_back(rectangle(x, y, 1, 1));
    return patch;
}

TEST(TilingGaps, AreFoundWhereTilesTouchAtCornersOnly) {
    const std::vector<Cell> four = {{1, 0}, {0, 1}, {2, 1}, {1, 2}};
    expect_gaps(squares(four), 1, 1);
    EXPECT_TRUE(has(tiling_text("", 0, on_a_lattice(squares(four)), {}), "gap        of area 1 around 1.5 1.5"));
    // A ring of eight squares that touch at corners only, and one around it.
    const std::vector<Cell> diamond = {{2, 0}, {3, 1}, {4, 2}, {3, 3}, {2, 4}, {1, 3}, {0, 2}, {1, 1}};
    expect_gaps(squares(diamond), 1, 1);
    // A chessboard has a gap wherever four squares meet.
    std::vector<Cell> board;
    for (int x = 0; x < 6; ++x) {
        for (int y = 0; y < 6; ++y) {
            if ((x + y) % 2 == 0) board.emplace_back(x, y);
        }
    }
    expect_gaps(squares(board), 8, 1);
}

TEST(TilingGaps, AreFoundWithinOthersAndAroundIslands) {
    const auto frame = [](int x, int y, int size) {
        return Patch{rectangle(x, y, size - 1, 1), rectangle(x + size - 1, y, 1, size - 1),
                     rectangle(x + 1, y + size - 1, size - 1, 1), rectangle(x, y + 1, 1, size - 1)};
    };
    const auto joined = [](Patch a, const Patch& b) {
        a.insert(a.end(), b.begin(), b.end());
        return a;
    };
    const Patch nested = joined(frame(0, 0, 9), frame(2, 2, 5));
    expect_gaps(frame(0, 0, 9), 1, 1);
    expect_gaps(nested, 2, 2);
    expect_gaps(joined(nested, {rectangle(4, 4, 1, 1)}), 2, 3);          // an island in the middle: 9 - 1 cells
    expect_gaps(joined(frame(0, 0, 5), {rectangle(1, 1, 1, 1)}), 1, 1);  // at an edge
    expect_gaps(joined(frame(0, 0, 5), {rectangle(2, 2, 1, 1)}), 1, 2);  // not at all
    // An island that touches two corners of the ring divides the gap.
    Patch cut = frame(0, 0, 6);
    for (int i = 1; i < 5; ++i) cut.push_back(rectangle(i, i, 1, 1));
    expect_gaps(cut, 2, 1);
    // An island that touches at one corner does not.
    expect_gaps(joined(joined(frame(0, 0, 7), {rectangle(1, 1, 1, 1)}), {rectangle(2, 2, 1, 1)}), 1, 1);
    // Two patches side by side.
    expect_gaps(joined(frame(0, 0, 3), frame(5, 1, 3)), 2, 2);
    expect_gaps({rectangle(0, 0, 2, 1), rectangle(4, 0, 1, 2)}, 0, 2);
    // One tile closes the bay of another, by an edge or by two corners.
    expect_gaps({bay(0, 0, 3), rectangle(0, 3, 3, 1)}, 1, 1);
    expect_gaps({bay(0, 0, 3), rectangle(1, 3, 1, 1)}, 1, 1);
    expect_gaps({bay(0, 0, 4), rectangle(1, 2, 1, 1)}, 0, 1);
}

/// Random patches, with and without overlaps. The cells are the second algorithm.
TEST(TilingGaps, AgreeWithCountingCells) {
    std::mt19937 random(3);
    const auto below = [&](int limit) { return static_cast<int>(random() % static_cast<unsigned>(limit)); };
    int overlapping = 0, with_gaps = 0, tilings = 0;
    for (int round = 0; round < 6000; ++round) {
        const int size = 2 + round % 7, tries = 1 + below(size * size + 1);
        const bool may_overlap = round % 5 == 0;
        Patch patch;
        std::set<Cell> used;
        for (int i = 0; i < tries; ++i) {
            const int x = below(size), y = below(size), kind = below(6);
            Polyomino tile = kind < 3    ? rectangle(x, y, 1, 1)
                             : kind == 3 ? rectangle(x, y, 2, 1)
                             : kind == 4 ? rectangle(x, y, 1, 1 + below(3))
                                         : bay(x, y, 3 + below(2));
            const bool is_free =
                std::none_of(tile.cells.begin(), tile.cells.end(), [&](Cell cell) { return used.contains(cell); });
            if (!is_free && !may_overlap) continue;
            const bool is_known = std::any_of(patch.begin(), patch.end(),
                                              [&](const Polyomino& other) { return other.corners == tile.corners; });
            if (is_known) continue;
            used.insert(tile.cells.begin(), tile.cells.end());
            patch.push_back(std::move(tile));
        }
        const Counted counted = count(patch);
        ++(counted.overlaps ? overlapping : counted.gaps.empty() ? tilings : with_gaps);
        const double angle = 0.1 * (round % 60);
        expect_as_counted(in_doubles(patch, angle), counted, angle, 0.37);
        if (round % 3 == 0) expect_as_counted(on_a_lattice(patch), counted, 0, 1);
        if (HasFailure()) FAIL() << "round " << round;
    }
    EXPECT_GT(overlapping, 500);
    EXPECT_GT(with_gaps, 1000);
    EXPECT_GT(tilings, 1000);
}

/// The same on a grid of triangles, where six tiles meet at a point.
TEST(TilingGaps, AgreeWithCountingTriangles) {
    std::mt19937 random(4);
    const double height = std::sqrt(3.0) / 2;
    int with_gaps = 0;
    for (int round = 0; round < 1500; ++round) {
        const int size = 3 + round % 5;
        // A triangle: column, row, and whether it points down.
        using Triangle = std::array<int, 3>;
        std::set<Triangle> full, left;
        for (int x = -1; x <= size; ++x) {
            for (int y = -1; y <= size; ++y) {
                for (int down = 0; down < 2; ++down) {
                    const bool is_inside = x >= 0 && y >= 0 && x < size && y < size;
                    (is_inside && random() % 10 < 6 ? full : left).insert({x, y, down});
                }
            }
        }
        PolygonList list;
        std::string axiom;
        for (const Triangle& triangle : full) {
            // Clang 14 does not capture structured bindings.
            const int x = triangle[0], y = triangle[1], down = triangle[2];
            const auto at = [&](int i, int j) { return glm::dvec2(x + i + 0.5 * (y + j), height * (y + j)); };
            if (down == 1) {
                list.corners.insert(list.corners.end(), {at(1, 0), at(1, 1), at(0, 1)});
            } else {
                list.corners.insert(list.corners.end(), {at(0, 0), at(1, 0), at(0, 1)});
            }
            list.end_polygon(0);
            axiom += "[f(" + std::to_string(x + down + 1) + ")+f(" + std::to_string(y + 1) + ")-" +
                     (down == 1 ? "+{F++F++F}]" : "{F++F++F}]");
        }
        std::size_t faces = 0;
        while (!left.empty()) {
            ++faces;
            std::vector<Triangle> reached = {*left.begin()};
            left.erase(left.begin());
            while (!reached.empty()) {
                const auto [x, y, down] = reached.back();
                reached.pop_back();
                const int way = down == 1 ? 1 : -1;
                const std::array<Triangle, 3> beside = {
                    {{x, y, 1 - down}, {x + way, y, 1 - down}, {x, y + way, 1 - down}}};
                for (const Triangle& other : beside) {
                    if (left.erase(other) > 0) reached.push_back(other);
                }
            }
        }
        if (full.empty()) continue;
        with_gaps += faces > 1 ? 1 : 0;
        const TilingExamination rough = examine_polygons(list, usual_tolerance(list), {}).examination;
        const TilingExamination exact =
            examine_tiling(
                reference::grammar_of(
                    "derivation length: 0\nangle factor: 6\nturn: left\nheading: 0\naxiom: " + axiom + "\n", {}, {}),
                {})
                .examination;
        EXPECT_TRUE(exact.is_exact);
        for (const TilingExamination* t : {&rough, &exact}) {
            ASSERT_EQ(t->gaps.size() + 1, faces) << round << '\n' << tiling_text("", 0, *t, {});
            ASSERT_TRUE(t->euler_agrees && t->areas_agree && t->violations.count == 0);
            ASSERT_EQ(t->is_tiling(), faces == 1);
        }
    }
    EXPECT_GT(with_gaps, 500);
}

}  // namespace sikku::tiling_gaps_test
