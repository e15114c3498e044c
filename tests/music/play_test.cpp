// tests/music/play_test.cpp: scores in every format with their options: remarks, provenance, errors.
#include "music/scores.h"

#include "art/provenance/provenance.h"
#include "music/arrangement.h"
#include "music/score/midi_check.h"
#include "tests/files.h"
#include "tests/fuzz/file_targets.h"
#include "tests/midi_tools.h"
#include "tests/works.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

namespace sikku::play_test {

const std::string hilbert = "axiom: X\nderivation length: 3\nX --> -YF+XFX+FY-\nY --> +XF-YFY-FX+\n";
const std::vector<std::string> scores_in_lines = {"abc", "csd", "sco", "strudel", "ly"};
const std::vector<std::string> other_scores = {"mid", "musicxml", "mxl", "svg", "html"};

MadeWork played(const std::string& pattern, const OptionValues& values, const std::string& format = "mid") {
    return made_work([&](MemoryDestination& memory) {
        const Assignment assigned = assign(scores(), parse("-", pattern), values);
        return scores().plan(assigned.document, format, assigned.options)->make(memory, "x." + format, {});
    });
}

std::string described(const std::string& pattern, const OptionValues& values) {
    const Assignment assigned = assign(scores(), parse("-", pattern), values);
    return describe_score({&assigned.document, 1}, assigned.options, {});
}

TEST(Play, EveryKindOfScoreIsReported) {
    for (const auto& formats : {scores_in_lines, other_scores}) {
        for (const std::string& format : formats) {
            EXPECT_TRUE(has(played(hilbert, {}, format).remarks, "26 notes, 4 bars, 8.0 s")) << format;
        }
    }
}

TEST(Play, ScoresInLinesContainTheirPattern) {
    for (const std::string& format : scores_in_lines) {
        const MemoryFile file(played(hilbert, {}, format).bytes());
        EXPECT_EQ(read_provenance(file.path()).value().pattern, hilbert) << format;
    }
}

TEST(Play, BundledMelodiesAreCleanAndTheSameEveryTime) {
    std::size_t melodies = 0;
    for (const auto& file : pattern_files("patterns/melodies")) {
        const Document document = load(file.string());
        for (const auto& formats : {scores_in_lines, other_scores}) {
            for (const std::string& format : formats) {
                const std::string bytes = made_work(scores(), document, format).bytes();
                EXPECT_EQ(made_work(scores(), document, format).bytes(), bytes) << file << format;
                if (format == "mid") {
                    EXPECT_EQ(midi_faults(bytes), "") << file;
                }
            }
        }
        ++melodies;
    }
    EXPECT_EQ(melodies, 15u);
}

TEST(Play, ValuesOfPartsAreRefused) {
    for (const auto& [key, value, message] : std::vector<std::tuple<const char*, const char*, const char*>>{
             {"start", "-1", "expected bars of rest"},
             {"start", "1000000", "expected bars"},
             {"transposition", "x", "expected semitones"},
             {"rhythm", "E(0,8)", "expected 1 to 256 notes"},
             {"inversion", "maybe", "expected no or yes"}}) {
        EXPECT_TRUE(has(error_of<PatternError>([&, k = key, v = value] {
                            const Document part = parse("-", hilbert).with({part_setting(k, v)});
                            play(part, "mid");
                        }),
                        message));
    }
}

TEST(Play, PiecesAreDescribedWithoutPlaying) {
    EXPECT_TRUE(has(described(hilbert, {{"n", "40"}}), "notes     483570327845851669882470"));
    const std::string piece =
        described(hilbert, {{"n", "40"}, {"from-bar", "1000000000"}, {"bars", "2"}, {"anchor", "piece"}});
    EXPECT_TRUE(has(piece, "bars      2"));
    EXPECT_TRUE(has(piece, "range "));
    EXPECT_FALSE(has(described(contents(bundled("kolams/snake-kolam")), {}), "no notes"));
}

TEST(Play, PiecesOfAnyOrderArePlayed) {
    EXPECT_TRUE(
        has(played(hilbert, {{"n", "40"}, {"from-bar", "1000000000"}, {"bars", "16"}}).remarks, " 16 bars, 32.0 s"));
    EXPECT_EQ(played(hilbert, {{"n", "40"}, {"seconds", "10"}}).error, "");
    EXPECT_EQ(played(hilbert, {{"n", "60"}, {"from-bar", "1000000000000000000"}, {"bars", "2"}}).error, "");
}

TEST(Play, LossesAreReported) {
    EXPECT_TRUE(has(played(hilbert, {{"unit", "1/128"}}, "musicxml").remarks, "at a 64th"));
    EXPECT_TRUE(has(played(hilbert, {{"scale", "22-shruti"}}, "ly").remarks,
                    "nearest quarter tone, with the difference in cents"));
    EXPECT_TRUE(has(played(hilbert, {{"n", "8"}}).remarks, "beyond C-1 to G9"));
    EXPECT_TRUE(has(played(hilbert, {{"mapping", "counterpoint"}, {"vertical", "rest"}}).remarks,
                    "'vertical:' has no meaning"));
}

TEST(Play, AHumanPlaysThePieceAsTheWhole) {
    const Document document = load("hilbert-in-c");
    const std::string whole_bytes = play(document, "mid", {{"humanise", "1"}});
    const std::string piece_bytes = play(document, "mid", {{"humanise", "1"}, {"from-bar", "3"}, {"bars", "2"}});
    const auto whole = read_midi(whole_bytes).notes;
    const auto piece = read_midi(piece_bytes).notes;
    std::size_t equal = 0;
    for (const MidiNote& note : piece) {
        equal += static_cast<std::size_t>(std::count_if(whole.begin(), whole.end(), [&](const MidiNote& other) {
            return other.onset == note.onset + 2 * 1920 && other.key == note.key && other.velocity == note.velocity;
        }));
    }
    EXPECT_GE(equal + 1, piece.size());
}

TEST(Play, ATransposedScoreIsWrittenInItsKey) {
    for (const std::string semitones : {"0", "2", "-2"}) {
        EXPECT_TRUE(has(play(load("hilbert"), "musicxml", {{"transpose", semitones}}), "<fifths>" + semitones + "<"));
    }
}

TEST(Play, GuessedInstrumentsAreReported) {
    const auto told = [](const std::string& name) { return played(hilbert, {{"instrument", name}}).remarks; };
    EXPECT_TRUE(has(told("strings"), "'strings' is taken to be Tremolo Strings (45), the first of "));
    EXPECT_TRUE(has(told("harp"), "taken to be Orchestral Harp (47)")) << "whole words come first";
    EXPECT_TRUE(has(told("drums"), "taken to be Steel Drums (115)"));
    for (const char* name : {"flute", "piano", "Violin"}) EXPECT_FALSE(has(told(name), "taken")) << name;
}

TEST(Play, ValuesAreRefused) {
    const std::vector<std::pair<OptionValues, std::string>> mistakes = {
        {{{"scale", "majr"}}, "unknown scale 'majr'; did you mean 'major'"},
        {{{"scale", ""}}, "unknown scale ''"},
        {{{"scale", "no.scl"}}, "No such file or directory"},
        {{{"keyboard", "/dev/zero"}}, "over 1 MB"},
        {{{"tempo", "0"}}, "quarter notes a minute"},
        {{{"tempo", "nan"}}, "quarter notes a minute"},
        {{{"meter", "4/0"}}, "expected a meter"},
        {{{"meter", "0/4"}}, "expected a meter"},
        {{{"meter", "4"}}, "expected a meter"},
        {{{"unit", "0"}}, "expected a note value"},
        {{{"unit", "1/7"}}, "1/7 is not a whole number of ticks"},
        {{{"unit", "1/28"}}, "for septuplets use `speed: 7:4`"},
        {{{"velocity", "mf"}}, "or by x, y, depth, turn, length or level"},
        {{{"articulation", "staccato"}}, "5 to 100 percent"},
        {{{"articulation", "0%"}}, "from 5 to 100"},
        {{{"range", "C2-C7"}}, "`fold C2-C7`"},
        {{{"range", "fold C5-C4"}}, "the lowest and the highest note"},
        {{{"range", "refuse"}, {"n", "8"}}, "beyond the keys 0 to 127"},
        {{{"harmony", "chords"}}, "`bass 2`"},
        {{{"harmony", "progression Imaj8-IV"}}, "unknown chord 'Imaj8'"},
        {{{"harmony", "progression I-X"}}, "unknown chord 'X'; expected numerals such as IV, ii7"},
        {{{"harmony", "bass 0"}}, "from 1 to 30"},
        {{{"harmony", "bass 3"}}, ""},
        {{{"rhythm", "E(5,3)"}}, "more notes (5) than slots (3)"},
        {{{"rhythm", ""}}, "rhythm: a template begins"},
        {{{"rhythm", "0+2"}}, "groups of a tala"},
        {{{"rhythm", "..x"}}, "begins with x"},
        {{{"swing", "90"}}, "from 50 to 80"},
        {{{"phrases", "0"}}, "1 or more"},
        {{{"phrases", "2"}, {"breath", "x"}}, "expected a note value"},
        {{{"cadence", "tonc"}}, "did you mean 'tonic'"},
        {{{"brackets", "sequential"}}, "expected voices, sequence or shares"},
        {{{"ending", "bang"}}, "expected none, ritardando or fermata"},
        {{{"canon", "1/0 7"}}, "expected bars and an interval"},
        {{{"tonic", "H9"}}, "expected a note such as C4"},
        {{{"tonic", "C12"}}, "expected a note such as C4"},
        {{{"tonic", "60"}}, "expected C4 for key 60 of MIDI, or 60 Hz"},
        {{{"tonic", "99999 Hz"}}, "beyond what MIDI can write"},
        {{{"instrument", "kazooo"}}, "instrument"},
        {{{"instrument", "129"}}, "1 to 128"},
        {{{"instrument", ""}}, "expected a General MIDI name"},
        {{{"anchor", "lowest"}}, "expected first note, piece"},
        {{{"seconds", "0"}}, "expected a number above 0"},
        {{{"seconds", "1e-9"}}, "shorter than a tick"},
        {{{"from-bar", "9223372036854775807"}}, "the melody ends at bar 4"},
        {{{"from-bar", "1000"}}, "the melody ends at bar 4"},
        {{{"from-bar", "99999999999999999999"}}, "too large"},
        {{{"excerpt", "9-9"}}, "the melody ends at bar 4"}};
    for (const auto& [values, message] : mistakes) {
        EXPECT_TRUE(is_refused(played(hilbert, values), 2, message)) << values[0].name << ' ' << values[0].text;
    }
}

TEST(Play, LongScoresAndPatternsWithoutMelodyAreRefused) {
    EXPECT_TRUE(is_refused(played(hilbert, {{"n", "40"}}), 1, "4 GiB"));
    EXPECT_TRUE(is_refused(played(hilbert, {{"n", "40"}}, "musicxml"), 1, "above the budget"));
    EXPECT_TRUE(is_refused(played(hilbert, {{"n", "11"}}, "musicxml"), 2, "limit the bars"));
    EXPECT_TRUE(is_refused(played(hilbert, {{"n", "10"}}, "wav"), 2, "6 hours 45 minutes"));
    EXPECT_TRUE(is_refused(played("axiom: FFF\n", {}), 2, "no horizontal run"));
    EXPECT_TRUE(is_refused(played("axiom: +++\n", {}), 2, "the word has no steps such as F"));
    EXPECT_TRUE(is_refused(played("axiom: F]\n", {{"heading", "0"}}), 2, "']' without '['"));
    EXPECT_TRUE(is_refused(played("axiom: F\nscale: nothing-such\n", {}), 2, "-:2:8: unknown scale"));
    std::string branches = "heading: 0\naxiom: ";
    for (int i = 0; i < 20; ++i) branches += "[FFFF]";
    EXPECT_TRUE(is_refused(played("scale: shruti\n" + branches + "\n", {}), 2, "too many voices"));
    EXPECT_EQ(played(branches + "\n", {}).error, "") << "on one channel";
}

}  // namespace sikku::play_test
