// tests/program/map_program_test.cpp: maps in the commands of the program.
#include "tests/maps.h"
#include "tests/program.h"
#include "tests/sha256.h"

#include <gtest/gtest.h>

#include <filesystem>

namespace sikku::map_program_test {

TEST(MapCommands, DerivePrintsEdgesAndCells) {
    const ScratchFolder folder;
    const std::string file = folder.write("layer.lsys", maps::layer);
    EXPECT_EQ(run({"derive", file}).output,
              "edge g 0 1 0\nedge c 1 2 0\nedge a 2 0 0\ncell +0 +1 +2\nouter -2 -1 -0\n");
    EXPECT_EQ(sha256(run({"derive", file, "-n", "10"}).output),
              "c0f0aa0105cae1aa9814ed8b3c12457b8f2f10c790bf06cc7dbbb4d946db7e0f");
    EXPECT_EQ(run({"derive", file, "--set", "divide=twice"}).status, 2);
}

TEST(MapCommands, MeasureCounts) {
    const ScratchFolder folder;
    const std::string file = folder.write("checkers.lsys", "title: Checkers\n" + maps::checkers);
    EXPECT_TRUE(run({"measure", file, "-n", "1"}).output.starts_with("Checkers, n = 1\ncells    2\n"));
    const Outcome refused = run({"measure", file, "-n", "60", "--budget", "10000"});
    EXPECT_EQ(refused.status, 1);
    EXPECT_TRUE(has(refused.errors, "the largest derivation length that fits is"));
}

TEST(MapCommands, WhatNeedsATurtleRefusesInOneLine) {
    const ScratchFolder folder;
    const std::string file = folder.write("layer.lsys", maps::layer);
    for (const std::vector<std::string>& command :
         {std::vector<std::string>{"play", file}, {"play", file, "-o", folder.file("a.mid")}}) {
        const Outcome outcome = run(command);
        EXPECT_EQ(outcome.status, 2);
        EXPECT_TRUE(has(outcome.errors, "1:1: a map has no turtle, so it has no melody"));
    }
    const Outcome kolam = run({"kolam", file});
    EXPECT_EQ(kolam.status, 2);
    EXPECT_TRUE(has(kolam.errors, "a map has no turtle, so it is not a kolam"));
    const Outcome tempo = run({"play", file, "--tempo", "90", "-o", folder.file("a.mid")});
    EXPECT_EQ(tempo.status, 2);
    EXPECT_EQ(run({"draw", file, "-o", folder.file("a.obj")}).status, 2);
    EXPECT_EQ(run({"draw", file, "--dots", "-o", folder.file("a.svg")}).status, 2);
    EXPECT_EQ(run({"draw", file, "-o", folder.file("a.svg")}).status, 0);
}

TEST(MapCommands, FiguresArePosters) {
    const ScratchFolder folder;
    for (const char* figure : {"figure-5.2", "figure-5.3"}) {
        const std::string file = std::string(SIKKU_SOURCE_DIR "/patterns/posters/") + figure + ".toml";
        const Outcome made = run({"gallery", "--file", file, "-o", folder.file(figure)});
        EXPECT_EQ(made.status, 0) << made.errors;
        EXPECT_TRUE(std::filesystem::exists(folder.path() / figure / "poster.pdf"));
        const Outcome forecast = run({"gallery", "--file", file, "--dry-run"});
        EXPECT_EQ(forecast.status, 0) << forecast.errors;
    }
}

TEST(MapCommands, CheckReportsEveryError) {
    const Outcome outcome = run({"check", SIKKU_SOURCE_DIR "/tests/corpus/bad/map.lsys"});
    EXPECT_EQ(outcome.status, 2);
    for (const char* place : {":2:1:", ":3:8:", ":4:9:", ":5:9:", ":6:9:", ":7:7:", ":8:5:", ":9:12:", ":10:8:",
                              ":11:11:", ":12:8:", ":13:8:"}) {
        EXPECT_TRUE(has(outcome.output, place)) << place << "\n" << outcome.output;
    }
    EXPECT_EQ(run({"check", SIKKU_SOURCE_DIR "/tests/corpus/good/map.lsys"}).status, 0);
}

}  // namespace sikku::map_program_test
