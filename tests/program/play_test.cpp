// tests/program/play_test.cpp: the outputs and errors of `sikku play`.
#include "tests/files.h"
#include "tests/midi_reader.h"
#include "tests/program.h"
#include "tests/tools.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

namespace sikku::play_test {

/// Plays `pattern` into a file that must not be there after a failure.
Outcome played(const std::string& pattern, std::vector<std::string> arguments, const std::string& name = "x.mid",
               bool* is_written = nullptr) {
    const ScratchFolder folder;
    arguments.insert(arguments.begin(), {"play", "-", "-o", folder.file(name)});
    const Outcome outcome = run(arguments, {.input = pattern, .folder = folder.path()});
    const bool exists = std::filesystem::exists(folder.file(name));
    if (is_written) *is_written = exists;
    EXPECT_EQ(exists, outcome.status == 0) << outcome.errors;
    EXPECT_EQ(folder.names().size(), outcome.status == 0 ? 1U : 0U) << "nothing is left behind";
    return outcome;
}

const std::string hilbert = "axiom: X\nderivation length: 3\nX --> -YF+XFX+FY-\nY --> +XF-YFY-FX+\n";

TEST(Play, WritesEveryKindOfScore) {
    for (const char* name : {"x.mid", "x.MIDI", "x.musicxml", "x.mxl", "x.ly", "x.abc", "x.csd", "x.sco", "x.strudel",
                             "x.svg", "x.html"}) {
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

TEST(Play, ScoresInLinesContainTheirPattern) {
    const ScratchFolder folder;
    const std::string pattern = folder.write("x.lsys", hilbert);
    for (const char* name : {"x.abc", "x.csd", "x.sco", "x.strudel", "x.ly"}) {
        ASSERT_EQ(run({"-q", "play", pattern, "-o", folder.file(name)}).status, 0);
        EXPECT_EQ(run({"show", folder.file(name)}).output, hilbert) << name;
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
        {"hilbert-in-c@transposition=x", "expected semitones"},
        {"hilbert-in-c@rhythm=E(0,8)", "expected 1 to 256 notes"},
        {"hilbert-in-c@start=1000000", "expected bars"},
        {"hilbert-in-c@start=1,n=3,start=2", "start is given twice"},
        {"hilbert-in-c@transpose=1,transposition=2", "transposition is given twice"},
        {"hilbert-in-c@inversion=maybe", "expected no or yes"}};
    for (const auto& [name, message] : bad) {
        const Outcome outcome = run({"play", name, "-o", folder.file("x.mid")});
        EXPECT_EQ(outcome.status, 2) << name;
        EXPECT_TRUE(has(outcome.errors, message));
    }
}

TEST(Play, FormRhythmAndHarmonyRefuseWhatTheyCannotRead) {
    const std::vector<std::pair<std::vector<std::string>, std::string>> bad = {
        {{"--rhythm", "0+2"}, "groups of a tala"},
        {{"--rhythm", "..x"}, "begins with x"},
        {{"--swing", "90"}, "from 50 to 80"},
        {{"--phrases", "0"}, "1 or more"},
        {{"--phrases", "2", "--breath", "x"}, "expected a note value"},
        {{"--cadence", "tonc"}, "did you mean 'tonic'"},
        {{"--articulation", "0%"}, "from 5 to 100"},
        {{"--harmony", "progression I-X"}, "expected chords from I to VII"},
        {{"--harmony", "bass 0"}, "from 1 to 30"},
        {{"--brackets", "sequential"}, "expected voices, sequence or shares"},
        {{"--ending", "bang"}, "expected none, ritardando or fermata"}};
    for (const auto& [options, message] : bad) {
        const Outcome outcome = played(hilbert, options);
        EXPECT_EQ(outcome.status, 2) << options[1];
        EXPECT_TRUE(has(outcome.errors, message));
    }
    EXPECT_EQ(played(hilbert, {"--harmony", "bass 3"}).status, 2);
}

TEST(Play, WhatItWritesIsCleanAndTheSameEveryTime) {
    const ScratchFolder folder;
    std::vector<std::string> names;
    for (const auto& entry :
         std::filesystem::directory_iterator(std::filesystem::path(SIKKU_SOURCE_DIR) / "patterns/melodies")) {
        names.push_back(entry.path().stem().string());
    }
    ASSERT_EQ(names.size(), 13u);
    for (const std::string& name : names) {
        for (const char* ending :
             {".mid", ".musicxml", ".mxl", ".ly", ".abc", ".csd", ".sco", ".strudel", ".svg", ".html"}) {
            const std::string one = folder.file(name + ending);
            const std::string two = folder.file(name + "-2" + ending);
            ASSERT_EQ(run({"-q", "play", name, "-o", one}).status, 0) << name << ending;
            ASSERT_EQ(run({"-q", "play", name, "-o", two}, {.environment = {{"LC_ALL", "de_DE.UTF-8"}}}).status, 0);
            EXPECT_EQ(contents(one), contents(two)) << name << ending;
            if (ending == std::string(".mid")) {
                const Outcome checked = run({"check", one});
                EXPECT_EQ(checked.status, 0) << checked.output;
            }
        }
    }
    // Several patterns are tracks of one score.
    ASSERT_EQ(
        run({"play", names[0], names[1], "--transpose", "-12", "--humanise", "0.5", "-o", folder.file("all.mid")})
            .status,
        0);
    EXPECT_EQ(run({"check", folder.file("all.mid")}).status, 0);
}

TEST(Play, TellsWithoutPlaying) {
    const Outcome outcome = run({"play", "-", "-n", "40"}, {.input = hilbert});
    EXPECT_EQ(outcome.status, 0);
    EXPECT_TRUE(has(outcome.output, "notes     483570327845851669882470"));
}

TEST(Play, TellsOfPieces) {
    const Outcome outcome =
        run({"play", "-", "-n", "40", "--from-bar", "1000000000", "--bars", "2", "--anchor", "piece"},
            {.input = hilbert});
    EXPECT_EQ(outcome.status, 0);
    EXPECT_TRUE(has(outcome.output, "bars      2"));
    EXPECT_TRUE(has(outcome.output, "range "));
}

TEST(Play, WhatIsLostOnTheWayIsTold) {
    const auto told = [](std::vector<std::string> arguments, const std::string& name, std::string_view message) {
        const Outcome outcome = played(hilbert, std::move(arguments), name);
        EXPECT_EQ(outcome.status, 0) << outcome.errors;
        EXPECT_TRUE(has(outcome.errors, message));
    };
    told({"--unit", "1/128"}, "x.musicxml", "at a 64th");
    told({"--scale", "22-shruti"}, "x.ly", "nearest quarter tone, with the difference in cents");
    told({"-n", "8"}, "x.mid", "beyond C-1 to G9");
    told({"--mapping", "counterpoint", "--vertical", "rest"}, "x.mid", "'vertical:' has no meaning");
}

TEST(Play, AHumanPlaysThePieceAsTheWhole) {
    const ScratchFolder folder;
    const auto notes = [&](std::vector<std::string> piece) {
        const std::string file = folder.file("x.mid");
        std::vector<std::string> arguments = {"-q", "play", "hilbert-in-c", "--humanise", "1", "-o", file};
        arguments.insert(arguments.end(), piece.begin(), piece.end());
        EXPECT_EQ(run(arguments).status, 0);
        const std::string bytes = contents(file);
        return read_midi(bytes).notes;
    };
    const auto whole = notes({});
    const auto piece = notes({"--from-bar", "3", "--bars", "2"});
    std::size_t equal = 0;
    for (const MidiNote& note : piece) {
        equal += static_cast<std::size_t>(std::count_if(whole.begin(), whole.end(), [&](const MidiNote& other) {
            return other.onset == note.onset + 2 * 1920 && other.key == note.key && other.velocity == note.velocity;
        }));
    }
    EXPECT_GE(equal + 1, piece.size());
}

TEST(Play, ATransposedScoreIsWrittenInItsKey) {
    const ScratchFolder folder;
    const auto key = [&](const std::string& semitones) {
        EXPECT_EQ(run({"-q", "play", "hilbert", "--transpose", semitones, "-o", folder.file("x.musicxml")}).status,
                  0);
        const std::string text = contents(folder.file("x.musicxml"));
        const std::size_t at = text.find("<fifths>");
        return text.substr(at + 8, text.find('<', at + 8) - at - 8);
    };
    EXPECT_EQ(key("0"), "0");
    EXPECT_EQ(key("2"), "2");
    EXPECT_EQ(key("-2"), "-2");
}

TEST(Play, AScoreHoldsItsPattern) {
    const ScratchFolder folder;
    ASSERT_EQ(run({"-q", "play", "hilbert-in-c", "-o", folder.file("x.mid")}).status, 0);
    EXPECT_EQ(run({"-q", "show", folder.file("x.mid")}).output, run({"-q", "show", "hilbert-in-c"}).output);
    std::filesystem::rename(folder.file("x.mid"), folder.file("x"));
    EXPECT_EQ(run({"check", folder.file("x")}).status, 0) << "a MIDI file is known by its first bytes";
    EXPECT_EQ(run({"-q", "show", folder.file("x")}).status, 0);
}

TEST(Play, APieceOfAnyOrder) {
    const Outcome outcome = played(hilbert, {"-n", "40", "--from-bar", "1000000000", "--bars", "16"});
    EXPECT_EQ(outcome.status, 0) << outcome.errors;
    EXPECT_TRUE(has(outcome.errors, " 16 bars, 32.0 s"));
    EXPECT_EQ(played(hilbert, {"-n", "40", "--seconds", "10"}).status, 0);
}

TEST(Play, Mistakes) {
    const auto refused = [](const std::string& pattern, std::vector<std::string> arguments, int status,
                            std::string_view message, const std::string& name = "x.mid") {
        const Outcome outcome = played(pattern, std::move(arguments), name);
        EXPECT_EQ(outcome.status, status) << outcome.errors;
        EXPECT_TRUE(has(outcome.errors, message));
    };
    refused(hilbert, {"--scale", "majr"}, 2, "unknown scale 'majr'; did you mean 'major'");
    refused(hilbert, {"--tempo", "0"}, 2, "quarter notes a minute");
    refused(hilbert, {"--tempo", "nan"}, 2, "quarter notes a minute");
    refused(hilbert, {"--meter", "4/0"}, 2, "expected a meter");
    refused(hilbert, {"--meter", "0/4"}, 2, "expected a meter");
    refused(hilbert, {"--meter", "4"}, 2, "expected a meter");
    refused(hilbert, {"--unit", "0"}, 2, "expected a note value");
    refused(hilbert, {"--unit", "1/7"}, 2, "1/7 is not a whole number of ticks");
    refused(hilbert, {"--velocity", "mf"}, 2, "or by x, y, depth, turn, length or level");
    refused(hilbert, {"--articulation", "staccato"}, 2, "5 to 100 percent");
    refused(hilbert, {"--range", "C2-C7"}, 2, "`fold C2-C7`");
    refused(hilbert, {"--harmony", "chords"}, 2, "`bass 2`");
    refused(hilbert, {"--harmony", "progression Imaj7-IV"}, 2, "unknown chord 'Imaj7'");
    refused(hilbert, {"--rhythm", "E(5,3)"}, 2, "more notes (5) than slots (3)");
    refused(hilbert, {"--rhythm", ""}, 2, "--rhythm: a template begins");
    refused(hilbert, {"--canon", "1/0 7"}, 2, "expected bars and an interval");
    refused(hilbert, {"--seconds", "0"}, 2, "expected a number above 0");
    refused(hilbert, {"--tonic", "H9"}, 2, "expected a note such as C4");
    refused(hilbert, {"--tonic", "C12"}, 2, "expected a note such as C4");
    refused(hilbert, {"--tonic", "60"}, 2, "expected C4 for key 60 of MIDI, or 60 Hz");
    refused(hilbert, {"--tonic", "99999 Hz"}, 2, "beyond what MIDI can write");
    refused(hilbert, {"--instrument", "kazooo"}, 2, "instrument");
    refused(hilbert, {"--instrument", "129"}, 2, "1 to 128");
    refused(hilbert, {"--anchor", "lowest"}, 2, "expected first note, piece");
    refused(hilbert, {"--range", "refuse", "-n", "8"}, 2, "beyond the keys 0 to 127");
    refused(hilbert, {"--scale", "no.scl"}, 2, "No such file or directory");
    refused(hilbert, {"-n", "40"}, 1, "4 GiB");
    refused(hilbert, {"-n", "40"}, 1, "above the budget", "x.musicxml");
    refused(hilbert, {"-n", "11"}, 2, "limit the bars", "x.musicxml");
    refused(hilbert, {"--from-bar", "9223372036854775807"}, 2, "the melody ends at bar 4");
    refused(hilbert, {"--from-bar", "1000"}, 2, "the melody ends at bar 4");
    refused(hilbert, {"--range", "fold C5-C4"}, 2, "the lowest and the highest note");
    refused(hilbert, {"--scale", ""}, 2, "unknown scale ''");
    refused(hilbert, {"--keyboard", "/dev/zero"}, 2, "over 1 MB");
    refused(hilbert, {"-n", "10"}, 2, "6 hours 45 minutes", "x.wav");
    refused(hilbert, {}, 2, "unknown extension", "x.ogg");
    refused("axiom: FFF\n", {}, 2, "no horizontal run");
    refused("axiom: +++\n", {}, 2, "the word has no steps such as F");
    refused(hilbert, {"--excerpt", "9-9"}, 2, "the melody ends at bar 4");
    refused(hilbert, {"--seconds", "1e-9"}, 2, "shorter than a tick");
    refused(hilbert, {"--from-bar", "99999999999999999999"}, 2, "too large");
    refused(hilbert, {"--instrument", ""}, 2, "expected a General MIDI name");
    refused("axiom: F]\n", {"--set", "heading=0"}, 2, "']' without '['");
    std::string branches = "heading: 0\naxiom: ";
    for (int i = 0; i < 20; ++i) branches += "[FFFF]";
    refused("scale: shruti\n" + branches + "\n", {}, 2, "too many voices");
    EXPECT_EQ(played(branches + "\n", {}, "x.mid").status, 0);  // on one channel
    refused("axiom: F\nscale: nothing-such\n", {}, 2, "-:2:8: unknown scale");
}

TEST(Play, GuessedInstrumentsAreReported) {
    const Outcome strings = played(hilbert, {"--instrument", "strings"});
    EXPECT_TRUE(has(strings.errors, "'strings' is taken to be Tremolo Strings (45), the first of "));
    const Outcome harp = played(hilbert, {"--instrument", "harp"});
    EXPECT_TRUE(has(harp.errors, "taken to be Orchestral Harp (47)")) << "whole words come first";
    const Outcome drums = played(hilbert, {"--instrument", "drums"});
    EXPECT_TRUE(has(drums.errors, "taken to be Steel Drums (115)"));
    for (const char* name : {"flute", "piano", "Violin"}) {
        EXPECT_FALSE(has(played(hilbert, {"--instrument", name}).errors, "taken")) << name;
    }
}

TEST(Play, FarBarsAndKolams) {
    const Outcome far = played(hilbert, {"-n", "60", "--from-bar", "1000000000000000000", "--bars", "2"});
    EXPECT_EQ(far.status, 0) << far.errors;
    const std::vector<std::string> arguments = {"play", "snake-kolam"};
    const Outcome kolam = run(arguments);
    EXPECT_EQ(kolam.status, 0) << kolam.errors;
    EXPECT_FALSE(has(kolam.output, "no notes"));
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
