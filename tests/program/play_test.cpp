// tests/program/play_test.cpp: the outputs and errors of `sikku play`.
#include "music/scores.h"
#include "tests/files.h"
#include "tests/program.h"
#include "tests/tools.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

namespace sikku::play_test {

/// Plays `pattern` into a file that must not be there after a failure.
Outcome played(const std::string& pattern, std::vector<std::string> arguments, const std::string& name = "x.mid") {
    const ScratchFolder folder;
    arguments.insert(arguments.begin(), {"play", "-", "-o", folder.file(name)});
    const Outcome outcome = run(arguments, {.input = pattern, .folder = folder.path()});
    const bool exists = std::filesystem::exists(folder.file(name));
    EXPECT_EQ(exists, outcome.status == 0) << outcome.errors;
    EXPECT_EQ(folder.names().size(), outcome.status == 0 ? 1U : 0U) << "nothing is left behind";
    return outcome;
}

const std::string hilbert = "axiom: X\nderivation length: 3\nX --> -YF+XFX+FY-\nY --> +XF-YFY-FX+\n";

TEST(Play, WritesEveryKindOfScore) {
    for (const char* name : {"x.mid", "x.MIDI", "x.html"}) {
        const Outcome outcome = played(hilbert, {}, name);
        EXPECT_EQ(outcome.status, 0) << name << outcome.errors;
        EXPECT_TRUE(has(outcome.errors, "26 notes, 4 bars, 8.0 s"));
    }
}

TEST(Play, PrintsWithLilyPond) {
    NEEDS("lilypond");
    const ScratchFolder folder;
    const std::string pattern = folder.write("x.lsys", hilbert);
    const std::string one = folder.file("one.pdf");
    const std::string two = folder.file("two.pdf");
    ASSERT_EQ(run({"-q", "play", pattern, "-o", one}).status, 0);
    ASSERT_EQ(run({"-q", "play", pattern, "-o", two}).status, 0);
    EXPECT_TRUE(contents(one).starts_with("%PDF-"));
    EXPECT_EQ(contents(one), contents(two));
    EXPECT_EQ(run({"show", one}).output, hilbert);
}

TEST(Play, SaysThatLilyPondIsMissing) {
    const ScratchFolder folder;
    const std::string pattern = folder.write("x.lsys", hilbert);
    const Outcome outcome =
        run({"play", pattern, "-o", folder.file("x.pdf")}, {.environment = {{"PATH", "/nowhere"}}});
    EXPECT_EQ(outcome.status, 1);
    EXPECT_FALSE(std::filesystem::exists(folder.file("x.pdf")));
    EXPECT_TRUE(has(outcome.errors, "needs the program lilypond"));
}

TEST(Play, SaysWhyLilyPondFails) {
    const ScratchFolder folder;
    const std::string pattern = folder.write("x.lsys", hilbert);
    const std::string program = folder.write("lilypond", "");
    std::filesystem::permissions(program, std::filesystem::perms::owner_all);
    for (const auto& [script, reason] : std::vector<std::pair<std::string, std::string>>{
             {"echo boom >&2; exit 3", "lilypond failed: it ended with status 3; its last messages:\n  boom"},
             {"exit 0", "lilypond failed: it wrote no PDF"},
             {"kill -9 $$", "lilypond failed: signal 9 ended it"}}) {
        folder.write("lilypond", "#!/bin/sh\n" + script + "\n");
        const Outcome outcome = run({"play", pattern, "-o", folder.file("x.pdf")},
                                    {.environment = {{"PATH", folder.path().string() + ":/usr/bin:/bin"}}});
        EXPECT_EQ(outcome.status, 1);
        EXPECT_FALSE(std::filesystem::exists(folder.file("x.pdf")));
        EXPECT_TRUE(has(outcome.errors, reason));
    }
}

TEST(Play, PartsHaveKeysOfTheirOwn) {
    const ScratchFolder folder;
    const std::string file = folder.file("canon.mid");
    const Outcome canon =
        run({"play", "hilbert-in-c", "hilbert-in-c@start=2,transposition=-12,rhythm=curve", "-o", file});
    EXPECT_EQ(canon.status, 0) << canon.errors;
    EXPECT_TRUE(has(canon.errors, "206 notes, 18 bars"));
    EXPECT_EQ(run({"check", file}).output, "");
    const std::vector<std::pair<std::string, std::string>> bad = {
        {"hilbert-in-c@start", "expected KEY=VALUE"},
        {"hilbert-in-c@=2", "expected KEY=VALUE"},
        {"hilbert-in-c@strat=2", "unknown key 'strat'"},
        {"hilbert-in-c@start=-1", "expected bars of rest"},
        {"hilbert-in-c@start=1,n=3,start=2", "start is given twice"},
        {"hilbert-in-c@transpose=1,transposition=2", "transposition is given twice"}};
    for (const auto& [name, message] : bad) {
        const Outcome outcome = run({"play", name, "-o", folder.file("x.mid")});
        EXPECT_EQ(outcome.status, 2) << name;
        EXPECT_TRUE(has(outcome.errors, message));
    }
}

/// In every locale the bytes equal those of the library.
TEST(Play, WhatItWritesIsCleanAndTheSameEverywhere) {
    const ScratchFolder folder;
    const Document document = load("hilbert-in-c");
    for (const std::string format : {"mid", "musicxml", "mxl", "ly", "abc", "csd", "sco", "strudel", "svg", "html"}) {
        const std::string file = folder.file("one." + format);
        const Outcome outcome =
            run({"-q", "play", "hilbert-in-c", "-o", file}, {.environment = {{"LC_ALL", "de_DE.UTF-8"}}});
        ASSERT_EQ(outcome.status, 0) << format << outcome.errors;
        EXPECT_EQ(contents(file), play(document, format)) << format;
    }
    // Several patterns are tracks of one score.
    const std::string all = folder.file("all.mid");
    ASSERT_EQ(run({"play", "hilbert-in-c", "hilbert", "--transpose", "-12", "--humanise", "0.5", "-o", all}).status,
              0);
    EXPECT_EQ(run({"check", folder.file("one.mid"), all}).status, 0);
}

TEST(Play, TellsWithoutPlaying) {
    const Outcome outcome = run({"play", "-", "-n", "40"}, {.input = hilbert});
    EXPECT_EQ(outcome.status, 0);
    EXPECT_TRUE(has(outcome.output, "notes     483570327845851669882470"));
}

TEST(Play, AScoreHoldsItsPattern) {
    const ScratchFolder folder;
    ASSERT_EQ(run({"-q", "play", "hilbert-in-c", "-o", folder.file("x.mid")}).status, 0);
    EXPECT_EQ(run({"-q", "show", folder.file("x.mid")}).output, run({"-q", "show", "hilbert-in-c"}).output);
    std::filesystem::rename(folder.file("x.mid"), folder.file("x"));
    EXPECT_EQ(run({"check", folder.file("x")}).status, 0) << "a MIDI file is known by its first bytes";
    EXPECT_EQ(run({"-q", "show", folder.file("x")}).status, 0);
}

TEST(Play, Mistakes) {
    const auto refused = [](const std::string& pattern, std::vector<std::string> arguments, int status,
                            std::string_view message, const std::string& name = "x.mid") {
        const Outcome outcome = played(pattern, std::move(arguments), name);
        EXPECT_EQ(outcome.status, status) << outcome.errors;
        EXPECT_TRUE(has(outcome.errors, message));
    };
    refused(hilbert, {"--scale", "majr"}, 2, "--scale majr: unknown scale 'majr'; did you mean 'major'");
    refused(hilbert, {"--rhythm", ""}, 2, "--rhythm: a template begins");
    refused(hilbert, {"-n", "40"}, 1, "4 GiB");
    refused(hilbert, {"-n", "11"}, 2, "limit the bars", "x.musicxml");
    refused(hilbert, {}, 2, "unknown extension", "x.ogg");
    refused("axiom: FFF\n", {}, 2, "no horizontal run");
    refused("axiom: F]\n", {"--set", "heading=0"}, 2, "']' without '['");
    refused("axiom: F\nscale: nothing-such\n", {}, 2, "-:2:8: unknown scale");
}

TEST(Play, ScalesOfFiles) {
    const ScratchFolder folder;
    folder.write("third.scl", "! third.scl\nA third tone scale\n 6\n200.\n400.\n600.\n800.\n1000.\n2/1\n");
    folder.write("broken.scl", "x\n 2\n100.\nabc\n");
    folder.write("p.lsys", "heading: 0\nscale: third.scl\n" + hilbert);
    const Outcome good = run({"play", folder.file("p.lsys"), "-o", folder.file("x.mid")});
    EXPECT_EQ(good.status, 0) << good.errors;
    const Outcome bad = run({"play", folder.file("p.lsys"), "--scale", "broken.scl", "-o", folder.file("y.mid")});
    EXPECT_EQ(bad.status, 2);
    EXPECT_TRUE(has(bad.errors, "broken.scl:4:1"));
    EXPECT_EQ(run({"check", folder.file("third.scl")}).status, 0);
    const Outcome checked = run({"check", folder.file("broken.scl")});
    EXPECT_EQ(checked.status, 2);
    EXPECT_TRUE(has(checked.output, "broken.scl:4:1"));
    EXPECT_FALSE(std::filesystem::exists(folder.file("y.mid")));
}

}  // namespace sikku::play_test
