// tests/program/sheet_test.cpp: runs `sikku sheet`, and draws with borders, repeats and lines of text.
#include "tests/program.h"
#include "tests/tools.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace sikku::sheet_test {

class SheetProgram : public ::testing::Test {
protected:
    SheetProgram() {
        here_.folder = folder_.path();
        folder_.write("a.lsys",
                      "title: A\naxiom: F-F-F-F\nF --> F-F+F\nderivation length: 1\nstroke: 0.2 step navy\n");
        folder_.write("with@sign.lsys", "axiom: F+F\n");
    }
    Outcome sheet(std::vector<std::string> arguments) {
        arguments.insert(arguments.begin(), "sheet");
        return run(arguments, here_);
    }
    void expect_mistake(const std::vector<std::string>& arguments, const std::string& part) {
        const Outcome outcome = sheet(arguments);
        EXPECT_EQ(outcome.status, 2) << outcome.errors;
        EXPECT_TRUE(has(outcome.errors, part));
        EXPECT_FALSE(std::filesystem::exists(folder_ / "x.svg"));
    }
    ScratchFolder folder_;
    Surroundings here_;
};

TEST_F(SheetProgram, WritesEveryFormat) {
    for (const char* format : {"svg", "pdf", "png", "tif", "jpg", "exr", "hpgl", "gcode"}) {
        const std::string file = std::string("x.") + format;
        const Outcome outcome = sheet({"a.lsys@n=2,border=rope,rotate=30", "with@sign.lsys",
                                       "snake-kolam@repeat=ring:3,gap=5%,dots", "--columns", "2", "--gutter", "9mm",
                                       "--titles", "title", "--heading", "All", "--dpi", "40", "-o", file});
        EXPECT_EQ(outcome.status, 0) << outcome.errors;
        EXPECT_GT(std::filesystem::file_size(folder_ / file), 500u);
    }
}

TEST_F(SheetProgram, ReportsMistakes) {
    expect_mistake({"a.lsys@sise=3", "-o", "x.svg"}, "sise");
    expect_mistake({"a.lsys@size=A3", "-o", "x.svg"}, "--size A3: applies to the whole sheet");
    expect_mistake({"a.lsys@x=-3mm", "-o", "x.svg"}, "--x -3mm: expected a length");
    expect_mistake({"a.lsys@border=kavi", "-o", "x.svg"}, "--border kavi: unknown border; did you mean 'kaavi'?");
    expect_mistake({"a.lsys", "--repeat", "p5", "-o", "x.svg"}, "p31m");
    expect_mistake({"a.lsys", "--columns", "0", "-o", "x.svg"}, "--columns");
    expect_mistake({"a.lsys", "-o", "x.gif"}, "a sheet is SVG");
    expect_mistake({"a.lsys", "-o", "x.txt"}, "expected an SVG");
    expect_mistake({"no-such-pattern", "-o", "x.svg"}, "no-such-pattern");
}

TEST_F(SheetProgram, WorkbooksArePdf) {
    const auto workbook = [&](std::vector<std::string> arguments) {
        arguments.insert(arguments.begin(), "workbook");
        return run(arguments, here_);
    };
    const Outcome made = workbook({"snake-kolam@n=2", "snake-kolam@n=1,border=rope", "--booklet", "-o", "class.pdf"});
    EXPECT_EQ(made.status, 0) << made.errors;
    EXPECT_TRUE(has(made.errors, "4 sheets to fold"));
    EXPECT_TRUE(has(contents(folder_ / "class.pdf"), "%PDF-1.6"));
    const auto refused = [&](const std::vector<std::string>& arguments, const std::string& part) {
        const Outcome outcome = workbook(arguments);
        EXPECT_EQ(outcome.status, 2) << outcome.errors;
        EXPECT_TRUE(has(outcome.errors, part));
        EXPECT_FALSE(std::filesystem::exists(folder_ / "x.pdf"));
    };
    refused({"snake-kolam", "-o", "x.svg"}, "expected a PDF");
    refused({"snake-kolam", "--size", "1mm", "-o", "x.pdf"}, "10 cm");
    refused({"snake-kolam@tile=A4", "-o", "x.pdf"}, "the pages of a workbook have their own");
    refused({"snake-kolam@ground=navy", "-o", "x.pdf"}, "white paper");
    refused({"no-such-pattern", "-o", "x.pdf"}, "no-such-pattern");
    refused({"-o", "x.pdf"}, "KOLAM");
}

TEST_F(SheetProgram, GalleriesOnWhitePaperHaveWhitePosters) {
    const Outcome made = run(
        {"gallery", "a.lsys", "snake-kolam", "-o", "wall", "-f", "svg", "--paper", "white", "--poster", "A4"}, here_);
    EXPECT_EQ(made.status, 0) << made.errors;
    const std::string poster = contents(folder_ / "wall/poster.svg");
    EXPECT_FALSE(has(poster, "#f7f4ec"));
    EXPECT_TRUE(has(poster, "fill=\"#ffffff\""));
}

TEST_F(SheetProgram, BordersAndLinesOfTextComeFromThePattern) {
    folder_.write("tooth.lsys", "axiom: +F--F\nangle increment: 45\nstroke: 0.1 step lime\n");
    folder_.write("b.lsys", "title: Framed\naxiom: F+F+F+F\nborder: tooth.lsys\nstroke: 1mm navy\n");
    const auto draw = [&](std::vector<std::string> more) {
        more.insert(more.begin(), {"draw", "b.lsys", "-o", "b.svg"});
        const Outcome outcome = run(more, here_);
        EXPECT_EQ(outcome.status, 0) << outcome.errors;
        return contents(folder_ / "b.svg");
    };
    EXPECT_TRUE(has(draw({}), "#00ff00"));
    EXPECT_FALSE(has(draw({"--border", "none"}), "#00ff00"));
    EXPECT_FALSE(has(draw({"--border", "lotus"}), "#00ff00"));
    EXPECT_FALSE(has(draw({"--window", "0,0,1,1"}), "#00ff00"));
    const std::string plain = draw({"--border", "none"});
    EXPECT_GT(draw({"--border", "none", "--title-line"}).size(), plain.size() + 300);
    EXPECT_GT(draw({"--border", "none", "--edition", "3/50"}).size(), plain.size() + 200);
    EXPECT_EQ(run({"draw", "b.lsys", "-o", "b.glb"}, here_).status, 0);
    EXPECT_EQ(run({"draw", "b.lsys", "-o", "b.svg", "--border", "pipe.lsys"}, here_).status, 2);
}

TEST_F(SheetProgram, AFontAppliesToAllTextsOfASheet) {
    if (!std::filesystem::exists("/usr/share/fonts/truetype/noto/NotoSerif-Bold.ttf")) {
        GTEST_SKIP() << "fonts-noto-core is not installed";
    }
    folder_.write("l.lsys", "title: Law\naxiom: F+F\nground: none\nstroke: 1mm navy\n");
    const auto sheet = [&](std::vector<std::string> more) {
        more.insert(more.begin(), {"sheet", "l.lsys", "-o", "s.svg"});
        return run(more, here_);
    };
    const auto areas = [&](const std::vector<std::string>& more) {
        const Outcome outcome = sheet(more);
        EXPECT_EQ(outcome.status, 0) << outcome.errors;
        const std::string text = contents(folder_ / "s.svg");
        std::size_t count = 0;
        for (std::size_t at = 0; (at = text.find("z\"/>", at)) != std::string::npos; ++at) ++count;
        return count;
    };
    const std::vector<std::string> font = {"--font", "Noto Serif"};
    EXPECT_EQ(areas({"--titles", "title", font[0], font[1]}), 3u);
    EXPECT_EQ(areas({"--titles", "title", "--heading", "Two words", font[0], font[1]}), 11u);
    EXPECT_EQ(areas({"--title-line=Oak", font[0], font[1]}), 3u);
    EXPECT_EQ(areas({"--titles", "title"}), 0u);
    const Outcome refused = sheet(font);
    EXPECT_EQ(refused.status, 2);
    EXPECT_TRUE(has(refused.errors, "--font: needs 'titles', 'heading', --title-line or --edition"))
        << refused.errors;
}

TEST_F(SheetProgram, ReportsWhatDrawReportsOnceWithTheNamesOfTheDrawings) {
    folder_.write("line.lsys", "title: Line\naxiom: FF\n");
    const Outcome dots = sheet({"line.lsys", "snake-kolam", "line.lsys@title=Second", "--dots", "-o", "x.svg"});
    EXPECT_EQ(dots.status, 0) << dots.errors;
    EXPECT_TRUE(has(dots.errors, "'Line', 'Second': no dots were drawn"));
    const Outcome plot = sheet({"line.lsys", "snake-kolam@fields=kind", "a.lsys@fields=kind", "-o", "x.gcode"});
    EXPECT_TRUE(has(plot.errors, "plots fill fields only by hatching"));
    const Outcome pale = sheet({"line.lsys@fields=kind", "a.lsys", "--hatch=1mm", "-o", "x.hpgl"});
    EXPECT_TRUE(has(pale.errors, "'Line': no fields were filled"));
    EXPECT_TRUE(has(pale.errors, "--hatch has no effect"));
    EXPECT_TRUE(has(sheet({"a.lsys", "--compression", "9", "-o", "x.svg"}).errors, "--compression has no effect"));
}

TEST_F(SheetProgram, CaptionsOfKolamsStateTheirGrid) {
    ASSERT_EQ(run({"kolam", "--grid", "3x3", "--crossings", "all", "-o", "k.lsys"}, here_).status, 0);
    const auto svg = [&](const std::string& titles) {
        EXPECT_EQ(sheet({"k.lsys@title=K", "--titles", titles, "-o", "x.svg"}).status, 0);
        return contents(folder_ / "x.svg");
    };
    // The grid and the description are two more lines of many strokes; productions would be none.
    EXPECT_GT(svg("caption").size(), svg("title").size() + 2000);
}

TEST_F(SheetProgram, PlacesThatAreMissingOrOverlapAreMistakesOfUse) {
    expect_mistake({"a.lsys@x=1mm,y=1mm", "with@sign.lsys", "-o", "x.svg"}, "'with@sign' has no place on the sheet");
    const Outcome overlap = sheet({"a.lsys@x=20mm,y=20mm", "with@sign.lsys@x=30mm,y=30mm", "-o", "x.png"});
    EXPECT_EQ(overlap.status, 2) << overlap.errors;
    expect_mistake({"a.lsys", "with@sign.lsys@width=3mm", "-o", "x.svg"}, "(drawing 'with@sign.lsys')");
    const Outcome gif = sheet({"a.lsys", "-o", "x.gif"});
    EXPECT_FALSE(has(gif.errors, "--format"));
}

TEST_F(SheetProgram, BordersOfPatternsThatAreNotDrawnAreReported) {
    folder_.write("b.lsys", "title: Framed\naxiom: F+F+F+F\nborder: rope\nstroke: 1mm navy\n");
    const auto errors = [&](std::vector<std::string> more) {
        more.insert(more.begin(), {"draw", "b.lsys"});
        const Outcome outcome = run(more, here_);
        EXPECT_EQ(outcome.status, 0) << outcome.errors;
        return outcome.errors;
    };
    EXPECT_TRUE(has(errors({"--window", "0,0,1,1", "-o", "w.svg"}), "a window shows only part"));
    EXPECT_TRUE(has(errors({"--lesson", "-o", "l.pdf"}), "a lesson teaches the lines"));
    EXPECT_FALSE(has(errors({"-o", "b.svg"}), "border"));
    EXPECT_FALSE(has(errors({"--window", "0,0,1,1", "--border", "none", "-o", "w.svg"}), "border"));
}

}  // namespace sikku::sheet_test
