// Workbooks: the notes for teachers, the order by difficulty, the pages, and the order of booklets.
#include "art/workbook/workbook.h"
#include "art/prints.h"
#include "art/workbook/kolam_facts.h"
#include "art/workbook/workbook_pages.h"
#include "engine/base/output.h"
#include "tests/checks.h"
#include "tests/print_tools.h"
#include "tests/works.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace sikku::workbook_test {

const std::string snake =
    "title: Snake\naxiom: f+Xf+f+Xf\nX --> Xf-f-f+Xf+f+Xf-f-f+X\nderivation length: 2\nangle factor: 4\n"
    "ground: #8c3b2a\nstroke: 0.22 step #fffaf0\nline: spline\n";
const std::string ring = "title: Ring\naxiom: F+F+F+F\nangle factor: 4\nground: #8c3b2a\nstroke: 0.1 step #fffaf0\n";

std::vector<glm::dvec2> rows_of(const std::vector<int>& counts) {
    std::vector<glm::dvec2> dots;
    double y = 0;
    for (const int count : counts) {
        for (int i = 0; i < count; ++i) dots.emplace_back(i - (count - 1) / 2.0, y);
        y -= 1;
    }
    return dots;
}

/// The notations of the manual: rectangles, ner pulli in steps of two, idukku pulli in steps of one.
TEST(DotRows, AreWrittenInTheCustomaryNotation) {
    EXPECT_EQ(DotRows(rows_of({5, 5, 5})).notation(), "3x5");
    EXPECT_EQ(DotRows(rows_of({1, 3, 5, 7, 5, 3, 1})).notation(), "7-1 ner pulli");
    EXPECT_EQ(DotRows(rows_of({3, 4, 5, 4, 3})).notation(), "5-3 idukku pulli");
    EXPECT_EQ(DotRows(rows_of({2, 4, 4, 2})).notation(), "2-4-4-2");
    EXPECT_EQ(DotRows(rows_of({1})).notation(), "1x1");
    EXPECT_EQ(DotRows({}).notation(), "");
    EXPECT_EQ(DotRows(rows_of(std::vector<int>(20, 1))).notation(), "20x1");
}

TEST(DotRows, NumberDotsFromTheTopLeft) {
    const DotRows rows(rows_of({1, 3, 1}));
    EXPECT_EQ(rows.nearest({0, 0.2}), (DotNumber{1, 1}));
    EXPECT_EQ(rows.nearest({1.2, -1.1}), (DotNumber{2, 3}));
    EXPECT_EQ(rows.nearest({0, -5}), (DotNumber{3, 1}));
    EXPECT_EQ(DotRows({}).nearest({0, 0}), DotNumber{});
}

TEST(KolamFacts, DifficultyCountsDotsCrossingsAndStrokesOfALine) {
    KolamFacts facts{
        .title = "", .grid = "", .dots = 13, .lines = 2, .crossings = 16, .strokes = 4, .symmetry = {}, .starts = {}};
    EXPECT_EQ(facts.difficulty(), 13 + 16 + 8);
    EXPECT_EQ(facts.level(), 2);
    facts.crossings = 0;
    facts.dots = 1;
    EXPECT_EQ(facts.level(), 1);
    facts.dots = 1000;
    EXPECT_EQ(facts.level(), most_level);
}

/// Folded sheets read 1, 2, 3, …: the order that bookbinders use.
TEST(Booklet, IsInSaddleStitchOrder) {
    using Sides = std::vector<std::pair<std::size_t, std::size_t>>;
    EXPECT_EQ(saddle_stitch(4), (Sides{{3, 0}, {1, 2}}));
    EXPECT_EQ(saddle_stitch(8), (Sides{{7, 0}, {1, 6}, {5, 2}, {3, 4}}));
    for (const std::size_t count : {4u, 12u, 40u}) {
        std::vector<int> seen(count, 0);
        for (const auto& [left, right] : saddle_stitch(count)) {
            EXPECT_EQ(left + right, count - 1);
            ++seen[left];
            ++seen[right];
        }
        EXPECT_EQ(std::count(seen.begin(), seen.end(), 1), static_cast<std::ptrdiff_t>(count));
    }
}

class Workbook : public ::testing::Test {
protected:
    std::filesystem::path make(const OptionValues& values, const std::vector<SheetItem>& items) {
        MemoryDestination memory;
        remarks_ = remarks_of(plan_workbook(items, values)->make(memory, "class.pdf", {}));
        return folder_.write("class.pdf", memory.take("class.pdf"));
    }
    static std::vector<SheetItem> items() {
        return {{parse("snake.lsys", snake), {}}, {parse("ring.lsys", ring), {}}};
    }
    ScratchFolder folder_;
    std::string remarks_;
};

int pages_of_pdf(const std::filesystem::path& pdf) {
    const std::string info = run_tool("pdfinfo '" + pdf.string() + "'").text;
    return std::stoi(info.substr(info.find("Pages:") + 6));
}

TEST_F(Workbook, HasTheSamePagesFoldedAndNot) {
    NEEDS("pdfinfo");
    NEEDS("qpdf");
    const std::filesystem::path flat = make({}, items());
    EXPECT_EQ(pdf_complaints(flat), "");
    EXPECT_TRUE(has(remarks_, "13 pages of 2 kolams")) << remarks_;
    EXPECT_EQ(pages_of_pdf(flat), 14);  // with a blank one
    EXPECT_TRUE(has(run_tool("pdfinfo '" + flat.string() + "'").text, "595.276 x 841.89"));
    const std::filesystem::path folded = make({{"booklet", "true"}}, items());
    EXPECT_EQ(pdf_complaints(folded), "");
    EXPECT_EQ(pages_of_pdf(folded), 8);  // 16 pages, two on each side
    EXPECT_TRUE(has(run_tool("pdfinfo '" + folded.string() + "'").text, "841.89 x 595.276"));
}

/// Little ink: the mean of each page is nearly white.
TEST_F(Workbook, IsOnWhitePaper) {
    NEEDS("pdftoppm");
    const std::filesystem::path pdf = make({}, items());
    ASSERT_TRUE(run_tool("pdftoppm -r 20 '" + pdf.string() + "' '" + pdf.string() + ".p'").ok);
    for (int page = 1; page <= 13; ++page) {
        const PixelGrid grid =
            read_ppm(pdf.string() + ".p-" + (page < 10 ? "0" : "") + std::to_string(page) + ".ppm");
        double light = 0;
        for (int y = 0; y < grid.height; ++y) {
            for (int x = 0; x < grid.width; ++x) light += grid.at(x, y).green;
        }
        EXPECT_GT(light / (255.0 * grid.width * grid.height), 0.8) << page;
        EXPECT_GT(grid.at(0, 0).green, 250) << page;
    }
}

TEST_F(Workbook, LeavesOutColouringPagesThatAreTooFine) {
    make({{"colouring", "100000"}}, items());
    EXPECT_TRUE(has(remarks_, "'Snake' has no colouring page: the smallest of"));
    EXPECT_TRUE(has(remarks_, "11 pages of 2 kolams"));
}

TEST_F(Workbook, RefusesWhatItCannotTeach) {
    const auto refused = [&](const std::vector<SheetItem>& items, const OptionValues& values) {
        return made_work(
            [&](MemoryDestination& memory) { return plan_workbook(items, values)->make(memory, "class.pdf", {}); });
    };
    EXPECT_TRUE(is_refused(refused({}, {}), 2, "at least one kolam"));
    EXPECT_TRUE(is_refused(refused(std::vector<SheetItem>(61, items().front()), {}), 2, "at most 60"));
    EXPECT_TRUE(is_refused(refused(items(), {{"size", "3mm"}}), 2, "10 cm"));
    EXPECT_TRUE(is_refused(refused({{items().front().document, {{"lesson", ""}}}}, {}), 2, "'snake.lsys'"));
    EXPECT_TRUE(is_refused(refused({{items().front().document, {{"ground", "navy"}}}}, {}), 2, "white paper"));
    EXPECT_TRUE(is_refused(refused({{parse("map.lsys", "map: clockwise\naxiom: A A A A\nA --> A\n"), {}}}, {}), 2,
                           "no strokes to teach"));
    EXPECT_NE(refused({{parse("nothing.lsys", "axiom: f\n"), {}}}, {}).status, 0);
    EXPECT_NE(refused({{parse("space.lsys", "axiom: F&F\n"), {}}}, {}).status, 0);
}

}  // namespace sikku::workbook_test
