// tests/music/emphasis_test.cpp: dynamics that patterns state and accents of rhythms, in print and in MIDI.
#include "music/scores.h"
#include "tests/checks.h"
#include "tests/midi_tools.h"
#include "tests/notation_tools.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <pugixml.hpp>

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

namespace sikku::emphasis_test {

const std::string table =
    "mapping: symbols\nnote A: C4 1/4 mf\nnote B: C4 1/4 p\nnote C: C4 1/4 ff\nnote D: C4 1/4\n";
const std::string steps = "axiom: FFFFFFFF\nheading: 0\nruns: each step\n";

std::string printed(const std::string& text, std::string_view format, const OptionValues& values = {}) {
    return play(parse("e.lsys", text), format, values);
}

/// `0 mf, 2 p`: the quarters at which dynamics stand in the first part of a MusicXML score; `<` and `>` are hairpins,
/// `!` their ends.
std::string dynamics_of(const std::string& text) {
    pugi::xml_document document;
    EXPECT_TRUE(document.load_string(printed(text, "musicxml").c_str()));
    std::string marks;
    const pugi::xml_node part = document.select_node("//part").node();
    const double divisions = part.select_node(".//divisions").node().text().as_double();
    double here = 0;
    for (const pugi::xml_node measure : part.children("measure")) {
        for (const pugi::xml_node node : measure.children()) {
            const std::string_view name = node.name();
            const double duration = node.child("duration").text().as_double() / divisions;
            if (name == "backup") here -= duration;
            if (name == "forward" || (name == "note" && !node.child("chord"))) here += duration;
            const pugi::xml_node type = node.child("direction-type");
            const std::string_view wedge = type.child("wedge").attribute("type").value();
            std::string mark = type.child("dynamics").first_child().name();
            if (!wedge.empty()) mark = wedge == "crescendo" ? "<" : wedge == "diminuendo" ? ">" : "!";
            if (!mark.empty()) marks += fmt::format("{}{} {}", marks.empty() ? "" : ", ", here, mark);
        }
    }
    return marks;
}

/// `.>..`: which of the notes in the first part of a MusicXML score are accented.
std::string accents_of(const std::string& text, const OptionValues& values) {
    pugi::xml_document document;
    EXPECT_TRUE(document.load_string(printed(text, "musicxml", values).c_str()));
    std::string accents;
    for (const auto& note : document.select_nodes("//part[1]/measure/note[pitch]")) {
        if (note.node().select_node("tie[@type='stop']")) continue;
        accents += note.node().select_node("notations/articulations/accent") ? '>' : '.';
    }
    return accents;
}

std::vector<int> velocities(const std::string& text, const OptionValues& values) {
    std::vector<int> all;
    for (const MidiNote& note : read_midi(printed(text, "mid", values)).notes) all.push_back(note.velocity);
    return all;
}

TEST(Emphasis, StatedDynamicsStandAtTheirNotes) {
    EXPECT_EQ(dynamics_of(table + "axiom: AABBAACC\n"), "0 mf, 2 p, 4 mf, 6 ff");
    EXPECT_EQ(dynamics_of(table + "axiom: ACAAACAA\n"), "0 mf, 1 ff, 2 mf, 5 ff, 6 mf");
    const std::string abc = printed(table + "axiom: AABBAACC\n", "abc");
    EXPECT_TRUE(has(abc, "!mf!C2 C2 !p!C2 C2 | !mf!C2 C2 !ff!C2 C2 |]"));
    const std::string lilypond = printed(table + "axiom: AABBAACC\n", "ly");
    EXPECT_TRUE(has(lilypond, "c'4\\mf c'4 c'4\\p c'4 | % 1\n        c'4\\mf c'4 c'4\\ff c'4 \\bar"));
}

/// An accompaniment of loud bass notes and soft chords has its balance printed once, until it changes.
TEST(Emphasis, ARepeatedBalanceIsPrintedOnce) {
    EXPECT_EQ(dynamics_of(table + "axiom: ABBBABBBABBBABBBABBB\n"), "0 mf, 1 p");
    EXPECT_EQ(dynamics_of(table + "axiom: ABBBABBBABBBABBBAAAA\n"), "0 mf, 1 p, 16 mf");
    EXPECT_EQ(dynamics_of(table + "axiom: ABBBABBBABBB\n"), "0 mf, 1 p, 4 mf, 5 p, 8 mf, 9 p");
    // An excerpt states it again.
    const std::string fourth = printed(table + "axiom: ABBBABBBABBBABBBABBB\n", "abc", {{"from-bar", "4"}});
    EXPECT_TRUE(has(fourth, "!mf!C2 !p!C2 C2 C2"));
}

TEST(Emphasis, ChangesStateDynamicsToo) {
    const std::string changes = table + "change L: loud\nchange S: soft\nchange U: louder 20\nchange N: 100\n";
    EXPECT_EQ(dynamics_of(changes + "axiom: DDLDDSDDA\n"), "0 mf, 2 f, 4 p, 6 mf");
    // A level that the changes have moved is printed as it sounds.
    EXPECT_EQ(dynamics_of(changes + "axiom: BUBCA\n"), "0 p, 1 mp, 2 fff, 3 f");
    // Velocities given as numbers or parameters do not state dynamics.
    EXPECT_EQ(dynamics_of(changes + "axiom: AAAANDDDDDDDD\n"), "0 mf, 4 f");
    EXPECT_EQ(dynamics_of(changes + "axiom: AAAA(1,96)AAAA\n"), "0 mf");
}

TEST(Emphasis, NotesWithoutDynamicsKeepThoseBeforeThem) {
    // A few notes, though they sound as mf, change nothing; a bar of them does.
    EXPECT_EQ(dynamics_of(table + "axiom: BDBD\n"), "0 p");
    EXPECT_EQ(dynamics_of(table + "axiom: BBBBDDDDBBBB\n"), "0 p, 4 mf, 8 p");
    // Along a curve of velocities these are what sounds.
    EXPECT_EQ(dynamics_of(table + "axiom: ABAB\nvelocity: by x 96-96\n"), "0 f");
}

TEST(Emphasis, HandsShareDynamicsUnlessTheirOwnAreFewer) {
    const std::string hands =
        "mapping: symbols\nnote A: C5 1/4 mf\nnote B: C3 1/4 f\nnote C: C3 1/4 mf\nrest r: 1/4\n";
    const std::string own = hands + "axiom: [ArAr][rBrB]\n";
    const std::string abc = printed(own, "abc");
    EXPECT_TRUE(has(abc, "!mf!c2 z2 c2 z2"));
    EXPECT_TRUE(has(abc, "z2 !f!C,2 z2 C,2"));
    const std::string lilypond = printed(own, "ly");
    EXPECT_TRUE(has(lilypond, "c''4\\mf r4 c''4 r4"));
    EXPECT_TRUE(has(lilypond, "r4 c4\\f r4 c4"));
    EXPECT_EQ(dynamics_of(own), "0 mf, 1 f");
    const std::string shared = hands + "axiom: [rrAA][CCrr]\n";
    EXPECT_EQ(dynamics_of(shared), "0 mf");
    EXPECT_EQ(count_of(printed(shared, "ly"), "\\mf"), 1u);
    // The first note may be that of the other hand.
    const std::string late = printed(shared, "abc");
    EXPECT_EQ(count_of(late, "!mf!"), 1u);
    EXPECT_TRUE(has(late, "!mf!C,2 C,2"));
}

TEST(Emphasis, DynamicsOfSeveralDrumsAreTheirBalance) {
    const std::string drums =
        "mapping: symbols\ndrum h: closed hi-hat 1/8 p\ndrum k: bass drum 1/4 f\ndrum K: bass drum 1/4 p\n";
    EXPECT_EQ(dynamics_of(drums + "axiom: [hhhhhhhhhhhhhhhh][kkkkkkkk]\n"), "0 mf");
    EXPECT_EQ(dynamics_of(drums + "axiom: kkKKkKkk\n"), "0 f, 2 p, 4 f, 5 p, 6 f");
}

TEST(Emphasis, RhythmsAccentTheirNotes) {
    EXPECT_EQ(accents_of(steps, {{"rhythm", "xxXx"}}), "..>...>.");
    EXPECT_EQ(accents_of(steps, {{"rhythm", "adi"}}), ">..>..>.");
    EXPECT_EQ(accents_of(steps, {{"rhythm", "X"}}), ">>>>>>>>");
    EXPECT_EQ(accents_of(steps, {{"rhythm", "xxxx"}}), "........");
    EXPECT_EQ(accents_of(table + "axiom: ABAB\n", {{"rhythm", "Xx"}, {"unit", "1/4"}}), ">.>.");
    const OptionValues values = {{"rhythm", "xxXx"}};
    EXPECT_EQ(count_of(printed(steps, "ly", values), "->"), 2u);
    EXPECT_EQ(count_of(printed(steps, "abc", values), "!accent!"), 2u);
    // The dynamic is that of the other notes.
    EXPECT_EQ(dynamics_of(steps + "rhythm: adi\n"), "0 mf");
}

TEST(Emphasis, AccentsAreAddedToCurves) {
    const std::string rhythm = steps + "rhythm: X.x~\n";
    EXPECT_EQ(velocities(rhythm, {}), (std::vector<int>{96, 80, 96, 80, 96, 80, 96, 80}));
    const std::vector<int> plain = velocities(steps + "rhythm: x.x~\n", {{"velocity", "by x 40-120"}});
    std::vector<int> accented = velocities(rhythm, {{"velocity", "by x 40-120"}});
    ASSERT_EQ(accented.size(), 8u);
    for (std::size_t i = 0; i < 8; ++i) EXPECT_EQ(accented[i], std::min(127, plain[i] + (i % 2 == 0 ? 16 : 0))) << i;
    EXPECT_EQ(accents_of(rhythm, {{"velocity", "by x 40-120"}}), ">.>.>.>.");
}

}  // namespace sikku::emphasis_test
