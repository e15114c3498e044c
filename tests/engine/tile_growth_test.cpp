// tests/engine/tile_growth_test.cpp: growth and shares of tiles by productions alone, compared with the literature
// and with derived patches.
#include "engine/tiling/tile_growth.h"
#include "engine/tiling/tiling.h"
#include "engine/tiling/tiling_text.h"
#include "tests/checks.h"
#include "tests/files.h"
#include "tests/module_reference.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace sikku::tile_growth_test {

TilingExamination examined(const std::string& name, int n) {
    const std::filesystem::path file =
        std::filesystem::path(SIKKU_SOURCE_DIR) / "patterns/tilings" / (name + ".lsys");
    return examine_tiling(reference::grammar_of(contents(file), {{"-n", "derivation length", std::to_string(n)}}), {})
        .examination;
}

TileGrowth growth_of(const std::string& name, int n) {
    return find_growth(reference::grammar_of(
        contents(std::filesystem::path(SIKKU_SOURCE_DIR) / "patterns/tilings" / (name + ".lsys")),
        {{"-n", "derivation length", std::to_string(n)}}));
}

TEST(TileGrowth, FindsThePublishedFactors) {
    const std::map<std::string, std::string> lengths = {
        {"penrose-rhombs", "τ"},
        {"penrose-kite-dart", "τ"},
        {"ammann-beenker", "1 + √2"},
        {"chair", "2"},
        {"sphinx", "2"},
        {"half-hex", "2"},
        {"table", "2"},
        {"p-pentomino", "2"},
        {"twin-dragon", "√2"},
        {"gosper-islands", "√7"},
        {"ammann-a3", "τ"},
        {"socolar", "2 + √3"},
        {"shield", "√(2 + √3)"},
        {"chair-of-nine", "3"},
    };
    for (const auto& [name, form] : lengths) {
        const TileGrowth growth = growth_of(name, 5);
        ASSERT_TRUE(growth.length.has_value()) << name << growth.unknown << growth.no_limit << growth.no_length;
        EXPECT_EQ(closed_form(*growth.length), form) << name;
        EXPECT_NEAR(*growth.length * *growth.length, growth.tiles.value_or(0), 1e-9) << name;
    }
    EXPECT_NEAR(growth_of("twin-dragon", 5).turn, 45, 1e-9);
    const std::map<std::string, std::string> tiles = {
        {"fibonacci-squares", "(3 + √5) / 2"}, {"hat", "(7 + 3 √5) / 2"}, {"spectre", "4 + √15"}};
    for (const auto& [name, form] : tiles) {
        const TileGrowth growth = growth_of(name, 5);
        ASSERT_TRUE(growth.tiles.has_value()) << name;
        EXPECT_EQ(closed_form(*growth.tiles), form) << name;
        EXPECT_FALSE(growth.length.has_value()) << name;
    }
    for (const char* name : {"trihexagonal", "herringbone"}) EXPECT_FALSE(growth_of(name, 5).tiles) << name;
    // Systems with parameters are counted in plain form.
    const std::map<std::string, std::string> computed = {
        {"pinwheel", "√5"}, {"pinwheel-10", "√10"}, {"pinwheel-13", "√13"}, {"golden-bee", "√τ"}};
    for (const auto& [name, form] : computed) {
        const TileGrowth growth = growth_of(name, 20);
        ASSERT_TRUE(growth.length.has_value()) << name << growth.unknown << growth.no_limit << growth.no_length;
        EXPECT_EQ(closed_form(*growth.length), form) << name;
        EXPECT_NEAR(*growth.length * *growth.length, growth.tiles.value_or(0), 1e-9) << name;
    }
    EXPECT_FALSE(growth_of("padovan-spiral", 10).tiles);
    EXPECT_EQ(closed_form(std::sqrt(4 + std::sqrt(15.0))), "√(4 + √15)");
    EXPECT_EQ(closed_form(2 + std::sqrt(3.0)), "2 + √3");
    EXPECT_EQ(closed_form(std::acos(-1.0)), "");
}

/// A symbol that begins to move shifts what follows its parent, also as the last symbol of a successor: the tile lies
/// at 2, 5, 12, 29, whose ratio is not 2.
TEST(TileGrowth, WhatFollowsAParentFollowsItsLastSymbol) {
    const TileGrowth growth = find_growth(reference::grammar_of(
        "axiom: FT\nangle increment: 90\nderivation length: 3\nF --> FFA\nA --> F\nT --> TTTT\ninterpret:\n"
        "T --> [{F+F+F+F}]\n",
        {}));
    EXPECT_FALSE(growth.length.has_value());
    EXPECT_EQ(growth.no_length, "the moves are not multiplied by one number");
}

TEST(TileGrowth, FindsThePublishedFrequencies) {
    const double tau = (1 + std::sqrt(5.0)) / 2;
    const TileGrowth rhombs = growth_of("penrose-rhombs", 5);
    ASSERT_EQ(rhombs.frequencies.size(), 2U);
    EXPECT_NEAR(rhombs.frequencies[1] / rhombs.frequencies[0], tau, 1e-9);  // thick : thin
    EXPECT_EQ(rhombs.period, 1U);
    // Every step of the spectres reflects all tiles.
    const TileGrowth spectres = growth_of("spectre", 5);
    EXPECT_EQ(spectres.period, 2U);
    const TileGrowth octagonal = growth_of("ammann-beenker", 5);
    ASSERT_EQ(octagonal.frequencies.size(), 2U);
    EXPECT_NEAR(octagonal.frequencies[0] / octagonal.frequencies[1], std::sqrt(2.0), 1e-9);  // rhombs : squares
    // The tiles of Socolar are dual to the vertices and the crossings of two triangular grids at 30 degrees.
    const TileGrowth twelvefold = growth_of("socolar", 5);
    ASSERT_EQ(twelvefold.frequencies.size(), 3U);
    for (std::size_t i = 0; i < 3; ++i) {
        const double share = twelvefold.shapes[i].angles.size() == 6 ? 1 : std::sqrt(3.0);
        EXPECT_NEAR(twelvefold.frequencies[i] * (1 + 2 * std::sqrt(3.0)), share, 1e-9);
    }
    const TileGrowth squares = growth_of("fibonacci-squares", 5);
    ASSERT_EQ(squares.frequencies.size(), 3U);
    for (std::size_t i = 0; i < 3; ++i) {
        const double expected = squares.shapes[i].area == 64   ? 1
                                : squares.shapes[i].area == 40 ? 2 / tau
                                                               : 1 / tau / tau;
        EXPECT_NEAR(squares.frequencies[i] * (1 + 2 / tau + 1 / tau / tau), expected, 1e-9);
    }
}

/// Shares by hand and colour: Smith et al. 2023 for hats, and the roots of x^3 = x^2 + x + 1 for Rauzy's fractal.
TEST(TileGrowth, FindsSharesOfHandsAndColours) {
    const double tau = (1 + std::sqrt(5.0)) / 2;
    const TileGrowth hats = growth_of("hat", 3);
    ASSERT_EQ(hats.reflected.size(), 1U);
    EXPECT_NEAR(hats.reflected[0], 1 / (std::pow(tau, 4) + 1), 1e-9);
    double sum = 0;
    for (const TileKindCount& each : hats.counts) sum += each.share.value_or(0);
    EXPECT_NEAR(sum, 1, 1e-9);
    const TileGrowth faces = growth_of("rauzy", 8);
    ASSERT_EQ(faces.colours.size(), 3U);
    const double beta = 1.8392867552141612;
    // A tile of each colour becomes others as the letters of the word do, so that shares fall by powers of beta.
    EXPECT_NEAR(faces.colours[0].second, 0.419643, 1e-6);
    EXPECT_NEAR(faces.colours[1].second, 0.352201, 1e-6);
    EXPECT_NEAR(faces.colours[2].second, 0.228155, 1e-6);
    EXPECT_NEAR(faces.tiles.value_or(0), beta, 1e-9);
    EXPECT_EQ(faces.reflected, std::vector<double>{0});
    // Every step of the spectres reflects all tiles, so that shares of hands alternate.
    const TileGrowth spectres = growth_of("spectre", 3);
    EXPECT_EQ(spectres.frequencies, std::vector<double>{1});
    EXPECT_TRUE(spectres.reflected.empty());
    EXPECT_FALSE(spectres.is_average);
    // The second spectre of a pair has a colour of its own.
    ASSERT_FALSE(spectres.colours.empty());
    EXPECT_NEAR(spectres.colours.back().second, (5 - std::sqrt(15.0)) / 10, 1e-9);
    EXPECT_TRUE(has(tile_counts_text("", 3, spectres), "shares of kinds do not settle"));
}

TileGrowth growth_of_text(const std::string& text) {
    return find_growth(
        reference::grammar_of("derivation length: 4\nangle factor: 4\nturn: left\nheading: 0\n" + text));
}

TEST(TileGrowth, ClaimsNoLimitIfSharesAlternate) {
    // A square becomes two rectangles, and each of these a square: 1, 2, 2, 4, 4 …
    const TileGrowth growth =
        growth_of_text("axiom: A\nA --> [B][fB]\nB --> [A]\ninterpret:\nA --> [{F+F+F+F}]\nB --> [{FF+F+FF+F}]\n");
    EXPECT_NEAR(growth.tiles.value_or(0), std::sqrt(2.0), 1e-9);
    EXPECT_TRUE(growth.is_average);
    EXPECT_TRUE(growth.frequencies.empty());
    EXPECT_TRUE(has(tile_counts_text("", 4, growth), "times as many tiles a step on average"));
    // The colour of a tile that sets none follows from those around it.
    const TileGrowth unknown = growth_of_text("axiom: A\nA --> ;(2)A;(3)A\ninterpret:\nA --> [{F+F+F+F}]\n");
    ASSERT_EQ(unknown.counts.size(), 1U);
    EXPECT_FALSE(unknown.counts[0].colour.has_value());
    EXPECT_TRUE(unknown.colours.empty());
}

/// Steps of a path are moves, and so are those that only turns move.
TEST(TileGrowth, CountsStepsOfPathsAsMoves) {
    const TileGrowth dragon = growth_of("terdragon", 6);
    ASSERT_TRUE(dragon.length.has_value()) << dragon.no_length;
    EXPECT_NEAR(*dragon.length, std::sqrt(3.0), 1e-12);  // Davis & Knuth 1970
    EXPECT_NEAR(dragon.turn, 30, 1e-9);
    const TileGrowth bent = growth_of_text("axiom: AXA\nA --> AA\nX --> +\ninterpret:\nA --> [{F+F+F+F}]f\nX --> \n");
    EXPECT_FALSE(bent.length.has_value());
    const TileGrowth begun = growth_of_text(
        "axiom: AXA\nA --> [A][A][A][A]\nX --> Y\nY --> YY\ninterpret:\nA --> [{F+F+F+F}]\nX --> \nY --> f\n");
    EXPECT_FALSE(begun.length.has_value());
}

/// Numbers by kind for long derivations follow the recurrences of the literature; for short ones those of the tiles.
TEST(TileGrowth, CountsWithoutDeriving) {
    const auto total = [](const TileGrowth& growth) {
        Integer sum = 0;
        for (const TileKindCount& each : growth.counts) sum += each.count;
        return sum;
    };
    for (const char* name : {"penrose-rhombs", "ammann-beenker", "hat-equal", "sphinx", "herringbone"}) {
        const TilingExamination t = examined(name, 4);
        const TileGrowth growth = growth_of(name, 4);
        EXPECT_EQ(total(growth), t.tiles) << name;
        std::uint64_t reflected = 0;
        for (const TileKindCount& each : growth.counts) {
            if (each.is_reflected) reflected += static_cast<std::uint64_t>(each.count);
        }
        std::uint64_t seen = 0;
        for (const TileShape& shape : t.shapes) seen += shape.reflected;
        EXPECT_EQ(reflected, seen) << name;
    }
    Integer before = 1, now = 9;
    for (int n = 2; n <= 60; ++n) {
        const Integer next = 8 * now - before;
        before = now;
        now = next;
    }
    EXPECT_EQ(total(growth_of("spectre", 60)), now);
    EXPECT_EQ(total(growth_of("chair", 60)), Integer(1) << 120);
    EXPECT_EQ(total(growth_of("pinwheel", 60)), 2 * boost::multiprecision::pow(Integer(5), 60));
    EXPECT_EQ(total(growth_of("padovan-spiral", 15)), 16);
    // Thick and thin rhombs are five times Fibonacci numbers.
    const TileGrowth rhombs = growth_of("penrose-rhombs", 60);
    ASSERT_EQ(rhombs.counts.size(), 2U);
    Integer thin = 5, thick = 5;
    for (int n = 2; n <= 60; ++n) {
        const Integer more = thick;
        thick = 2 * thick + thin;
        thin += more;
    }
    EXPECT_EQ(rhombs.counts[0].count, thin);
    EXPECT_EQ(rhombs.counts[1].count, thick);
}

}  // namespace sikku::tile_growth_test
