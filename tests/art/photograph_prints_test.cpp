// tests/art/photograph_prints_test.cpp: kolams read from prints of this program: within borders, and on sheets.
#include "art/kolam/dot_grid_making.h"
#include "art/kolam/dot_grid_pattern.h"
#include "art/prints.h"
#include "art/product/print_cell.h"
#include "art/reading/photograph.h"
#include "engine/language/document.h"
#include "tests/checks.h"
#include "tests/files.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <set>
#include <string>
#include <vector>

namespace sikku::photograph_prints_test {

struct PrintedKolam {
    std::string grid;
    std::uint64_t seed = 1;
    DotGrid dots = parse_dot_grid(grid);
    GapStates states = made(dots, seed);

    static GapStates made(const DotGrid& dots, std::uint64_t seed) {
        return random_states(dots,
                             {.seed = seed, .symmetry = usual_symmetries(dots, false).front(), .composed = true});
    }
    Document document() const { return parse("kolam.lsys", kolam_pattern(dots, states, {}).text); }
};

std::string notes_of(const Photograph& photograph) {
    std::string text = photograph.kolam.grid.text();
    for (const std::string& note : photograph.kolam.notes) text += "\n" + note;
    return text;
}

struct PrintSize {
    int millimetres;
    int dpi;
};

Photograph read_print(const PrintedKolam& kolam, const std::string& border, const PrintSize& size) {
    const ScratchFolder folder;
    folder.write("print.png", draw(kolam.document(), "png",
                                   {{"dots", ""},
                                    {"border", border},
                                    {"size", fmt::format("{0}x{0}mm", size.millimetres)},
                                    {"dpi", fmt::format("{}", size.dpi)}}));
    return read_photograph(folder.path() / "print.png");
}

/// The kolam is read as it is, without a doubt, and nothing around it is taken for another one.
void expect_as_drawn(const PrintedKolam& kolam, const std::string& border, const PrintSize& size) {
    SCOPED_TRACE(
        fmt::format("{} seed {}, {}, {} mm, {} dpi", kolam.grid, kolam.seed, border, size.millimetres, size.dpi));
    const Photograph read = read_print(kolam, border, size);
    EXPECT_EQ(read.kolam.grid.text(), kolam.dots.text()) << notes_of(read);
    EXPECT_EQ(read.kolam.states, kolam.states) << notes_of(read);
    EXPECT_TRUE(read.kolam.doubtful().empty());
    EXPECT_EQ(read.kolams, 1U) << notes_of(read);
    EXPECT_FALSE(has(notes_of(read), "another kolam"));
}

const std::vector<std::string> borders = {"kaavi",    "padi",  "lotus",     "rope",
                                          "diamonds", "waves", "marigolds", "lamps"};

/// Borders have dots, rings and crossings, some of them at places of the lattice or like the dots of the kolam.
TEST(PhotographPrints, BordersAreNotPartsOfKolams) {
    // Dots of the border, which its inner line separates from the kolam, lie on its lattice.
    expect_as_drawn({"11-1", 5}, "diamonds", {120, 130});
    expect_as_drawn({"11-1", 2}, "diamonds", {130, 130});
    // Dots of the border bend the lattice of the kolam.
    expect_as_drawn({"9-1", 5}, "diamonds", {120, 130});
    expect_as_drawn({"7-1", 5}, "waves", {130, 130});
    // The ornaments have a lattice of their own.
    expect_as_drawn({"7-1", 5}, "diamonds", {160, 130});
    expect_as_drawn({"9-5 idukku", 5}, "diamonds", {100, 130});
    expect_as_drawn({"11-1", 5}, "rope", {100, 130});
    // The spots of the flowers outnumber the dots.
    expect_as_drawn({"5x5", 2}, "marigolds", {210, 130});
    expect_as_drawn({"11-1", 2}, "marigolds", {100, 130});
    // Some dots of the border lie so close to the kolam that the border is found in pieces.
    expect_as_drawn({"9-5 idukku", 2}, "rope", {120, 130});
}

/// The strands of a rope and its dots are a kolam, which is read if the one within it is not found.
TEST(PhotographPrints, FramesAroundOtherLinesAreReported) {
    const DotGrid dots = parse_dot_grid("7x7");
    const GapStates states = random_states(dots, {.seed = 2, .symmetry = GridSymmetry::d4, .composed = true});
    const Document document = parse("kolam.lsys", kolam_pattern(dots, states, {}).text);
    const ScratchFolder folder;
    for (const bool is_filled : {false, true}) {
        OptionValues options = {{"dots", ""}, {"border", "rope"}, {"dpi", "100"}};
        if (is_filled) options.emplace_back("fields", "chessboard");
        folder.write("print.png", draw(document, "png", options));
        const Photograph read = read_photograph(folder.path() / "print.png");
        const bool is_whole = read.kolam.grid.text() == dots.text();
        const bool is_reported = notes_of(read).find("lines within it were not read") != std::string::npos;
        EXPECT_NE(is_whole, is_reported) << notes_of(read);
        EXPECT_TRUE(is_whole || is_filled);
    }
}

TEST(PhotographPrints, AllBordersInTheFullCheck) {
    if (!std::getenv("SIKKU_FULL")) GTEST_SKIP() << "some minutes; SIKKU_FULL=1 runs it";
    for (const char* grid : {"5x5", "7-1", "9-1", "11-1", "15-1", "9-5 idukku"}) {
        for (const std::string& border : borders) {
            for (const int millimetres : {100, 120, 130, 160, 210, 300}) {
                expect_as_drawn({grid, 2}, border, {millimetres, 130});
            }
        }
    }
}

/// On a sheet, multiples of the steps between dots lead from one kolam to the next.
TEST(PhotographPrints, AllKolamsOfASheetAreReadable) {
    for (const char* grid : {"5x5", "5-1"}) {
        const PrintedKolam kolam{grid, 2};
        const SheetCell cell = print_cell(kolam.document(), read_draw_settings({{"dots", ""}}));
        for (const std::size_t count : {6U, 9U}) {
            SCOPED_TRACE(fmt::format("{} of {}", count, grid));
            SheetOptions sheet;
            sheet.page = {210, 297, 10};
            sheet.dpi = 130;
            sheet.format = PrintFormat::png;
            const ScratchFolder folder;
            draw_sheet(std::vector<SheetCell>(count, cell), sheet, folder.path() / "sheet.png");
            std::set<std::pair<double, double>> corners;
            for (const std::size_t number : {std::size_t{1}, count}) {
                const Photograph read = read_photograph(folder.path() / "sheet.png", {.number = number});
                EXPECT_EQ(read.kolams, count) << notes_of(read);
                EXPECT_EQ(read.readable, count) << notes_of(read);
                EXPECT_FALSE(has(notes_of(read), "border"));
                EXPECT_EQ(read.kolam.grid.text(), kolam.dots.text());
                EXPECT_EQ(read.kolam.states, kolam.states);
                const glm::dvec2 corner = read.in_file(read.kolam.grid.dots().front());
                corners.emplace(corner.x, corner.y);
            }
            EXPECT_EQ(corners.size(), 2U);
        }
    }
}

}  // namespace sikku::photograph_prints_test
