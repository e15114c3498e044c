// Generations of tiles and their divisions: against the numbers of the literature, areas, and rewriting symbol by
// symbol.
#include "engine/derivation/derivation.h"
#include "engine/language/document.h"
#include "engine/tiling/polygon_place.h"
#include "engine/tiling/tile_family.h"
#include "engine/tiling/tile_growth.h"
#include "tests/checks.h"

#include <gtest/gtest.h>
#include <glm/mat2x2.hpp>
#include <glm/vec3.hpp>

#include <cmath>
#include <map>
#include <numbers>
#include <string>
#include <vector>

namespace sikku::tile_division_test {

std::vector<TileGeneration> generations(const std::string& name, std::int64_t last) {
    return tile_generations(load(name).grammar(), 0, last, {}, {});
}

std::vector<TileDivision> divisions(const std::string& name, std::int64_t last) {
    const Document document = load(name);
    const TileGrowth growth = find_growth(document.grammar());
    std::optional<glm::dvec2> factor;
    const double angle = growth.turn * std::numbers::pi / 180;
    if (growth.length) factor = *growth.length * glm::dvec2(std::cos(angle), std::sin(angle));
    return tile_divisions(tile_generations(document.grammar(), 0, last, {}, {}), factor, {});
}

TEST(Rewriting, ReportsTheParentOfEachSymbol) {
    // One symbol after the other, in systems without contexts.
    for (const char* name : {"chair", "pinwheel", "bush-272", "capsella"}) {
        const Document document = load(name);
        const Grammar& grammar = document.grammar();
        ModuleWord word = grammar.axiom_modules();
        for (int step = 1; step <= 3; ++step) {
            std::vector<std::uint32_t> parents, expected;
            const ModuleWord next = rewrite(grammar, grammar.tables()[0], word, step, {}, &parents);
            const double* arguments = word.arguments.data();
            for (std::size_t i = 0; i < word.symbols.size(); ++i) {
                const auto arity = grammar.symbols()[word.symbols[i]].arity;
                const ModuleWord alone{{word.symbols[i]}, {arguments, arguments + arity}, {}};
                arguments += arity;
                const auto made = rewrite(grammar, grammar.tables()[0], alone, step);
                expected.insert(expected.end(), made.symbols.size(), static_cast<std::uint32_t>(i));
            }
            EXPECT_EQ(parents, expected) << name;
            word = next;
        }
    }
}

TEST(Rewriting, ReportsParentsAcrossContextsAndCuts) {
    const Document document =
        parse("cut.lsys", "axiom: BA[C]A%A[AA]\nB < A --> BAA\nA --> A\nC --> CC\nderivation length: 1\n");
    const Grammar& grammar = document.grammar();
    std::vector<std::uint32_t> parents;
    const ModuleWord next = rewrite(grammar, grammar.tables()[0], grammar.axiom_modules(), 1, {}, &parents);
    EXPECT_EQ(to_text(grammar, next), "BBAA[CC]A");
    EXPECT_EQ(parents, (std::vector<std::uint32_t>{0, 1, 1, 1, 2, 3, 3, 4, 5}));
}

TEST(TileGenerations, HaveTheNumbersOfTheLiterature) {
    const std::map<std::string, std::vector<std::size_t>> known = {{"penrose-rhombs", {5, 10, 25, 65, 170, 445}},
                                                                   {"chair", {1, 4, 16, 64}},
                                                                   {"hat", {1, 8, 55, 377}},
                                                                   {"spectre", {1, 9, 71, 559}},
                                                                   {"pinwheel", {2, 10, 50, 250}},
                                                                   {"twin-dragon", {1, 2, 4, 8, 16}}};
    for (const auto& [name, numbers] : known) {
        const auto all = generations(name, static_cast<std::int64_t>(numbers.size()) - 1);
        ASSERT_EQ(all.size(), numbers.size());
        for (std::size_t n = 0; n < numbers.size(); ++n) {
            EXPECT_EQ(all[n].polygons.size(), numbers[n]) << name << ' ' << n;
            EXPECT_EQ(all[n].symbol.size(), numbers[n]);
            EXPECT_EQ(all[n].parent.size(), n == 0 ? 0 : numbers[n]);
        }
    }
}

TEST(TileGenerations, AreRefusedWhereTheyDoNotFollowEachOther) {
    EXPECT_THROW(generations("trihexagonal", 6), LineageError);
    EXPECT_THROW(generations("bush-3d", 2), LineageError);
    EXPECT_THROW(generations("cell-layer", 2), WordError);
    try {
        tile_generations(load("chair").grammar(), 0, 6, {2e8, 500}, {});
        FAIL();
    } catch (const BudgetError& error) {
        // 1 + 4 + 16 + 64 + 256 are 341, and 1024 more are too many.
        EXPECT_TRUE(has(error.what(), "the largest derivation length that fits is 4"));
    }
}

/// By the angles under which a point sees the sides.
bool lies_within(std::span<const glm::dvec2> corners, glm::dvec2 point) {
    double turn = 0;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const glm::dvec2 a = corners[i] - point, b = corners[(i + 1) % corners.size()] - point;
        turn += std::atan2(a.x * b.y - a.y * b.x, a.x * b.x + a.y * b.y);
    }
    return std::fabs(turn) > 3;
}

TEST(TileDivisions, CutRepTilesIntoTheirParts) {
    const std::map<std::string, std::size_t> parts = {{"chair", 4},        {"sphinx", 4},      {"half-hex", 4},
                                                      {"table", 4},        {"p-pentomino", 4}, {"pinwheel", 5},
                                                      {"pinwheel-10", 10}, {"equithirds", 3}};
    for (const auto& [name, count] : parts) {
        const auto all = generations(name, 2);
        const auto found = divisions(name, 2);
        for (std::size_t k = 0; k < found.size(); ++k) {
            const TileDivision& division = found[k];
            EXPECT_TRUE(division.is_cut) << name;
            EXPECT_EQ(division.share, 1) << name;
            EXPECT_LT(division.deviation, 1e-9) << name;
            EXPECT_EQ(division.inside, 1) << name;
            std::vector<double> area(all[k].polygons.size(), 0);
            std::vector<std::size_t> number(area.size(), 0);
            for (std::size_t i = 0; i < division.parent.size(); ++i) {
                const std::uint32_t parent = division.parent[i];
                ASSERT_NE(parent, no_number);
                ++number[parent];
                area[parent] += mass_of(all[k + 1].polygons.polygon(i)).area;
                std::vector<glm::dvec2> outline;
                for (const glm::dvec2 corner : all[k].polygons.polygon(parent)) {
                    outline.push_back(division.map * glm::dvec3(corner, 1));
                }
                for (const glm::dvec2 point : points_within(all[k + 1].polygons.polygon(i))) {
                    EXPECT_TRUE(lies_within(outline, point)) << name << ' ' << i;
                }
            }
            const double growth = std::fabs(glm::determinant(glm::dmat2x2(division.map[0], division.map[1])));
            for (std::size_t i = 0; i < area.size(); ++i) {
                EXPECT_EQ(number[i], count) << name;
                EXPECT_NEAR(area[i], growth * mass_of(all[k].polygons.polygon(i)).area, 1e-6) << name;
            }
        }
    }
}

TEST(TileDivisions, ScaleAndTurnByTheFactorOfTheMoves) {
    const auto expect_map = [](const std::string& name, double x, double y) {
        for (const TileDivision& division : divisions(name, 3)) {
            EXPECT_NEAR(division.map[0].x, x, 1e-9) << name;
            EXPECT_NEAR(division.map[0].y, y, 1e-9) << name;
            EXPECT_NEAR(division.map[1].x, -y, 1e-9) << name;
            EXPECT_NEAR(division.map[1].y, x, 1e-9) << name;
        }
    };
    expect_map("chair", 2, 0);
    expect_map("penrose-rhombs", (1 + std::sqrt(5.0)) / 2, 0);
    expect_map("twin-dragon", 1, 1);
    expect_map("gosper-islands", 2.5, std::sqrt(0.75));
    expect_map("pinwheel", std::sqrt(5.0), 0);  // fitted: the lengths are parameters
    // Spectres grow by the root of 4 + the root of 15 in the limit, and only roughly in one place.
    const TileDivision spectre = divisions("spectre", 3).back();
    const double determinant = glm::determinant(glm::dmat2x2(spectre.map[0], spectre.map[1]));
    EXPECT_NEAR(determinant, 4 + std::sqrt(15.0), 0.3);
    EXPECT_GT(spectre.deviation, 0);
    EXPECT_LT(spectre.deviation, 0.1);
    EXPECT_GT(divisions("rauzy", 8).back().deviation, 0.2) << "no similarity";
}

TEST(TileDivisions, GiveHalvesToTheTileInWhichTheyLie) {
    // The matrix of Penrose's rhombs: a thick one becomes two thick ones and a thin one, a thin one one of each.
    const auto all = generations("penrose-rhombs", 7);
    const TileDivision division = divisions("penrose-rhombs", 7).back();
    std::vector<std::pair<int, int>> parts(all[6].polygons.size());  // thin and thick
    for (std::size_t i = 0; i < division.parent.size(); ++i) {
        if (division.parent[i] == no_number) continue;
        auto& [thin, thick] = parts[division.parent[i]];
        ++(all[7].polygons.colour[i] == 1 ? thin : thick);
    }
    std::size_t whole = 0;
    for (std::size_t i = 0; i < parts.size(); ++i) {
        const std::pair expected = all[6].polygons.colour[i] == 1 ? std::pair(1, 1) : std::pair(1, 2);
        if (parts[i] == expected) ++whole;
        EXPECT_LE(parts[i].first, expected.first + 1);
        EXPECT_LE(parts[i].second, expected.second + 1);
    }
    // Halves at the border have no other half.
    EXPECT_GT(static_cast<double>(whole), 0.9 * static_cast<double>(parts.size()));
}

TEST(InnerMiddle, IsThatOfTheLargestDisc) {
    const std::vector<glm::dvec2> triangle = {{0, 0}, {4, 0}, {0, 3}};  // inscribed circle of radius 1
    const glm::dvec2 middle = inner_middle(triangle);
    EXPECT_NEAR(middle.x, 1, 0.01);
    EXPECT_NEAR(middle.y, 1, 0.01);
    const std::vector<glm::dvec2> brick = {{0, 0}, {4, 0}, {4, 2}, {0, 2}};  // many; the one at the centroid
    EXPECT_NEAR(inner_middle(brick).x, 2, 0.01);
    EXPECT_NEAR(inner_middle(brick).y, 1, 0.01);
    const std::vector<glm::dvec2> chair = {{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}};
    EXPECT_NEAR(inner_middle(chair).x, 2 - std::sqrt(2.0), 0.01);
    EXPECT_NEAR(inner_middle(chair).y, 2 - std::sqrt(2.0), 0.01);
}

}  // namespace sikku::tile_division_test
