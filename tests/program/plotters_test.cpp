// tests/program/plotters_test.cpp: `sikku plotters`, and profiles of plotters in files.
#include "tests/files.h"
#include "tests/print_tools.h"
#include "tests/program.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace sikku::plotters_test {

TEST(Plotters, AreListedAndPrinted) {
    const Outcome list = run({"plotters"});
    EXPECT_EQ(list.status, 0);
    for (const char* name : {"axidraw ", "grbl ", "grbl-laser ", "hp7475a ", "marlin ", "marlin-z ", "z "}) {
        EXPECT_TRUE(has(list.output, std::string("\n") + name) || list.output.starts_with(name)) << name;
    }
    const Outcome one = run({"plotters", "marlin"});
    EXPECT_EQ(one.status, 0);
    EXPECT_TRUE(has(one.output, "dwell: G4 P{milliseconds}\n"));
    const Outcome unknown = run({"plotters", "roland"});
    EXPECT_EQ(unknown.status, 2);
    EXPECT_TRUE(has(unknown.errors, "unknown plotter 'roland'; expected axidraw, grbl,"));
}

TEST(Plotters, AFileIsAsGoodAsAName) {
    const ScratchFolder folder;
    const std::string file = folder.write("mine.plotter", run({"plotters", "marlin"}).output);
    const std::string named = folder.file("named.gcode"), own = folder.file("own.gcode");
    EXPECT_EQ(run({"-q", "draw", "hilbert", "-n", "3", "--profile", "marlin", "-o", named}).status, 0);
    EXPECT_EQ(run({"-q", "draw", "hilbert", "-n", "3", "--profile", file, "-o", own}).status, 0);
    EXPECT_EQ(without_recipe("gcode", contents(named)), without_recipe("gcode", contents(own)));
    EXPECT_TRUE(has(contents(own), "\nG4 P150\n"));
    // Options replace what the file says.
    EXPECT_EQ(run({"-q", "draw", "hilbert", "-n", "3", "--profile", file, "--pen-speed", "11", "-o", own}).status, 0);
    EXPECT_TRUE(has(contents(own), " F660\n"));
    folder.write("mine.plotter", "language: G-code\npen up: {hight}\n");
    const Outcome wrong = run({"-q", "draw", "hilbert", "-n", "3", "--profile", file, "-o", own});
    EXPECT_EQ(wrong.status, 2);
    EXPECT_TRUE(has(wrong.errors, "mine.plotter:2:9: unknown placeholder {hight}"));
}

/// A profile is a user's text, like a pattern: everything that is wrong with it has status 2.
TEST(Plotters, FilesThatCannotBeUsedAreUsageErrors) {
    const ScratchFolder folder;
    const std::string own = folder.file("own.gcode");
    const auto refusal = [&](const std::string& file) {
        const Outcome outcome = run({"-q", "draw", "hilbert", "-n", "3", "--profile", file, "-o", own});
        EXPECT_EQ(outcome.status, 2) << file;
        return outcome.errors;
    };
    EXPECT_TRUE(has(refusal(folder.file("none.x")), "No such file"));
    EXPECT_TRUE(has(refusal(folder.path().string() + "/"), "is a folder"));
    EXPECT_TRUE(has(refusal(folder.write("big.plotter", std::string(70'000, 'a'))), "larger than 64 kB"));
    const std::string file = folder.write("far.plotter", "language: G-code\nend: G0 X0 Y1e300\nstart: G0 Xnan\n");
    const std::string errors = refusal(file);
    EXPECT_TRUE(has(errors, "far.plotter:2:12: expected a place within 10 m of the origin"));
    EXPECT_TRUE(has(errors, "far.plotter:3:11: expected a place within 10 m of the origin"));
}

TEST(Plotters, AProfileForSvgMakesAPlot) {
    const ScratchFolder folder;
    const auto made = [&](const std::vector<std::string>& more, const std::string& name) {
        std::vector<std::string> words = {"-q", "draw", "hilbert", "-n", "3", "-o", folder.file(name)};
        words.insert(words.end(), more.begin(), more.end());
        return run(words);
    };
    ASSERT_EQ(made({"--profile", "axidraw"}, "own.svg").status, 0);
    ASSERT_EQ(made({"--profile", "axidraw", "--plotter"}, "both.svg").status, 0);
    EXPECT_EQ(without_recipe("svg", contents(folder.file("own.svg"))),
              without_recipe("svg", contents(folder.file("both.svg"))));
    const Outcome pdf = made({"--profile", "axidraw"}, "own.pdf");
    EXPECT_EQ(pdf.status, 2);
    EXPECT_TRUE(has(pdf.errors, "--profile axidraw: this plotter reads SVG, not PDF"));
}

TEST(Plotters, PensThatDrawNothingAreReported) {
    const ScratchFolder folder;
    const auto errors = [&](const std::string& pen) {
        return run({"draw", "hilbert", "-n", "3", "--pen", pen, "-o", folder.file("a.gcode")}).errors;
    };
    EXPECT_TRUE(has(errors("7 speed=10"), "warning: --pen 7 has no effect: the plot uses 1 pen\n"));
    EXPECT_TRUE(has(errors("navy speed=10"), "warning: --pen navy has no effect: no pen has this colour\n"));
    EXPECT_FALSE(has(errors("1 speed=10"), "warning"));
}

TEST(Plotters, APlotIsResumedInMetres) {
    const ScratchFolder folder;
    const Outcome outcome = run({"draw", "hilbert", "-n", "3", "--resume", "900m", "-o", folder.file("a.gcode")});
    EXPECT_EQ(outcome.status, 2);
    EXPECT_TRUE(has(outcome.errors, "--resume 900m: the whole plot draws only "));
    EXPECT_FALSE(has(outcome.errors, "mm"));
}

TEST(Plotters, AFileBelongsToTheJobsOfAGallery) {
    const ScratchFolder folder;
    folder.write("mine.plotter", "language: G-code\nspeed: 10\n");
    const std::string file = folder.write(
        "g.toml", "pattern = 'hilbert'\nformat = 'gcode'\nsize = '40x40mm'\nn = 2\nprofile = 'mine.plotter'\n");
    const std::vector<std::string> asked = {"gallery", "--file", file, "-o", folder.file("out")};
    const Outcome first = run(asked);
    EXPECT_EQ(first.status, 0) << first.errors;
    EXPECT_TRUE(has(run(asked).errors, "0 made, 1 up to date"));
    folder.write("mine.plotter", "language: G-code\nspeed: 20\n");
    EXPECT_TRUE(has(run(asked).errors, "1 made"));
}

}  // namespace sikku::plotters_test
