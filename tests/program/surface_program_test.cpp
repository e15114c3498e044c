// tests/program/surface_program_test.cpp: surfaces and blades in every output, and the files of surfaces.
#include "art/link/link.h"
#include "tests/files.h"
#include "tests/program.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

namespace sikku::surface_program_test {

const std::filesystem::path corpus = std::filesystem::path(SIKKU_SOURCE_DIR) / "tests/corpus/surfaces";

const std::string leafy =
    "title: Leafy\naxiom: F~leaf(s)F\ndefine s = 1\nvariant big: s = 3\nsurface: leaf = leaf.s\n"
    "stroke: 0.1 step black\n";

TEST(SurfaceProgram, EveryOutputShowsThem) {
    const ScratchFolder folder;
    for (const std::string pattern : {"generic-plant", "cordate-leaf", "cordate-leaf-polygons"}) {
        SCOPED_TRACE(pattern);
        for (const char* name : {"a.svg", "a.pdf", "a.png", "a.tif", "a.hpgl", "a.gcode", "a.obj", "a.glb"}) {
            // Without fills there is less to see.
            const Outcome whole =
                run({"-q", "draw", pattern, "--size", "40x50mm", "--dpi", "40", "-o", folder.file(name)});
            EXPECT_EQ(whole.status, 0) << name << whole.errors;
            const std::string with = contents(folder.file(name));
            const Outcome bare =
                run({"-q", "draw", pattern, "--size", "40x50mm", "--dpi", "40", "--set",
                     pattern == "generic-plant" ? "palette=#6f9a45 #00000000 #00000000 #00000000" : "fill=#00000000",
                     "-o", folder.file(name)});
            EXPECT_EQ(bare.status, 0) << name << bare.errors;
            const std::string_view ending = std::string_view(name).substr(2);
            const bool is_plot = ending == "hpgl" || ending == "gcode";
            // A plot draws the outlines of polygons only where no line does.
            if (!is_plot || pattern == "generic-plant") {
                EXPECT_NE(contents(folder.file(name)), with) << name;
            }
        }
        const std::vector<std::vector<std::string>> others = {
            {"--generations", "3:5", "-o", folder.file("g.gif"), "--dpi", "30", "--size", "40x50mm"},
            {"--generations", "3:5", "-o", folder.file("g.svg"), "--size", "A5"},
            {"--generations", "3:5", "--frames", "-o", folder.file("f.png"), "--dpi", "30", "--size", "40x50mm"},
            {"--tile", "60x60mm", "-o", folder.file("t.pdf")},
            {"--plotter", "--hatch", "1mm", "-o", folder.file("p.svg"), "--size", "A6"}};
        for (std::vector<std::string> arguments : others) {
            arguments.insert(arguments.begin(), {"-q", "draw", pattern});
            const Outcome outcome = run(arguments);
            EXPECT_EQ(outcome.status, 0) << arguments[3] << outcome.errors;
        }
    }
}

TEST(SurfaceProgram, WhatSpaceLacksIsRefused) {
    const Outcome outcome = run({"draw", "generic-plant", "--dots", "-o", "x.svg"});
    EXPECT_EQ(outcome.status, 2);
    EXPECT_TRUE(has(outcome.errors, "this one pitches, rolls, bends or has surfaces"));
    const Outcome kolam = run({"kolam", "generic-plant"});
    EXPECT_EQ(kolam.status, 1);
    EXPECT_TRUE(has(kolam.errors, "a kolam lies in the plane: this drawing pitches, rolls, bends or has surfaces"));
}

TEST(SurfaceProgram, FilesAreFoundBesideThePattern) {
    const ScratchFolder folder;
    std::filesystem::create_directory(folder / "sub");
    std::filesystem::copy_file(corpus / "two-patches.s", folder / "sub/leaf.s");
    folder.write("sub/leafy.lsys", leafy);
    EXPECT_EQ(run({"-q", "draw", "sub/leafy.lsys", "-o", "a.svg"}, {.folder = folder.path()}).status, 0);
    EXPECT_EQ(
        run({"-q", "draw", "sub/leafy.lsys", "--variant", "big", "-o", "b.svg"}, {.folder = folder.path()}).status,
        0);
    EXPECT_NE(contents(folder / "a.svg"), contents(folder / "b.svg"));
    // Otherwise they are in the working directory: a pattern from a pipe or a trusted link has no folder.
    const std::filesystem::path sub = folder / "sub";
    EXPECT_EQ(run({"-q", "draw", "-", "-o", "c.svg"}, {.input = leafy, .folder = sub}).status, 0);
    SharedWork work;
    work.name = "leafy.lsys";
    work.text = leafy;
    const std::string link = "#" + link_of(work);
    EXPECT_EQ(run({"-q", "draw", link, "--trust-link", "-o", "d.svg"}, {.folder = sub}).status, 0);
    EXPECT_EQ(contents(sub / "d.svg"), contents(sub / "c.svg"));
    const Outcome outcome = run({"-q", "draw", link, "--trust-link", "-o", "e.svg"}, {.folder = folder.path()});
    EXPECT_EQ(outcome.status, 2);
    EXPECT_TRUE(has(outcome.errors, "leafy.lsys:5:17: 'leaf.s' cannot be read: No such file"));
    // Patches of the pattern itself travel with it.
    work.text = run({"show", "generic-plant"}).output;
    EXPECT_EQ(run({"-q", "draw", "#" + link_of(work), "-o", "f.svg"}, {.folder = folder.path()}).status, 0);
}

TEST(SurfaceProgram, GalleriesAreMadeAgainWhenAFileChanges) {
    const ScratchFolder folder;
    folder.write("leaf.s", contents(corpus / "two-patches.s"));
    folder.write("leafy.lsys", leafy);
    folder.write("g.toml", "pattern = 'leafy.lsys'\nvariant = ['', 'big']\nformat = 'svg'\n");
    const auto made = [&] {
        const Outcome outcome = run({"gallery", "--file", folder.file("g.toml"), "-o", folder.file("out")});
        EXPECT_EQ(outcome.status, 0) << outcome.errors;
        return outcome.output + outcome.errors;
    };
    EXPECT_TRUE(has(made(), "2 made"));
    const std::string before = contents(folder / "out/leafy-big.svg");
    EXPECT_FALSE(has(made(), "made ("));
    std::string text = contents(folder / "leaf.s");
    text.replace(text.find("SIZE: 302.0"), 11, "SIZE: 151.0");
    folder.write("leaf.s", text);
    EXPECT_TRUE(has(made(), "2 made"));
    EXPECT_NE(contents(folder / "out/leafy-big.svg"), before);
}

}  // namespace sikku::surface_program_test
