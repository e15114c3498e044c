#include "art/writer/draw.h"

#include "tests/checks.h"
#include "tests/print_tools.h"

#include <pugixml.hpp>

namespace sikku::draw_test {

/// The drawing of a pattern on a page of 100 x 60 mm with margins of 5 mm.
class Draw : public ::testing::Test {
protected:
    DrawReport draw(const std::string& text, const std::string& name = "print.svg") {
        Diagnostics diagnostics;
        const Pattern pattern = parse_pattern("test.lsys", text, diagnostics);
        const Grammar grammar = compile_grammar(pattern, diagnostics);
        Print print;
        print.page = {100.0, 60.0, 5.0};
        print.dpi = 25.4;
        print.style = read_style(pattern, 300.0, diagnostics);
        print.pattern = text;
        diagnostics.throw_if_errors();
        options_.format = print_format(name).value();
        return sikku::draw(grammar, print, options_, folder_ / name);
    }

    /// Attributes of what the print holds, found by an XPath.
    std::vector<std::string> found(const std::string& path, const char* attribute) {
        pugi::xml_document document;
        EXPECT_TRUE(document.load_file((folder_ / "print.svg").c_str()));
        std::vector<std::string> list;
        for (const auto& node : document.select_nodes(path.c_str())) {
            list.emplace_back(node.node().attribute(attribute).value());
        }
        return list;
    }

    ScratchFolder folder_;
    DrawOptions options_;
};

TEST_F(Draw, AWidthThatIsSetIsInTheUnitOfTheStroke) {
    options_.placement.step = 10.0;
    const DrawReport points = draw("axiom: !(2)F\nstroke: 1pt\n");
    EXPECT_EQ(found("//g[path]", "stroke-width"), std::vector<std::string>{"705.556"});
    EXPECT_NEAR(points.size.x, 2 * 25.4 / 72, 1e-9);
    EXPECT_NEAR(points.size.y, 10 + 2 * 25.4 / 72, 1e-9);
    const DrawReport steps = draw("axiom: !(0.5)F\nstroke: 0.1 step\n");
    EXPECT_EQ(found("//g[path]", "stroke-width"), std::vector<std::string>{"5000"});
    EXPECT_NEAR(steps.size.x, 5, 1e-9);
}

TEST_F(Draw, TellsHowOftenItReadsTheWord) {
    int passes = 0;
    std::uint64_t read = 0;
    options_.begin = [&](int count) {
        EXPECT_EQ(passes, 0) << "told twice";
        EXPECT_EQ(read, 0u) << "told too late";
        passes = count;
    };
    options_.watch = [&](std::uint64_t symbols) { read += symbols; };
    const auto expect = [&](const std::string& text, int expected, std::uint64_t symbols) {
        for (const char* name : {"print.svg", "print.png"}) {
            passes = 0;
            read = 0;
            draw(text, name);
            if (expected > 0) {
                EXPECT_EQ(passes, expected) << text;
            }
            EXPECT_GT(passes, 0) << text;
            EXPECT_EQ(read, static_cast<std::uint64_t>(passes) * symbols) << text;
        }
    };
    expect("axiom: F+F\n", 1, 3);
    expect("axiom: F[+F]F\n", 1, 6);
    expect("axiom: FF@O\n", 2, 3);
    expect("axiom: !FF\n", 2, 3);
    expect("axiom: ;F\n", 1, 2);
    expect("axiom: ;F'F\npalette: black transparent\n", 2, 4);
    expect("axiom: F+F+F+F\nline: spline\n", 2, 7);
    expect("axiom: F[+F]F\nline: spline\n", 3, 6);
    // With contexts, as often as it takes.
    expect("axiom: F+F\nderivation length: 1\nF < F --> F\n", 0, 3);
    expect("axiom: F+F\nderivation length: 1\nF < F --> F\nline: spline\n", 0, 3);
}

TEST_F(Draw, WhatIsNotSeenTakesNoRoom) {
    const std::string style = "palette: black transparent red\nfill: gold\nheading: 0\n";
    const auto size = [&](const std::string& axiom, const std::string& more = "") {
        options_.placement.step = 1.0;
        return draw("axiom: " + axiom + "\n" + style + more).size;
    };
    const auto expect = [](glm::dvec2 actual, double width, double height) {
        EXPECT_NEAR(actual.x, width, 1e-9);
        EXPECT_NEAR(actual.y, height, 1e-9);
    };
    expect(size("F(4);F(8)"), 4.4, 0.4);
    expect(size("-F(4);+F(8)"), 0.4, 4.4);
    expect(size(";F(8);F(4)"), 4.4, 0.4);
    expect(size("F(4);!(3)F(8)"), 4.4, 0.4);
    expect(size("F(4)!(0)F(8)"), 4.4, 0.4);
    expect(size("F(4);{F(8)+F(8)+F(8)}"), 4.4, 0.4);
    expect(size("F(4);f(8)@O(2)@."), 4.4, 0.4);
    expect(size("F(4)[;F(8)]", "line: spline\n"), 4.4, 0.4);
    expect(size("{!(3)F(8)+F(8)+F(8)}", "stroke: none\n"), 8, 8);
    expect(size("{F(8)+F(8)+F(8)}!(3)+F(9)", "stroke: none\n"), 8, 8);
    expect(size("@O(2)f(8)@.", "stroke: none\n"), 10.8, 4.8);
    // What is seen does as before.
    expect(size("F(4);;F(8)"), 12.4, 0.4);
    expect(size("F(4)!(3)F(8)"), 15, 3);
}

TEST_F(Draw, WhereNothingIsSeenNothingIsWritten) {
    for (const std::string text :
         {"axiom: F\nstroke: none\n", "axiom: F\nstroke: transparent\n", "axiom: ;F\npalette: black transparent\n",
          "axiom: F\nstroke: none\nline: spline\n", "axiom: !(0)F\n", "axiom: {F+F+F}@O\nstroke: none\nfill: none\n",
          "axiom: !(0)@.\n", "axiom: f\n", "axiom: A\n"}) {
        EXPECT_TRUE(has(error_of<std::runtime_error>([&] { draw(text); }), "nothing to draw"));
    }
    EXPECT_TRUE(folder_.names().empty());
}

TEST_F(Draw, FillsFollowTheSplineDrawnAlongThem) {
    options_.placement.step = 10.0;
    const std::string square = "axiom: {F+F+F+F}\nline: spline\nstroke: none\nfill: gold\n";
    const DrawReport report = draw(square);
    // Of a closed uniform spline over a square the curve reaches from 1/24 to 23/24.
    EXPECT_NEAR(report.size.x, 10 * 11.0 / 12, 1e-9);
    const auto paths = found("//g[@fill='#ffd700']/path", "d");
    ASSERT_EQ(paths.size(), 1u);
    EXPECT_TRUE(has(paths[0], "c"));
    EXPECT_FALSE(has(paths[0], "l"));
    EXPECT_TRUE(paths[0].ends_with("z"));
    // Straight lines keep their polygons.
    draw("axiom: {F+F+F+F}\nstroke: none\nfill: gold\n");
    EXPECT_FALSE(has(found("//g[@fill='#ffd700']/path", "d")[0], "c"));
    for (const char* name : {"print.pdf", "print.png", "print.hpgl"}) {
        EXPECT_NEAR(draw(square, name).size.x, 10 * 11.0 / 12, 1e-9) << name;
    }
}

TEST_F(Draw, FilledSplinesCoverTheSamePixelsInEveryFormat) {
    if (!has_program("rsvg-convert") || !has_program("oiiotool"))
        GTEST_SKIP() << "rsvg-convert or oiiotool is missing";
    const std::string text =
        "axiom: F{F+F+F-F-F-F+}[{;F-F+F+F}]F{;F+FF+F+F}\nline: spline\nstroke: 0.1 step black\n"
        "palette: gold #2f7d32 navy\n";
    draw(text, "print.svg");
    draw(text, "print.png");
    draw(text, "print.pdf");
    ASSERT_TRUE(
        run_tool("rsvg-convert -w 100 '" + folder_.file("print.svg") + "' -o '" + folder_.file("svg.png") + "'").ok);
    const auto pixels = [&](const std::string& name) { return read_by_oiiotool(folder_ / name); };
    const PixelGrid page = pixels("svg.png");
    const PixelGrid picture = pixels("print.png");
    ASSERT_EQ(picture.width, 100);
    ASSERT_EQ(page.width, 100);
    double difference = 0;
    int inked = 0;
    for (int y = 2; y < std::min(page.height, picture.height) - 2; ++y) {
        for (int x = 2; x < std::min(page.width, picture.width) - 2; ++x) {
            const Colour a = page.at(x, y), b = picture.at(x, y);
            difference += std::abs(a.red - b.red) + std::abs(a.green - b.green) + std::abs(a.blue - b.blue);
            inked += near(b, {255, 255, 255, 255}) ? 0 : 1;
        }
    }
    EXPECT_GT(inked, 500);
    EXPECT_LT(difference / inked, 60) << "mean difference of inked pixels, of 765";
}

TEST_F(Draw, MovesLiftThePenOfASplineWithLifts) {
    options_.placement.step = 5.0;
    const std::string axiom = "axiom: F+F-Fff+F-F\nstroke: 0.2mm\n";
    draw(axiom + "line: spline\n");
    EXPECT_EQ(found("//path", "d").size(), 1u);
    draw(axiom + "line: spline with lifts\n");
    EXPECT_EQ(found("//path", "d").size(), 2u);
    // Brackets or not, closed lines are closed.
    draw("axiom: F+F+F+Fff+F+F+F+F\nline: spline with lifts\n");
    const auto paths = found("//path", "d");
    ASSERT_EQ(paths.size(), 2u);
    for (const std::string& path : paths) EXPECT_TRUE(path.ends_with("z")) << path;
}

TEST_F(Draw, ADotThatThePatternDrawsIsDrawnOnce) {
    const std::string square = "axiom: F+F+F+F+[+(45)f(0.7071)@O(0.1)]\nstroke: 0.4mm black\n";
    draw(square);
    EXPECT_EQ(found("//circle", "r").size(), 1u);
    draw(square + "dots: 0.2 step red\n");
    EXPECT_EQ(found("//circle", "r").size(), 1u);
    // Discs elsewhere are not dots of the kolam.
    draw("axiom: F+F+F+F+[+(45)f(3)@O(0.1)]\ndots: 0.2 step red\n");
    EXPECT_EQ(found("//circle", "r").size(), 2u);
    options_.only_dots = true;
    draw(square + "dots: 0.2 step red\n");
    EXPECT_EQ(found("//circle", "r").size(), 1u);
}

TEST_F(Draw, LinesBetweenUnseenOnesHaveColoursOfTheirOwn) {
    options_.colours_strokes = true;
    draw("axiom: F+F+F+F+;(1)F(3);(0)F(2)+F(2)+F(2)+F(2)\npalette: #fffaf0 transparent\nground: #7d3324\n");
    const auto colours = found("//g[@stroke]", "stroke");
    ASSERT_EQ(colours.size(), 2u);
    EXPECT_NE(colours[0], colours[1]);
}

}  // namespace sikku::draw_test
