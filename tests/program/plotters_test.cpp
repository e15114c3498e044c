// tests/program/plotters_test.cpp: `sikku plotters`, and profiles of plotters in files.
#include "tests/files.h"
#include "tests/program.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace sikku {
namespace {

TEST(Plotters, AreListedAndPrinted) {
    const Outcome list = run({"plotters"});
    EXPECT_EQ(list.status, 0);
    for (const char* name : {"axidraw ", "grbl ", "hp7475a ", "marlin ", "marlin-z ", "z "}) {
        EXPECT_TRUE(has(list.output, std::string("\n") + name) || list.output.starts_with(name)) << name;
    }
    const Outcome one = run({"plotters", "marlin"});
    EXPECT_EQ(one.status, 0);
    EXPECT_TRUE(has(one.output, "dwell: G4 P{milliseconds}\n"));
    const Outcome unknown = run({"plotters", "roland"});
    EXPECT_EQ(unknown.status, 2);
    EXPECT_TRUE(has(unknown.errors, "unknown plotter 'roland'; expected axidraw, grbl,")) << unknown.errors;
}

TEST(Plotters, AFileIsAsGoodAsAName) {
    const ScratchFolder folder;
    const std::string file = folder.write("mine.plotter", run({"plotters", "marlin"}).output);
    const std::string named = folder.file("named.gcode"), own = folder.file("own.gcode");
    EXPECT_EQ(run({"-q", "draw", "hilbert", "-n", "3", "--profile", "marlin", "-o", named}).status, 0);
    EXPECT_EQ(run({"-q", "draw", "hilbert", "-n", "3", "--profile", file, "-o", own}).status, 0);
    EXPECT_EQ(contents(named), contents(own));
    EXPECT_TRUE(has(contents(own), "\nG4 P150\n"));
    // Options replace what the file says.
    EXPECT_EQ(run({"-q", "draw", "hilbert", "-n", "3", "--profile", file, "--pen-speed", "11", "-o", own}).status, 0);
    EXPECT_TRUE(has(contents(own), " F660\n"));
    folder.write("mine.plotter", "language: G-code\npen up: {hight}\n");
    const Outcome wrong = run({"-q", "draw", "hilbert", "-n", "3", "--profile", file, "-o", own});
    EXPECT_EQ(wrong.status, 2);
    EXPECT_TRUE(has(wrong.errors, "mine.plotter:2:9: unknown placeholder {hight}")) << wrong.errors;
    const Outcome missing = run({"-q", "draw", "hilbert", "-n", "3", "--profile", folder.file("none.x"), "-o", own});
    EXPECT_EQ(missing.status, 1);
    EXPECT_TRUE(has(missing.errors, "none.x")) << missing.errors;
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

}  // namespace
}  // namespace sikku
