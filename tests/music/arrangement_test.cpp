// tests/music/arrangement_test.cpp: arrangements, compared with what their notes should be by hand, and strict
// counterpoint with a checker of its own.
#include "music/arrangement.h"

#include "music/scores.h"
#include "tests/fuzz/file_targets.h"
#include "tests/midi_tools.h"
#include "tests/works.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <pugixml.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <tuple>
#include <vector>

namespace sikku::arrangement_test {

// Degrees 0 1 2 1 in notes of 1, 1, 1 and 2 steps: a bar of 5/8.
const std::string steps = "heading: 0\nturn: left\nangle factor: 4\naxiom: F+F-F+F-F-F+FF\n";
const std::string hilbert =
    "title: Hilbert\naxiom: X\nderivation length: 4\nX --> -YF+XFX+FY-\nY --> +XF-YFY-FX+\nheading: 0\n";

Arrangement read(const std::string& text) {
    return read_arrangement("a.toml", text, [](const std::string& name) {
        if (name == "steps") return NamedPattern{name, steps};
        if (name == "branches") return NamedPattern{name, "heading: 0\naxiom: [FF][FF]\n"};
        if (name == "hilbert") return NamedPattern{name, hilbert};
        throw std::runtime_error("no pattern named '" + name + "'");
    });
}

NoteList notes_of(const std::string& text, const OptionValues& values = {}) {
    return list_notes(read(text), values, {});
}

/// `0:60/240`: onset, key and duration of the notes of a voice.
std::string told(const NoteList& list, int voice = 0) {
    std::string text;
    for (const Note& note : list.notes) {
        if (note.voice != voice) continue;
        text += fmt::format("{}{}:{}/{}", text.empty() ? "" : " ", note.onset, note.key, note.duration);
    }
    return text;
}

std::string track(const std::string& keys, const std::string& pattern = "steps") {
    return "[[track]]\npattern = \"" + pattern + "\"\n" + keys;
}

TEST(Arrangement, TracksHaveKeysOfTheirOwn) {
    EXPECT_EQ(told(notes_of(track(""))), "0:60/240 240:62/240 480:64/240 720:62/480");
    EXPECT_EQ(told(notes_of(track("start = 2\ntransposition = -12\n"))),
              "3840:48/240 4080:50/240 4320:52/240 4560:50/480");
    EXPECT_EQ(told(notes_of(track("augmentation = \"1/2\"\n"))), "0:60/120 120:62/120 240:64/120 360:62/240");
    EXPECT_EQ(told(notes_of(track("augmentation = 2\n"))), "0:60/480 480:62/480 960:64/480 1440:62/960");
    EXPECT_EQ(told(notes_of(track("inversion = true\n"))), "0:60/240 240:59/240 480:57/240 720:59/480");
    EXPECT_EQ(told(notes_of(track("inversion = \"yes\"\n"))), told(notes_of(track("inversion = true\n"))));
    EXPECT_EQ(told(notes_of(track("inversion = false\n"))), told(notes_of(track(""))));
    EXPECT_EQ(told(notes_of(track("retrograde = true\n"))), "0:62/480 480:64/240 720:62/240 960:60/240");
    EXPECT_EQ(told(notes_of(track("tempo-ratio = \"3:2\"\n"))), "0:60/160 160:62/160 320:64/160 480:62/320");
    EXPECT_EQ(told(notes_of(track("unit = \"1/16\"\nscale = \"minor\"\n"))),
              "0:60/120 120:62/120 240:63/120 360:62/240");
    EXPECT_EQ(told(notes_of("meter = \"3/8\"\n" + track("excerpt = \"2-2\"\n"))), "0:62/480");
}

TEST(Arrangement, LoopsRepeatWholeBarsOfTheirOwnMeter) {
    EXPECT_EQ(told(notes_of(track("meter = \"5/8\"\nloop = 2\n"))),
              "0:60/240 240:62/240 480:64/240 720:62/480 1200:60/240 1440:62/240 1680:64/240 1920:62/480");
    // 5/8 against 3/8: together after 15 eighths.
    const NoteList common = notes_of(track("meter = \"5/8\"\nloop = \"common\"\n") +
                                     track("meter = \"3/8\"\nexcerpt = \"1-1\"\nloop = \"common\"\n"));
    EXPECT_EQ(common.end, 15 * 240);
    EXPECT_EQ(
        std::count_if(common.notes.begin(), common.notes.end(), [](const Note& note) { return note.voice == 0; }),
        3 * 4);
    EXPECT_EQ(
        std::count_if(common.notes.begin(), common.notes.end(), [](const Note& note) { return note.voice == 1; }),
        5 * 3);
    // The loop ends with the longest part.
    const NoteList filled = notes_of(track("", "hilbert") + track("meter = \"5/8\"\nloop = \"fill\"\n"));
    EXPECT_EQ(filled.end, notes_of(track("", "hilbert")).end);
    EXPECT_THROW(notes_of(track("loop = \"common\"\nmeter = \"61/64\"\n") +
                          track("loop = \"common\"\nmeter = \"59/64\"\ntempo-ratio = \"64:63\"\n") +
                          track("loop = \"common\"\nmeter = \"53/64\"\ntempo-ratio = \"62:61\"\n")),
                 ScoreError);
    EXPECT_THROW(notes_of(track("loop = 10000\nn = 7\n", "hilbert")), ScoreError);
}

/// Loops that begin at different bars end at the first bar where all of them end, by trial.
TEST(Arrangement, LoopsThatBeginLaterEndTogether) {
    const auto loop = [](int start, int bars) {
        return track(fmt::format("start = {}\nloop = \"common\"\n", start), fmt::format("bars {}", bars));
    };
    const auto read_bars = [](const std::string& name) {
        return NamedPattern{name, fmt::format("axiom: {}\nmapping: symbols\nnote N: C4 1/1\n",
                                              std::string(static_cast<std::size_t>(name.back() - '0'), 'N'))};
    };
    int met = 0;
    for (const int first : {2, 3, 6, 8}) {
        for (const int second : {3, 4, 9}) {
            for (const int third : {1, 5}) {
                for (const int start : {0, 1, 2, 4}) {
                    const std::string text = loop(0, first) + loop(start, second) + loop(3, third);
                    std::int64_t wanted = 0;
                    const int earliest = std::max({first, start + second, 3 + third});
                    for (int end = earliest; end < 1000 && wanted == 0; ++end) {
                        const bool is_end = end % first == 0 && (end - start) % second == 0 && (end - 3) % third == 0;
                        if (is_end) wanted = end;
                    }
                    const Arrangement arrangement = read_arrangement("a.toml", text, read_bars);
                    if (wanted == 0) {
                        EXPECT_THROW(list_notes(arrangement, {}, {}), ScoreError) << text;
                        continue;
                    }
                    ++met;
                    EXPECT_EQ(list_notes(arrangement, {}, {}).end, wanted * 1920) << text;
                }
            }
        }
    }
    EXPECT_GT(met, 50);
}

TEST(Arrangement, CanonsFollowBySemitonesAndDegrees) {
    const NoteList list =
        notes_of("meter = \"5/8\"\n" + track("canon = [\"1 -12\", \"2 third\", \"0.5 octave below\"]\n"));
    EXPECT_EQ(list.parts.size(), 4u);
    EXPECT_EQ(told(list, 1), "1200:48/240 1440:50/240 1680:52/240 1920:50/480");
    EXPECT_EQ(told(list, 2), "2400:64/240 2640:65/240 2880:67/240 3120:65/480");
    EXPECT_EQ(told(list, 3), "600:48/240 840:50/240 1080:52/240 1320:50/480");
}

/// Two tempos in print: tuplets notate the rhythm exactly.
TEST(Arrangement, PartsWithTheirOwnTempoArePrinted) {
    for (const auto& [speed, actual] :
         {std::pair{"3:2", "3"}, {"5:4", "5"}, {"7:4", "7"}, {"7:8", "7"}, {"2:1", ""}, {"1:2", ""}}) {
        const std::string text = track("instrument = \"Violin\"\n") +
                                 track(fmt::format("speed = \"{}\"\ninstrument = \"Cello\"\n", speed));
        MemoryDestination memory;
        const auto remarks = plan_score(read(text), "musicxml", {})->make(memory, "x", {}).remarks;
        EXPECT_EQ(remarks.size(), 1u) << speed;  // none about notes that were moved
        pugi::xml_document xml;
        ASSERT_TRUE(xml.load_string(memory.take("x").c_str()));
        const auto tuplets = xml.select_nodes("//part[2]//time-modification/actual-notes");
        EXPECT_EQ(tuplets.empty(), std::string(actual).empty()) << speed;
        for (const auto& one : tuplets) EXPECT_EQ(one.node().text().get(), std::string(actual));
        // The divisions of a quarter are the same in both parts.
        const NoteList list = notes_of(text);
        double divisions = xml.select_node("//divisions").node().text().as_double();
        std::vector<double> onsets;
        double now = 0;
        for (const auto& one : xml.select_nodes("//part[2]//note")) {
            const pugi::xml_node note = one.node();
            const bool goes_on = note.select_node("tie[@type='stop']");
            if (note.child("pitch") && !goes_on) onsets.push_back(now * 480 / divisions);
            now += note.child("duration").text().as_double();
        }
        std::vector<double> expected;
        for (const Note& note : list.notes) {
            if (note.voice == 1) expected.push_back(static_cast<double>(note.onset));
        }
        EXPECT_EQ(onsets, expected) << speed;
    }
}

TEST(Arrangement, TracksHaveNames) {
    const auto names = [](const std::string& text) {
        MemoryDestination memory;
        plan_score(read(text), "musicxml", {})->make(memory, "score.musicxml", {});
        pugi::xml_document document;
        document.load_string(memory.take("score.musicxml").c_str());
        std::string all;
        for (const auto& name : document.select_nodes("//part-name"))
            all += std::string(name.node().text().get()) + ";";
        return all;
    };
    EXPECT_EQ(names(track("name = \"Left <&> right\"\n") + track("instrument = \"Flute\"\n")),
              "Left <&> right;Flute;");
}

TEST(Arrangement, EndingsLieWithinTheRange) {
    const auto last_key = [](const std::string& keys) {
        return notes_of(track("form = \"A B2\"\n" + keys, "hilbert")).notes.back().key;
    };
    // The tonic above C6 is one or more periods of 3/1 above C4, not octaves.
    const double twelfth = 12 * std::log2(3.0);
    const double periods = (last_key("scale = \"bohlen-pierce\"\nrange = \"fold C6-A7\"\n") - 60) / twelfth;
    EXPECT_GE(periods, 1);
    EXPECT_NEAR(periods, std::round(periods), 1e-6);
    // The tonic nearest to the end may lie beyond the range; its octave within is the goal then.
    EXPECT_EQ(last_key("range = \"reflect G4-E5\"\n"), 72);
    EXPECT_EQ(last_key("range = \"clamp F3-E4\"\n"), 60);
}

TEST(Arrangement, FormsAreMadeOfSubCurves) {
    const NoteList plain = notes_of(track("", "hilbert"));
    const NoteList formed = notes_of(track("form = \"ABCD\"\n", "hilbert"));
    ASSERT_EQ(formed.notes.size(), plain.notes.size());
    for (std::size_t i = 0; i < plain.notes.size(); ++i) EXPECT_EQ(formed.notes[i].key, plain.notes[i].key);
    const NoteList again = notes_of(track("form = \"AABA\"\n", "hilbert"));
    std::vector<double> first;
    std::vector<double> keys;
    for (const Note& note : again.notes) keys.push_back(note.key);
    for (const Note& note : notes_of(track("form = \"A\"\n", "hilbert")).notes) first.push_back(note.key);
    ASSERT_GT(keys.size(), 3 * first.size());
    EXPECT_TRUE(std::equal(first.begin(), first.end(), keys.begin()));
    EXPECT_TRUE(std::equal(first.begin(), first.end(), keys.begin() + static_cast<std::ptrdiff_t>(first.size())));
    EXPECT_TRUE(std::equal(first.rbegin(), first.rend(), keys.rbegin()));
    // Each section begins at a bar line.
    for (const std::size_t i : {first.size(), 2 * first.size(), again.notes.size() - first.size()}) {
        EXPECT_EQ(again.notes[i].onset % 1920, 0) << i;
    }
    // Endings: the first leads to the fifth, the second to the tonic, and all before them is the same.
    const NoteList endings = notes_of(track("form = \"A1 A2\"\n", "hilbert"));
    keys.clear();
    for (const Note& note : endings.notes) keys.push_back(note.key);
    ASSERT_EQ(keys.size(), 2 * first.size());
    EXPECT_EQ(std::fmod(keys[first.size() - 1], 12), 7);
    EXPECT_EQ(std::fmod(keys.back(), 12), 0);
    EXPECT_TRUE(
        std::equal(keys.begin(), keys.begin() + static_cast<std::ptrdiff_t>(first.size()) - 3, first.begin()));
    for (std::size_t i = keys.size() - 2; i < keys.size(); ++i) EXPECT_LE(std::fabs(keys[i] - keys[i - 1]), 2);
    EXPECT_THROW(notes_of(track("form = \"AZ\"\n", "hilbert")), ScoreError);
    // Order 3 of n = 4 has 4 sub-curves, of n = 5 has 16; the largest are 4 at any n, but at n = 1 there is only one.
    const auto refusal = [](const std::string& text) -> std::string {
        return sikku::error_of<ScoreError>([&] { notes_of(track(text, "hilbert")); }, "none");
    };
    EXPECT_TRUE(has(refusal("form = \"ABCDE order 3\"\n"), "has 4 sub-curves of order 3; n = 5 has enough, and"));
    EXPECT_EQ(refusal("n = 5\nform = \"ABCDE order 3\"\n"), "none");
    EXPECT_TRUE(has(refusal("form = \"ABCDE\"\n"), "has 4 sub-curves of order 3; a lower order"));
    EXPECT_TRUE(has(refusal("n = 1\nform = \"AB\"\n"), "has 1 sub-curve of order 1; n = 2 has enough"));
    EXPECT_EQ(refusal("n = 2\nform = \"AB\"\n"), "none");
    EXPECT_NO_THROW(notes_of(track("form = \"AZ order 1\"\n", "hilbert")));
}

TEST(Arrangement, SectionsFollowTheForm) {
    const NoteList list = notes_of("meter = \"5/8\"\nform = \"A B A2\"\n" + track("section = \"A\"\n") +
                                   track("section = \"B\"\ntransposition = 12\n") + track("loop = \"fill\"\n"));
    EXPECT_EQ(told(list, 0),
              "0:60/240 240:62/240 480:64/240 720:62/480 2400:60/240 2640:64/240 2880:62/240 3120:60/480");
    EXPECT_EQ(told(list, 1), "1200:72/240 1440:74/240 1680:76/240 1920:74/480");
    EXPECT_EQ(list.end, 3600);
    EXPECT_EQ(std::count_if(list.notes.begin(), list.notes.end(), [](const Note& note) { return note.voice == 2; }),
              12);
}

/// The remarks of a score in memory.
std::vector<std::string> remarks_of(const std::string& text, std::string_view format = "mid") {
    MemoryDestination memory;
    std::vector<std::string> remarks;
    for (const Remark& remark : plan_score(read(text), format, {})->make(memory, "score", {}).remarks) {
        if (remark.is_warning) remarks.push_back(remark.text);
    }
    return remarks;
}

/// A of a bar of 4/4, B of one of 3/4 at half the tempo and a tone higher.
const std::string two_sections =
    "tempo = 120\nform = \"A B A\"\n[[section]]\nname = \"B\"\ntempo = \"60 Adagio\"\nmeter = \"3/4\"\ntonic = "
    "\"D4\"\n" +
    track("section = \"A\"\n") + track("section = \"B\"\n");

TEST(Arrangement, SectionsHaveTheirOwnTempoMeterAndKeys) {
    const NoteList list = notes_of(two_sections);
    const std::string a = "0:60/240 240:62/240 480:64/240 720:62/480";
    EXPECT_EQ(told(list, 0), a + " 3360:60/240 3600:62/240 3840:64/240 4080:62/480");
    EXPECT_EQ(told(list, 1), "1920:62/240 2160:64/240 2400:66/240 2640:64/480");
    const SectionChange slow{1920, {60, "Adagio", {3, 4}}};
    const SectionChange back{3360, {120, "", {4, 4}}};
    EXPECT_EQ(list.changes, (std::vector{slow, back}));
    // A track replaces the keys of its section.
    EXPECT_EQ(told(notes_of(two_sections + "tonic = \"E4\"\n"), 1),
              "1920:64/240 2160:66/240 2400:68/240 2640:66/480");
    // Options apply to all sections.
    EXPECT_EQ(notes_of(two_sections, {{"tempo", "90"}}).changes,
              (std::vector<SectionChange>{{1920, {90, "", {3, 4}}}, {3360, {90, "", {4, 4}}}}));
    EXPECT_EQ(notes_of(two_sections, {{"meter", "4/4"}}).changes,
              (std::vector<SectionChange>{{1920, {60, "Adagio", {4, 4}}}, {3840, {120, "", {4, 4}}}}));
    // Neighbouring sections with equal tempo and meter yield no change.
    EXPECT_EQ(notes_of("form = \"A B B A\"\n" + two_sections.substr(two_sections.find("[[section]]"))).changes.size(),
              2u);
    EXPECT_TRUE(notes_of("form = \"B B\"\n[[section]]\nname = \"B\"\ntempo = 60\n" + track("section = \"B\"\n"))
                    .changes.empty());
}

TEST(Arrangement, TheFirstSectionHasItsOwnTempoAndMeter) {
    // 5/8 at 90; the piece, and B, are in 4/4 at 120.
    const std::string first = "[[section]]\nname = \"A\"\ntempo = \"90 Moderato\"\nmeter = \"5/8\"\n";
    const std::string tracks = track("section = \"A\"\n") + track("section = \"B\"\n");
    const NoteList list = notes_of("form = \"A B A A\"\n" + first + tracks);
    EXPECT_EQ(list.tempo, 90);
    EXPECT_EQ(list.meter, (Meter{5, 8}));
    EXPECT_EQ(list.changes,
              (std::vector<SectionChange>{{1200, {120, "", {4, 4}}}, {3120, {90, "Moderato", {5, 8}}}}));
    EXPECT_EQ(told(list, 1), "1200:60/240 1440:62/240 1680:64/240 1920:62/480");
    EXPECT_EQ(list.end, 3120 + 2400);
    const NoteList alone = notes_of("form = \"A\"\n" + first + track("section = \"A\"\n"));
    EXPECT_EQ(alone.tempo, 90);
    EXPECT_EQ(alone.meter, (Meter{5, 8}));
    EXPECT_TRUE(alone.changes.empty());
    EXPECT_EQ(notes_of("form = \"A B\"\n" + first + tracks, {{"from-bar", "2"}}).meter, (Meter{4, 4}));
    EXPECT_TRUE(remarks_of("form = \"A B\"\n" + first + tracks).empty());
}

TEST(Arrangement, ExcerptsBeginWithTheTempoAndMeterOfTheirSection) {
    const NoteList middle = notes_of(two_sections, {{"from-bar", "2"}});
    EXPECT_EQ(middle.tempo, 60);
    EXPECT_EQ(middle.meter, (Meter{3, 4}));
    EXPECT_EQ(told(middle, 1), "0:62/240 240:64/240 480:66/240 720:64/480");
    EXPECT_EQ(middle.changes, (std::vector<SectionChange>{{1440, {120, "", {4, 4}}}}));
    const NoteList one = notes_of(two_sections, {{"from-bar", "2"}, {"bars", "1"}});
    EXPECT_TRUE(one.changes.empty());
    EXPECT_EQ(one.notes.size(), 4u);
    EXPECT_EQ(told(notes_of(two_sections, {{"from-bar", "3"}}), 0), "0:60/240 240:62/240 480:64/240 720:62/480");
    // Two seconds of A, then one at 60.
    EXPECT_EQ(notes_of(two_sections, {{"seconds", "3"}}).end, 1920 + 480);
    EXPECT_EQ(notes_of(two_sections, {{"from-bar", "2"}, {"seconds", "4"}}).end, 1440 + 960);
    EXPECT_THROW(notes_of(two_sections, {{"from-bar", "9000000000000000000"}}), std::runtime_error);
    EXPECT_THROW(notes_of(two_sections, {{"from-bar", "9000000000000"}, {"bars", "9000000000000000000"}}),
                 ScoreError);
}

/// `1920:3/4 1920:1000000`: the meter and tempo events of the first track.
std::string tempos_and_meters(const std::string& midi) {
    std::string text;
    for (const MidiEvent& event : read_midi(midi).events) {
        const auto byte = [&](std::size_t i) { return static_cast<int>(static_cast<unsigned char>(event.data[i])); };
        if (event.status != 0xFF) continue;
        if (event.type == 0x51) text += fmt::format(" {}:{}", event.tick, byte(0) << 16 | byte(1) << 8 | byte(2));
        if (event.type == 0x58) text += fmt::format(" {}:{}/{}", event.tick, byte(0), 1 << byte(1));
    }
    return text;
}

TEST(Arrangement, EveryFormatHasTheTempoAndMeterOfSections) {
    const auto written = [](const std::string& format, const OptionValues& values = {}) {
        MemoryDestination memory;
        plan_score(read(two_sections), format, values)->make(memory, "score", {});
        return memory.take("score");
    };
    const std::string expected = " 0:500000 0:4/4 1920:1000000 1920:3/4 3360:500000 3360:4/4";
    EXPECT_EQ(tempos_and_meters(written("mid")), expected);
    EXPECT_EQ(tempos_and_meters(written("mid", {{"midi-format", "0"}})), expected);
    EXPECT_EQ(tempos_and_meters(written("mid", {{"from-bar", "2"}})), " 0:1000000 0:3/4 1440:500000 1440:4/4");
    // A ritardando slows the tempo of the section down.
    EXPECT_TRUE(tempos_and_meters(written("mid", {{"ending", "ritardando"}}))
                    .ends_with(fmt::format(":{:.0f}", 500000 / 0.6)));
    pugi::xml_document xml;
    ASSERT_TRUE(xml.load_string(written("musicxml").c_str()));
    std::string printed;
    for (const auto& measure : xml.select_nodes("//part[1]/measure")) {
        const pugi::xml_node node = measure.node();
        printed += fmt::format("{}/{} {}{}{}; ", node.select_node("attributes/time/beats").node().text().get(),
                               node.select_node("attributes/time/beat-type").node().text().get(),
                               node.select_node(".//words").node().text().get(),
                               node.select_node(".//per-minute").node().text().get(),
                               node.select_node("barline/bar-style").node().text().get());
    }
    EXPECT_EQ(printed, "4/4 120light-light; 3/4 Adagio 60light-light; 4/4 120light-heavy; ");
    const std::string ly = written("ly");
    EXPECT_TRUE(has(ly, "\\time 3/4 \\tempo \"Adagio\" 4 = 60 ")) << ly;
    EXPECT_TRUE(has(ly, "\\time 4/4 \\tempo 4 = 120 ")) << ly;
    EXPECT_TRUE(has(written("abc"), " [M:3/4] [Q:\"Adagio\" 1/4=60] DEF E2 z || ")) << written("abc");
    EXPECT_TRUE(has(written("sco"), "t 0 120 4 120 4 60 7 60 7 120\n")) << written("sco");
    EXPECT_TRUE(has(written("html"), "\"bars\":[[0,1920],[1920,1440],[3360,1920]]"));
    EXPECT_TRUE(has(written("html"), "\"tempos\":[[1920,0.5],[3360,1]]"));
    // In mini-notation an eighth of B is as long as a quarter of A.
    EXPECT_TRUE(has(written("strudel"), "~@4 d4 e4 f#4 e4@2 ~@7")) << written("strudel");
}

/// The key signatures of the first track, such as `1920:2`; minor keys have an m.
std::string signatures(const std::string& midi) {
    std::string text;
    for (const MidiEvent& event : read_midi(midi).events) {
        if (event.status != 0xFF || event.type != 0x59) continue;
        EXPECT_EQ(event.track, 0);
        text += fmt::format(" {}:{}{}", event.tick, static_cast<int>(static_cast<signed char>(event.data[0])),
                            event.data[1] == 1 ? "m" : "");
    }
    return text;
}

/// The key signatures of an arrangement as a MIDI file.
std::string written_keys(const std::string& text, const OptionValues& values = {}) {
    MemoryDestination memory;
    plan_score(read(text), "mid", values)->make(memory, "score", {});
    const std::string bytes = memory.take("score");
    EXPECT_EQ(midi_faults(bytes), "");
    return signatures(bytes);
}

TEST(Arrangement, MidiHasTheKeysOfSections) {
    const std::string a = track("section = \"A\"\n");
    const std::string b = track("section = \"B\"\n");
    const std::string c = track("section = \"C\"\n");
    // A in C major, B in E flat, C in a scale without a key.
    const std::string keys =
        "[[section]]\nname = \"B\"\ntonic = \"Eb4\"\n[[section]]\nname = \"C\"\nscale = \"whole tone\"\n";
    const std::string all = "form = \"A B B A C B\"\n" + keys + a + b + c;
    EXPECT_EQ(written_keys(all), " 0:0 1920:-3 5760:0 9600:-3");
    EXPECT_EQ(written_keys(all, {{"midi-format", "0"}}), " 0:0 1920:-3 5760:0 9600:-3");
    EXPECT_EQ(written_keys(all, {{"tuning", "mpe"}}), " 0:0 1920:-3 5760:0 9600:-3");
    // Sections with a tempo and a meter of their own, a key of a track, and a minor key.
    EXPECT_EQ(written_keys("form = \"B A\"\n[[section]]\nname = \"B\"\ntempo = 60\nmeter = \"2/4\"\n" + a + b +
                           "tonic = \"F#4\"\nscale = \"minor\"\n"),
              " 0:3m 1920:0");
    // Excerpts begin with the key of their section.
    EXPECT_EQ(written_keys(all, {{"from-bar", "2"}}), " 0:-3 3840:0 7680:-3");
    EXPECT_EQ(written_keys(all, {{"from-bar", "3"}, {"bars", "2"}}), " 0:-3 1920:0");
    EXPECT_EQ(written_keys(all, {{"from-bar", "3"}, {"bars", "1"}}), " 0:-3");
    EXPECT_EQ(written_keys(all, {{"from-bar", "5"}, {"bars", "1"}}), "");
    // The first pitched part of the section decides, not that of the whole piece.
    EXPECT_EQ(written_keys("form = \"A B\"\n" + track("tonic = \"D4\"\nloop = 2\n") + a + b + "tonic = \"A4\"\n" + b),
              " 0:0 1920:3");
    EXPECT_EQ(written_keys("form = \"A A\"\n" + a), " 0:0");
    EXPECT_EQ(written_keys(all, {{"transpose", "2"}}), " 0:2 1920:-1 5760:2 7680:0 9600:-1");
}

TEST(Arrangement, BarsAfterAFormAreRefused) {
    const std::string text = "form = \"A B A\"\n" + track("section = \"A\"\n") + track("section = \"B\"\n");
    // The melodies end in bar 1, the piece in bar 3.
    EXPECT_EQ(error_of([&] {
                  notes_of(text, {{"from-bar", "4"}});
              }),
              "the requested bars contain no notes: the melody ends before them");
    EXPECT_FALSE(notes_of(text, {{"from-bar", "3"}}).notes.empty());
}

TEST(Arrangement, KeysOfSectionsChangeAtBarLinesAfterAnUpbeat) {
    const std::string keys = "[[section]]\nname = \"B\"\ntonic = \"Eb4\"\n";
    const std::string a = track("section = \"A\"\n");
    const std::string b = track("section = \"B\"\n");
    const std::string form = "form = \"A B A\"\n" + keys;
    const std::string upbeat = "upbeat = \"1/8\"\n";
    // Sections last a bar each: the notes of an eighth before it and of four eighths in it.
    for (const std::string& text : {form + a + upbeat + b, form + a + upbeat + b + upbeat}) {
        EXPECT_EQ(written_keys(text), " 0:0 2160:-3 4080:0");
        EXPECT_EQ(written_keys(text, {{"midi-format", "0"}}), " 0:0 2160:-3 4080:0");
        EXPECT_EQ(written_keys(text, {{"tuning", "mpe"}}), " 0:0 2160:-3 4080:0");
        EXPECT_EQ(written_keys(text, {{"from-bar", "2"}}), " 0:-3 1920:0");
        EXPECT_EQ(written_keys(text, {{"from-bar", "3"}, {"bars", "1"}}), " 0:0");
    }
    // An upbeat of B alone sounds in the bar before.
    EXPECT_EQ(written_keys(form + a + b + upbeat), " 0:0 1920:-3 3840:0");
}

TEST(Arrangement, KeysOfSectionsAreChecked) {
    const auto refusal = [](const std::string& keys, const std::string& form = "form = \"A\"\n") {
        return error_of([&] { read(form + "[[section]]\n" + keys + track("section = \"A\"\n")); }, "none");
    };
    EXPECT_EQ(refusal("name = \"A\"\ntempo = 90\n"), "none");
    EXPECT_TRUE(has(refusal("name = \"C\"\ntempo = 90\n"), "a.toml:3:1: section C is not in the form of the piece"))
        << refusal("name = \"C\"\ntempo = 90\n");
    EXPECT_TRUE(has(refusal("tempo = 90\n"), "this section has no name; expected a letter such as name = \"B\""));
    EXPECT_TRUE(has(refusal("name = \"AB\"\n"), "name: expected a letter from A to Z"));
    EXPECT_TRUE(has(refusal("name = \"A\"\n[[section]]\nname = \"A\"\n"), "two sections are named A"));
    EXPECT_TRUE(has(refusal("name = \"A\"\ntempo = \"96 by y 84-108\"\n"),
                    "only the tempo of the whole piece can follow a curve"));
    EXPECT_TRUE(has(refusal("name = \"A\"\nending = \"fermata\"\n"), "ending belongs to the whole piece"));
    EXPECT_TRUE(has(refusal("name = \"A\"\ntmpo = 90\n"), "unknown key 'tmpo'; did you mean 'tempo'?"))
        << refusal("name = \"A\"\ntmpo = 90\n");
    EXPECT_TRUE(has(refusal("name = \"A\"\nn = 3\nfoo = 1\n"), "'n' belongs to a track"));
    EXPECT_TRUE(has(refusal("name = \"A\"\nn = 3\nfoo = 1\n"), "unknown key 'foo'")) << "both";
    EXPECT_TRUE(has(refusal("name = \"A\"\ntempo = 0\n"), "tempo: ")) << refusal("name = \"A\"\ntempo = 0\n");
    EXPECT_TRUE(has(refusal("name = \"A\"\nmeter = \"3/5\"\n"), "meter: "));
    EXPECT_TRUE(
        has(error_of([] { read("section = \"A\"\n" + track("")); }, "none"), "section: expected [[section]] tables"));
}

TEST(Arrangement, RemarksNameTheRangeOfTheTrack) {
    using Remarks = std::vector<std::string>;
    // Degrees 0 1 2 1: C D E D.
    EXPECT_EQ(remarks_of(track("") + track("range = \"reflect C4-D4\"\n")),
              (Remarks{"1 note was beyond C4 to D4 and reflected"}));
    EXPECT_EQ(remarks_of(track("range = \"fold C3-C4\"\ninstrument = \"Violin\"\n") +
                         track("range = \"clamp C4-D4\"\ninstrument = \"Cello\"\n") +
                         track("range = \"fold C3-C4\"\ninstrument = \"Viola\"\n")),
              (Remarks{"6 notes of Violin, Viola were beyond C3 to C4 and folded back",
                       "1 note of Cello was beyond C4 to D4 and held at the last key"}));
    // No octave of D and E lies within: they are not folded.
    EXPECT_EQ(remarks_of(track("range = \"fold C4-C#4\"\n")),
              (Remarks{"3 notes were beyond C4 to Db4 and held at the last key"}));
    EXPECT_EQ(remarks_of(track("transposition = -60\ninstrument = \"Violin\"\n") + track(""), "musicxml"),
              (Remarks{"4 notes were beyond C0 to G9 and folded back",
                       "4 notes lie outside the range of Violin (G3 to G7); the lowest is C0"}));
    // Also where parts are played to their ends before.
    EXPECT_EQ(remarks_of(track("") + track("range = \"fold C3-C4\"\nretrograde = true\n")),
              (Remarks{"3 notes were beyond C3 to C4 and folded back"}));
}

TEST(Arrangement, KeysOfThePieceThatReplaceThoseOfItsPatternsAreReportedOnce) {
    const auto facts = [](const std::string& text) {
        MemoryDestination memory;
        return remarks_of(plan_score(read(text), "mid", {})->make(memory, "score", {}));
    };
    const std::string drone =
        "[[pattern]]\nname = \"drone\"\ntext = \"\"\"\nheading: 0\naxiom: FF\nscale: major\ntonic: C3\nunit: "
        "1/4\n\"\"\"\n";
    const std::string head = "scale = \"dorian\"\ntonic = \"D4\"\n";
    const std::string told = facts(head + drone + track("", "drone") + track("start = 2\n", "drone"));
    EXPECT_TRUE(has(told, "'drone' states scale, tonic itself, but the values above the tracks apply"));
    EXPECT_EQ(told.find("'drone'"), told.rfind("'drone'")) << "once";
    // The track sets the key itself, or the piece sets the same value.
    EXPECT_FALSE(has(facts(head + drone + track("scale = \"minor\"\ntonic = \"C3\"\n", "drone")), "'drone'"));
    EXPECT_FALSE(has(facts("scale = \"major\"\n" + drone + track("", "drone")), "'drone'"));
    // Patterns of other files are meant to be played in the key of the piece.
    EXPECT_FALSE(has(facts(head + track("")), "itself"));
    EXPECT_TRUE(describe_score(read(head + drone + track("", "drone")), {}, {}).starts_with("drone, n = 0\n"));
}

/// Options that a format of scores cannot express change nothing, and a warning says so.
TEST(ScoreOptions, AreAppliedOrReported) {
    const Document document = parse(
        "h.lsys", "axiom: X\nX --> +YF-XFX-FY+\nY --> -XF+YFY+FX-\nderivation length: 2\nangle increment: 90\n");
    const auto warnings_of = [&](const std::string& format, const OptionValues& values) {
        return sikku::warnings_of(remarks_about(scores(), document, format, values));
    };
    // Names of keys contain blanks, those of options dashes.
    EXPECT_EQ(warnings_of("mid", {{"named-notes", "no"}}),
              "'named notes:' has no meaning without `mapping: symbols`\n");
    const OptionValues options = {
        {"midi-format", "0"}, {"tuning", "mts"}, {"humanise", "0.5"}, {"pan", "by x"}, {"controller", "74 by y"}};
    EXPECT_EQ(warnings_of("mid", {{"score", "concert"}}), "'score' has no effect: it applies only to print\n");
    EXPECT_EQ(warnings_of("mid", {{"grace-notes", "true"}}),
              "'grace-notes' has no effect: it applies only to print\n");
    EXPECT_EQ(warnings_of("ly", {{"grace-notes", "true"}, {"gamaka", "kampita all"}}), "");
    EXPECT_EQ(warnings_of("ly", {{"grace-notes", "true"}}),
              "'grace-notes' has no effect: no note has a kampita or a jaru\n");
    for (const char* format : {"musicxml", "ly", "abc"}) {
        EXPECT_EQ(warnings_of(format, {{"score", "concert"}, {"instrument", "clarinet"}}), "");
        EXPECT_EQ(warnings_of(format, {{"score", "concert"}}),
                  "'score' has no effect: no part has a transposing instrument\n");
    }
    for (const char* format : {"mid", "musicxml", "ly", "abc"}) {
        for (const auto& [name, value] : options) {
            const std::string warnings = warnings_of(format, {{name, value}});
            const bool is_told = warnings.find("'" + name + "' has no effect: ") != std::string::npos;
            EXPECT_EQ(is_told, std::string(format) != "mid") << name << " as " << format;
        }
    }
}

TEST(Arrangement, WarnsOfSharedPan) {
    const auto tracks = [](int count, const std::string& keys, const std::string& pattern = "steps") {
        std::string text;
        for (int i = 0; i < count; ++i) text += track(keys, pattern);
        return text;
    };
    using Remarks = std::vector<std::string>;
    const std::string shared = "voices of {} share MIDI channels, and with them pan and controllers";
    const std::string mpe = "; 'tuning' mpe gives each note a channel";
    const std::string pan = "instrument = \"Flute\"\npan = \"by x\"\n";
    EXPECT_EQ(remarks_of(tracks(15, pan)), Remarks());
    EXPECT_EQ(remarks_of(tracks(16, pan)), Remarks({fmt::format(fmt::runtime(shared), "Flute") + mpe}));
    EXPECT_EQ(remarks_of(tracks(16, pan), "musicxml"), Remarks());
    // The flutes have their own, the violins share one.
    EXPECT_EQ(remarks_of(tracks(14, pan) + tracks(2, "instrument = \"Violin\"\n")), Remarks());
    EXPECT_EQ(remarks_of(tracks(14, pan) + tracks(2, "instrument = \"Violin\"\ncontroller = \"74 by y\"\n")),
              Remarks({fmt::format(fmt::runtime(shared), "Violin") + mpe}));
    EXPECT_EQ(remarks_of(tracks(6, pan, "branches")), Remarks({fmt::format(fmt::runtime(shared), "Flute") + mpe}));
    // Drums share one in any case.
    const std::string drums =
        "[[pattern]]\nname = \"drums\"\ntext = \"\"\"\naxiom: kk\nmapping: symbols\ndrum k: bass drum\n\"\"\"\n";
    EXPECT_EQ(remarks_of(drums + tracks(1, pan, "drums")), Remarks());
    EXPECT_EQ(remarks_of(drums + tracks(2, pan, "drums")), Remarks({fmt::format(fmt::runtime(shared), "Drums")}));
}

TEST(Arrangement, TooManyVoicesAreCountedWithTheirCause) {
    const auto error_of = [](const std::string& keys, int tracks, const std::string& pattern = "steps") {
        std::string text;
        for (int i = 0; i < tracks; ++i) text += track(keys, pattern);
        return sikku::error_of([&] { remarks_of(text); });
    };
    const std::string end = " need a MIDI channel for each voice; there are 15 besides drums";
    EXPECT_EQ(error_of("gamaka = \"meend all\"\n", 15), "");
    EXPECT_EQ(error_of("gamaka = \"meend all\"\n", 16), "too many voices: 16 at once; gamakas" + end);
    EXPECT_EQ(error_of("gamaka = \"meend all\"\n", 15, "branches"), "too many voices: 45 at once; gamakas" + end);
    EXPECT_EQ(error_of("scale = \"22-shruti\"\n", 40), "too many voices: 40 at once; notes between the keys" + end);
    EXPECT_EQ(error_of("vertical = \"glissando\"\n", 20), "too many voices: 20 at once; glissandi" + end);
}

pugi::xml_document xml_of(const std::string& text) {
    MemoryDestination memory;
    plan_score(read(text), "musicxml", {})->make(memory, "score.musicxml", {});
    pugi::xml_document document;
    EXPECT_TRUE(document.load_string(memory.take("score.musicxml").c_str()));
    return document;
}

/// The letter of the first note of each bar of a part; `-` for rests.
std::string bars_of(const pugi::xml_document& document, int part) {
    std::string text;
    for (const auto& measure : document.select_nodes(fmt::format("//part[@id='P{}']/measure", part).c_str())) {
        const std::string letter = measure.node().select_node("note/pitch/step").node().child_value();
        text += letter.empty() ? "-" : letter;
    }
    return text;
}

/// `Flute 1, Flute 2`: the names of tracks of a MIDI file, but for the first.
std::string tracks_of(const std::string& midi) {
    std::string names;
    for (const MidiEvent& event : read_midi(midi).events) {
        if (event.status != 0xFF || event.type != 3 || event.track == 0) continue;
        names += (names.empty() ? "" : ", ") + event.data;
    }
    return names;
}

TEST(Arrangement, TracksOfMidiHaveTheNamesOfPrint) {
    const auto names = [](const std::string& text) {
        MemoryDestination memory;
        plan_score(read(text), "mid", {})->make(memory, "score.mid", {});
        return tracks_of(memory.take("score.mid"));
    };
    EXPECT_EQ(names(track("")), "Piano");
    EXPECT_EQ(names(track("name = \"Lead\"\ncanon = \"1 -12, 2 0\"\n") + track("instrument = \"Cello\"\n")),
              "Lead 1, Lead 2, Lead 3, Cello");
    EXPECT_EQ(names(track("", "branches")), "Piano 1, Piano 2");
    EXPECT_EQ(names(track("", "branches") + track("")), "Piano 1.1, Piano 1.2, Piano 2");
    EXPECT_EQ(names(track("instrument = \"Sitar\"\nharmony = \"drone\"\n")), "Sitar 1, Sitar 2.1, Sitar 2.2");
    // Voices that are silent do not count.
    const std::string beat =
        "axiom: [hhhhhhhh][krskks]\nmapping: symbols\nunit: 1/8\ndrum k: bass drum\ndrum s: acoustic snare 1/4\n"
        "drum h: closed hi-hat\nrest r: 1/8\n";
    const Document document = parse("beat.lsys", beat);
    EXPECT_EQ(tracks_of(play(document, "mid")), "Drums 1, Drums 2");
    EXPECT_EQ(tracks_of(play(document, "mid", {{"loop", "2"}})), "Drums 1, Drums 2");
}

TEST(Arrangement, RecipesHaveEachKeyOnce) {
    const auto made = [](const std::string& midi) { return read_midi(midi).made; };
    const std::string values = play(parse("steps.lsys", steps), "mid", {{"unit", "1/4"}, {"transpose", "2"}});
    EXPECT_TRUE(made(values).ends_with(", -n 0 --set unit=1/4 --transpose 2")) << made(values);
    MemoryDestination memory;
    plan_score(read(track("")), "mid", {{"unit", "1/4"}})->make(memory, "score.mid", {});
    const std::string arranged = made(memory.take("score.mid"));
    EXPECT_TRUE(arranged.ends_with(", --unit 1/4")) << arranged;
}

TEST(Arrangement, RemarksAboutMovedNotesNameWhatHelps) {
    const auto remark = [](const std::string& text, const OptionValues& values) {
        MemoryDestination memory;
        std::string warnings;
        const Document document = parse("m.lsys", text);
        for (const Remark& one :
             plan_score(std::span(&document, 1), "ly", values)->make(memory, "m.ly", {}).remarks) {
            if (one.is_warning) warnings += one.text;
        }
        return warnings;
    };
    const std::string moved =
        " not begin or end at a 64th or in a tuplet of 3, 5, 6, 7, 10 or 12 and are written at the nearest 64th";
    const std::string sloped = "heading: 0\nangle increment: 22.5\naxiom: F+F+F-F\n";
    const std::string advice = "; the curve leaves the square grid, where `rhythm: x` makes each step last one unit";
    EXPECT_EQ(remark(sloped, {{"unit", "1/8"}}), "3 notes do" + moved + advice);
    EXPECT_EQ(remark(sloped, {{"unit", "1/8"}, {"rhythm", "x"}}), "");
    EXPECT_TRUE(remark(steps, {{"unit", "1/15"}}).ends_with("; another `unit` such as 1/8 keeps the rhythm"));
    EXPECT_EQ(remark(steps, {{"unit", "1/20"}}), "");
}

TEST(Arrangement, PartsThatTakeTurnsShareAStaff) {
    const std::string flute = "unit = \"1/2\"\ninstrument = \"Flute\"\n";
    const auto names = [](const pugi::xml_document& document) {
        std::string text;
        for (const auto& part : document.select_nodes("//score-part/part-name")) {
            text += std::string(part.node().child_value()) + " ";
        }
        return text;
    };
    // Three bars of C D E D: in halves, two to a bar.
    const std::string sections = "form = \"A B A\"\n" + track(flute + "section = \"A\"\n") +
                                 track(flute + "section = \"B\"\nscale = \"major\"\ntonic = \"A4\"\n") +
                                 track("unit = \"1/2\"\ninstrument = \"Cello\"\nsection = \"A\"\n") +
                                 track(
                                     "unit = \"1/2\"\ninstrument = \"Cello\"\nsection = \"B\"\nstart = 1\n"
                                     "scale = \"major\"\ntonic = \"A2\"\n");
    const pugi::xml_document document = xml_of(sections);
    EXPECT_EQ(names(document), "Flute Cello ");
    EXPECT_EQ(bars_of(document, 1), "CEDACB-CED");
    EXPECT_EQ(bars_of(document, 2), "CED-ACBCED");
    // Both parts change their key where the section begins, though one of them rests there.
    for (const int part : {1, 2}) {
        std::string keys;
        for (const auto& fifths : document.select_nodes(fmt::format("//part[@id='P{}']//fifths", part).c_str())) {
            keys += fmt::format("{}:{} ", fifths.node().parent().parent().parent().attribute("number").value(),
                                fifths.node().child_value());
        }
        EXPECT_EQ(keys, "1:0 4:3 8:0 ");
    }
    EXPECT_EQ(document.select_nodes("//part[@id='P1']//bar-style[text()='light-light']").size(), 2u);
    // What sounds in one bar has staves of its own, and so has another instrument.
    EXPECT_EQ(names(xml_of(track(flute) + track(flute))), "Flute 1 Flute 2 ");
    EXPECT_EQ(names(xml_of(track(flute) + track(flute + "start = 8\n"))), "Flute ");
    EXPECT_EQ(names(xml_of(track(flute) + track("instrument = \"Oboe\"\nstart = 8\n"))), "Flute Oboe ");
    // Two lines of a keyboard are for two hands.
    const pugi::xml_document keyboard = xml_of(track("") + track("transposition = -24\n"));
    EXPECT_EQ(names(keyboard), "Piano ");
    EXPECT_EQ(keyboard.select_node("//staves").node().text().as_int(), 2);
}

TEST(Arrangement, PiecesFromTheMiddle) {
    const std::string text = "meter = \"5/8\"\n" + track("loop = 4\nretrograde = true\n") + track("start = 1\n");
    const NoteList whole = notes_of(text);
    const NoteList piece = notes_of(text, {{"from-bar", "2"}, {"bars", "1"}});
    std::vector<std::tuple<std::int64_t, int, double>> expected;
    std::vector<std::tuple<std::int64_t, int, double>> found;
    for (const Note& note : whole.notes) {
        if (note.onset >= 1200 && note.onset < 2400) expected.emplace_back(note.onset - 1200, note.voice, note.key);
    }
    for (const Note& note : piece.notes) found.emplace_back(note.onset, note.voice, note.key);
    EXPECT_EQ(found, expected);
}

TEST(Arrangement, TheTextContainsEveryPattern) {
    const Arrangement first =
        read("title = \"x\"\n# a remark\n" + track("n = 3\n", "hilbert") + track("start = 1\n"));
    const auto nothing = [](const std::string&) -> NamedPattern { throw std::runtime_error("not needed"); };
    const Arrangement second = read_arrangement("b.toml", first.text, nothing);
    EXPECT_EQ(second.text, first.text);
    EXPECT_TRUE(has(first.text, "# a remark"));
    EXPECT_EQ(told(list_notes(first, {}, {})), told(list_notes(second, {}, {})));
    // Patterns with any letters.
    for (const std::string& odd : {std::string("axiom: F\n// '''\n"), std::string("axiom: F\r\n"),
                                   std::string("// \x01 \"\\\naxiom: F\n"), std::string("\naxiom: F'")}) {
        const Document document = parse("odd \"name\"", odd);
        const std::vector<Document> two = {document, document.with({part_setting("start", "2")})};
        const Arrangement stored = arrangement_of(two);
        const Arrangement again = read_arrangement("c.toml", stored.text, nothing);
        EXPECT_EQ(again.tracks.front().document.source().text(), odd);
        EXPECT_EQ(again.tracks.back().document.text("start"), "2");
    }
}

TEST(Arrangement, EveryScoreContainsIt) {
    const Arrangement piece =
        read("title = \"A \\\"piece\\\" #(ly:exit) \\\\ } % --> ]]>\"\ntempo = 100\nscale = \"dorian\"\n" +
             track("n = 3\n", "hilbert") +
             track("start = 1\ninversion = true\nloop = \"fill\"\ncounterpoint = \"strict\"\n"));
    for (const std::string format : {"mid", "musicxml", "mxl", "ly", "abc", "csd", "sco", "strudel", "svg", "html"}) {
        const MadeWork made = made_work([&](MemoryDestination& memory) {
            return plan_score(piece, format, {})->make(memory, "x." + format, {});
        });
        EXPECT_TRUE(has(made.remarks, "counterpoint: ")) << format;
        EXPECT_EQ(try_show(made.bytes()), piece.text) << format;
    }
}

TEST(Arrangement, MistakesHavePlaces) {
    const auto refused = [](const std::string& text, std::string_view message) {
        EXPECT_TRUE(has(error_of<std::runtime_error>([&] { notes_of(text); }), message));
    };
    refused("", "a.toml: an arrangement has at least one [[track]]");
    refused("format = \"mid\"\n[[item]]\npattern = \"steps\"\n", "a.toml:2:3: a gallery file has [[item]]");
    refused("titel = \"x\"\n" + track(""), "a.toml:1:1: unknown key 'titel'; did you mean 'title'?");
    refused(track("strat = 2\n"), "a.toml:3:1: unknown key 'strat'; did you mean 'start'?");
    refused(track("tempo = 90\n"), "a.toml:3:1: tempo belongs to the whole piece");
    refused("tempo = 0\n" + track(""), "a.toml:1:1: tempo: expected quarter notes a minute");
    refused(track("tempo-ratio = \"0:1\"\n"), "a.toml:3:1: speed: expected a ratio");
    refused(track("speed = \"3:0\"\n"), "expected a ratio");
    refused(track("augmentation = 0\n"), "augmentation: expected how many times longer");
    refused(track("augmentation = \"1/64\"\nunit = \"1/64\"\n"), "no whole numbers of ticks");
    refused(track("loop = 0\n"), "loop: expected how often");
    refused(track("loop = -3\n"), "loop: expected how often");
    for (const char* rhythm :
         {"", "~", "~~~~", "E(0,0)", "E(0,8)", "E(3,0)", "E(1,1000000000)", "0+0", "4+0", "-4"}) {
        refused(track(fmt::format("rhythm = \"{}\"\n", rhythm)), "a.toml:3:1: rhythm: ");
    }
    for (const char* unit : {"0", "-1/8", "1/0", "0/8", "999999999999/1", "1/999999999999", "1e300", "nan"}) {
        refused(track(fmt::format("unit = \"{}\"\n", unit)), "a.toml:3:1: unit: expected a note value");
    }
    for (const char* tempo : {"0", "-5", "nan", "inf", "1e30"}) {
        refused(fmt::format("tempo = \"{}\"\n", tempo) + track(""),
                "a.toml:1:1: tempo: expected quarter notes a minute");
    }
    for (const char* meter : {"0/4", "4/0", "99999999/4", "-3/4"}) {
        refused(track(fmt::format("meter = \"{}\"\n", meter)), "a.toml:3:1: meter: expected a meter");
    }
    refused(track("canon = \"2 x\"\n"), "canon: expected bars and an interval");
    refused(track("canon = \"" + std::string(100, ',') + "\"\n"), "canon: expected");
    refused(track("name = \"\"\n"), "name: expected a line of 1 to 100 bytes");
    refused(track("name = \"two\\nlines\"\n"), "name: expected a line of 1 to 100 bytes");
    refused(track("form = \"aaba\"\n"), "form: expected the order of sub-curves");
    refused(track("instrument = \"kazooo\"\n"), "a.toml:3:1: instrument: ");
    refused(track("n = -1\n"), "a.toml:3:1: n: expected");
    refused(track("set = { nothing = 1 }\n"), "a.toml:3:");
    refused(track("", "missing"), "a.toml:2:1: no pattern named 'missing'");
    refused(track("", "other.toml"), "a.toml:2:1: other.toml: a track plays a pattern, not another arrangement");
    refused(track("transpos = 2\n"), "a.toml:3:1: unknown key 'transpos'; did you mean 'transpose'?");
    refused("[[track]]\nstart = 1\n", "this track has no pattern");
    // All mistakes are reported by line, those of the head once.
    refused("scale = \"majro\"\ncolour = \"red\"\n" + track("transpos = 2\nunit = 0\n") + track("name = \"\"\n") +
                "[[track]]\npattern = 3.5\nstart = 1\n[[track]]\npattern = []\n",
            "a.toml:1:1: scale: unknown scale 'majro'; did you mean 'major'?\n"
            "a.toml:2:1: unknown key 'colour'\n"
            "a.toml:5:1: unknown key 'transpos'; did you mean 'transpose'?\n"
            "a.toml:6:1: unit: ");
    refused(track("transpos = 2\n", "missing"),
            "a.toml:2:1: no pattern named 'missing'\na.toml:3:1: unknown key 'transpos'");
    refused("[[track]]\ntranspos = 2\npattern = \"missing\"\n",
            "a.toml:2:1: unknown key 'transpos'; did you mean 'transpose'?\na.toml:3:1: no pattern named 'missing'");
    refused("scale = \"majro\"\ncolour = \"red\"\n", "a.toml:2:1: unknown key 'colour'\na.toml: an arrangement has");
    refused("colour = \"red\"\n" + track("variant = \"zz\"\n"),
            "a.toml:1:1: unknown key 'colour'\na.toml:4:1: variant zz: this pattern has no variants");
    refused("colour = \"red\"\n[[pattern]]\nname = \"x\"\ntext = \"axiom: F(\"\n" + track("", "x"),
            "a.toml:1:1: unknown key 'colour'\nx:1:");
    refused("form = \"A\"\n" + track(""), "a.toml:1:1: no track has section A");
    refused(track("section = \"A\"\n"), "section A needs a form above the first track");
    refused("form = \"B\"\n" + track("section = \"A\"\n"), "section A is not in the form");
    refused(track("set = { ending = \"none\" }\n"), "a.toml:3:9: ending belongs to the whole piece");
    refused(track("set = { Tempo = 30 }\n"), "a.toml:3:9: tempo belongs to the whole piece");
    refused(
        "[[pattern]]\nname = \"x\"\ntext = \"axiom: A(1)\\nA(x) --> FA(x+1)\"\n" + track("n = 3\nphrases = 2\n", "x"),
        "a.toml:4:1: phrases need a system without contexts");
    refused(track("n = \"three\"\n"), "a.toml:3:1: n: expected a whole number");
    refused("bpm = 90\n" + track(""), "unknown key 'bpm'; did you mean 'tempo'?");
    refused("track = 3\n", "at least one [[track]]");
    refused("[[pattern]]\nname = \"x\"\n" + track(""), "a [[pattern]] has a name and a text");
    refused("[[pattern]]\nname = \"x\"\ntext = \"axiom: F(\"\n" + track("", "x"), "x:1:");
    std::string many;
    for (int i = 0; i < 501; ++i) many += track("");
    refused(many, "too many tracks");
    std::string million;
    for (int i = 0; i < 1'000'000; ++i) million += "[[track]]\n";
    refused(million, "too many");
}

// ---- strict counterpoint, checked tick by tick

struct Faults {
    int dissonances = 0;
    int parallels = 0;
    int strong = 0;  ///< strong beats on which two voices sound
};

/// Looks at every strong beat and at every tick at which two voices begin notes. @param strong  ticks between strong
/// beats
Faults faults_of(const NoteList& list, std::int64_t strong) {
    std::map<int, std::map<std::int64_t, const Note*>> voices;
    for (const Note& note : list.notes) voices[note.voice][note.onset] = &note;
    const auto sounding = [](const std::map<std::int64_t, const Note*>& voice, std::int64_t tick) -> const Note* {
        for (const auto& [onset, note] : voice) {
            if (onset <= tick && tick < onset + note->duration) return note;
        }
        return nullptr;
    };
    Faults result;
    const std::set<int> consonant = {0, 3, 4, 7, 8, 9};
    for (auto a = voices.begin(); a != voices.end(); ++a) {
        for (auto b = std::next(a); b != voices.end(); ++b) {
            for (std::int64_t tick = 0; tick < list.end; tick += strong) {
                const Note* one = sounding(a->second, tick);
                const Note* other = sounding(b->second, tick);
                if (!one || !other) continue;
                ++result.strong;
                if (!consonant.contains(static_cast<int>(std::abs(one->key - other->key)) % 12)) ++result.dissonances;
            }
            for (auto note = a->second.begin(); note != a->second.end(); ++note) {
                const auto other = b->second.find(note->first);
                if (note == a->second.begin() || other == b->second.end() || other == b->second.begin()) continue;
                const double before = std::abs(std::prev(note)->second->key - std::prev(other)->second->key);
                const double now = std::abs(note->second->key - other->second->key);
                const bool both_move = std::prev(note)->second->key != note->second->key &&
                                       std::prev(other)->second->key != other->second->key;
                const int interval = static_cast<int>(now) % 12;
                if (both_move && (interval == 0 || interval == 7) && static_cast<int>(before) % 12 == interval) {
                    ++result.parallels;
                }
            }
        }
    }
    return result;
}

TEST(Counterpoint, StrictPartsGiveWay) {
    int worst = 0;
    for (const char* second : {"start = 2\n", "inversion = true\n", "retrograde = true\n", "augmentation = 2\n",
                               "start = 1\ntransposition = -12\n", "set = { heading = 90 }\n"}) {
        for (const char* scale : {"major", "dorian", "harmonic minor"}) {
            const std::string head = fmt::format("scale = \"{}\"\n", scale);
            const std::string text = head + track("", "hilbert") + track(second, "hilbert");
            const Faults before = faults_of(notes_of(text), 960);
            const Faults after = faults_of(notes_of(text + "counterpoint = \"strict\"\n"), 960);
            EXPECT_GT(after.strong, 10);
            EXPECT_EQ(after.dissonances, 0) << second << scale;
            EXPECT_EQ(after.parallels, 0) << second << scale;
            worst = std::max(worst, before.dissonances + before.parallels);
        }
    }
    EXPECT_GT(worst, 10) << "there is something to mend";
    // The bass of a melody gives way to it.
    const NoteList bass =
        notes_of(track("harmony = \"bass 2\"\ncounterpoint = \"strict\"\nphrases = \"none\"\n", "hilbert"));
    const Faults with_bass = faults_of(bass, 960);
    EXPECT_EQ(with_bass.parallels, 0);
    // A long note sounds over many strong beats and cannot agree with all that the melody does there.
    EXPECT_LT(with_bass.dissonances, with_bass.strong / 2);
    // The first part stays.
    EXPECT_EQ(told(notes_of(track("counterpoint = \"strict\"\n", "hilbert"))), told(notes_of(track("", "hilbert"))));
}

}  // namespace sikku::arrangement_test
