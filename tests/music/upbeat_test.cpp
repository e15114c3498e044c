// tests/music/upbeat_test.cpp: melodies that begin before the first bar line.
#include "music/arrangement.h"
#include "music/scores.h"

#include "music/score/bar_lines.h"
#include "tests/checks.h"
#include "tests/midi_tools.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <map>
#include <string>
#include <tuple>
#include <vector>

namespace sikku::upbeat_test {

const std::string curve =
    "axiom: X\nX --> -YF+XFX+FY-\nY --> +XF-YFY-FX+\nheading: 0\nderivation length: 4\nunit: 1/8\n";
constexpr std::int64_t bar = 1920;

NoteList notes_of(const std::string& text, const OptionValues& values = {}) {
    const Document document = parse("u.lsys", text);
    return list_notes({&document, 1}, values, {});
}

using Told = std::vector<std::tuple<std::int64_t, std::int64_t, int, double, int>>;
/// Notes from a tick on, moved by some ticks.
Told told(const std::vector<Note>& notes, std::int64_t from = 0, std::int64_t moved = 0) {
    Told all;
    for (const Note& note : notes) {
        if (note.onset < from) continue;
        all.emplace_back(note.onset + moved, note.onset + note.duration + moved, note.voice, note.key, note.velocity);
    }
    std::sort(all.begin(), all.end());
    return all;
}

TEST(Upbeat, BarLinesAreCountedFromTheFirstFullBar) {
    const BarLines bars({4, 4, {}}, {}, 480);
    EXPECT_EQ(bars.upbeat(), 480);
    // Naively: bar lines at 0, 480, 2400, 4320, …
    for (std::int64_t tick = 0; tick < 5 * bar; tick += 30) {
        const std::int64_t full = tick < 480 ? -1 : (tick - 480) / bar;
        const std::int64_t begin = 480 + full * bar;
        EXPECT_EQ(bars.number(tick), full + 1) << tick;
        EXPECT_EQ(bars.printed_number(tick), full + 1) << tick;
        EXPECT_EQ(bars.begin(tick), begin) << tick;
        EXPECT_EQ(bars.end(tick), begin + bar) << tick;
        EXPECT_EQ(bars.place(tick), tick - begin) << tick;
        EXPECT_EQ(bars.written(tick), full < 0 ? 480 : bar) << tick;
        EXPECT_EQ(bars.next(tick), tick == 0 || tick == begin ? tick : begin + bar) << tick;
    }
    EXPECT_EQ(bars.onset(0), 0);
    EXPECT_EQ(bars.onset(1), 480);
    EXPECT_EQ(bars.onset(3), 480 + 2 * bar);
    EXPECT_EQ(bars.from(480).upbeat(), 0);
    EXPECT_EQ(BarLines({4, 4, {}}).printed_number(0), 1);
}

/// The same melody after a rest that fills the rest of the first bar: a second way to place an upbeat.
TEST(Upbeat, IsTheEndOfABarThatBeginsWithARest) {
    const std::string table = "axiom: {}\nmapping: symbols\nnamed notes: yes\nunit: 1/8\nrest R: {}\n";
    const std::string words = "C4D4E4F4G4A4B4C5B4A4G4F4E4D4C4D4E4G4E4C4D4F4E4D4C4D4B3C4";
    struct Case {
        std::string plain, rested;  // keys
    };
    for (const Case& keys :
         {Case{"", ""},
          {"swing: 66\n", "swing: 66\n"},
          {"articulation: detached\n", "articulation: detached\n"},
          {"harmony: drone\n", "harmony: drone\n"},
          {"harmony: triads\naccompaniment: oom-pah\n", "harmony: triads\naccompaniment: oom-pah\n"},
          // The rest takes the last chord.
          {"harmony: progression I-IV-V7\n", "harmony: progression V7-I-IV\n"},
          {"harmony: progression I-IV-V7\naccompaniment: walking bass\n",
           "harmony: progression V7-I-IV\naccompaniment: walking bass\n"},
          {"velocity: by length\n", "velocity: by length\n"}}) {
        for (const auto& [meter, length] : {std::pair("4/4", 1920), std::pair("3/4", 1440), std::pair("7/8", 1680)}) {
            for (const int eighths : {1, 2, 5}) {
                const int rest = length / 240 - eighths;
                const std::string more = fmt::format("meter: {}\n", meter);
                const NoteList list = notes_of(fmt::format(fmt::runtime(table), words, "1/8") + more + keys.plain +
                                               fmt::format("upbeat: {}/8\n", eighths));
                const NoteList rested = notes_of(
                    fmt::format(fmt::runtime(table), "R" + words, fmt::format("{}/8", rest)) + more + keys.rested);
                // The chords of triads change their position from bar to bar: only their bass is compared.
                const int highest = keys.plain.find("triads") != std::string::npos ? 1 : 9;
                // Chords of the first bar are not played before an upbeat.
                Told expected, found;
                for (const auto& note : told(rested.notes, 0, -240 * rest)) {
                    const bool is_early = std::get<2>(note) > 0 && std::get<0>(note) < eighths * 240;
                    if (!is_early && std::get<2>(note) <= highest) expected.push_back(note);
                }
                for (const auto& note : told(list.notes)) {
                    if (std::get<2>(note) <= highest) found.push_back(note);
                }
                EXPECT_EQ(found, expected) << keys.plain << meter << eighths;
                EXPECT_GT(expected.size(), 20u);
            }
        }
    }
}

TEST(Upbeat, LeavesTheNotesOfACurveWhereTheyAre) {
    const NoteList plain = notes_of(curve);
    EXPECT_EQ(told(notes_of(curve + "upbeat: 1/4\n").notes), told(plain.notes));
    // Phrases that breathe to the bar end where the next upbeat begins.
    const std::string phrases = curve + "phrases: 2\nbreath: bar\n";
    EXPECT_EQ(told(notes_of(phrases + "upbeat: 3/8\n").notes), told(notes_of(phrases).notes));
    // Sections of a form begin with the upbeat.
    const std::string form = curve + "phrases: 2\nform: A B2 A+1\n";
    EXPECT_EQ(told(notes_of(form + "upbeat: 1/8\n").notes), told(notes_of(form).notes));
}

TEST(Upbeat, AKorvaiEndsOnTheDownbeat) {
    for (const int eighths : {0, 1, 2, 3, 6}) {
        const std::string upbeat = eighths > 0 ? fmt::format("upbeat: {}/8\n", eighths) : "";
        const NoteList list = notes_of(curve + "phrases: 2\nform: A Bk\n" + upbeat);
        const Note last = *std::max_element(list.notes.begin(), list.notes.end(),
                                            [](const Note& a, const Note& b) { return a.onset < b.onset; });
        EXPECT_EQ((last.onset - 240 * eighths) % bar, 0) << eighths;
        EXPECT_EQ(last.duration, bar);
    }
}

TEST(Upbeat, ExcerptsAreCutOutByTheBarsOfPrint) {
    for (const std::string more : {"", "harmony: progression I-IV-V7-I\naccompaniment: oom-pah\n", "swing: 60\n"}) {
        const std::string text = curve + more + "upbeat: 1/4\n";
        const NoteList whole = notes_of(text);
        const auto window = [&](int from, int bars) {
            return notes_of(text, {{"from-bar", std::to_string(from)}, {"bars", std::to_string(bars)}});
        };
        for (const auto& [from, bars] : {std::pair(1, 2), std::pair(2, 1), std::pair(4, 3), std::pair(9, 2)}) {
            const std::int64_t begin = from == 1 ? 0 : 480 + (from - 1) * bar;
            const std::int64_t end = 480 + (from - 1 + bars) * bar;
            Told expected;
            for (Note note : whole.notes) {
                const std::int64_t note_end = std::min(note.onset + note.duration, end);
                note.onset = std::max(note.onset, begin);
                if (note_end <= note.onset) continue;
                note.duration = note_end - note.onset;
                for (const auto& one : told({note}, 0, -begin)) expected.push_back(one);
            }
            std::sort(expected.begin(), expected.end());
            EXPECT_EQ(told(window(from, bars).notes), expected) << more << from;
        }
        // The key counts bars in the same way.
        EXPECT_EQ(told(notes_of(text + "excerpt: 4-6\n").notes), told(window(4, 3).notes)) << more;
        EXPECT_EQ(told(notes_of(text + "excerpt: 1-2\n").notes), told(window(1, 2).notes)) << more;
    }
}

/// Eight quarters.
const std::string word = "axiom: CDEFGABC\nmapping: symbols\nnamed notes: yes\nunit: 1/4\n";

TEST(Upbeat, BassesAndRepeatedNotesHaveTheirTimesWithoutIt) {
    for (const std::string keys :
         {"harmony: bass\n", "harmony: bass 1\nphrases: 2\n", "harmony: bass 1\nphrases: 2\nform: A B A\n",
          "harmony: bass 1\nphrases: 2\nbreath: bar\n", "harmony: bass 1\nloop: 2\n"}) {
        EXPECT_EQ(told(notes_of(curve + keys + "upbeat: 1/4\n").notes), told(notes_of(curve + keys).notes)) << keys;
    }
    const auto melody = [](const NoteList& list) {
        std::vector<Note> notes;
        std::copy_if(list.notes.begin(), list.notes.end(), std::back_inserter(notes),
                     [](const Note& note) { return note.voice == 0; });
        return told(notes);
    };
    for (const std::string harmony : {"", "harmony: triads\n", "harmony: drone\n", "harmony: progression I-IV-V-I\n",
                                      "harmony: progression I-IV-V-I\naccompaniment: walking bass\n"}) {
        const std::string text = word + harmony + "loop: 3\n";
        EXPECT_EQ(melody(notes_of(text + "upbeat: 1/4\n")), melody(notes_of(word + "loop: 3\n"))) << harmony;
    }
}

TEST(Upbeat, ADroneIsHeldThroughTheUpbeatsOfRepetitions) {
    const NoteList list = notes_of(word + "harmony: drone\nloop: 3\nupbeat: 1/4\n");
    std::int64_t held_until = 480;
    for (const Note& note : list.notes) {
        if (note.voice != 1) continue;
        EXPECT_EQ(note.onset, held_until);
        held_until = note.onset + note.duration;
    }
    EXPECT_EQ(held_until, 3 * 3840);
}

/// The chords of a form with an upbeat.
std::vector<Note> chords_of(const std::string& text, const OptionValues& values) {
    std::vector<Note> chords = notes_of(text, values).notes;
    std::erase_if(chords, [](const Note& note) { return note.voice == 0; });
    EXPECT_GT(chords.size(), 4u) << text;
    return chords;
}

TEST(Upbeat, ChordsChangeAtBarLines) {
    for (const std::string form : {"A B A", "A Ac", "A A*2 B", "A A/2 B"}) {
        for (const int eighths : {1, 2, 4, 6}) {
            const std::string text = curve + "phrases: 2\nharmony: progression I-IV-V-I\nform: " + form +
                                     fmt::format("\nupbeat: {}/8\n", eighths);
            for (const Note& note : chords_of(text, {})) {
                EXPECT_EQ((note.onset - 240 * eighths) % bar, 0) << text << note.onset;
            }
        }
    }
}

TEST(Upbeat, ChordsOfSectionsDoNotOverlap) {
    const OptionValues longer = {{"unit", "1/4"}};
    for (const std::string form : {"A B A", "A Ac", "A A*2 B", "A A/2 B", "A Ar B", "A Ak B"}) {
        for (const std::string more : {"", "accompaniment: oom-pah\n", "breath: 1/4\n", "breath: bar\n"}) {
            for (const int eighths : {1, 2, 4, 6}) {
                const std::string text = curve + "phrases: 2\nharmony: progression I-IV-V-I\nform: " + form + "\n" +
                                         more + fmt::format("upbeat: {}/8\n", eighths);
                EXPECT_EQ(midi_faults(play(parse("u.lsys", text), "mid", longer)), "");
                std::map<int, std::int64_t> sounds_until;
                for (const Note& note : chords_of(text, longer)) {
                    std::int64_t& until = sounds_until[note.voice];
                    EXPECT_GE(note.onset, until) << text;
                    until = note.onset + note.duration;
                }
            }
        }
    }
}

/// Each note of an augmented section keeps its place from the bar line, stretched.
TEST(Upbeat, AugmentedSectionsStayOnTheBeats) {
    for (const auto& [change, times] : {std::pair("*2", 2.0), std::pair("/2", 0.5)}) {
        const std::string text = curve + "phrases: 2\nupbeat: 1/4\nform: A";
        const Told plain = told(notes_of(text + " A\n").notes);
        const Told changed = told(notes_of(text + " A" + change + "\n").notes);
        ASSERT_EQ(plain.size(), changed.size());
        const std::size_t half = plain.size() / 2;
        for (std::size_t i = 0; i < half; ++i) {
            const std::int64_t line = 480;
            const double from_line = times * static_cast<double>(std::get<0>(plain[i]) - line);
            const double found = static_cast<double>(std::get<0>(changed[half + i]) - line) - from_line;
            EXPECT_EQ(std::fmod(found, bar), 0) << change << i;
            EXPECT_EQ(std::get<3>(changed[half + i]), std::get<3>(plain[i]));
        }
    }
}

NoteList piece_of(const std::string& text) {
    return list_notes(
        read_arrangement("p.toml", text, [](const std::string&) -> NamedPattern { throw ScoreError("none"); }), {},
        {});
}

/// An upbeat that is in some parts and sections only moves all that begins at bar lines together, and nothing else.
TEST(Upbeat, SectionsHaveTheirLengthsWithoutIt) {
    const std::string words = "[[pattern]]\nname = \"a\"\ntext = \"\"\"\n" + word + "\"\"\"\n";
    const auto track = [](const std::string& keys) { return "[[track]]\npattern = \"a\"\n" + keys; };
    const std::string upbeat = "upbeat = \"1/4\"\n";
    struct Case {
        std::string form, first, second, third;  // keys of three tracks, without the upbeats
        int with_upbeat;                         // bits of the tracks that have an upbeat
        std::int64_t opening;                    // ticks before the first bar line
    };
    const std::string a = "section = \"A\"\n", b = "section = \"B\"\n", fill = "loop = \"fill\"\n";
    const std::string common = "loop = \"common\"\n";
    for (const Case& one : {Case{"form = \"ABA\"\n", a, a, b, 1, 480}, Case{"form = \"ABA\"\n", a, a, b, 5, 480},
                            Case{"form = \"ABA\"\n", a, a + fill, b, 1, 480}, Case{"form = \"AB\"\n", a, a, b, 4, 0},
                            Case{"form = \"AB\"\n", a, a + "loop = 2\n", b, 4, 0},
                            Case{"", common, common, common, 1, 480}, Case{"", "", "start = 2\n", "loop = 2\n", 2, 0},
                            Case{"", "start = 2\n", "start = 1\n", "loop = 2\n", 3, 0}}) {
        std::string plain = one.form + words, moved = plain;
        const std::vector<std::string> tracks = {one.first, one.second, one.third};
        for (std::size_t i = 0; i < tracks.size(); ++i) {
            plain += track(tracks[i]);
            moved += track(tracks[i] + ((one.with_upbeat >> i & 1) != 0 ? upbeat : ""));
        }
        // Parts with an upbeat begin that much before the bar line at which they began.
        Told expected;
        for (const auto& [begin, end, voice, key, velocity] : told(piece_of(plain).notes)) {
            const bool is_early = (one.with_upbeat >> voice & 1) != 0;
            const std::int64_t later = one.opening - (is_early ? 480 : 0);
            expected.emplace_back(begin + later, end + later, voice, key, 0);
        }
        Told found;
        for (const auto& [begin, end, voice, key, velocity] : told(piece_of(moved).notes))
            found.emplace_back(begin, end, voice, key, 0);
        std::sort(expected.begin(), expected.end());
        EXPECT_EQ(found, expected) << moved;
        EXPECT_FALSE(found.empty());
    }
}

TEST(Upbeat, RepetitionsOnStageKeepTheMeter) {
    const BarLines bars({4, 4, {}}, {}, 480);
    EXPECT_EQ(bars.next_pass(8 * 480), 8 * 480);
    EXPECT_EQ(bars.next_pass(7 * 480), 8 * 480);
    // The last bar is full: the upbeat follows a bar later.
    EXPECT_EQ(bars.next_pass(9 * 480), 12 * 480);
    EXPECT_EQ(BarLines({4, 4, {}}).next_pass(9 * 480), 12 * 480);
    EXPECT_EQ(bars.printed_onset(0), 0);
    EXPECT_EQ(bars.printed_onset(2), 480 + bar);
    EXPECT_EQ(BarLines({4, 4, {}}).printed_onset(2), bar);
    EXPECT_EQ(BarLines({4, 4, {}}).printed_onset(0), 0);
}

TEST(Upbeat, PartsMeetAtTheFirstBarLine) {
    const auto piece = [](const std::string& keys) {
        return "[[pattern]]\nname = \"a\"\ntext = \"\"\"\naxiom: F+F\n\"\"\"\n[[track]]\npattern = \"a\"\nupbeat = "
               "\"1/4\"\n"
               "[[track]]\npattern = \"a\"\n" +
               keys;
    };
    const auto list = [](const std::string& text) {
        return list_notes(
            read_arrangement("p.toml", text, [](const std::string&) -> NamedPattern { throw ScoreError("none"); }),
            {}, {});
    };
    const auto onset_of = [](const NoteList& notes, int voice) {
        std::int64_t first = INT64_MAX;
        for (const Note& note : notes.notes) {
            if (note.voice == voice) first = std::min(first, note.onset);
        }
        return first;
    };
    EXPECT_EQ(onset_of(list(piece("")), 0), 0);
    EXPECT_EQ(onset_of(list(piece("")), 1), 480);
    EXPECT_EQ(onset_of(list(piece("upbeat = \"1/8\"\n")), 1), 240);
    EXPECT_EQ(onset_of(list(piece("start = 1\n")), 1), 480 + bar);
    EXPECT_EQ(onset_of(list(piece("loop = \"2\"\n")), 1), 480);
    EXPECT_NE(error_of([&] {
                  list("form = \"AB\"\n[[section]]\nname = \"B\"\ntempo = 90\n" + piece("section = \"B\"\n"));
              }),
              "");
}

TEST(Upbeat, IsWrittenAsAShortBar) {
    const Document document = parse("u.lsys", curve + "upbeat: 3/8\nmeter: 6/8\n");
    const auto has = [&](const std::string& format, const std::string& text, const OptionValues& values = {}) {
        return play(document, format, values).find(text) != std::string::npos;
    };
    EXPECT_TRUE(has("musicxml", "<measure number=\"0\" implicit=\"yes\">"));
    EXPECT_TRUE(has("musicxml", "<measure number=\"1\">"));
    EXPECT_TRUE(has("ly", "\\partial 1*3/8"));
    // Only the score that begins with it has one.
    for (const char* format : {"musicxml", "ly"}) {
        EXPECT_FALSE(has(format, "implicit", {{"from-bar", "2"}})) << format;
        EXPECT_FALSE(has(format, "partial", {{"from-bar", "2"}})) << format;
    }
    EXPECT_TRUE(has("musicxml", "<measure number=\"2\">", {{"from-bar", "2"}, {"bars", "1"}}));
    EXPECT_FALSE(has("musicxml", "<measure number=\"3\">", {{"from-bar", "2"}, {"bars", "1"}}));
    // The first meter of a MIDI file is that of the upbeat: 3/8, then 6/8 after 720 ticks.
    const std::string midi = play(document, "mid");
    const std::string first = hex_bytes("00 FF 58 04 03 03 0C 08"), second = hex_bytes("FF 58 04 06 03 0C 08");
    EXPECT_NE(midi.find(first), std::string::npos);
    EXPECT_NE(midi.find(second), std::string::npos);
    EXPECT_EQ(midi_faults(midi), "");
}

TEST(Upbeat, OtherValuesAreRefused) {
    const auto said = [](const std::string& keys) { return error_of([&] { notes_of(curve + keys); }); };
    for (const std::string value : {"1", "4/4", "0", "-1/4", "1/7", "1/12", "x", "1/4 bar", "100000/1"}) {
        EXPECT_NE(said("upbeat: " + value + "\n").find("expected a note value shorter than a bar"), std::string::npos)
            << value;
    }
    EXPECT_NE(said("meter: 5/1\nupbeat: 257/64\n").find("at most 255"), std::string::npos);
    EXPECT_EQ(said("meter: 5/1\nupbeat: 4/1\n"), "");
    EXPECT_NE(said("upbeat: 1/4\nspeed: 3:2\n").find("cannot be combined"), std::string::npos);
    EXPECT_NE(said("upbeat: 1/4\nretrograde: yes\n").find("cannot be combined"), std::string::npos);
    EXPECT_EQ(said("upbeat: none\n"), "");
}

}  // namespace sikku::upbeat_test
