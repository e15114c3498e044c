// tests/art/photograph_hint_test.cpp: photographs read with an expected grid, in a region, and with dots changed by
// hand.
#include "art/kolam/dot_grid_making.h"
#include "art/reading/grid_fit.h"
#include "art/reading/kolam_fixes.h"
#include "art/reading/photograph.h"
#include "tests/checks.h"
#include "tests/files.h"
#include "tests/photograph_maker.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <set>
#include <string>
#include <vector>

namespace sikku::photograph_hint_test {

MadePhotograph made_of(const std::string& grid, std::uint32_t seed, double level = 0.4) {
    DotGrid dots = parse_dot_grid(grid);
    GapStates states =
        random_states(dots, {.seed = 40 + seed, .symmetry = usual_symmetries(dots, false).front(), .composed = true});
    MadePhotograph made{std::move(dots), std::move(states)};
    made.light_lines = seed % 2 == 1;
    made.width = 800;
    made.height = 600;
    made.seed = 500 + seed;
    made.distortion = {level, level, level, level, level, level, level};
    return made;
}

Photograph read_made(const MadePhotograph& made, const PhotographOptions& options) {
    const ScratchFolder folder;
    write_photograph(made, folder.path() / "photo.jpg");
    return read_photograph(folder.path() / "photo.jpg", options);
}

std::string refusal_of(const MadePhotograph& made, const PhotographOptions& options) {
    try {
        return "read as " + read_made(made, options).kolam.grid.text();
    } catch (const NoKolam& refused) {
        EXPECT_TRUE(refused.picture().best.has_value());
        return refused.what();
    }
}

std::string notes_of(const Photograph& photograph) {
    std::string text = photograph.kolam.grid.text();
    for (const std::string& note : photograph.kolam.notes) text += "\n" + note;
    return text;
}

void expect_certain_gaps(const ReadKolam& read, const MadePhotograph& made) {
    ASSERT_EQ(read.grid.text(), made.grid.text());
    for (std::uint32_t gap = 0; gap < read.states.size(); ++gap) {
        EXPECT_TRUE(read.is_doubtful(gap) || read.states[gap] == made.states[gap]) << "gap " << gap;
    }
}

TEST(PhotographHint, CompletesDotsThatWereNotSeen) {
    struct Case {
        const char* grid;
        std::vector<std::uint32_t> lost;
    };
    const std::vector<Case> cases = {
        {"1-3-5-7-5-3-1", {0, 9, 15, 24}}, {"5x5", {0, 4, 20, 24, 12}}, {"9-5 idukku", {0, 4, 30, 56, 60}}};
    std::uint32_t seed = 0;
    for (const Case& each : cases) {
        MadePhotograph made = made_of(each.grid, ++seed);
        made.lost = each.lost;
        const Photograph read = read_made(made, {.grid = made.grid});
        SCOPED_TRACE(notes_of(read));
        expect_certain_gaps(read.kolam, made);
        std::set<GridDot> lost;
        for (const std::uint32_t dot : each.lost) lost.insert(made.grid.dots()[dot]);
        for (const GridDot dot : read.completed) EXPECT_TRUE(lost.contains(dot));
        EXPECT_TRUE(std::is_sorted(read.completed.begin(), read.completed.end(), is_before));
        EXPECT_TRUE(read.missing.empty());
        // Loops of interlaced dots are closer to each other.
        const std::size_t share = made.grid.lattice() == DotLattice::square ? 8 : 2;
        EXPECT_LE(share * read.kolam.doubtful().size(), made.states.size());
    }
}

TEST(PhotographHint, ReportsContradictions) {
    const MadePhotograph made = made_of("1-3-5-7-5-3-1", 1);
    EXPECT_EQ(refusal_of(made, {.grid = parse_dot_grid("9-1")}),
              "found 25 dots (1-3-5-7-5-3-1); expected 41 dots (1-3-5-7-9-7-5-3-1)");
    EXPECT_EQ(refusal_of(made, {.grid = parse_dot_grid("5-1")}),
              "found 25 dots (1-3-5-7-5-3-1); expected 13 dots (1-3-5-3-1)");
    // A row more or less, on blank ground.
    EXPECT_EQ(refusal_of(made_of("6x6", 2), {.grid = parse_dot_grid("7x6")}),
              "found 36 dots (6x6); expected 42 dots (7x6)");
    EXPECT_EQ(refusal_of(made_of("6x6", 2), {.grid = parse_dot_grid("6x5")}),
              "found 36 dots (6x6); expected 30 dots (6x5)");
    EXPECT_EQ(error_of<std::runtime_error>(
                  [&] { read_made(made, {.lattice = DotLattice::triangular, .grid = made.grid}); }),
              "the expected grid has another lattice");
    EXPECT_EQ(error_of<std::runtime_error>([&] { read_made(made, {.grid = parse_dot_grid("101x100")}); }),
              "the expected grid has 10100 dots; a photograph can show 10000");
}

TEST(PhotographHint, GridsMayBeSeenFromAnySide) {
    for (const auto& [seen, given] :
         {std::pair("5x7", "7x5"), std::pair("oooo/ooo./oo../o...", "...o/..oo/.ooo/oooo"),
          std::pair("4-5-6-5-4-3-2", "2-3-4-5-6-5-4")}) {
        const MadePhotograph made = made_of(seen, 3);
        const Photograph read = read_made(made, {.grid = parse_dot_grid(given)});
        expect_certain_gaps(read.kolam, made);
        EXPECT_TRUE(read.completed.empty()) << notes_of(read);
    }
}

TEST(PhotographHint, ChoosesAmongTheKolamsOfAPage) {
    MadePhotograph made = made_of("5x5", 1);
    OtherKolam other{parse_dot_grid("1-3-5-3-1"), {}, {7.3, 0.2}};
    other.states = random_states(other.grid, {.seed = 9, .composed = true});
    made.others.push_back(other);
    const Photograph read = read_made(made, {.grid = other.grid});
    EXPECT_EQ(read.kolam.grid.text(), "1-3-5-3-1");
    EXPECT_EQ(read.kolam.states, other.states);
    EXPECT_EQ(read_made(made, {.grid = made.grid}).kolam.states, made.states);
    EXPECT_TRUE(has(refusal_of(made, {.number = 2, .grid = made.grid}), "expected 25 dots (5x5)"));
}

TEST(PhotographHint, RegionsAreReadAlone) {
    MadePhotograph made = made_of("5x5", 1);
    made.width = 1400;
    made.height = 900;
    OtherKolam other{parse_dot_grid("1-3-5-7-5-3-1"), {}, {8.3, 0.2}};
    other.states = random_states(other.grid, {.seed = 9, .composed = true});
    made.others.push_back(other);
    const Photograph whole = read_made(made, {.grid = made.grid});
    const glm::dvec2 first = whole.in_file(whole.kolam.grid.dots().front());
    const glm::dvec2 last = whole.in_file(whole.kolam.grid.dots().back());
    const double margin = 0.3 * (last.x - first.x);
    const std::string crop =
        fmt::format("{:.0f},{:.0f},{:.0f},{:.0f}", first.x - margin, std::max(0.0, first.y - margin),
                    last.x - first.x + 2 * margin, last.y - first.y + 1.8 * margin);
    const PictureRegion region = parse_crop(crop);
    const Photograph part = read_made(made, {.region = region});
    EXPECT_EQ(part.kolam.states, made.states);
    EXPECT_EQ(part.kolams, 1U);
    for (const GridDot dot : made.grid.dots()) EXPECT_LT(glm::distance(part.in_file(dot), whole.in_file(dot)), 3.0);
    // The same corners, and a trapezium around them.
    const auto [a, b, c, d] = region.corners;
    const auto text = [](glm::dvec2 at) { return fmt::format("{:.0f},{:.0f} ", at.x, at.y); };
    for (const double lean : {0.0, 30.0}) {
        const glm::dvec2 off(lean, 0);
        const Photograph straight =
            read_made(made, {.region = parse_corners(text(a + off) + text(b - off) + text(c) + text(d))});
        EXPECT_EQ(straight.kolam.states, made.states) << notes_of(straight);
        for (const GridDot dot : made.grid.dots()) {
            EXPECT_LT(glm::distance(straight.in_file(dot), whole.in_file(dot)), 3.0);
        }
    }
    EXPECT_TRUE(has(error_of<std::runtime_error>([&] { read_made(made, {.region = parse_crop("900,0,600,400")}); }),
                    "the point 1500,0 lies outside of the picture of 1400 x 900 pixels"));
}

/// A crop has the pixels of the picture, and a rectangle is seen as it was before it was tilted.
TEST(PhotographHint, RegionsAreExact) {
    DecodedPicture picture{40, 30, {}, 40, 30};
    for (int y = 0; y < 30; ++y) {
        for (int x = 0; x < 40; ++x) {
            for (const int value : {5 * x, 7 * y, x + y}) picture.pixels.push_back(static_cast<std::uint8_t>(value));
        }
    }
    const PictureDecoder decode = [&](int) { return picture; };
    const DecodedPicture cut = read_region(decode, parse_crop("3,4,20,18"), 100);
    ASSERT_EQ(cut.width, 20);
    ASSERT_EQ(cut.height, 18);
    for (int y = 0; y < 18; ++y) {
        for (int x = 0; x < 20; ++x) {
            const std::size_t at = 3 * static_cast<std::size_t>(20 * y + x);
            EXPECT_EQ(cut.pixels[at], 5 * (x + 3));
            EXPECT_EQ(cut.pixels[at + 1], 7 * (y + 4));
        }
    }
    const DecodedPicture half = read_region(decode, parse_crop("0,0,40,30"), 20);
    EXPECT_EQ(half.width, 20);
    EXPECT_NEAR(half.pixels[0], 2.5, 0.51);
    const Homography map = parse_corners("5,5 30,8 35,25 2,28").to_file();
    EXPECT_LT(glm::distance(map({0, 0}), glm::dvec2(5.5, 5.5)), 1e-9);
    EXPECT_EQ(parse_corners("0,0 0,9 9,9 9,0").corners, parse_corners("0,0 9,0 9,9 0,9").corners);
}

TEST(PhotographHint, RefusesOtherRegions) {
    const auto crop = [](const std::string& text) { return error_of<std::runtime_error>([&] { parse_crop(text); }); };
    const auto corners = [](const std::string& text) {
        return error_of<std::runtime_error>([&] { parse_corners(text); });
    };
    for (const char* text : {"", "1,2,3", "1,2,3,4,5", "a,2,3,4", "-1,2,3,4", "1,2,0,4", "1,2,nan,4", "1,2,1e9,4"}) {
        EXPECT_TRUE(has(crop(text), "expected X,Y,WIDTH,HEIGHT")) << text;
    }
    EXPECT_TRUE(has(corners("1,2 3,4 5,6"), "expected four points"));
    for (const char* text : {"0,0 9,9 9,0 0,9", "0,0 9,0 5,1 0,9", "0,0 5,0 9,0 9,9", "1,1 1,1 1,1 1,1"}) {
        EXPECT_TRUE(has(corners(text), "not the corners of a quadrangle")) << text;
    }
}

TEST(PhotographHint, DotsAreAddedAndRemovedByHand) {
    MadePhotograph made = made_of("1-3-5-7-5-3-1", 2);
    const Photograph less = read_made(made, {.fixes = {"no dot 1,4; no dot 2,3"}});
    EXPECT_EQ(less.kolam.grid.text(), "..ooo/.o.ooo/ooooooo/.ooooo/..ooo/...o") << notes_of(less);
    EXPECT_TRUE(has(notes_of(less), "0 dots added and 2 removed"));
    // Later fixes count in the kolam that the first ones made.
    const Photograph again = read_made(made, {.fixes = {"no dot 1,4", "dot 0,4", "1,1: join"}});
    EXPECT_EQ(again.kolam.grid.text(), made.grid.text());
    EXPECT_EQ(again.kolam.states[0], GapState::joined);
    EXPECT_EQ(again.kolam.certainty[0], 1);
    made.lost = {0};
    const Photograph found = read_made(made, {});
    const bool is_lost = found.kolam.grid.dots().size() == 24;
    const Photograph fixed = read_made(made, {.fixes = std::vector<std::string>(is_lost ? 1 : 0, "dot 0,4")});
    expect_certain_gaps(fixed.kolam, made);
    for (const auto& [fix, why] :
         std::vector<std::pair<std::string, std::string>>{{"dot 1,4", "there is a dot already"},
                                                          {"no dot 1,1", "the place is empty"},
                                                          {"dot 9,30", "no dot is near"},
                                                          {"dot 3", "expected ROW,GAP: STATE"},
                                                          {"dot -4,2147483647", "no dot is near"},
                                                          {"dot 9999999999,1", "expected ROW,GAP: STATE"}}) {
        EXPECT_TRUE(has(error_of<FixError>([&] { read_made(made_of("7-1", 2), {.fixes = {fix}}); }), why)) << fix;
    }
}

TEST(PhotographHint, AddressesNameAllPlaces) {
    for (const char* text : {"5x5", "1-3-5-3-1", "9-5 idukku", "6,5", "5,6", "oo./.oo/o.o", "4-5-6-5-4-3-2"}) {
        const DotGrid grid = parse_dot_grid(text);
        const GridDot first = grid.dots().front();
        std::set<std::pair<std::int32_t, std::int32_t>> addresses;
        for (const GridDot dot : grid.dots()) {
            const DotAddress address = address_of(grid, dot);
            EXPECT_TRUE(place_at(grid, address) == dot) << text;
            EXPECT_GE(address.row, 1);
            EXPECT_GE(address.number, 1);
            EXPECT_TRUE(addresses.emplace(address.row, address.number).second);
            for (std::uint32_t side = 0; side < grid.sides(); ++side) {
                const GridDot place = dot + grid.step(side);
                EXPECT_TRUE(place_at(grid, address_of(grid, place)) == place) << text;
                EXPECT_GE(address_of(grid, place).number, 0);
            }
        }
        EXPECT_EQ(address_of(grid, first).row, 1);
    }
}

/// Fixes of kolams from other files: new gaps turn back and are doubtful.
TEST(PhotographHint, FixesChangeTheDotsOfAnyKolam) {
    const DotGrid grid = parse_dot_grid("3x3");
    ReadKolam kolam{grid, parse_gap_states(grid, "all")};
    fix_gaps(kolam, "no dot 2,2; dot 0,2");
    EXPECT_EQ(kolam.grid.text(), ".o/ooo/o.o/ooo");
    EXPECT_EQ(gap_states_text(kolam.grid, kolam.states), "0 11 11 11 11");
    EXPECT_EQ(kolam.doubtful(), std::vector<std::uint32_t>{0});
    fix_gaps(kolam, "1,1: cross");
    EXPECT_TRUE(kolam.doubtful().empty());
    EXPECT_EQ(kolam.repaired, std::vector<std::uint32_t>{0});
    ReadKolam one{parse_dot_grid("o"), {}};
    EXPECT_TRUE(has(error_of<FixError>([&] { fix_gaps(one, "no dot 1,1"); }), "the only dot"));
}

/// Some dots are missing, but all others agree.
TEST(PhotographHint, GridsAreLaidWhereMostDotsAgree) {
    PictureChance chance(11);
    for (const char* text : {"5x7", "1-3-5-7-5-3-1", "9-5 idukku", "oo.oo/ooooo/.ooo./ooooo/oo.oo"}) {
        const DotGrid wanted = parse_dot_grid(text);
        std::vector<std::vector<std::int32_t>> columns;
        std::int32_t row = INT32_MAX;
        std::size_t kept = 0;
        for (const GridDot dot : wanted.dots()) {
            if (dot.y != row) columns.emplace_back();
            row = dot.y;
            if (chance.uniform(0, 1) < 0.2) continue;
            columns.back().push_back(dot.x);
            ++kept;
        }
        const DotGrid found(wanted.lattice(), columns);
        const std::vector<GridFit> fits = fit_grid(wanted, found);
        ASSERT_FALSE(fits.empty());
        EXPECT_EQ(fits[0].agreed, kept) << text;
        EXPECT_EQ(fits[0].surplus, 0U);
        EXPECT_EQ(fits[0].places.size(), wanted.dots().size());
    }
}

}  // namespace sikku::photograph_hint_test
