// tests/program/arrangement_program_test.cpp: `sikku play` with arrangements, and what scores contain of them.
#include "tests/files.h"
#include "tests/midi_reader.h"
#include "tests/program.h"
#include "tests/tools.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <set>
#include <string>
#include <vector>

namespace sikku::arrangement_program_test {

using Arguments = std::vector<std::string>;

const std::string piece =
    "title = \"A \\\"piece\\\" #(ly:exit) \\\\ } % --> ]]>\"\ntempo = 100\nscale = \"dorian\"\n\n"
    "[[track]]\npattern = \"hilbert\"\nn = 3\n\n"
    "[[track]]\npattern = \"mine.lsys\"\nstart = 1\ninversion = true\nloop = \"fill\"\ncounterpoint = \"strict\"\n";
const std::string mine = "title: Mine\naxiom: X\nderivation length: 2\nX --> -YF+XFX+FY-\nY --> +XF-YFY-FX+\n";

TEST(ArrangementProgram, EveryScoreContainsTheArrangement) {
    const ScratchFolder folder;
    folder.write("mine.lsys", mine);
    const std::string file = folder.write("piece.toml", piece);
    std::string first;
    for (const char* ending : {"mid", "mxl", "ly"}) {
        const std::string score = folder.file(std::string("x.") + ending);
        const Outcome played = run(Arguments{"play", file, "-o", score});
        ASSERT_EQ(played.status, 0) << ending << played.errors;
        EXPECT_TRUE(has(played.errors, "counterpoint: "));
        const Outcome shown = run(Arguments{"-q", "show", score});
        EXPECT_TRUE(shown.output.starts_with(piece)) << ending;
        if (first.empty()) first = shown.output;
        EXPECT_EQ(shown.output, first) << ending;
    }
    // It plays again without the pattern file.
    const ScratchFolder other;
    const std::string again = other.write("again.toml", first);
    ASSERT_EQ(run(Arguments{"play", again, "-o", other.file("x.mid")}).status, 0);
    EXPECT_EQ(contents(other.file("x.mid")), contents(folder.file("x.mid")));
    EXPECT_EQ(run(Arguments{"check", again, other.file("x.mid")}).output, "");
}

TEST(ArrangementProgram, PartsOfTheCommandLineAreRecovered) {
    const ScratchFolder folder;
    const Outcome played =
        run(Arguments{"play", "hilbert-in-c", "hilbert-in-c@n=3,loop=2,tempo-ratio=3:2,retrograde=yes",
                      "dragon@unit=1/16,angle factor=8", "--tempo", "90", "-o", folder.file("x.mid")});
    ASSERT_EQ(played.status, 0) << played.errors;
    const Outcome shown = run(Arguments{"show", folder.file("x.mid")});
    for (const char* text : {"loop = \"2\"", "speed = \"3:2\"", "retrograde = \"yes\"", "n = \"3\"",
                             "unit = \"1/16\"", "name = \"dragon", "Hilbert in C major"}) {
        EXPECT_TRUE(has(shown.output, text)) << text << "\n" << shown.output;
    }
    EXPECT_TRUE(has(shown.errors, "--tempo 90"));
    const std::string again = folder.write("again.toml", shown.output);
    const Outcome replayed = run(Arguments{"play", again, "--tempo", "90", "-o", folder.file("y.mid")});
    ASSERT_EQ(replayed.status, 0) << replayed.errors;
    EXPECT_EQ(contents(folder.file("y.mid")), contents(folder.file("x.mid")));
}

TEST(ArrangementProgram, MistakesWriteNothing) {
    const ScratchFolder folder;
    const auto refused = [&](const std::string& text, const std::string& message) {
        const std::string file = folder.write("bad.toml", text);
        const Outcome outcome = run(Arguments{"play", file, "-o", folder.file("x.mid")});
        EXPECT_EQ(outcome.status, 2) << outcome.errors;
        EXPECT_TRUE(has(outcome.errors, message));
        EXPECT_FALSE(std::filesystem::exists(folder.file("x.mid")));
        EXPECT_EQ(run(Arguments{"check", file}).status, 2);
    };
    refused("[[track]]\npattern = \"hilbet\"\n", "bad.toml:2:1: no file or pattern named 'hilbet'");
    refused("[[track]]\npattern = \"bad.toml\"\n", "not another arrangement");
    refused("[[track]]\npattern = hilbert\n", "text values need quotes");
    refused(
        "form = \"A\"\n[[section]]\nname = \"A\"\nmeter = \"3/4\"\n[[track]]\npattern = \"hilbert\"\n"
        "section = \"A\"\nupbeat = \"1/4\"\n",
        "'upbeat:' cannot be combined with sections that state tempo or meter");
    const Outcome two = run(Arguments{"play", "invention", "hilbert"});
    EXPECT_EQ(two.status, 2);
    EXPECT_TRUE(has(two.errors, "played alone"));
    EXPECT_EQ(run(Arguments{"play", "hilbert", "invention"}).status, 2);
    EXPECT_EQ(run(Arguments{"play", "invention", "-n", "3"}).status, 2);
    EXPECT_EQ(run(Arguments{"play", "missing.toml"}).status, 2);
    for (const char* command : {"measure", "derive"}) {
        const Outcome other = run(Arguments{command, "canon"});
        EXPECT_EQ(other.status, 2);
        EXPECT_TRUE(has(other.errors, "canon: this is an arrangement; `sikku play` plays it"));
    }
    refused("[[track]]\npattern = \"canon\"\n", "canon: a track plays a pattern, not another arrangement");
    EXPECT_TRUE(has(run(Arguments{"patterns", "arrangement"}).errors, "did you mean 'arrangements'?"));
    // `transpose` is another name of `transposition`.
    const std::string one = folder.file("one.mid");
    const std::string two_names = folder.file("two.mid");
    EXPECT_EQ(run(Arguments{"play", "hilbert-in-c@transpose=-12,start=4", "-o", one}).status, 0);
    EXPECT_EQ(run(Arguments{"play", "hilbert-in-c@transposition=-12,start=4", "-o", two_names}).status, 0);
    EXPECT_EQ(contents(one), contents(two_names));
    // Commas that no key follows belong to the value.
    const std::string canon = folder.file("canon.mid");
    EXPECT_EQ(run(Arguments{"play", "hilbert-in-c@n=3,canon=2 -12, 4 -24,inversion=true", "-o", canon}).errors,
              "75 notes, 8 bars, 15.0 s, D1 to D4\n");
}

TEST(ArrangementProgram, SeedsSelectHumanPlayers) {
    const ScratchFolder folder;
    std::set<std::string> files;
    for (const char* seed : {"0", "1", "2", "2"}) {
        const std::string file = folder.file("x.mid");
        EXPECT_EQ(run(Arguments{"play", "canon", "--humanise", "0.5", "--seed", seed, "-o", file}).status, 0);
        files.insert(contents(file));
    }
    EXPECT_EQ(files.size(), 3u);
    EXPECT_EQ(run(Arguments{"play", "canon", "--seed", "1", "-o", folder.file("x.mid")}).status, 2);
}

TEST(ArrangementProgram, ExtremeValuesAreRefusedWithTheirPlaces) {
    const ScratchFolder folder;
    const auto refused = [&](const std::string& text, const std::string& message) {
        const std::string file = folder.write("bad.toml", text);
        for (const Arguments& arguments :
             {Arguments{"play", file, "-o", folder.file("x.mid")}, Arguments{"play", file, "--port", "/dev/null"}}) {
            const Outcome outcome = run(arguments);
            EXPECT_EQ(outcome.status, 2) << outcome.errors;
            EXPECT_TRUE(has(outcome.errors, message));
            EXPECT_LT(outcome.peak, sanitized ? 2'000'000 : 200 * 1024) << text.substr(0, 100);
        }
        EXPECT_FALSE(std::filesystem::exists(folder.file("x.mid")));
    };
    const std::string track = "[[track]]\npattern = \"hilbert\"\n";
    // Arrangements that name each other.
    folder.write("other.toml", "[[track]]\npattern = \"bad.toml\"\n");
    refused("[[track]]\npattern = \"other.toml\"\n",
            "bad.toml:2:1: other.toml: a track plays a pattern, not another");
    std::string tracks;
    for (int i = 0; i < 1'000'000; ++i) tracks += track;
    refused(tracks, "bad.toml: the file is too large: a file has at most 16 MB");
    refused(tracks.substr(0, track.size() * 20'000), "too many tracks");
    refused(track + "rhythm = \"E(1,1000000000)\"\n", "bad.toml:3:1: rhythm: ");
}

TEST(ArrangementProgram, TheBundledOnesAreCleanAndPlayOneToTwoMinutes) {
    const ScratchFolder folder;
    const Outcome names = run(Arguments{"patterns", "arrangements", "--names"});
    EXPECT_EQ(names.output, "blues\ncanon\nfugue\ngamelan\ninvention\nmohanam\nraga\nrooms\nseven\n");
    for (const char* name :
         {"blues", "canon", "fugue", "gamelan", "invention", "mohanam", "raga", "rooms", "seven"}) {
        const std::string score = folder.file(std::string(name) + ".mid");
        const Outcome played = run(Arguments{"play", name, "-o", score});
        EXPECT_EQ(played.status, 0) << played.errors;
        EXPECT_TRUE(has(played.errors, "s, 1 min "));
        EXPECT_EQ(run(Arguments{"check", score, name}).output, "");
        EXPECT_EQ(run(Arguments{"play", name, "-o", folder.file("x.ly")}).status, 0);
    }
}

}  // namespace sikku::arrangement_program_test
