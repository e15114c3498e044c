// Colouring pages: closed regions of a least area between lines of at least three points, checked in the printed
// page.
#include "art/prints.h"
#include "art/sheets.h"
#include "engine/base/output.h"
#include "tests/checks.h"
#include "tests/print_tools.h"
#include "tests/works.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <deque>
#include <regex>
#include <string>
#include <vector>

namespace sikku::colouring_test {

/// Two rows of two squares, each with its own edges.
const std::string squares =
    "title: Squares\naxiom: [A][fA][+f-A][f+f-A]\nangle increment: 90\nheading: 0\nturn: left\n"
    "ground: #7d3324\nstroke: 0.4 step #fffaf0\npalette: #fffaf0 #c23a6b\ninterpret:\nA --> {F+F+F+F}\n";
const std::string kolam =
    "title: Snake\naxiom: F+XF+F+XF\nX --> XF-F-F+XF+F+XF-F-F+X\nderivation length: 1\nangle increment: 90\n"
    "line: spline\nground: #7d3324\nstroke: 0.2 step #fffaf0\n";
/// An open line that crosses itself once.
const std::string loop = "axiom: FFF+FF+FF+FFF\nangle increment: 90\nstroke: 1mm black\n";

/// Areas in mm² of the regions of light pixels that do not reach the edge, by breadth-first search.
std::vector<double> flooded(const PixelGrid& grid, double dpi) {
    const auto place = [&](int x, int y) {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(grid.width) + static_cast<std::size_t>(x);
    };
    std::vector<char> seen(place(0, grid.height), 0);
    std::vector<double> areas;
    for (int top = 0; top < grid.height; ++top) {
        for (int left = 0; left < grid.width; ++left) {
            std::deque<std::pair<int, int>> front = {{left, top}};
            std::size_t pixels = 0;
            bool is_open = false;
            while (!front.empty()) {
                const auto [x, y] = front.front();
                front.pop_front();
                if (x < 0 || y < 0 || x >= grid.width || y >= grid.height) {
                    is_open = true;
                    continue;
                }
                if (seen[place(x, y)] || grid.at(x, y).green < 128) continue;
                seen[place(x, y)] = 1;
                ++pixels;
                for (const auto& [right, down] : {std::pair(1, 0), {-1, 0}, {0, 1}, {0, -1}}) {
                    front.emplace_back(x + right, y + down);
                }
            }
            const double pixel = 25.4 / dpi;
            if (pixels > 0 && !is_open) areas.push_back(static_cast<double>(pixels) * pixel * pixel);
        }
    }
    return areas;
}

/// A kolam of four lines with horns.
std::string knot() {
    return load("kolam-7-to-1-642e8j2b").source().text();
}

class Colouring : public ::testing::Test {
protected:
    std::string make(const std::string& pattern, const std::string& format, OptionValues values) {
        values.push_back({"colouring", "200"});
        const MadeWork work = made_work(prints(), parse("page.lsys", pattern), format, values);
        remarks_ = work.remarks;
        return format == "svg" ? work.bytes().substr(work.bytes().find("</metadata>")) : work.bytes();
    }
    std::string refused(const std::string& pattern, OptionValues values, const std::string& format = "svg") {
        if (!has_colouring(values)) values.push_back({"colouring", ""});
        const MadeWork work = made_work(prints(), parse("page.lsys", pattern), format, values);
        EXPECT_EQ(work.status, 2) << work.error;
        return work.error;
    }
    static bool has_colouring(const OptionValues& values) {
        return std::any_of(values.begin(), values.end(),
                           [](const OptionValue& value) { return value.name == "colouring"; });
    }
    /// Width in millimetres of the first lines of an SVG.
    static double width_of(const std::string& svg) {
        std::smatch found;
        const std::regex form("scale\\(0\\.001\\)\" fill=\"none\" stroke=\"#000000\" stroke-width=\"([0-9.]+)\"");
        return std::regex_search(svg, found, form) ? std::stod(found[1]) / 1000 : 0;
    }
    ScratchFolder folder_;
    std::string remarks_;
};

TEST_F(Colouring, RegionsOfThePrintedPageAreLargeEnough) {
    NEEDS("pdftoppm");
    for (const auto& [pattern, regions] : {std::pair(squares, 4u), {kolam, 1u}, {loop, 1u}, {knot(), 29u}}) {
        const std::string pdf = folder_.write("page.pdf", make(pattern, "pdf", {{"size", "A4"}}));
        const std::vector<double> areas = flooded(render_pdf(pdf, 100), 100);
        ASSERT_EQ(areas.size(), regions);
        const double least = *std::min_element(areas.begin(), areas.end());
        EXPECT_GE(least, 199);
        // The program counts and measures the same regions.
        EXPECT_TRUE(has(remarks_, std::to_string(areas.size()) + " region")) << remarks_;
        std::smatch stated;
        ASSERT_TRUE(std::regex_search(remarks_, stated, std::regex("of ([0-9]+) mm")));
        EXPECT_NEAR(std::stod(stated[1]), least, 0.01 * least + 1);
    }
}

/// A square of side a has an area of (a - w)² within lines of width w.
TEST_F(Colouring, MeasuresASquareWithinItsLines) {
    make(squares, "svg", {{"step", "20mm"}});
    EXPECT_TRUE(has(remarks_, "4 regions to colour, the smallest of 359 mm²")) << remarks_;
    // 15.3 mm are enough for 200 mm², 15.1 mm are not.
    make(squares, "svg", {{"step", "15.3mm"}});
    EXPECT_TRUE(has(refused(squares, {{"step", "15.1mm"}}), "below 200 mm²; expected a step of at least 15.3 mm"));
}

TEST_F(Colouring, LinesHaveThreePointsAndOneInkOnWhite) {
    const std::string svg = make(squares, "svg", {{"size", "A4"}});
    EXPECT_GE(width_of(svg), 3 * 25.4 / 72);
    EXPECT_FALSE(has(svg, "#c23a6b"));
    EXPECT_FALSE(has(svg, "#7d3324"));
    const std::string brown = make(squares, "svg", {{"size", "A4"}, {"stroke", "2mm sienna"}});
    EXPECT_TRUE(has(brown, "#a0522d"));
    EXPECT_TRUE(has(refused(squares, {{"stroke", "0.5mm"}}), "at least 1.06mm"));
    EXPECT_TRUE(has(refused(squares, {{"stroke", "0.2 step"}}), "at least 1.06mm"));
    EXPECT_TRUE(has(refused(squares, {{"stroke", "none"}}), "at least 1.06mm"));
}

/// The stated page and the stated derivation length are large enough.
TEST_F(Colouring, StatesALargerPageOrAShorterDerivation) {
    const auto grid = [](int steps) {
        return "title: Grid\naxiom: A\nA --> A[fA][+f-A][f+f-A]\nf --> ff\nangle increment: 90\nheading: 0\n"
               "turn: left\nstroke: 0.4mm #203060\ninterpret:\nA --> {F+F+F+F}\nderivation length: " +
               std::to_string(steps) + "\n";
    };
    const std::string error = refused(grid(4), {{"size", "A4"}});
    std::smatch size;
    ASSERT_TRUE(std::regex_search(error, size, std::regex("of at least ([0-9]+) x ([0-9]+) mm"))) << error;
    EXPECT_TRUE(has(error, "mm (A3), n = 3 or a smaller area"));
    make(grid(4), "svg", {{"size", size[1].str() + "x" + size[2].str() + "mm"}});
    make(grid(3), "svg", {{"size", "A4"}});
    EXPECT_EQ(made_work(prints(), parse("page.lsys", grid(4)), "svg", {{"colouring", "0"}}).status, 0);
}

TEST_F(Colouring, RefusesWhatIsNotAnOutline) {
    EXPECT_TRUE(has(refused(squares, {{"step", "1.2mm"}}), "the smallest of 4 closed regions has 0.0"));
    EXPECT_TRUE(has(refused("axiom: F+F\nstroke: 1mm black\n", {}), "no region"));
    for (const char* option :
         {"dots", "border", "fields", "weave", "parallel", "hand", "palette", "ground", "fill"}) {
        const std::string value = option == std::string("dots")       ? ""
                                  : option == std::string("border")   ? "kaavi"
                                  : option == std::string("fields")   ? "by kind"
                                  : option == std::string("weave")    ? "yes"
                                  : option == std::string("parallel") ? "3"
                                  : option == std::string("hand")     ? "0.5"
                                                                      : "red";
        EXPECT_TRUE(has(refused(kolam, {{option, value}}), "outlines alone")) << option;
    }
    EXPECT_TRUE(has(refused(kolam, {{"lesson", ""}}), "at once"));
    EXPECT_TRUE(has(refused(kolam, {}, "gif"), ""));
    EXPECT_TRUE(has(refused(kolam, {}, "stl"), "a model has no page"));
    EXPECT_TRUE(has(refused("axiom: F&F\n", {}), "in the plane"));
    for (const char* value : {"-1", "big", "1e9", "nan", "2cm"}) {
        EXPECT_TRUE(has(refused(kolam, {{"colouring", value}}), "expected")) << value;
    }
}

/// Outlines ignore the fields, dots and borders of the pattern.
TEST_F(Colouring, LeavesOutWhatThePatternAdds) {
    const std::string rich = kolam +
                             "fields: chessboard\nweave: yes\nparallel: 3\nhand: 0.5\nborder: lotus\n"
                             "dots: 2mm white\n";
    const auto drawn = [&](const std::string& pattern) {
        const std::string svg = make(pattern, "svg", {{"size", "A4"}});
        return svg.substr(svg.find("<path"));
    };
    EXPECT_EQ(drawn(rich), drawn(kolam));
}

TEST_F(Colouring, HoldsForSheetsRepeatsAndTiles) {
    const Document document = parse("squares.lsys", squares);
    MemoryDestination memory;
    const std::vector<SheetItem> items = {{document, {}}, {document, {}}};
    plan_sheet(items, "svg", {{"colouring", ""}, {"size", "A4"}})->make(memory, "sheet.svg", {}, 1);
    EXPECT_GE(width_of(memory.take("sheet.svg")), 3 * 25.4 / 72);
    EXPECT_THROW(plan_sheet(items, "svg", {{"colouring", ""}, {"size", "60x60mm"}})->make(memory, "s.svg", {}, 1),
                 SettingError);
    make(squares, "svg", {{"repeat", "p1:2x2"}, {"size", "A3"}});
    EXPECT_TRUE(has(remarks_, "16 regions")) << remarks_;
    make(squares, "png", {{"dpi", "50"}, {"title-line", "Boo"}, {"size", "A4"}});
    EXPECT_TRUE(has(remarks_, "4 regions")) << remarks_;
}

}  // namespace sikku::colouring_test
