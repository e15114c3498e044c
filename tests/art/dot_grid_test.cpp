#include "art/kolam/dot_grid.h"

#include "art/kolam/dot_grid_enumeration.h"
#include "art/kolam/dot_grid_making.h"
#include "art/kolam/dot_grid_pattern.h"
#include "art/kolam/kolam.h"
#include "art/style/style.h"
#include "engine/geometry/spline.h"
#include "tests/checks.h"
#include "tests/reference.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <map>
#include <numbers>
#include <numeric>
#include <set>
#include <string>
#include <vector>

namespace sikku::dot_grid_test {

GapStates state_of(const DotGrid& grid, std::uint64_t bits) {
    GapStates crossings(grid.gaps().size());
    for (std::size_t i = 0; i < crossings.size(); ++i) crossings[i] = static_cast<GapState>(bits >> i & 1U);
    return crossings;
}

// --- grids --------------------------------------------------------------------------------------------------------

TEST(DotGrid, ReadsRectanglesAndRows) {
    const DotGrid rectangle = parse_dot_grid("3x4");
    EXPECT_EQ(rectangle.dots().size(), 12u);
    EXPECT_EQ(rectangle.gaps().size(), 17u);
    EXPECT_EQ(rectangle.dots()[0], (GridDot{-3, 2}));
    EXPECT_EQ(rectangle.text(), "3x4");
    const DotGrid diamond = parse_dot_grid("1-3-5-7-5-3-1");
    EXPECT_EQ(diamond.dots().size(), 25u);
    EXPECT_EQ(diamond.gaps().size(), 36u);
    EXPECT_EQ(diamond.text(), "1-3-5-7-5-3-1");
    EXPECT_EQ(parse_dot_grid("1-3-5").dots().size(), 9u);  // not symmetric from top to bottom
    EXPECT_FALSE(has_symmetry(parse_dot_grid("1-3-5"), GridSymmetry::mirror_y));
    EXPECT_TRUE(has_symmetry(parse_dot_grid("1-3-5"), GridSymmetry::mirror_x));
    for (const DotGrid* grid : {&rectangle, &diamond}) {
        for (std::uint32_t i = 0; i < grid->dots().size(); ++i) EXPECT_EQ(grid->dot_at(grid->dots()[i]), i);
        for (const GridGap& gap : grid->gaps()) {
            const GridDot from = grid->dots()[gap.from];
            const GridDot to = grid->dots()[gap.to];
            EXPECT_EQ(std::abs(from.x - to.x) + std::abs(from.y - to.y), 2);
        }
    }
}

TEST(DotGrid, ReadsTheNotationsOfPractitioners) {
    struct Case {
        const char* text;
        const char* canonical;
        std::size_t dots, gaps;
    };
    for (const Case& known : {Case{"7 to 1 ner pulli", "1-3-5-7-5-3-1", 25, 36},
                              {"7-1", "1-3-5-7-5-3-1", 25, 36},
                              {"1 to 7 to 1", "1-3-5-7-5-3-1", 25, 36},
                              {"1-7-1 ner", "1-3-5-7-5-3-1", 25, 36},
                              {"1-7-1", "1-7-1", 9, 8},
                              {"7,1", "7,1", 8, 7},
                              {"7 X 7 dots", "7x7", 49, 84},
                              {"7×7", "7x7", 49, 84},
                              {"15-8 idukku pulli", "15-8 idukku", 169, 462},
                              {"15 to 8", "15-8 idukku", 169, 462},
                              {"15x8 Sandhu Pulli", "15-8 idukku", 169, 462},
                              {"15–8", "15-8 idukku", 169, 462},
                              {"8-15 idukku", "15-8 idukku", 169, 462},
                              {"5-3", "5-3 idukku", 19, 42},
                              {"3-4-5-4-3", "5-3 idukku", 19, 42},
                              {"5-3 ner", "3-5-3", 11, 14},
                              {"5-1 idukku", "5-1 idukku", 25, 56},
                              {"7x7 idukku", "7-6-7-6-7-6-7", 46, 111},
                              {"15x9-9x3", "9-9-9-15-15-15-15-15-15-15-15-15-9-9-9", 189, 348},
                              {"7x3 to 3", "3-5-7-7-7-5-3", 37, 60},
                              {"ஏழு", "1x7", 7, 6},
                              {"ஏழு முதல் ஒன்று வரை நேர்ப்புள்ளி", "1-3-5-7-5-3-1", 25, 36},
                              {"7 புள்ளி 1 வரை", "1-3-5-7-5-3-1", 25, 36},
                              {"௧௫ இடுக்குப் புள்ளி ௮ வரை", "15-8 idukku", 169, 462},
                              {"பதினைந்து-எட்டு இடுக்கு", "15-8 idukku", 169, 462},
                              {"௭x௭", "7x7", 49, 84},
                              {".o./ooo/.o.", "1-3-1", 5, 4},
                              {"ooo\no.o\r\nooo\n", "ooo/o.o/ooo", 8, 8},
                              {"•••/•_•", "ooo/o.o", 5, 4},
                              {"o o/ o /o o", "2-1-2", 5, 6},
                              {"oo//oo", "oo//oo", 4, 2},
                              {" o o o/o o o/ o   o", " o o o/o o o/ o   o", 8, 12}}) {
        const DotGrid grid = parse_dot_grid(known.text);
        EXPECT_EQ(grid.text(), known.canonical) << known.text;
        EXPECT_EQ(grid.dots().size(), known.dots) << known.text;
        EXPECT_EQ(grid.gaps().size(), known.gaps) << known.text;
        EXPECT_EQ(parse_dot_grid(grid.text()).dots(), grid.dots()) << known.text;
        for (std::uint32_t i = 0; i < grid.dots().size(); ++i) EXPECT_EQ(grid.dot_at(grid.dots()[i]), i);
        for (const GridGap& gap : grid.gaps()) {
            const GridDot way = grid.step(gap.side);
            const GridDot from = grid.dots()[gap.from];
            EXPECT_EQ(grid.dots()[gap.to], (GridDot{from.x + way.x, from.y + way.y})) << known.text;
            // In the plane neighbours are one spacing apart.
            const double height = grid.lattice() == DotLattice::square ? 1.0 : std::sqrt(0.75);
            EXPECT_NEAR(std::hypot(way.x / 2.0, height * way.y / 2.0), 1.0, 1e-15);
        }
    }
    EXPECT_EQ(parse_dot_grid("oo//oo").groups(), 2u);
    EXPECT_EQ(parse_dot_grid("15-8").groups(), 1u);
    EXPECT_THROW(DotGrid(DotLattice::square, {{0, 1}}), std::runtime_error);
    EXPECT_THROW(DotGrid(DotLattice::square, {{}}), std::runtime_error);
}

TEST(DotGrid, RefusesWhatIsNoGrid) {
    for (const char* text : {"0x5", "7x", "x7", "1--3", "-1-3", "7x7x7", "", "7 7", "3-", "7x-7", "to 7", "7 to",
                             "1 to 3 to 5", "7x3-5", "7x3,5x1", "7\n7"}) {
        EXPECT_TRUE(has(error_of([&] { parse_dot_grid(text); }), "expected ROWSxCOLUMNS")) << text;
    }
    for (const char* text : {"99999999x99999999", "4294967295x4294967295", "99999999999999999999x1", "2001x2000",
                             "4000001", "3999999-3"}) {
        EXPECT_TRUE(has(error_of([&] { parse_dot_grid(text); }), "can have at most 4000000 dots")) << text;
    }
    EXPECT_TRUE(has(error_of([] { parse_dot_grid("1-2-4"); }), "row 3 of the grid has 4 dots"));
    EXPECT_TRUE(has(error_of([] { parse_dot_grid("./."); }), "the shape has no dots"));
    EXPECT_TRUE(has(error_of([] { parse_dot_grid("three"); }), "unknown word 'three'"));
    EXPECT_TRUE(has(error_of([] { parse_dot_grid("7-4 ner pulli"); }), "rows from 7 never reach 4"));
    EXPECT_TRUE(has(error_of([] { parse_dot_grid("7x3 to 4"); }), "interlaced rows of the same length"));
    EXPECT_TRUE(has(error_of([] { parse_dot_grid("1-3-5-3-1 idukku"); }), "odd and even numbers"));
    EXPECT_TRUE(has(error_of([] { parse_dot_grid("ஏழு மயில்"); }), "unknown word 'மயில்'"));
    EXPECT_THROW(parse_dot_grid("7 வரை"), std::runtime_error);
    EXPECT_THROW(parse_dot_grid("7 1"), std::runtime_error);
    EXPECT_TRUE(has(error_of([] { parse_dot_grid("ner 7-6-7 idukku"); }), "either straight or interlaced"));
    EXPECT_TRUE(has(error_of([] { parse_dot_grid("o o o/o  o"); }), "column 4 of row 2"));
    EXPECT_NE(error_of([] { DotGrid({}); }), "");
    EXPECT_NE(error_of([] { DotGrid({3, 0}); }), "");
}

TEST(DotGrid, CrossingsAreReadBack) {
    const DotGrid grid = parse_dot_grid("1-3-5-3-1");
    const GapStates crossings = random_states(grid, {.seed = 3});
    const std::string text = gap_states_text(grid, crossings);
    EXPECT_EQ(std::count(text.begin(), text.end(), ' '), 6);  // no gap within the rows of one dot
    EXPECT_EQ(parse_gap_states(grid, text), crossings);
    EXPECT_EQ(parse_gap_states(grid, "all"), GapStates(16, GapState::crossed));
    EXPECT_EQ(parse_gap_states(grid, "None"), GapStates(16, GapState::turned));
    EXPECT_EQ(parse_gap_states(grid, "11111111/0,0000\n000"), parse_gap_states(grid, "1111111100000000"));
    EXPECT_TRUE(has(error_of([&] { parse_gap_states(grid, "0101"); }), "4 digits"));
    EXPECT_NE(error_of([&] { parse_gap_states(grid, "0102"); }), "");
}

// --- lines --------------------------------------------------------------------------------------------------------

TEST(DotGrid, AllCrossingsMakeAsManyLinesAsTheGreatestCommonDivisor) {
    for (std::uint32_t a = 1; a <= 12; ++a) {
        for (std::uint32_t b = 1; b <= 12; ++b) {
            const DotGrid grid(std::vector<std::uint32_t>(a, b));
            const GapStates all(grid.gaps().size(), GapState::crossed);
            EXPECT_EQ(count_lines(grid, all), std::gcd(a, b)) << a << 'x' << b;
            EXPECT_EQ(laplacian_nullity(grid, all), std::gcd(a, b)) << a << 'x' << b;
            EXPECT_EQ(count_lines(grid, GapStates(all.size(), GapState::turned)), a * b);
        }
    }
}

TEST(DotGrid, FollowedLinesAreTheNullity) {
    for (const char* text : {"2x3", "3x3"}) {
        const DotGrid grid = parse_dot_grid(text);
        for (std::uint64_t bits = 0; bits < std::uint64_t{1} << grid.gaps().size(); ++bits) {
            const GapStates crossings = state_of(grid, bits);
            ASSERT_EQ(count_lines(grid, crossings), laplacian_nullity(grid, crossings)) << text << ' ' << bits;
        }
    }
    for (const char* text :
         {"10x10", "7x130", "130x7", "1-3-5-7-9-7-5-3-1", "2-4-6-8-8-2-2", "1-9-1-5-1", "1x200", "50x50"}) {
        const DotGrid grid = parse_dot_grid(text);
        for (std::uint64_t seed = 0; seed < 20; ++seed) {
            const GapStates crossings =
                random_states(grid, {.seed = seed, .density = static_cast<double>(seed) / 19});
            ASSERT_EQ(count_lines(grid, crossings), laplacian_nullity(grid, crossings)) << text << ' ' << seed;
        }
    }
}

/// Interlaced dots whose gaps are all crossed: straight lines in three directions that turn back at the border.
TEST(DotGrid, FollowedLinesAreTheNullityOnInterlacedAndJoinedGaps) {
    for (const char* text : {"2,1", "3-2 idukku", "2-3-4", "ooo/o.o/ooo", "3x3"}) {
        const DotGrid grid = parse_dot_grid(text);
        const std::size_t gaps = grid.gaps().size();
        std::uint64_t count = 1;
        for (std::size_t i = 0; i < gaps; ++i) count *= 3;
        for (std::uint64_t number = 0; number<count; number += count> 100000 ? 61 : 1) {
            GapStates states(gaps);
            std::uint64_t rest = number;
            for (GapState& state : states) {
                state = static_cast<GapState>(rest % 3);
                rest /= 3;
            }
            ASSERT_EQ(count_lines(grid, states), laplacian_nullity(grid, states))
                << text << ' ' << gap_states_text(grid, states);
        }
    }
    for (const char* text :
         {"15-8", "7-4", "20-1 idukku", "9x9 idukku", "ooooo/oo.oo/o...o/oo.oo/ooooo", "12x12", "oo//oo"}) {
        const DotGrid grid = parse_dot_grid(text);
        for (std::uint64_t seed = 0; seed < 20; ++seed) {
            const GapStates states = random_states(grid, {.seed = seed,
                                                          .density = static_cast<double>(seed) / 19,
                                                          .joined = static_cast<double>(seed % 3) / 2});
            ASSERT_EQ(count_lines(grid, states), laplacian_nullity(grid, states)) << text << ' ' << seed;
        }
    }
}

TEST(DotGrid, RandomKolamsAreInOnePiece) {
    for (const char* text : {"9x9", "7-1", "ooo/o.o/ooo"}) {
        const DotGrid grid = parse_dot_grid(text);
        for (std::uint64_t seed = 0; seed < 20; ++seed) {
            for (const GridSymmetry symmetry : usual_symmetries(grid, false)) {
                const GapStates states = random_states(
                    grid, {.seed = seed, .density = 0.1, .joined = 0.1, .symmetry = symmetry, .composed = true});
                EXPECT_TRUE(is_symmetric(grid, states, symmetry));
                std::vector<std::uint32_t> reached = {0};  // from the first dot through gaps that do not turn back
                for (std::size_t i = 0; i < reached.size(); ++i) {
                    for (std::uint32_t side = 0; side < grid.sides(); ++side) {
                        const std::int32_t gap = grid.gap(reached[i], side);
                        if (gap < 0 || states[static_cast<std::size_t>(gap)] == GapState::turned) continue;
                        const GridGap& open = grid.gaps()[static_cast<std::size_t>(gap)];
                        for (const std::uint32_t dot : {open.from, open.to}) {
                            if (std::find(reached.begin(), reached.end(), dot) == reached.end())
                                reached.push_back(dot);
                        }
                    }
                }
                EXPECT_EQ(reached.size(), grid.dots().size()) << text << ' ' << seed;
            }
        }
    }
}

/// The most crossings that a line runs straight through, one after the other.
std::size_t longest_run(const DotGrid& grid, const GapStates& states) {
    std::size_t longest = 0;
    for (const ArcStep& start : line_starts(grid, states)) {
        std::size_t run = 0;
        ArcStep step = start;
        for (int round = 0; round < 2; ++round) {  // a run may pass the start
            do {
                const ArcStep next = next_step(grid, states, step);
                run = next.dot != step.dot && heading(grid, next) == heading(grid, step) ? run + 1 : 0;
                longest = std::max(longest, run);
                step = next;
            } while (step != start);
        }
    }
    return longest;
}

std::size_t single_rings(const DotGrid& grid, const GapStates& states) {
    std::vector<char> is_crossed(grid.dots().size());
    for (std::size_t i = 0; i < states.size(); ++i) {
        if (states[i] != GapState::turned) is_crossed[grid.gaps()[i].from] = is_crossed[grid.gaps()[i].to] = 1;
    }
    return static_cast<std::size_t>(std::count(is_crossed.begin(), is_crossed.end(), 0));
}

TEST(DotGrid, InterlacedKolamsAreComposed) {
    for (const char* text : {"5-3", "7-4", "9-5", "7x7 idukku", "8-1 idukku", "4-5-6-7"}) {
        const DotGrid grid = parse_dot_grid(text);
        for (const GridSymmetry symmetry : usual_symmetries(grid, false)) {
            std::set<std::string> different;
            constexpr std::uint64_t seeds = 6;
            for (std::uint64_t seed = 0; seed < seeds; ++seed) {
                const GapStates states = random_states(grid, {.seed = seed, .symmetry = symmetry, .composed = true});
                const std::string what = fmt::format("{} {} {}", text, grid_symmetry_name(symmetry), seed);
                EXPECT_TRUE(is_symmetric(grid, states, symmetry)) << what;
                EXPECT_LE(longest_run(grid, states), 6u) << what;
                EXPECT_LE(single_rings(grid, states), 3 + grid.dots().size() / 6) << what;
                different.insert(gap_states_text(grid, canonical_states(grid, states)));
            }
            EXPECT_GE(different.size(), grid.dots().size() > 60 ? seeds : 1) << text;
        }
    }
    // Independent gaps are not.
    const DotGrid grid = parse_dot_grid("15-8");
    const GapStates independent = random_states(grid, {.seed = 1, .symmetry = GridSymmetry::d6});
    EXPECT_GT(longest_run(grid, independent), 8u);
}

/// Gaps between neighbouring layers of dots, by the outer layer, and those of them that are crossed. Layers count
/// from the rim.
std::map<int, std::array<std::size_t, 2>> gaps_between_layers(const DotGrid& grid, const GapStates& states) {
    std::vector<int> layers(grid.dots().size(), -1);
    for (int layer = 0; std::find(layers.begin(), layers.end(), -1) != layers.end(); ++layer) {
        for (std::uint32_t dot = 0; dot < layers.size(); ++dot) {
            bool is_at_rim = false;  // of the dots that are left
            for (std::uint32_t side = 0; side < grid.sides(); ++side) {
                const GridDot next = grid.dots()[dot] + grid.step(side);
                const auto other = grid.dot_at(next);
                is_at_rim = is_at_rim || !other || (layers[*other] >= 0 && layers[*other] < layer);
            }
            if (layers[dot] < 0 && is_at_rim) layers[dot] = layer;
        }
    }
    std::map<int, std::array<std::size_t, 2>> between;
    for (std::size_t i = 0; i < states.size(); ++i) {
        const int from = layers[grid.gaps()[i].from], to = layers[grid.gaps()[i].to];
        if (from == to) continue;
        auto& [gaps, crossed] = between[std::min(from, to)];
        ++gaps;
        crossed += states[i] == GapState::crossed;
    }
    return between;
}

/// A frame surrounds the middle: no line leads from one to the other.
TEST(DotGrid, LargeInterlacedKolamsAreFramed) {
    for (const char* text : {"11-6", "13-7", "15-8", "19-10", "9x9 idukku", "12x8 idukku", "13-1 idukku",
                             "1-2-3-4-5-6-7-8-9-10-11-12-13", "12-5 idukku"}) {
        const DotGrid grid = parse_dot_grid(text);
        for (const GridSymmetry symmetry : usual_symmetries(grid, false)) {
            std::set<std::string> different;
            constexpr std::uint64_t seeds = 8;
            for (std::uint64_t seed = 0; seed < seeds; ++seed) {
                const GapStates states = random_states(grid, {.seed = seed, .symmetry = symmetry, .composed = true});
                const std::string what = fmt::format("{} {} {}", text, grid_symmetry_name(symmetry), seed);
                EXPECT_TRUE(is_symmetric(grid, states, symmetry)) << what;
                EXPECT_LE(single_rings(grid, states), 3 + grid.dots().size() / 6) << what;
                const auto between = gaps_between_layers(grid, states);
                EXPECT_TRUE(std::any_of(between.begin(), between.end(), [](const auto& layer) {
                    return layer.second[1] == 0;
                })) << what;
                different.insert(gap_states_text(grid, canonical_states(grid, states)));
            }
            EXPECT_GE(different.size(), seeds - 1) << text << ' ' << grid_symmetry_name(symmetry);
        }
    }
}

/// The middle of a square is a flower with six mirrors, though the square has two.
TEST(DotGrid, MiddlesOfSquaresAreHexagons) {
    const DotGrid grid = parse_dot_grid("9x9 idukku");
    const std::uint32_t centre = *grid.dot_at({0, 0});
    std::size_t hexagons = 0;
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
        const GapStates states =
            random_states(grid, {.seed = seed, .symmetry = GridSymmetry::mirrors, .composed = true});
        std::array<std::set<GapState>, 3> found;  // the states of gaps at the centre, and of two rings around it
        for (std::uint32_t side = 0; side < grid.sides(); ++side) {
            found[0].insert(states[static_cast<std::size_t>(grid.gap(centre, side))]);
            const std::uint32_t corner = *grid.dot_at(grid.step(side));
            found[1].insert(states[static_cast<std::size_t>(grid.gap(corner, (side + 2) % 6))]);
            found[2].insert(states[static_cast<std::size_t>(grid.gap(corner, side))]);
        }
        hexagons += std::all_of(found.begin(), found.end(), [](const auto& ring) { return ring.size() == 1; });
    }
    EXPECT_GE(hexagons, 8u);
}

TEST(DotGrid, ComposesOneDotARowAndManyDots) {
    for (const char* text :
         {"1", "2,1", "1-2-1-2-1-2", "3-2 idukku", "300-201 idukku", "50,49", "40-41-40", "2x60 idukku"}) {
        const DotGrid grid = parse_dot_grid(text);
        const GapStates states = random_states(grid, {.seed = 1, .composed = true});
        EXPECT_EQ(states.size(), grid.gaps().size()) << text;
        EXPECT_EQ(count_lines(grid, states), line_starts(grid, states).size()) << text;
    }
}

TEST(DotGrid, MendingChangesOneGapLessThanThereAreLines) {
    for (const char* text : {"1x1", "2x2", "7x7", "10x3", "1-3-5-7-5-3-1", "50x50", "9-5", "ooo/o.o/ooo"}) {
        const DotGrid grid = parse_dot_grid(text);
        for (std::uint64_t seed = 0; seed < 10; ++seed) {
            const GapStates before = random_states(grid, {.seed = seed, .density = 0.1 * static_cast<double>(seed)});
            GapStates after = before;
            const std::size_t lines = count_lines(grid, before);
            EXPECT_EQ(make_single_line(grid, after, seed), lines - 1);
            std::size_t different = 0;
            for (std::size_t i = 0; i < before.size(); ++i) different += before[i] != after[i];
            EXPECT_EQ(different, lines - 1);
            EXPECT_EQ(count_lines(grid, after), 1u);
            EXPECT_EQ(laplacian_nullity(grid, after), 1u);
        }
    }
}

// --- symmetry -----------------------------------------------------------------------------------------------------

TEST(DotGrid, SymmetriesHaveNames) {
    for (const char* name : {"none", "C2", "C3", "C4", "C6", "mirror-x", "mirror-y", "diagonal", "mirrors",
                             "diagonals", "D3", "D3-y", "D4", "D6"}) {
        EXPECT_EQ(grid_symmetry_name(parse_grid_symmetry(name)), name);
    }
    EXPECT_EQ(grid_symmetry_list().size(), 14u);
    EXPECT_EQ(parse_grid_symmetry("d1"), GridSymmetry::mirror_x);
    EXPECT_EQ(parse_grid_symmetry("D2"), GridSymmetry::mirrors);
    EXPECT_EQ(parse_grid_symmetry("c4"), GridSymmetry::c4);
    EXPECT_EQ(parse_grid_symmetry("Mirror X"), GridSymmetry::mirror_x);
    EXPECT_TRUE(has(error_of([] { parse_grid_symmetry("C5"); }), "expected none, C2"));
}

/// A crossing seen through a map of the plane, by the places of its dots.
TEST(DotGrid, SymmetricSetsAreSymmetric) {
    const auto quarter = [](GridDot dot) { return GridDot{-dot.y, dot.x}; };
    const auto half = [](GridDot dot) { return GridDot{-dot.x, -dot.y}; };
    const auto left = [](GridDot dot) { return GridDot{-dot.x, dot.y}; };
    const auto top = [](GridDot dot) { return GridDot{dot.x, -dot.y}; };
    for (const char* text : {"7x7", "6x6", "1-3-5-7-5-3-1", "2-4-4-2"}) {
        const DotGrid grid = parse_dot_grid(text);
        for (const GridSymmetry symmetry : {GridSymmetry::c2, GridSymmetry::c4, GridSymmetry::mirror_x,
                                            GridSymmetry::mirror_y, GridSymmetry::mirrors, GridSymmetry::d4}) {
            const GapStates crossings = random_states(grid, {.seed = 5, .density = 0.5, .symmetry = symmetry});
            const auto holds = [&](const auto& map) {
                std::map<std::pair<std::uint32_t, std::uint32_t>, GapState> set;
                for (std::size_t i = 0; i < crossings.size(); ++i) {
                    set[std::minmax(grid.gaps()[i].from, grid.gaps()[i].to)] = crossings[i];
                }
                for (std::size_t i = 0; i < crossings.size(); ++i) {
                    const auto from = *grid.dot_at(map(grid.dots()[grid.gaps()[i].from]));
                    const auto to = *grid.dot_at(map(grid.dots()[grid.gaps()[i].to]));
                    if (set.at(std::minmax(from, to)) != crossings[i]) return false;
                }
                return true;
            };
            const bool is_d4 = symmetry == GridSymmetry::d4;
            const bool is_mirrors = symmetry == GridSymmetry::mirrors || is_d4;
            EXPECT_EQ(holds(quarter), symmetry == GridSymmetry::c4 || is_d4) << text;
            EXPECT_EQ(holds(half), symmetry == GridSymmetry::c2 || symmetry == GridSymmetry::c4 || is_mirrors)
                << text;
            EXPECT_EQ(holds(left), symmetry == GridSymmetry::mirror_x || is_mirrors) << text;
            EXPECT_EQ(holds(top), symmetry == GridSymmetry::mirror_y || is_mirrors) << text;
            EXPECT_TRUE(is_symmetric(grid, crossings, symmetry));
            EXPECT_EQ(is_symmetric(grid, crossings, GridSymmetry::d4), is_d4);
        }
    }
    EXPECT_EQ(grid_symmetries(parse_dot_grid("5x5")).size(), 8u);
    EXPECT_EQ(grid_symmetries(parse_dot_grid("5x4")).size(), 4u);
    EXPECT_EQ(grid_symmetries(parse_dot_grid("1-3-5")).size(), 2u);
    EXPECT_TRUE(has(error_of([] { random_states(parse_dot_grid("3x4"), {.symmetry = GridSymmetry::c4}); }),
                    "3x4 itself does not have the symmetry C4"));
    EXPECT_NE(error_of([] { random_states(parse_dot_grid("3x4"), {.density = std::nan("")}); }), "");
}

TEST(DotGrid, ImagesOfAKolamHaveOneCode) {
    std::set<std::string> codes;
    for (const char* text : {"5x5", "5-3", "1-3-5"}) {
        const DotGrid grid = parse_dot_grid(text);
        for (std::uint64_t seed = 0; seed < 5; ++seed) {
            const GapStates states = random_states(grid, {.seed = seed, .density = 0.5, .joined = 0.3});
            const std::string code = kolam_code(grid, states);
            EXPECT_EQ(code.size(), 8u);
            EXPECT_TRUE(codes.insert(code).second) << text << ' ' << seed;
            for (const auto& images : grid_symmetries(grid)) {
                GapStates image(states.size());
                for (std::size_t i = 0; i < images.size(); ++i) image[images[i]] = states[i];
                EXPECT_EQ(kolam_code(grid, image), code);
            }
        }
    }
}

TEST(DotGrid, SymmetriesTakeLinesToLines) {
    for (const char* text : {"3x4", "5x5", "5-3", "1-3-5", "oo./ooo/.oo"}) {
        const DotGrid grid = parse_dot_grid(text);
        const GapStates states = random_states(grid, {.seed = 3, .density = 0.5, .joined = 0.4});
        LineLabels before;
        label_lines(grid, states, before, {});
        const auto gaps = grid_symmetries(grid);
        const auto arcs = arc_symmetries(grid);
        ASSERT_EQ(arcs.size(), gaps.size());
        for (std::size_t k = 0; k < gaps.size(); ++k) {
            GapStates image(states.size());
            for (std::size_t i = 0; i < states.size(); ++i) image[gaps[k][i]] = states[i];
            LineLabels after;
            label_lines(grid, image, after, {});
            EXPECT_EQ(std::set<std::uint32_t>(arcs[k].begin(), arcs[k].end()).size(), before.line.size());
            std::set<std::pair<std::uint32_t, std::uint32_t>> lines;
            for (std::size_t i = 0; i < arcs[k].size(); ++i) {
                lines.insert({before.line[i], after.line[arcs[k][i]]});
            }
            EXPECT_EQ(lines.size(), before.starts.size()) << text << ' ' << k;
            EXPECT_EQ(after.starts.size(), before.starts.size());
        }
    }
}

TEST(DotGrid, PlacesHaveImages) {
    const DotGrid square(parse_dot_grid("5x5"));
    EXPECT_EQ(place_images(square, {0, 0}, GridSymmetry::d4).size(), 1u);
    EXPECT_EQ(place_images(square, {4, 2}, GridSymmetry::d4).size(), 8u);
    EXPECT_EQ(place_images(square, {6, 0}, GridSymmetry::c2), (std::vector<GridDot>{{6, 0}, {-6, 0}}));
    EXPECT_EQ(place_images(square, {6, 2}, GridSymmetry::diagonal), (std::vector<GridDot>{{6, 2}, {2, 6}}));
    EXPECT_EQ(place_images(parse_dot_grid("5-3"), {3, 2}, GridSymmetry::d6).size(), 6u);
    EXPECT_NE(error_of([&] { place_images(square, {0, 0}, GridSymmetry::c6); }), "");
    EXPECT_TRUE(square.is_solid());
    EXPECT_TRUE(parse_dot_grid("15-8 idukku").is_solid());
    EXPECT_FALSE(parse_dot_grid("oo./ooo").is_solid());
    EXPECT_FALSE(parse_dot_grid("o.o").is_solid());
}

TEST(DotGrid, ChanceIsTheSameEverywhere) {
    // SplitMix64 of 0 begins E220A839…, 6E789E6A…, 06C45D18…, F88BB8A8…: of 1 about 0.88, 0.43, 0.03, 0.97.
    EXPECT_EQ(gap_states_text(parse_dot_grid("2x2"), random_states(parse_dot_grid("2x2"), {})), "0 11 0");
    const DotGrid grid = parse_dot_grid("100x100");
    const GapStates crossings = random_states(grid, {.seed = 1, .density = 0.3});
    EXPECT_NEAR(static_cast<double>(std::count(crossings.begin(), crossings.end(), GapState::crossed)) / 19800, 0.3,
                0.015);
    EXPECT_NE(crossings, random_states(grid, {.seed = 2, .density = 0.3}));
}

TEST(DotGrid, SingleLinesWithASymmetryAreFound) {
    for (const auto& [text, symmetry] :
         {std::pair{"7x7", GridSymmetry::c4}, std::pair{"21x21", GridSymmetry::c4},
          std::pair{"1-3-5-7-9-7-5-3-1", GridSymmetry::c4}, std::pair{"20x21", GridSymmetry::mirrors},
          std::pair{"20x20", GridSymmetry::mirror_x}, std::pair{"9x9", GridSymmetry::c2},
          std::pair{"1-3-1", GridSymmetry::d4}, std::pair{"12x5", GridSymmetry::none},
          std::pair{"15-8", GridSymmetry::c6}, std::pair{"9-5", GridSymmetry::c3}, std::pair{"7-4", GridSymmetry::c2},
          std::pair{"3-2", GridSymmetry::d6}, std::pair{"7-4", GridSymmetry::mirror_y},
          std::pair{"1-2-3-4-5", GridSymmetry::c3}, std::pair{"2,1", GridSymmetry::d3}}) {
        const DotGrid grid = parse_dot_grid(text);
        const RandomKolam random{.seed = 11, .symmetry = symmetry};
        ASSERT_EQ(single_line_obstacle(grid, symmetry), std::nullopt) << text;
        const auto found = find_single_line(grid, random);
        ASSERT_TRUE(found) << text;
        EXPECT_EQ(count_lines(grid, found->states), 1u) << text;
        EXPECT_TRUE(is_symmetric(grid, found->states, symmetry)) << text;
        EXPECT_EQ(find_single_line(grid, random)->states, found->states) << text;
    }
    EXPECT_FALSE(find_single_line(parse_dot_grid("4x4"), {.symmetry = GridSymmetry::c4}, 50));
    EXPECT_FALSE(find_single_line(parse_dot_grid("oo//oo"), {}));
}

// --- enumeration --------------------------------------------------------------------------------------------------

struct Row {
    const char* grid;
    GridSymmetry symmetry;
    std::uint64_t states, single_line, distinct;
};
void expect_rows(const std::vector<Row>& rows) {
    for (const Row& row : rows) {
        const Enumeration found = enumerate_single_lines(parse_dot_grid(row.grid), {.symmetry = row.symmetry});
        const std::string what = row.grid + (" " + std::string(grid_symmetry_name(row.symmetry)));
        EXPECT_EQ(found.states, row.states) << what;
        EXPECT_EQ(found.single_line, row.single_line) << what;
        if (row.distinct > 0) {
            EXPECT_EQ(found.distinct, row.distinct) << what;
        }
    }
}
constexpr auto none = GridSymmetry::none;
constexpr auto c4 = GridSymmetry::c4;
constexpr auto mirrors = GridSymmetry::mirrors;
constexpr auto d4 = GridSymmetry::d4;

TEST(DotGridEnumeration, CountsSingleLines) {
    expect_rows({{"1x1", none, 1, 1, 1},
                 {"1x9", none, 256, 1, 1},
                 {"2x2", none, 16, 4, 1},
                 {"2x3", none, 128, 16, 7},
                 {"2x3", mirrors, 8, 2, 2},
                 {"3x3", none, 4096, 240, 35},
                 {"3x3", c4, 8, 2, 1},
                 {"3x3", mirrors, 16, 2, 1},
                 {"3x3", d4, 4, 0, 0},
                 {"1-3-1", none, 16, 1, 1},
                 {"1-3-1", d4, 2, 1, 1},
                 {"1-3-5-3-1", none, 65536, 240, 35},
                 {"1-3-5-3-1", c4, 16, 2, 1},
                 {"3x4", none, 131072, 3584, 936},
                 {"4x3", none, 131072, 3584, 936},
                 {"3x4", mirrors, 64, 8, 8},
                 {"3x5", none, 4194304, 53504, 13496},
                 {"3x5", mirrors, 128, 8, 8},
                 {"4x4", none, 16777216, 196608, 24704},
                 {"4x4", c4, 64, 0, 0},
                 {"4x4", d4, 16, 0, 0},
                 {"5x5", c4, 1024, 80, 0},
                 {"5x5", mirrors, 4096, 80, 0},
                 {"5x5", d4, 64, 0, 0},
                 {"6x6", c4, 32768, 0, 0},
                 {"6x6", mirrors, 262144, 0, 0},
                 {"7x7", c4, 2097152, 46592, 0},
                 {"7x7", d4, 4096, 0, 0},
                 {"1-3-5-7-5-3-1", c4, 512, 24, 0},
                 {"1-3-5-7-5-3-1", mirrors, 4096, 24, 0},
                 {"1-3-5-7-9-7-5-3-1", c4, 65536, 1088, 0},
                 {"1-3-5-7-9-7-5-3-1", mirrors, 1048576, 768, 0},
                 {"1-3-5-7-9-7-5-3-1", d4, 1024, 0, 0}});
}

TEST(DotGridEnumeration, CountsLargerOnesInTheFullCheck) {
    if (!std::getenv("SIKKU_FULL")) GTEST_SKIP() << "many seconds; SIKKU_FULL=1 runs it";
    expect_rows({{"4x5", none, std::uint64_t{1} << 31U, 10747904, 2689280},
                 {"5x4", none, std::uint64_t{1} << 31U, 10747904, 2689280}});
}

/// Three states of a gap.
TEST(DotGridEnumeration, CountsJoinedGaps) {
    for (const auto& [text, count] : {std::pair{"2x2", 40u}, std::pair{"2x3", 768u}, std::pair{"3x3", 132160u}}) {
        const Enumeration found = enumerate_single_lines(parse_dot_grid(text), {.joined = true});
        EXPECT_EQ(found.single_line, count) << text;
        EXPECT_EQ(found.states, static_cast<std::uint64_t>(std::pow(3, found.choices))) << text;
    }
    EXPECT_TRUE(has(error_of([] { enumerate_single_lines(parse_dot_grid("4x4"), {.joined = true}); }),
                    "24 free gaps make 3^24"));
}

/// The same numbers by looking at every state: lines by the Laplacian, classes by the orbits of their members.
TEST(DotGridEnumeration, AgreesWithLookingAtEveryState) {
    for (const char* text :
         {"2x2", "2x4", "3x3", "1-3-5", "1-3-1-3", "2-4-2", "3-2", "2,1", "3-2-1", "ooo/o.o/ooo"}) {
        const DotGrid grid = parse_dot_grid(text);
        const auto symmetries = grid_symmetries(grid);
        for (const GridSymmetry symmetry : grid_symmetry_list()) {
            if (!has_symmetry(grid, symmetry)) continue;
            std::vector<GapStates> single;
            std::vector<GapStates> distinct;
            for (std::uint64_t bits = 0; bits < std::uint64_t{1} << grid.gaps().size(); ++bits) {
                const GapStates crossings = state_of(grid, bits);
                if (!is_symmetric(grid, crossings, symmetry) || laplacian_nullity(grid, crossings) != 1) continue;
                single.push_back(crossings);
            }
            for (const GapStates& crossings : single) {
                GapStates least = crossings;
                for (const auto& images : symmetries) {
                    GapStates image(crossings.size());
                    for (std::size_t i = 0; i < images.size(); ++i) image[images[i]] = crossings[i];
                    if (is_symmetric(grid, image, symmetry)) least = std::min(least, image);
                }
                if (std::find(distinct.begin(), distinct.end(), least) == distinct.end()) distinct.push_back(least);
            }
            std::sort(distinct.begin(), distinct.end());
            for (const int threads : {1, 3}) {
                const Enumeration found =
                    enumerate_single_lines(grid, {.symmetry = symmetry, .keep = 100000, .threads = threads});
                const std::string what = text + (" " + std::string(grid_symmetry_name(symmetry)));
                EXPECT_EQ(found.single_line, single.size()) << what;
                EXPECT_EQ(found.distinct, distinct.size()) << what;
                EXPECT_EQ(found.kolams, distinct) << what;
            }
        }
    }
}

TEST(DotGridEnumeration, ObstaclesAreReal) {
    for (const char* text :
         {"1x1", "1x4", "1x5", "2x2", "2x3", "3x3", "2x4", "4x4", "3x4", "5x5", "6x6", "4x6", "1-3-1", "1-3-5-3-1",
          "1-1-5-1-1", "2-4-4-2", "1-3-5", "3-1-3", "1-5-5-5-1",
          // interlaced
          "2,1", "1-2-3", "1-2-3-4", "1-2-3-4-5", "3-2", "5-3", "4-2", "4-5-4", "5-4-5", "2-3-2-3", "7-4",
          // with holes
          "ooo/o.o/ooo", "ooooo/o.o.o/ooooo", " o o / o   o/ o o ", "oo/o.o/.oo"}) {
        const DotGrid grid = parse_dot_grid(text);
        for (const GridSymmetry symmetry : grid_symmetry_list()) {
            if (!has_symmetry(grid, symmetry)) continue;
            const auto orbits = gap_orbits(grid, symmetry);
            if (!orbits.empty() && *std::max_element(orbits.begin(), orbits.end()) >= 22) continue;
            EXPECT_EQ(single_line_obstacle(grid, symmetry).has_value(),
                      enumerate_single_lines(grid, {.symmetry = symmetry}).single_line == 0)
                << text << ' ' << grid_symmetry_name(symmetry);
        }
    }
}

TEST(DotGridEnumeration, RefusesWhatTakesTooLong) {
    EXPECT_TRUE(has(error_of([] { enumerate_single_lines(parse_dot_grid("10x10")); }), "180 free gaps make 2^180"));
    EXPECT_NE(error_of([] { enumerate_single_lines(parse_dot_grid("300x300")); }), "");
    EXPECT_NE(error_of([] { enumerate_single_lines(parse_dot_grid("3x4"), {.symmetry = c4}); }), "");
    EXPECT_THROW(enumerate_single_lines(parse_dot_grid("4x4"), {.monitor = Monitor([](void*) { return true; })}),
                 Stopped);
    const Enumeration few = enumerate_single_lines(parse_dot_grid("3x3"), {.keep = 4});
    EXPECT_EQ(few.kolams.size(), 4u);
    EXPECT_EQ(few.distinct, 35u);
}

// --- patterns -----------------------------------------------------------------------------------------------------

struct Drawn {
    std::vector<reference::Line> controls;  // of strokes that are seen, before the spline
    std::vector<reference::Line> strokes;   // after it
    Style style;
};
Drawn drawn(const std::string& text) {
    Diagnostics diagnostics;
    const Pattern pattern = parse_pattern("kolam.lsys", text, diagnostics);
    Drawn result;
    result.style = read_style(pattern, 300, diagnostics);
    check_keys(pattern, diagnostics);
    const Grammar grammar = compile_grammar(pattern, diagnostics);
    EXPECT_TRUE(diagnostics.list().empty()) << text;
    EXPECT_LE(grammar.steps(), 1);
    EXPECT_EQ(result.style.line, Line::spline);
    const auto walk = [&](PathSink& sink) {
        const auto turtle = Turtle::drawing(grammar, sink, true);
        derive(grammar, *turtle);
    };
    StrokeCensus census;
    walk(census);
    reference::Recorder controls;
    walk(controls);
    reference::Recorder curves;
    SplineSink spline(curves, census.closed);
    walk(spline);
    const auto seen = [&](const std::vector<reference::Line>& all) {
        std::vector<reference::Line> kept;
        std::copy_if(all.begin(), all.end(), std::back_inserter(kept),
                     [&](const reference::Line& line) { return result.style.draws(line.pens.at(0)); });
        return kept;
    };
    result.controls = seen(controls.strokes);
    result.strokes = seen(curves.strokes);
    return result;
}

std::pair<long, long> rounded(glm::dvec2 point) {
    return {std::lround(point.x * 1e6), std::lround(point.y * 1e6)};
}
/// The middles of the sides of all dots, in the turtle's plane; gaps, and the sides without one.
struct Middles {
    std::map<std::pair<long, long>, std::size_t> gaps;
    std::map<std::pair<long, long>, std::uint32_t> border;  // and the dot
};
Middles middles(const DotGrid& grid, const std::vector<glm::dvec2>& dots) {
    Middles found;
    const double distance = std::sqrt(0.5);  // from a dot, in steps
    for (std::uint32_t dot = 0; dot < dots.size(); ++dot) {
        for (std::uint32_t side = 0; side < grid.sides(); ++side) {
            const double angle = 2 * std::numbers::pi * side / grid.sides();
            const auto middle = rounded(dots[dot] + distance * glm::dvec2(std::cos(angle), std::sin(angle)));
            const std::int32_t gap = grid.gap(dot, side);
            if (gap < 0) {
                found.border[middle] = dot;
            } else {
                found.gaps[middle] = static_cast<std::size_t>(gap);
            }
        }
    }
    return found;
}

TEST(DotGridPattern, StrokesAreTheLines) {
    for (const auto& [text, density] :
         {std::pair{"1x1", 0.7}, std::pair{"3x3", 0.0}, std::pair{"3x3", 1.0}, std::pair{"7x7", 0.7},
          std::pair{"5x8", 0.4}, std::pair{"1-3-5-7-5-3-1", 0.7}, std::pair{"2-8-4", 0.9}, std::pair{"30x30", 0.6},
          std::pair{"ooo/o.o/ooo", 0.8}}) {
        const DotGrid grid = parse_dot_grid(text);
        for (const bool single : {false, true}) {
            GapStates crossings = random_states(grid, {.seed = 9, .density = density, .joined = 0.3});
            if (single) make_single_line(grid, crossings, 1);
            const KolamPattern pattern = kolam_pattern(grid, crossings, {.title = "A kolam", .description = "one"});
            EXPECT_EQ(pattern.lines, count_lines(grid, crossings));
            const Drawn found = drawn(pattern.text);
            ASSERT_EQ(found.controls.size(), pattern.lines);
            const Middles known = middles(grid, pattern.dots);
            std::vector<int> visits(crossings.size());
            std::map<std::pair<long, long>, int> border;
            std::vector<glm::dvec2> last_tangent(crossings.size());
            for (std::size_t k = 0; k < found.strokes.size(); ++k) {
                const std::vector<glm::dvec2>& controls = found.controls[k].points;
                const std::vector<glm::dvec2>& curve = found.strokes[k].points;
                const std::size_t count = controls.size() - 1;
                EXPECT_TRUE(found.controls[k].closed);
                EXPECT_TRUE(found.strokes[k].closed);
                ASSERT_EQ(curve.size(), 3 * count + 1);
                for (std::size_t i = 0; i < count; ++i) {
                    const glm::dvec2 control = controls[(i + 1) % count];
                    const auto place = rounded(control);
                    const auto gap = known.gaps.find(place);
                    if (gap == known.gaps.end()) {
                        ASSERT_TRUE(known.border.contains(place));
                        ++border[place];
                        continue;
                    }
                    ++visits[gap->second];
                    if (crossings[gap->second] != GapState::crossed) continue;
                    // The curve runs through the crossing, straight, at right angles to itself.
                    const glm::dvec2 ahead = curve[3 * i + 1] - curve[3 * i];
                    EXPECT_NEAR(curve[3 * i].x, control.x, 1e-12);
                    EXPECT_NEAR(curve[3 * i].y, control.y, 1e-12);
                    glm::dvec2& before = last_tangent[gap->second];
                    EXPECT_NEAR(ahead.x * before.x + ahead.y * before.y, 0, 1e-12);  // 0 at first
                    before = ahead;
                }
            }
            EXPECT_TRUE(std::all_of(visits.begin(), visits.end(), [](int count) { return count == 2; }));
            EXPECT_EQ(border.size(), known.border.size());
            for (const auto& [place, count] : border) EXPECT_EQ(count, 1);
        }
    }
}

/// Control points of rounded lines lie between dots, and pass gaps as the states say.
TEST(DotGridPattern, RoundedStrokesAreTheLines) {
    for (const auto& [text, density] : {std::pair{"7-4", 0.7}, std::pair{"5-6-7", 1.0}, std::pair{"2,1", 0.5}}) {
        const DotGrid grid = parse_dot_grid(text);
        for (const bool single : {false, true}) {
            GapStates states = random_states(grid, {.seed = 9, .density = density});
            if (single) make_single_line(grid, states, 1);
            const KolamPattern pattern = kolam_pattern(grid, states);
            const Drawn found = drawn(pattern.text);
            ASSERT_EQ(found.controls.size(), pattern.lines);
            std::vector<int> visits(states.size());
            std::size_t outer = 0;
            for (const reference::Line& line : found.controls) {
                EXPECT_TRUE(line.closed);
                for (std::size_t i = 0; i + 1 < line.points.size(); ++i) {
                    int nearest = 0;  // gaps on whose segment the point lies
                    for (std::size_t gap = 0; gap < states.size(); ++gap) {
                        const glm::dvec2 a = pattern.dots[grid.gaps()[gap].from],
                                         b = pattern.dots[grid.gaps()[gap].to];
                        const glm::dvec2 way = (b - a) / 4.0, from = line.points[i] - a;  // 2 steps apart
                        const double along = way.x * from.x + way.y * from.y;
                        if (std::fabs(2 * (way.x * from.y - way.y * from.x)) > 1e-6 || along < 0 || along > 1)
                            continue;
                        ++nearest;
                        ++visits[gap];
                        const double least = states[gap] == GapState::crossed ? 0.36 : 0.32;
                        EXPECT_GE(std::min(along, 1 - along), least - 1e-6);
                        EXPECT_GE(std::fabs(along - 0.5), states[gap] == GapState::turned ? 0.08 - 1e-6 : 0.0);
                    }
                    EXPECT_LE(nearest, 1);
                    outer += nearest == 0;
                }
            }
            EXPECT_TRUE(std::all_of(visits.begin(), visits.end(), [](int count) { return count == 2; })) << text;
            EXPECT_EQ(outer, 6 * grid.dots().size() - 2 * grid.gaps().size()) << text;
        }
    }
}

/// What was made is what the examination of the drawing finds, by another way.
TEST(DotGridPattern, ExaminationsFindWhatWasMade) {
    for (const char* text : {"7x7", "1-3-5-3-1", "7-4", "9-5", "4-5-6", "ooo/o.o/ooo", " o o / o   o/ o o "}) {
        const DotGrid grid = parse_dot_grid(text);
        const bool is_square = grid.lattice() == DotLattice::square;
        for (const GridSymmetry symmetry : usual_symmetries(grid, false)) {
            const GapStates states =
                random_states(grid, {.seed = 5, .density = 0.6, .symmetry = symmetry, .composed = true});
            const std::string pattern = kolam_pattern(grid, states).text;
            const Style style = drawn(pattern).style;
            const KolamExamination found =
                examine_kolam(reference::grammar_of(pattern),
                              {.spline = true, .draws = [&](const Pen& pen) { return style.draws(pen); }});
            const std::string what = text + (" " + std::string(grid_symmetry_name(symmetry)));
            EXPECT_EQ(found.is_exact, is_square) << what;
            EXPECT_TRUE(found.is_kolam()) << what;
            EXPECT_EQ(found.lines, count_lines(grid, states)) << what;
            EXPECT_EQ(found.dots.size(), grid.dots().size()) << what;
            EXPECT_EQ(found.crossings, std::count(states.begin(), states.end(), GapState::crossed)) << what;
            // Rounded lines keep their distance.
            EXPECT_EQ(found.touchings, is_square ? std::count(states.begin(), states.end(), GapState::turned) : 0)
                << what;
            EXPECT_GE(found.skew, is_square ? 0 : found.crossings / 2) << what;
            std::size_t kept = 0;  // the kolam's own symmetries
            for (const auto& images : grid_symmetries(grid)) {
                bool is_kept = true;
                for (std::size_t i = 0; i < images.size(); ++i) is_kept = is_kept && states[i] == states[images[i]];
                kept += is_kept;
            }
            EXPECT_EQ(found.symmetry.rotations + found.symmetry.mirrors, kept) << what;
        }
    }
}

/// Certified by the same examination.
TEST(DotGridPattern, ShapedRimsAddNoCrossings) {
    for (const RimStyle rim : {RimStyle::pointed, RimStyle::petal, RimStyle::horn, RimStyle::crescent}) {
        std::size_t shaped = 0;
        for (const char* text : {"7-1", "5x5", "9-1", "7-4", "9-5", "ooo/o.o/ooo", "1-2-3-4"}) {
            const DotGrid grid = parse_dot_grid(text);
            const std::vector<GridSymmetry> symmetries = usual_symmetries(grid, false);
            for (std::uint64_t seed = 0; seed < 4; ++seed) {
                GapStates states = random_states(
                    grid, {.seed = seed, .symmetry = symmetries[seed % symmetries.size()], .composed = true});
                if (seed == 3) make_single_line(grid, states, seed);
                const KolamPattern pattern = kolam_pattern(grid, states, {.rim = rim});
                shaped += pattern.shaped;
                const Style style = drawn(pattern.text).style;
                const KolamExamination found =
                    examine_kolam(reference::grammar_of(pattern.text),
                                  {.spline = true, .draws = [&](const Pen& pen) { return style.draws(pen); }});
                const std::string what = fmt::format("{} {} {}", rim_style_name(rim), text, seed);
                EXPECT_TRUE(found.is_kolam()) << what;
                EXPECT_EQ(found.lines, count_lines(grid, states)) << what;
                EXPECT_EQ(found.dots.size(), grid.dots().size()) << what;
                EXPECT_EQ(found.crossings, std::count(states.begin(), states.end(), GapState::crossed)) << what;
            }
        }
        EXPECT_GT(shaped, 20u) << rim_style_name(rim);
    }
    EXPECT_EQ(parse_rim_style("Horn"), RimStyle::horn);
    EXPECT_TRUE(
        has(error_of([] { parse_rim_style("spiky"); }), "'spiky': expected round, pointed, petal, horn, crescent"));
}

double least_distance_from_dots(const char* text, double joined) {
    const DotGrid grid = parse_dot_grid(text);
    const KolamPattern pattern = kolam_pattern(grid, random_states(grid, {.seed = 2, .joined = joined}));
    double least = 1e9;
    for (const reference::Line& stroke : drawn(pattern.text).strokes) {
        for (std::size_t i = 0; i + 3 < stroke.points.size(); i += 3) {
            for (int step = 0; step < 16; ++step) {
                const double t = step / 16.0;
                const double s = 1 - t;
                const glm::dvec2 at = s * s * s * stroke.points[i] + 3 * s * s * t * stroke.points[i + 1] +
                                      3 * s * t * t * stroke.points[i + 2] + t * t * t * stroke.points[i + 3];
                for (const glm::dvec2 dot : pattern.dots)
                    least = std::min(least, std::hypot(at.x - dot.x, at.y - dot.y));
            }
        }
    }
    return least;
}

TEST(DotGridPattern, CurvesKeepTheirDistanceFromDots) {
    EXPECT_GT(least_distance_from_dots("7x7", 0), 0.44);   // 0.31 of the spacing of dots
    EXPECT_GT(least_distance_from_dots("9-5", 0.3), 0.5);  // a quarter of it
}

/// As the examination of the drawing does, by its edges.
TEST(DotGridPattern, LinesThatAreImagesOfEachOtherShareAClass) {
    for (const char* text : {"7x7", "1-3-5-3-1", "7-4", "4-5-6", "ooo/o.o/ooo"}) {
        const DotGrid grid = parse_dot_grid(text);
        for (const GridSymmetry symmetry : usual_symmetries(grid, false)) {
            const GapStates states =
                random_states(grid, {.seed = 3, .density = 0.5, .joined = 0.2, .symmetry = symmetry});
            const std::string pattern = kolam_pattern(grid, states).text;
            const Style style = drawn(pattern).style;
            const KolamExamination found =
                examine_kolam(reference::grammar_of(pattern),
                              {.spline = true, .draws = [&](const Pen& pen) { return style.draws(pen); }});
            EXPECT_EQ(line_orbits(grid, states), found.orbit_of_line) << text << ' ' << grid_symmetry_name(symmetry);
        }
    }
}

TEST(DotGridPattern, ColoursAndDotsAreDrawn) {
    const DotGrid grid = parse_dot_grid("1-3-5-3-1");
    for (const bool single : {false, true}) {
        GapStates crossings(grid.gaps().size());
        if (single) make_single_line(grid, crossings, 7);
        for (const bool coloured : {false, true}) {
            const KolamPattern pattern = kolam_pattern(grid, crossings, {.coloured = coloured, .dot_symbols = true});
            const Drawn found = drawn(pattern.text);
            ASSERT_EQ(found.controls.size(), single ? 1u : 13u);
            for (std::size_t i = 0; i < found.controls.size(); ++i) {
                EXPECT_EQ(found.controls[i].pens.at(0).colour,
                          coloured ? static_cast<int>(line_orbits(grid, crossings)[i] % 8) : 0);
            }
            const Grammar grammar = reference::grammar_of(pattern.text);
            reference::Recorder recorder;
            derive(grammar, *Turtle::drawing(grammar, recorder, true));
            ASSERT_EQ(recorder.discs.size(), pattern.dots.size());
            for (std::size_t i = 0; i < recorder.discs.size(); ++i) {
                EXPECT_NEAR(recorder.discs[i].centre.x, pattern.dots[i].x, 1e-12);
                EXPECT_NEAR(recorder.discs[i].centre.y, pattern.dots[i].y, 1e-12);
                EXPECT_TRUE(found.style.draws(recorder.discs[i].pen));
            }
        }
    }
}

/// Fields between four crossed gaps, by the rows of digits: gaps within a row, then those to the next row.
std::size_t crossed_fields(const std::string& digits, std::size_t rows, std::size_t columns) {
    std::vector<std::string> words;
    for (std::size_t at = 0; at < digits.size();) {
        const std::size_t end = std::min(digits.find(' ', at), digits.size());
        words.push_back(digits.substr(at, end - at));
        at = end + 1;
    }
    std::size_t count = 0;
    for (std::size_t r = 0; r + 1 < rows; ++r) {
        for (std::size_t c = 0; c + 1 < columns; ++c) {
            count += words[2 * r][c] == '1' && words[2 * r + 1][c] == '1' && words[2 * r + 1][c + 1] == '1' &&
                     words[2 * r + 2][c] == '1';
        }
    }
    return count;
}

TEST(DotGridPattern, CentredDotsAreEncircled) {
    for (std::uint64_t seed = 0; seed < 12; ++seed) {
        const DotGrid grid = parse_dot_grid("5x6");
        GapStates states = random_states(grid, {.seed = seed, .density = 0.85});
        if (seed % 2 == 0) make_single_line(grid, states, seed);
        const KolamPattern pattern = kolam_pattern(
            grid, states, {.centred_dots = true, .rim = seed % 3 == 0 ? RimStyle::petal : RimStyle::round});
        EXPECT_EQ(pattern.centred, crossed_fields(gap_states_text(grid, states), 5, 6));
        const Style style = drawn(pattern.text).style;
        const KolamExamination found =
            examine_kolam(reference::grammar_of(pattern.text),
                          {.spline = true, .draws = [&](const Pen& pen) { return style.draws(pen); }});
        EXPECT_EQ(found.dots.size(), 30 + pattern.centred) << seed;
        EXPECT_EQ(found.has_own_dots, pattern.centred > 0);
        EXPECT_TRUE(found.is_kolam()) << seed << ' ' << found.faults().front();
    }
}

TEST(DotGridPattern, DotsBesideLinesAreLoose) {
    const DotGrid grid = parse_dot_grid("2x3");
    const std::string text = kolam_pattern(grid, parse_gap_states(grid, "all"), {.centred_dots = true}).text;
    const auto loose = [](const std::string& pattern) {
        const Style style = drawn(pattern).style;
        return examine_kolam(reference::grammar_of(pattern),
                             {.spline = true, .draws = [&](const Pen& pen) { return style.draws(pen); }})
            .loose_dots();
    };
    EXPECT_EQ(loose(text), 0u);
    std::string moved = text;
    const std::size_t last = moved.rfind("[;(1)@.]");
    ASSERT_NE(last, std::string::npos);
    // Outside of all lines, and two in one field.
    EXPECT_EQ(loose(moved.replace(last, 8, "[;(1)f(20)@.]")), 1u);
    EXPECT_EQ(loose(std::string(text).replace(last, 8, "[;(1)@.f(0.1)@.]")), 2u);
}

TEST(DotGridPattern, TellsItsCrossings) {
    const DotGrid grid = parse_dot_grid("4x4");
    const GapStates crossings = random_states(grid, {.seed = 12});
    const std::string text = kolam_pattern(grid, crossings).text;
    const std::size_t begin = text.find("// gaps: ") + 9;
    EXPECT_EQ(parse_gap_states(grid, std::string_view(text).substr(begin, text.find('\n', begin) - begin)),
              crossings);
}

}  // namespace sikku::dot_grid_test
