// tests/program/kolam_grid_test.cpp: runs the program to make kolams on grids and radial ones.
#include "art/kolam/dot_grid_symmetry.h"
#include "art/kolam/grid_kolam.h"
#include "tests/files.h"
#include "tests/program.h"
#include "tests/tools.h"

#include <gtest/gtest.h>

#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace sikku::kolam_grid_test {

class KolamGrid : public ::testing::Test {
protected:
    Outcome kolam(std::vector<std::string> arguments) {
        arguments.insert(arguments.begin(), "kolam");
        Surroundings here{.folder = folder_.path()};
        return run(arguments, here);
    }
    ScratchFolder folder_;
};

TEST_F(KolamGrid, MakesEveryKindOfGrid) {
    for (const auto& [grid, is_exact] : {std::pair{"7 to 1 ner pulli", "true"},
                                         {"7-4 idukku pulli", "false"},
                                         {"9x5-5x2", "true"},
                                         {"oo./ooo/.oo", "true"},
                                         {" o o / o   o/ o o ", "true"}}) {
        const Outcome made = kolam({"--grid", grid, "--dots", "--colours", "-o", "made.lsys"});
        ASSERT_EQ(made.status, 0) << grid << made.errors;
        const Outcome examined = kolam({"made.lsys", "--json"});
        EXPECT_TRUE(has(examined.output, "\"kolam\": true")) << grid << examined.output;
        EXPECT_TRUE(has(examined.output, std::string("\"exact\": ") + is_exact)) << grid << examined.output;
    }
    folder_.write("shape.txt", ".ooo.\nooooo\noo.oo\nooooo\n.ooo.\n");
    EXPECT_EQ(kolam({"--grid", "@shape.txt", "--single-line", "-o", "shape.lsys"}).status, 0);
    EXPECT_TRUE(has(kolam({"shape.lsys"}).output, "a single line (anthathi), 20 dots"));
}

TEST_F(KolamGrid, FillsAPageAndStatesItsCommand) {
    const Outcome made = kolam({"--grid", "5xfill", "--size", "120x40cm", "--border", "rope", "--period", "4",
                                "--single-line", "--seed", "2", "-o", "a.lsys"});
    ASSERT_EQ(made.status, 0) << made.errors;
    EXPECT_TRUE(has(made.errors, "5x18: 90 dots"));
    const std::string text = contents(folder_ / "a.lsys");
    EXPECT_TRUE(has(text,
                    "source: sikku kolam --grid 5xfill --size 120x40cm --border rope --period 4 --single-line "
                    "--seed 2\n"));
    EXPECT_TRUE(has(kolam({"a.lsys"}).output, "a single line (anthathi), 90 dots, all encircled"));
    EXPECT_EQ(kolam({"--grid", "fill idukku", "--dot-spacing", "2cm", "--landscape", "-o", "b.kolam.json"}).status,
              1);
    const Outcome interlaced =
        kolam({"--grid", "fill idukku", "--dot-spacing", "2cm", "--landscape", "-o", "b.lsys", "--json"});
    EXPECT_EQ(interlaced.status, 0) << interlaced.errors;
    EXPECT_TRUE(has(contents(folder_ / "b.lsys"), "--grid 'fill idukku' --landscape --dot-spacing 2cm --seed 0\n"));
    const Outcome other = kolam({"--grid", "4xfill", "--size", "120x40cm", "--single-line", "--symmetry", "C2"});
    EXPECT_TRUE(has(other.errors, "note: another grid fits better, but no single line is possible on 4x12"));
}

TEST_F(KolamGrid, SetsCentredDots) {
    const Outcome made = kolam({"--grid", "...o.../.ooooo./.ooooo./ooo.ooo/.ooooo./.ooooo./...o...", "--crossings",
                                "all", "--centred", "-o", "mixed.lsys"});
    ASSERT_EQ(made.status, 0) << made.errors;
    EXPECT_TRUE(has(kolam({"mixed.lsys"}).output, "40 dots, all encircled"));
    ASSERT_EQ(kolam({"mixed.lsys", "-o", "again.lsys"}).status, 0);
    EXPECT_TRUE(has(kolam({"again.lsys"}).output, "40 dots, all encircled")) << "they survive";
    EXPECT_TRUE(
        has(kolam({"--grid", "3x3", "--crossings", "none", "--centred"}).errors, "warning: --centred has no effect"));
}

TEST_F(KolamGrid, RimsSurviveReading) {
    ASSERT_EQ(kolam({"--grid", "9-1", "--symmetry", "D4", "--rim", "horn", "--seed", "5", "-o", "a.lsys"}).status, 0);
    ASSERT_EQ(kolam({"a.lsys", "-o", "b.lsys"}).status, 0);
    EXPECT_TRUE(has(contents(folder_ / "b.lsys"), "// rim: horn"));
}

TEST_F(KolamGrid, ReadsNotationsFromFiles) {
    folder_.write("filled.txt", "3x3\n");
    folder_.write("page.txt", "7xfill\n");
    EXPECT_EQ(kolam({"--grid", "@filled.txt", "-o", "a.lsys"}).status, 0);
    const Outcome filled = kolam({"--grid", "@page.txt", "--size", "120x40cm", "-o", "b.lsys"});
    EXPECT_EQ(filled.status, 0) << filled.errors;
    EXPECT_TRUE(has(contents(folder_ / "b.lsys"), "source: sikku kolam --grid 7xfill --size 120x40cm"));
}

TEST_F(KolamGrid, ExtensionsMayBeCapitals) {
    const auto made = [&](const char* name) {
        EXPECT_EQ(kolam({"--grid", "5x5", "--single-line", "--seed", "2", "-o", name}).status, 0);
        return contents(folder_ / name);
    };
    const std::string csv = made("a.csv");
    EXPECT_TRUE(has(csv, "x-kolam 1,y-kolam 1"));
    EXPECT_EQ(made("A.CSV"), csv);
}

TEST_F(KolamGrid, NotationsThatMeanOtherDotsAreNoted) {
    EXPECT_TRUE(has(kolam({"--grid", "1-15-1", "-o", "a.lsys"}).errors,
                    "three rows of 1, 15 and 1 dots; for 1 up to 15 and back write 15-1"));
    EXPECT_FALSE(has(kolam({"--grid", "15-1", "-o", "a.lsys"}).errors, "note:"));
    EXPECT_TRUE(has(dot_grid_note("15 dots"), "one row of 15 dots; for rows from 1 up to 15 and back write 15-1"));
    EXPECT_TRUE(has(dot_grid_note("8"), "write 8-2"));
    for (const char* grid : {"7x7", "15-1", "1-3-5-3-1", "3-5-3", "7 to 1", "15-8 idukku pulli", "oo/oo"}) {
        EXPECT_EQ(dot_grid_note(grid), "") << grid;
    }
    EXPECT_ANY_THROW(dot_grid_note("4-9-9-4"));
}

/// The files of two seeds are the same, except for the seed, where the program reports it.
TEST_F(KolamGrid, ThirtySeedsGiveThirtyKolams) {
    for (const char* grid : {"1-3-5-3-1", "5x5", "7x3 to 3", "7-4", "9-1", "9x9 idukku", "13-7"}) {
        for (const bool single : {false, true}) {
            if (single && parse_dot_grid(grid).dots().size() > 70) continue;
            std::set<std::string> codes;
            for (int seed = 1; seed <= 30; ++seed) {
                GridKolamOptions options{.seed = static_cast<std::uint64_t>(seed), .single_line = single};
                const DotGrid dots = parse_dot_grid(grid);
                const GridKolam made = make_grid_kolam(dots, options, {});
                EXPECT_FALSE(made.same_seed) << grid << ' ' << seed;
                codes.insert(kolam_code(dots, made.states));
            }
            EXPECT_EQ(codes.size(), 30u) << grid << (single ? " single" : "");
        }
    }
}

TEST_F(KolamGrid, SeedsOfOneKolamAreNoted) {
    std::size_t same = 0;
    for (int seed = 0; seed < 12; ++seed) {
        const Outcome made = kolam({"--grid", "1-3-5-3-1", "--symmetry", "D4", "--density", "0.7", "--seed",
                                    std::to_string(seed), "--json", "-o", "a.lsys"});
        const std::size_t at = made.errors.find("gives the same kolam as seed ");
        if (at == std::string::npos) continue;
        ++same;
        const std::string other = std::to_string(std::stoi(made.errors.substr(at + 29)));
        kolam({"--grid", "1-3-5-3-1", "--symmetry", "D4", "--density", "0.7", "--seed", other, "-o", "b.lsys"});
        const auto word = [&](const char* name) {
            const std::string text = contents(folder_ / name);
            return text.substr(text.find("axiom"));
        };
        EXPECT_EQ(word("b.lsys"), word("a.lsys"));
    }
    EXPECT_GT(same, 0u);
    EXPECT_FALSE(has(kolam({"--grid", "15-1", "--seed", "3", "-o", "a.lsys"}).errors, "gives the same kolam"));
}

TEST_F(KolamGrid, TheSeedChoosesAUsualSymmetry) {
    const auto symmetries = [&](std::vector<std::string> arguments) {
        std::map<std::string, int> counts;
        for (int seed = 0; seed < 12; ++seed) {
            std::vector<std::string> all = {"--grid"};
            all.insert(all.end(), arguments.begin(), arguments.end());
            all.insert(all.end(), {"--seed", std::to_string(seed), "--json", "-o", "a.lsys"});
            const std::string found = kolam(all).output;
            const std::size_t at = found.find("\"symmetry\": \"") + 13;
            ++counts[found.substr(at, found.find('"', at) - at)];
        }
        return counts;
    };
    EXPECT_GT(symmetries({"7x7"})["D4"], 3);
    EXPECT_GT(symmetries({"7x7"}).size(), 2u);
    EXPECT_GT(symmetries({"7x7", "--single-line"})["C4"], 3);
    EXPECT_GT(symmetries({"7-4"})["D6"], 3);
    EXPECT_GT(symmetries({"7-4", "--single-line"})["C6"], 3);
    EXPECT_EQ(symmetries({"6x6", "--symmetry", "none"})["none"], 12);
    EXPECT_EQ(symmetries({"6x6"}).count("none"), 0u);
}

/// Symmetries that were not requested are tried for a short while only.
TEST_F(KolamGrid, ASingleLineOnALargeGridTakesSeconds) {
    const Outcome outcome = kolam({"--grid", "400x400", "--single-line", "-o", "large.lsys"});
    EXPECT_EQ(outcome.status, 0);
    EXPECT_TRUE(has(outcome.errors, "160000 dots"));
    EXPECT_TRUE(has(outcome.errors, ", 1 line; "));
    EXPECT_LT(outcome.seconds, sanitized ? 120 : 15);
}

TEST_F(KolamGrid, JoinedGapsAreMadeReadAndListed) {
    const Outcome made = kolam({"--grid", "5x5", "--density", "0.5", "--joined", "0.6", "-o", "a.lsys"});
    ASSERT_EQ(made.status, 0);
    EXPECT_TRUE(has(made.errors, " joined, "));
    const Outcome given = kolam({"--grid", "1x3", "--crossings", "12", "--json", "-o", "a.lsys"});
    EXPECT_TRUE(has(given.output, "\"crossed\": 1, \"joined\": 1, \"lines\": 1"));
    EXPECT_TRUE(
        has(kolam({"--grid", "2x2", "--enumerate", "--joined", "1"}).output, "81 states, 40 with a single line"));
}

TEST_F(KolamGrid, RadialKolamsHaveAsManyLinesAsTheGreatestCommonDivisor) {
    for (const auto& [size, lines] : {std::pair{"8x5", "\"lines\": 1,"}, std::pair{"8x6", "\"lines\": 2,"}}) {
        const Outcome made = kolam({"--radial", size, "--dots", "--json", "-o", "a.lsys"});
        EXPECT_TRUE(has(made.output, lines));
        EXPECT_TRUE(has(kolam({"a.lsys", "--json"}).output, lines));
    }
}

/// The commands in the files of the library make them again.
TEST_F(KolamGrid, MakesTheLibraryAgain) {
    std::size_t count = 0;
    for (const auto& file : pattern_files("patterns/kolam-library")) {
        if (count++ % 10 != 0) continue;
        const std::string text = contents(file);
        const std::string mark = "source: sikku kolam ";
        const std::size_t at = text.find(mark) + mark.size();
        std::vector<std::string> arguments;
        bool is_quoted = false;
        std::string word;
        for (const char byte : text.substr(at, text.find('\n', at) - at) + ' ') {
            if (byte == '\'') {
                is_quoted = !is_quoted;
            } else if (byte == ' ' && !is_quoted) {
                arguments.push_back(std::exchange(word, {}));
            } else {
                word += byte;
            }
        }
        const Outcome made = kolam(arguments);
        ASSERT_EQ(made.status, 0) << file << made.errors;
        const std::size_t word_at = text.find("axiom: ");
        const std::string axiom = text.substr(word_at, text.find("\n\n", word_at) - word_at);
        EXPECT_TRUE(has(made.output, axiom)) << file;
    }
}

TEST_F(KolamGrid, RefusesWithTheReason) {
    folder_.write("mask.txt", ".oo.\noooo\n.oox\n");
    struct Case {
        std::vector<std::string> arguments;
        int status;
        const char* message;
    };
    for (const Case& bad : {Case{{"--grid", "15-8", "--symmetry", "D4"}, 2, "interlaced grids have C2, C3, C6"},
                            {{"--grid", "7x7", "--symmetry", "C6"}, 2, "straight grids have C2, C4, mirrors and D4"},
                            {{"--grid", "7-4", "--symmetry", "D6", "--single-line"}, 1, "at its 3 dots"},
                            {{"--grid", "oo//oo", "--single-line"}, 1, "2 groups that no gap connects"},
                            {{"--grid", "1000x1000000"}, 2, "at most 4000000 dots"},
                            {{"--grid", "4000000000 to 1"}, 2, "at most 4000000 dots"},
                            {{"--grid", "7 foo"}, 2, "unknown word 'foo'"},
                            {{"--grid", "@missing.txt"}, 2, "missing.txt"},
                            {{"--grid", "3x3", "--crossings", "0123"}, 2, "0 turned back, 1 crossed, 2 joined"},
                            {{"--radial", "8"}, 2, "expected ARMSxDOTS"},
                            {{"--radial", "8x5", "--order", "1-2"}, 2, "each dot of an arm once"},
                            {{"--radial", "8x5", "--grid", "3x3"}, 2, "cannot be combined with"},
                            {{"--radial", "8x5", "--single-line"}, 2, "--single-line needs --grid"},
                            {{"--radial", "8x5", "-o", "x.kolam.json"}, 2, "a radial kolam has none"},
                            {{"--radial", "8x5", "-o", "x.csv"}, 2, "a radial kolam has none"},
                            {{"--radial", "8x5", "-o", "x.foo"}, 2, "unknown extension"},
                            {{"--grid", "3x3", "-o", "x.foo"}, 2, "unknown extension"},
                            {{"--grid", "3x3", "--colours", "-o", "x.json"}, 2, "--colours: -o x.json holds dots"},
                            {{"--grid", "3x3", "--dots", "-o", "x.csv"}, 2, "--dots: -o x.csv holds dots"},
                            {{"--grid", "oo./oXo/.oo"}, 2, "line 2, column 2: 'X' is not a place"},
                            {{"--grid", "•o/oä"}, 2, "line 2, column 2: 'ä' is not a place"},
                            {{"--grid", "@mask.txt"}, 2, "line 3, column 4: 'x' is not a place"},
                            {{"--grid", "../_."}, 2, "the shape has no dots"},
                            {{"--grid", "7x7", "--size", "A3"}, 2, "--size needs a --grid that fills the page"},
                            {{"--size", "A3"}, 2, "--size needs --grid"},
                            {{"--grid", "fill"}, 2, "--grid fill needs --dot-spacing"},
                            {{"--grid", "7xfill", "--dot-spacing", "1cm"}, 2, "--dot-spacing needs --grid fill"},
                            {{"--grid", "7xfill", "--size", "x"}, 2, "--size x: expected A0 to A10"},
                            {{"--grid", "7xfill", "--margin", "200mm"}, 2, "leave nothing of a page"},
                            {{"--grid", "7xfill", "--size", "A7", "--margin", "33mm", "--border", "padi"},
                             2,
                             "--border leaves no room on this page"},
                            {{"--grid", "7xfill", "--crossings", "all"}, 2, "--crossings needs a grid"},
                            {{"--grid", "7xfill", "--enumerate"}, 2, "--enumerate needs the numbers"},
                            {{"--grid", "fillxfill"}, 2, "expected fill, ROWSxfill or fillxCOLUMNS"},
                            {{"--grid", "3x9", "--period", "9"}, 1, "nothing repeats; expected fewer than 9"},
                            {{"--grid", "3x9", "--period", "0"}, 2, "expected a whole number from 1"},
                            {{"--grid", "3x3", "--period", "2", "--enumerate"}, 2, "cannot be combined with"},
                            {{"--grid", "7-4", "--centred"}, 2, "expected straight rows"},
                            {{"--grid", "3x3", "--centred", "-o", "x.csv"}, 2, "--centred: -o x.csv holds dots"},
                            {{"snake-kolam", "--dots"}, 2, "need --grid or --radial"}}) {
        const Outcome refused = kolam(bad.arguments);
        EXPECT_EQ(refused.status, bad.status) << bad.message << refused.errors;
        EXPECT_TRUE(has(refused.errors, bad.message));
    }
    EXPECT_EQ(folder_.names().size(), 1U);  // the mask
}

TEST(KolamCommand, TellsInWordsAndAsJson) {
    const Outcome snake = run({"kolam", "snake-kolam", "-n", "3"});
    EXPECT_EQ(snake.status, 0) << snake.errors;
    EXPECT_TRUE(has(snake.output, "yes: a single line (anthathi), 85 dots, all encircled"));
    EXPECT_TRUE(has(snake.output, "D4: 4 rotations, 4 mirrors, about 7.5 7.5"));
    const Outcome island = run(std::vector<std::string>{"kolam", "koch-island"});
    EXPECT_EQ(island.status, 0) << island.errors;
    EXPECT_TRUE(has(island.output, "no: 1 of 1 dot is not encircled"));
    const Outcome json = run({"kolam", "anklets-of-krishna", "-n", "1", "--json"});
    EXPECT_EQ(json.status, 0) << json.errors;
    EXPECT_TRUE(has(json.output, "\"kolam\": true"));
    EXPECT_TRUE(has(json.output, "\"dots\": [[-0.707107, 0]]}\n"));
    const Outcome nothing = run({"kolam", "-"}, {.input = "axiom: X\n"});
    EXPECT_EQ(nothing.status, 1);
    EXPECT_TRUE(has(nothing.errors, "nothing to examine"));
    const Outcome large = run({"kolam", "snake-kolam", "-n", "40"});
    EXPECT_EQ(large.status, 1);
    EXPECT_TRUE(has(large.errors, "budget"));
}

}  // namespace sikku::kolam_grid_test
