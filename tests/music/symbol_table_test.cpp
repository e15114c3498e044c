// tests/music/symbol_table_test.cpp: tables of symbols: what words sound, by hand, and as independent readers of MIDI
// and MusicXML see it.
#include "music/arrangement.h"
#include "music/scores.h"
#include "tests/midi_tools.h"
#include "tests/works.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <pugixml.hpp>

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace sikku::symbol_table_test {

const std::string head = "mapping: symbols\nunit: 1/8\n";

NoteList notes_of(const std::string& text, const OptionValues& values = {}) {
    const Document document = parse("table.lsys", head + text);
    return list_notes(std::span(&document, 1), values, {});
}

/// `0:60/240`: onset, key and duration of the notes of a voice; with the velocity on request.
std::string told(const NoteList& list, int voice = 0, bool has_velocity = false) {
    std::string text;
    for (const Note& note : list.notes) {
        if (note.voice != voice) continue;
        text += fmt::format("{}{}:{}/{}", text.empty() ? "" : " ", note.onset, note.key, note.duration);
        if (has_velocity) text += fmt::format("@{}", note.velocity);
    }
    return text;
}

std::string error_of(const std::string& text) {
    try {
        notes_of(text);
    } catch (const PatternError& error) {
        return error.diagnostics().front().message;
    } catch (const std::exception& error) {
        return error.what();
    }
    return "none";
}

TEST(SymbolTable, NotesHavePitchDurationAndVelocity) {
    const std::string rows =
        "note A: C4 1/8 mf\nnote B: degree 3 1/4 90\nrest R: 1/2\nnote C: F#5\nnote D: degree -1 p\n";
    EXPECT_EQ(told(notes_of(rows + "axiom: ABRCD\n"), 0, true),
              "0:60/240@80 240:65/480@90 1680:78/240@80 1920:59/240@48");
    // Names stay where they are in any scale, degrees follow it, and both follow transposition.
    EXPECT_EQ(told(notes_of(rows + "axiom: AB\nscale: minor\ntonic: A3\n")), "0:60/240 240:62/480");
    EXPECT_EQ(told(notes_of(rows + "axiom: AB\ntransposition: 2\n")), "0:62/240 240:67/480");
    EXPECT_EQ(told(notes_of(rows + "axiom: AB\n", {{"transpose", "-12"}})), "0:48/240 240:53/480");
    // + and - move by degrees: C to D, and F to G.
    EXPECT_EQ(told(notes_of(rows + "axiom: +AB-A\n")), "0:62/240 240:67/480 720:60/240");
    // Around the tonic, C, up and down change places: F is a fifth below.
    EXPECT_EQ(told(notes_of(rows + "axiom: AB\nnote G: E4\ninversion: yes\n")), "0:60/240 240:55/480");
    EXPECT_EQ(told(notes_of("note G: E4\naxiom: G\ninversion: yes\n")), "0:56/240");
    EXPECT_EQ(told(notes_of(rows + "axiom: AB\naugmentation: 2\n")), "0:60/480 480:65/960");
}

TEST(SymbolTable, ParametersAreDegreeDurationAndVelocity) {
    EXPECT_EQ(told(notes_of("note N:\naxiom: N(3,0.5,80)N(-1)N(0,2)N\n"), 0, true),
              "0:65/120@80 120:59/240@80 360:60/480@80 840:60/240@80");
    EXPECT_EQ(told(notes_of("note A: C5 1/4 f\nrest R:\naxiom: A(1)A(0.5,33)R(3)A\n"), 0, true),
              "0:72/240@96 240:72/120@33 1080:72/480@96");
    // Computed by a production: N(x) becomes a note a degree higher and half as long.
    EXPECT_EQ(told(notes_of("note N:\nderivation length: 2\naxiom: N(0,2)\nN(d,t) --> N(d,t/2)N(d+1,t/2)\n")),
              "0:60/120 120:62/120 240:62/120 360:64/120");
}

TEST(SymbolTable, ChangesHoldToTheEndOfABranch) {
    const std::string rows =
        "note A: C4\nchange L: louder\nchange S: softer 30\nchange P: pp\nchange O: octave up\nchange U: octave "
        "down\n"
        "change V: up 2\n";
    EXPECT_EQ(told(notes_of(rows + "axiom: ALALASAPA\n"), 0, true),
              "0:60/240@80 240:60/240@92 480:60/240@104 720:60/240@74 960:60/240@26");
    EXPECT_EQ(told(notes_of(rows + "axiom: OAUUAOVA\n")), "0:72/240 240:48/240 480:64/240");
    EXPECT_EQ(told(notes_of(rows + "brackets: sequence\naxiom: [OA]A\n")), "0:72/240 240:60/240");
    EXPECT_EQ(told(notes_of(rows + "axiom: L(5)A\n"), 0, true), "0:60/240@85");
    const std::string short_words =
        "note A: C4\nchange L: loud\nchange S: soft\nchange O: octave\nchange U: octave -2\nchange V: octave 1\n";
    EXPECT_EQ(told(notes_of(short_words + "axiom: LASAOAUAVA\n"), 0, true),
              "0:60/240@96 240:60/240@48 480:72/240@48 720:48/240@48 960:60/240@48");
}

TEST(SymbolTable, ChordsByName) {
    const auto keys = [](const std::string& chord) {
        std::vector<double> found;
        const NoteList list = notes_of("chord T: " + chord + " 1/4\naxiom: T\n");
        for (const Note& note : list.notes) found.push_back(note.key);
        std::sort(found.begin(), found.end());
        return found;
    };
    EXPECT_EQ(keys("C7"), (std::vector<double>{60, 64, 67, 70}));
    EXPECT_EQ(keys("C"), (std::vector<double>{60, 64, 67}));
    EXPECT_EQ(keys("Am"), (std::vector<double>{69, 72, 76}));
    EXPECT_EQ(keys("C/G"), (std::vector<double>{55, 60, 64}));
    EXPECT_EQ(keys("C4 C7"), (std::vector<double>{60, 96})) << "notes";
    EXPECT_EQ(keys("C4"), (std::vector<double>{60})) << "one note";
}

TEST(SymbolTable, ChordsAreNumeralsNamesOrDegrees) {
    const auto keys = [](const NoteList& list) {
        std::multiset<double> all;
        for (const Note& note : list.notes) all.insert(note.key);
        return all;
    };
    EXPECT_EQ(keys(notes_of("chord T: I 1/2\naxiom: T\n")), (std::multiset<double>{60, 64, 67}));
    EXPECT_EQ(keys(notes_of("chord T: V7\naxiom: T\n")), (std::multiset<double>{67, 71, 74, 77}));
    EXPECT_EQ(keys(notes_of("chord T: ii\ntonic: D4\naxiom: T\n")), (std::multiset<double>{64, 67, 71}));
    EXPECT_EQ(keys(notes_of("chord T: C4 Eb4 G4 1/4 f\naxiom: T\n")), (std::multiset<double>{60, 63, 67}));
    EXPECT_EQ(keys(notes_of("chord T: degrees 0 3 4\nscale: minor\naxiom: T\n")),
              (std::multiset<double>{60, 65, 67}));
    const NoteList list = notes_of("chord T: I 1/4\nnote A: C5\naxiom: TAT\n");
    EXPECT_EQ(told(list, 0), "0:60/480 480:72/240 720:60/480");
    EXPECT_EQ(told(list, 1), "0:64/480 720:64/480");
    EXPECT_EQ(told(list, 2), "0:67/480 720:67/480");
    EXPECT_EQ(list.parts.front().voices, 3);
}

TEST(SymbolTable, NamesOfNotesAloneAreOptIn) {
    EXPECT_EQ(told(notes_of("named notes: yes\naxiom: CDEF\n")), "0:60/240 240:62/240 480:64/240 720:65/240");
    EXPECT_EQ(told(notes_of("named notes: yes\nsymbols: Bb3 Fs5\naxiom: Bb3Fs5(2)A(1,20)\n"), 0, true),
              "0:58/240@80 240:78/480@80 720:69/240@20");
    // Without the key only F sounds, on the tonic.
    EXPECT_EQ(told(notes_of("axiom: CDEF\n")), "0:60/240");
}

TEST(SymbolTable, DrumsHaveAPartOfTheirOwn) {
    const std::string rows =
        "drum k: bass drum 1/8 f\ndrum s: Acoustic Snare 1/8\ndrum h: closed hi-hat 1/16 60\n"
        "drum b: bass drum + crash cymbal 1 1/4 ff\n";
    const NoteList alone = notes_of(rows + "axiom: khhsb\n");
    ASSERT_EQ(alone.parts.size(), 1u);
    EXPECT_TRUE(alone.parts[0].is_drums);
    EXPECT_EQ(told(alone, 0, true), "0:36/240@96 240:42/120@60 360:42/120@60 480:38/240@80 720:36/480@112");
    EXPECT_EQ(told(alone, 1, true), "720:49/480@112");
    // Beside notes: the drums of voice i are voice i of their own part. Transposition leaves them.
    const NoteList both = notes_of(rows + "note A: C4\nbrackets: voices\naxiom: A[k]s\n", {{"transpose", "5"}});
    ASSERT_EQ(both.parts.size(), 2u);
    EXPECT_FALSE(both.parts[0].is_drums);
    EXPECT_TRUE(both.parts[1].is_drums);
    EXPECT_EQ(both.parts[0].voices, 2);
    EXPECT_EQ(told(both, 0), "0:65/240");
    EXPECT_EQ(told(both, 2), "240:38/240");
    EXPECT_EQ(told(both, 3), "240:36/240");
}

TEST(SymbolTable, BracketsModesTempoAndRhythm) {
    const std::string rows = "note A: C4\nnote B: E4\ndrum k: bass drum\n";
    EXPECT_EQ(told(notes_of(rows + "brackets: sequence\naxiom: A[BB]A\n")),
              "0:60/240 240:64/240 480:64/240 720:60/240");
    // Three notes share a step.
    EXPECT_EQ(told(notes_of(rows + "brackets: shares\naxiom: A[BBB]A\n")),
              "0:60/240 240:64/80 320:64/80 400:64/80 480:60/240");
    const NoteList voices = notes_of(rows + "axiom: A[BB]A\n");
    EXPECT_EQ(told(voices, 0), "0:60/240 240:60/240");
    EXPECT_EQ(told(voices, 1), "240:64/240 480:64/240");
    EXPECT_EQ(told(notes_of(rows + "brackets: sequence\nrhythm: x.xx\naxiom: ABAB\n")),
              "0:60/480 480:64/240 720:60/240 960:64/480");
    EXPECT_EQ(told(notes_of(rows + "brackets: sequence\nswing: 75\naxiom: AkAk\n"), 1), "360:36/120 840:36/120");
    // Bars are the same, read from the middle.
    EXPECT_EQ(told(notes_of("note A: C4 1/4\nnote B: D4 1/4\naxiom: AABBAABB\n", {{"from-bar", "2"}, {"bars", "1"}})),
              "0:60/480 480:60/480 960:62/480 1440:62/480");
}

TEST(SymbolTable, PhrasesAndCadences) {
    const std::string rows =
        "note A: degree 1\nnote B: degree 5\nnote C: D4\nderivation length: 2\naxiom: X\n"
        "X --> YY\nbrackets: sequence\n";
    EXPECT_EQ(told(notes_of(rows + "Y --> AB\nphrases: 1\nbreath: 1/4\n")),
              "0:62/240 240:69/240 960:62/240 1200:69/240");
    EXPECT_EQ(told(notes_of(rows + "Y --> AB\nphrases: 1\nbreath: none\ncadence: tonic\n")),
              "0:71/240 240:72/240 480:71/240 720:72/240");
    // Notes with names stay.
    EXPECT_EQ(told(notes_of(rows + "Y --> AC\nphrases: 1\nbreath: none\ncadence: tonic\n")),
              "0:62/240 240:62/240 480:62/240 720:62/240");
}

TEST(SymbolTable, MidiHasDrumsOnChannelTen) {
    const Document document = parse(
        "d.lsys", head + "drum k: bass drum\ndrum h: 42\nnote A: C4 1/8 mf\naxiom: A[k][k]h[A][A]hk\ntempo: 90\n");
    const std::string bytes = play(document, "mid");
    EXPECT_EQ(midi_faults(bytes), "");
    const MidiFile file = read_midi(bytes);
    std::multiset<std::tuple<std::int64_t, int, int>> drums;
    for (const MidiNote& note : file.notes) {
        EXPECT_EQ(note.channel == 9, note.key != 60) << note.onset;
        if (note.channel == 9) drums.insert({note.onset, note.key, note.velocity});
    }
    // Two bass drums at once are one note of their channel.
    EXPECT_EQ(drums, (std::multiset<std::tuple<std::int64_t, int, int>>{
                         {240, 36, 80}, {240, 42, 80}, {480, 42, 80}, {720, 36, 80}}));
}

TEST(SymbolTable, DrumsStayOnTheirChannelWithMpeAndMicrotones) {
    const Document document =
        parse("d.lsys", head + "scale: 31-edo\ndrum k: bass drum\nnote A: degree 1\naxiom: A[k]A[k]A\n");
    for (const char* tuning : {"bend", "mts", "mpe"}) {
        const std::string bytes = play(document, "mid", {{"tuning", tuning}});
        EXPECT_EQ(midi_faults(bytes), "");
        int drums = 0;
        for (const MidiNote& note : read_midi(bytes).notes) {
            EXPECT_EQ(note.channel == 9, note.key == 36) << tuning;
            EXPECT_NEAR(note.bend, note.channel == 9 ? 0 : 12.0 / 31, 0.01) << tuning;
            drums += note.channel == 9 ? 1 : 0;
        }
        EXPECT_EQ(drums, 2) << tuning;
    }
}

TEST(SymbolTable, MusicXmlHasUnpitchedNotesOnAPercussionStaff) {
    const Document document = parse("d.lsys", head + "drum k: bass drum\ndrum h: closed hi-hat\naxiom: [kkkk]hhhh\n");
    pugi::xml_document xml;
    ASSERT_TRUE(xml.load_string(play(document, "musicxml").c_str()));
    EXPECT_STREQ(xml.select_node("//clef/sign").node().child_value(), "percussion");
    std::map<std::string, int> unpitched;  // by instrument
    for (const auto& node : xml.select_nodes("//midi-instrument")) {
        EXPECT_STREQ(node.node().child_value("midi-channel"), "10");
        unpitched[node.node().attribute("id").value()] =
            std::stoi(node.node().child_value("midi-unpitched")) - 1;  // counted from 1
    }
    std::multiset<int> keys;
    for (const auto& node : xml.select_nodes("//note[unpitched]")) {
        keys.insert(unpitched.at(node.node().child("instrument").attribute("id").value()));
        EXPECT_TRUE(node.node().child("pitch").empty());
        EXPECT_EQ(
            std::string(node.node().child_value("notehead")) == "x",
            keys.count(42) > 0 && std::string(node.node().child("unpitched").child_value("display-step")) == "G");
    }
    EXPECT_EQ(keys, (std::multiset<int>{36, 36, 36, 36, 42, 42, 42, 42}));
}

TEST(SymbolTable, ChordsArePrintedAsChords) {
    const Document document = parse("d.lsys", head +
                                                  "chord T: I 1/4\nnote A: C5 1/4\ndrum b: 36 + 49 1/4\n"
                                                  "chord U: C4 Eb4 1/4\naxiom: TAUb\n");
    EXPECT_TRUE(has(play(document, "ly"), "<c' e' g'>4\\mf c''4 <c' ees'>4"));
    // Hands and feet have lines of their own.
    EXPECT_TRUE(has(play(document, "ly"), "crashcymbala4"));
    EXPECT_TRUE(has(play(document, "ly"), "bassdrum4"));
    EXPECT_TRUE(has(play(document, "abc"), "[CEG]2 c2 [C_E]2"));
    pugi::xml_document xml;
    ASSERT_TRUE(xml.load_string(play(document, "musicxml").c_str()));
    std::vector<std::string> steps;
    for (const auto& node : xml.select_nodes("//note[pitch]")) {
        steps.push_back(std::string(node.node().child("chord").empty() ? "" : "+") +
                        node.node().child("pitch").child_value("step"));
        EXPECT_EQ(std::string(node.node().child_value("accidental")), steps.size() == 6 ? "flat" : "");
    }
    EXPECT_EQ(steps, (std::vector<std::string>{"C", "+E", "+G", "C", "C", "+E"}));
}

TEST(SymbolTable, OtherFormatsNameTheDrums) {
    const Document document = parse("d.lsys", head + "drum k: bass drum\ndrum s: snare drum\naxiom: ksks\n");
    const std::string lilypond = play(document, "ly");
    EXPECT_TRUE(has(lilypond, "\\drummode"));
    EXPECT_TRUE(has(lilypond, "bassdrum4 bassdrum4 r2"));
    EXPECT_TRUE(has(lilypond, "r8 acousticsnare8 r8 acousticsnare8 r2"));
    const std::string abc = play(document, "abc");
    EXPECT_TRUE(has(abc, "clef=perc"));
    EXPECT_TRUE(has(abc, "%%MIDI drummap =F 36\n%%MIDI drummap =c 38"));
    EXPECT_TRUE(has(play(document, "strudel"), "sound(`bd sd bd sd ~@4`)"));
    EXPECT_TRUE(has(play(document, "csd"), "i 1 0.5 0.5 38 0.629921 1"));
    EXPECT_TRUE(has(play(document, "html"), "\"drums\":[0]"));
}

TEST(SymbolTable, WhatIsSkippedAndUnusedIsReportedOnce) {
    const Document document =
        parse("d.lsys", head + "note A: C4\nnote Q: D4\naxiom: XAYXA\nX --> XY\nderivation length: 2\n");
    const Made made = remarks_about(scores(), document, "mid");
    ASSERT_EQ(made.remarks.size(), 3u);
    EXPECT_EQ(made.remarks[1].text, "symbols without a sound: 5 Y, 2 X");
    EXPECT_EQ(made.remarks[2].text, "the pattern does not contain the symbol 'Q' of the table");
    EXPECT_TRUE(has(describe_score(std::span(&document, 1), {}, {}), "no sound  5 Y, 2 X\n"));
}

TEST(SymbolTable, SkippedSymbolsAreReportedWithoutATable) {
    const Made made = remarks_about(scores(), parse("d.lsys", head + "axiom: F+(3)F!;CDF-(90)+(2.5)\n"), "mid");
    ASSERT_EQ(made.remarks.size(), 2u);
    EXPECT_EQ(made.remarks[1].text,
              "symbols without a sound: 1 !, 1 ;, 1 C, 1 D, 1 parameter of +, 1 parameter of -");
    const Document plain = parse("d.lsys", head + "axiom: F+F-F[+F]f\n");
    EXPECT_EQ(remarks_about(scores(), plain, "mid").remarks.size(), 1u);
}

/// Whole parameters of turns count degrees, also where the fold skips a part of the word.
TEST(SymbolTable, TurnsHaveDegrees) {
    const auto keys = [](const std::string& axiom, const OptionValues& values = {}) {
        const Document document = parse("d.lsys", head + axiom);
        std::vector<double> found;
        for (const Note& note : list_notes(std::span(&document, 1), values, {}).notes) found.push_back(note.key);
        return found;
    };
    EXPECT_EQ(keys("axiom: F+(3)F-(1)F+(0)f F-(90)F\n"), (std::vector<double>{60, 65, 64, 64, 62}));
    const std::string long_one = "axiom: X\nX --> XF+(2)F-(2)X\nderivation length: 13\n";
    const OptionValues far = {{"from-bar", "2001"}, {"bars", "2"}};
    const std::vector<double> all = keys(long_one);
    const std::vector<double> some = keys(long_one, far);
    ASSERT_FALSE(some.empty());
    EXPECT_NE(std::search(all.begin(), all.end(), some.begin(), some.end()), all.end());
}

TEST(SymbolTable, TracksOfArrangements) {
    const auto read = [](const std::string& text) {
        return read_arrangement("a.toml", text, [](const std::string& name) {
            return NamedPattern{name, head + (name == "drums" ? "drum k: bass drum 1/4\naxiom: kkkk\n"
                                                              : "note A: C4 1/4\nnote B: E4 1/4\naxiom: AB\n")};
        });
    };
    const NoteList list = list_notes(read("[[track]]\npattern = \"tune\"\nloop = 2\n\"note B\" = \"G4 1/2\"\n"
                                          "[[track]]\npattern = \"drums\"\nretrograde = true\nstart = 1\n"),
                                     {}, {});
    ASSERT_EQ(list.parts.size(), 2u);
    EXPECT_TRUE(list.parts[1].is_drums);
    EXPECT_EQ(told(list, 0), "0:60/480 480:67/960 1920:60/480 2400:67/960");
    EXPECT_EQ(told(list, 1), "1920:36/480 2400:36/480 2880:36/480 3360:36/480");
}

TEST(SymbolTable, ErrorsSayWhatIsExpected) {
    EXPECT_EQ(error_of("drum k: bas drum\naxiom: k\n"), "unknown drum 'bas drum'; did you mean 'bass drum'?");
    EXPECT_EQ(error_of("drum k: kick\naxiom: k\n"), "unknown drum 'kick'; did you mean 'bass drum'?");
    EXPECT_EQ(error_of("drum k: ride 1/8\naxiom: k\n"), "unknown drum 'ride'; did you mean 'ride cymbal'?");
    EXPECT_EQ(error_of("drum k: piano 1/8\naxiom: k\n"),
              "unknown drum 'piano'; expected a drum of General MIDI such as bass drum, or its key, 35 to 81");
    EXPECT_EQ(
        error_of("note A: C4 0/8\naxiom: A\n"),
        "unknown duration '0/8'; expected a note value above 0, such as 1/8, 3/16 or 1/1, up to 16 whole notes");
    EXPECT_EQ(error_of("note A: C4 1/8 300\naxiom: A\n"), "velocity 300; expected 1 to 127, or ppp to fff");
    EXPECT_EQ(error_of("note A: Cb-1\naxiom: A\n"), "Cb-1 lies beyond what MIDI can write; expected C-1 to G9");
    EXPECT_EQ(error_of("note A: H4\naxiom: A\n"),
              "unknown pitch 'H4'; expected a note such as C4, F#3 or Bb, or degree 3");
    EXPECT_EQ(error_of("note A: C4\nnote A: D4\naxiom: A\n"), "'note A:' is given twice");
    EXPECT_EQ(error_of("note A: C4\ndrum A: 36\naxiom: A\n"),
              "'A' is defined twice: 'note A:' states what it sounds");
    EXPECT_EQ(error_of("note AB: C4\naxiom: AB\n"),
              "'AB' is not one symbol; names of several letters are listed under 'symbols:'");
    EXPECT_EQ(error_of("chord T: VIII\naxiom: T\n"),
              "unknown chord 'VIII'; expected a numeral such as IV or V7, a name such as Am7, notes such as C4 E4 "
              "G4, or degrees 0 2 4");
    EXPECT_EQ(
        error_of("change L: faster\naxiom: LF\n"),
        "expected loud or soft, louder or softer, a velocity such as mf or 90, octave up or octave down, up 2 or "
        "down 2");
    EXPECT_EQ(error_of("change L: octave 300\naxiom: LF\n"), "unexpected '300'; expected an amount from 0 to 127");
    EXPECT_EQ(error_of("change L: octave 1 up\naxiom: LF\n"), "unexpected 'up'");
    EXPECT_EQ(error_of("note N:\naxiom: N(0,0)\n"),
              "symbol 1 of the word: its duration is 0; expected steps above 0, up to 1000000, of 'N'");
    EXPECT_EQ(error_of("note N:\naxiom: N(0,1,300)\n"),
              "symbol 1 of the word: its velocity is 300; expected 1 to 127, of 'N'");
    EXPECT_TRUE(has(error_of("note N:\nrange: refuse\naxiom: N(-100)\n"), "beyond the keys 0 to 127"));
    EXPECT_EQ(error_of("note N:\naxiom: N(-100)\n"), "none");  // folded
    EXPECT_TRUE(has(error_of("note A: C4\naxiom: X\n"), "no symbol of the word sounds"));
}

}  // namespace sikku::symbol_table_test
