#include "music/score/midi.h"

#include "tests/checks.h"
#include "tests/files.h"
#include "tests/midi_tools.h"
#include "tests/music/midi_size.h"
#include "tests/print_tools.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <random>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace sikku::midi_test {

/// Fails with the message of a ScoreError that holds `part`.
template <typename Work>
void expect_refused(Work&& work, const std::string& part) {
    try {
        work();
        ADD_FAILURE() << "nothing is refused; expected: " << part;
    } catch (const ScoreError& error) {
        EXPECT_TRUE(has(error.what(), part));
    }
}

MidiScore tiny_score() {
    MidiScore score;
    score.head = midi_head();
    score.head.parts.front().key = KeySignature{-3, true};
    score.head.meter = {6, 8};
    score.notes = {midi_note(0, 480, 60), midi_note(480, 96, 62), midi_note(704, 16384, 127, 0, 1)};
    score.end = 20000;
    return score;
}

MidiOptions microtonal(Tuning tuning, int format = 1) {
    MidiOptions options{.format = format, .microtonal = true, .tuning = tuning};
    return options;
}

TEST(Midi, GoldenBytes) {
    EXPECT_EQ(make_midi(tiny_score()), hex_bytes("4D546864 00000006 0001 0002 01E0"
                                                 "4D54726B 00000047"
                                                 "00 FF 03 06 41 20 74 65 73 74"
                                                 "00 FF 01 09 61 78 69 6F 6D 3A 20 46 0A"
                                                 "00 FF 01 11 73 69 6B 6B 75 20 30 2E 31 2E 30 2C 20 2D 6E 20 34"
                                                 "00 FF 51 03 07 A1 20"
                                                 "00 FF 58 04 06 03 0C 08"
                                                 "00 FF 59 02 FD 01"
                                                 "81 9C 20 FF 2F 00"
                                                 "4D54726B 0000002D"
                                                 "00 FF 03 05 46 6C 75 74 65"
                                                 "00 C0 49"
                                                 "00 90 3C 50  83 60 80 3C 40"
                                                 "00 90 3E 50  60 80 3E 40"
                                                 "81 00 90 7F 01  81 80 00 80 7F 40"
                                                 "96 60 FF 2F 00"));
}

TEST(Midi, GoldenBytesOfABend) {
    MidiScore score;
    score.head = midi_head();
    score.head.title.clear();
    score.head.parts.front().name.clear();
    score.notes = {midi_note(0, 10, 60.5), midi_note(10, 10, 60.5), midi_note(30, 10, 62.25), midi_note(40, 1, 62)};
    score.end = 41;
    const std::string bytes = make_midi(score, microtonal(Tuning::bend));
    EXPECT_TRUE(
        bytes.ends_with(hex_bytes("00 B0 65 00  00 B0 64 00  00 B0 06 02  00 B0 26 00  00 B0 65 7F  00 B0 64 7F"
                                  "00 C0 49"
                                  "00 E0 00 30  00 90 3D 50  0A 80 3D 40  00 90 3D 50  0A 80 3D 40"
                                  "0A E0 00 48  00 90 3E 50  0A 80 3E 40"
                                  "00 E0 00 40  00 90 3E 50  01 80 3E 40  00 FF 2F 00")));
    EXPECT_EQ(midi_faults(bytes), "");
}

TEST(Midi, GoldenBytesOfATuning) {
    MidiScore score;
    score.head = midi_head();
    score.head.parts.front().name.clear();
    score.notes = {midi_note(0, 10, 60.5), midi_note(10, 10, 60.5), midi_note(30, 10, 62.25), midi_note(40, 1, 61)};
    score.end = 41;
    const std::string bytes = make_midi(score, microtonal(Tuning::mts));
    EXPECT_TRUE(bytes.ends_with(
        hex_bytes("00 B0 65 00  00 B0 64 04  00 B0 06 00  00 B0 26 00"
                  "00 B0 65 00  00 B0 64 03  00 B0 06 00  00 B0 26 00  00 B0 65 7F  00 B0 64 7F"
                  "00 C0 49"
                  "00 F0 0B 7F 7F 08 02 00 01 3D 3C 40 00 F7  00 90 3D 50  0A 80 3D 40  00 90 3D 50  0A 80 3D 40"
                  "0A F0 0B 7F 7F 08 02 00 01 3E 3E 20 00 F7  00 90 3E 50  0A 80 3E 40"
                  "00 F0 0B 7F 7F 08 02 00 01 3D 3D 00 00 F7  00 90 3D 50  01 80 3D 40  00 FF 2F 00")));
    EXPECT_EQ(midi_faults(bytes), "");
}

TEST(Midi, TextsAreWhole) {
    MidiScore score = tiny_score();
    score.head.title = "சிக்கு கோலம்";
    score.head.pattern.clear();
    for (int i = 0; i < 100'000; ++i) score.head.pattern += "f → \0 \r\n"[i % 11];
    for (const int format : {0, 1}) {
        MidiOptions options{.format = format};
        const std::string bytes = make_midi(score, options);
        const MidiFile file = read_midi(bytes);
        EXPECT_EQ(file.title, score.head.title);
        EXPECT_EQ(file.pattern, score.head.pattern);
        EXPECT_EQ(file.made, score.head.made);
        EXPECT_EQ(midi_faults(bytes), "");
    }
    score.head.pattern.clear();
    EXPECT_EQ(read_midi(make_midi(score)).pattern, "");
    EXPECT_EQ(read_midi(make_midi(score)).made, score.head.made);
}

TEST(Midi, AScoreWithoutNotesIsAFile) {
    MidiScore score;
    score.head = midi_head(3);
    score.end = 1920;
    for (const int format : {0, 1}) {
        MidiOptions options{.format = format};
        const std::string bytes = make_midi(score, options);
        EXPECT_EQ(midi_faults(bytes), "");
        EXPECT_EQ(read_midi(bytes).ends, std::vector<std::int64_t>{1920});
    }
    score.end = 0;
    EXPECT_EQ(midi_faults(make_midi(score)), "");
    score.end = std::int64_t{1} << 28;
    expect_refused([&] { make_midi(score); }, "silence");
    score.end = -1;
    expect_refused([&] { make_midi(score); }, "ends at tick -1");
}

/// What a head can ask for that no file can hold.
TEST(Midi, RefusesHeads) {
    const auto refuse = [](auto&& change, const std::string& part, const MidiOptions& options = {}) {
        MidiScore score = tiny_score();
        change(score.head);
        expect_refused([&] { make_midi(score, options); }, part);
    };
    for (const double tempo : {0.0, -1.0, 3.5, 1.3e8, std::nan(""), HUGE_VAL}) {
        refuse([&](ScoreHead& head) { head.tempo = tempo; }, "tempo");
    }
    for (const Meter meter : {Meter{0, 4}, {256, 4}, {-1, 4}, {4, 0}, {4, 3}, {4, 128}, {4, -4}}) {
        refuse([&](ScoreHead& head) { head.meter = meter; }, "meter");
    }
    refuse([](ScoreHead& head) { head.parts.front().program = 128; }, "program 128");
    refuse([](ScoreHead& head) { head.parts.front().program = -1; }, "program -1");
    refuse([](ScoreHead& head) { head.parts.front().key = KeySignature{8, false}; }, "8 fifths");
    refuse([](ScoreHead& head) { head.title.assign(std::size_t{1} << 28, 'x'); }, "256 MB");
    MidiOptions options{.format = 2};
    refuse([](ScoreHead&) {}, "format 0 or 1, not 2", options);
    options = microtonal(Tuning::bend);
    for (const int range : {0, 25}) {
        options.bend_range = range;
        refuse([](ScoreHead&) {}, "bend range", options);
    }
    // The slowest and the fastest that there are.
    for (const double tempo : {3.58, 6e7}) {
        MidiScore score = tiny_score();
        score.head.tempo = tempo;
        score.end = 17088;
        EXPECT_EQ(midi_faults(make_midi(score)), "");
    }
}

TEST(Midi, RefusesNotes) {
    const auto refuse = [](const std::vector<Note>& notes, const std::string& part) {
        for (const int format : {0, 1}) {
            MidiScore score{.head = midi_head(2), .notes = notes, .end = std::int64_t{1} << 40};
            MidiOptions options{.format = format};
            expect_refused([&] { make_midi(score, options); }, part);
        }
    };
    constexpr auto huge = std::numeric_limits<std::int64_t>::max();
    refuse({midi_note(0, 0, 60)}, "voice 1, tick 0: a note of 0 ticks");
    refuse({midi_note(5, -1, 60)}, "voice 1, tick 5: a note of -1 ticks");
    refuse({midi_note(-1, 1, 60)}, "before the beginning");
    refuse({midi_note(0, 10, 60, 1), midi_note(9, 10, 60, 1)},
           "voice 2, tick 9: a note before the last one ends at 10");
    refuse({midi_note(0, 1, 60, 0, 0)}, "velocity 0");
    refuse({midi_note(0, 1, 60, 0, 128)}, "velocity 128");
    for (const double key : {-0.01, 127.01, std::nan(""), HUGE_VAL, -HUGE_VAL}) {
        refuse({midi_note(0, 1, key)}, "is not within 0 to 127");
    }
    refuse({midi_note(0, 1, 60.5)}, "key 60.5 has a fraction");
    refuse({midi_note(0, 1, 59.994)}, "has a fraction");
    refuse({midi_note(0, 1, 60, 2)}, "voice 3, which no part has");
    refuse({midi_note(0, 1, 60, -1)}, "voice 0, which no part has");
    refuse({midi_note(0, 1 << 28, 60)}, "a note of 268435456 ticks");
    refuse({midi_note(1 << 28, 1, 60)}, "a rest before it of 268435456 ticks");
    refuse({midi_note(0, huge, 60)}, "a note of");
    refuse({midi_note(huge, 1, 60)}, "a rest before it of");
    // The score's end is checked as well.
    refuse({midi_note(0, 1, 60)}, "a MIDI file can tell");
    MidiScore score = tiny_score();
    score.end = 17087;
    expect_refused([&] { make_midi(score); }, "the score ends at tick 17087, but its notes at 17088");
}

TEST(Midi, HalfACentIsNoFraction) {
    MidiScore score = tiny_score();
    score.notes = {midi_note(0, 480, 60.005), midi_note(480, 480, 59.995)};
    score.end = 960;
    const std::string bytes = make_midi(score);
    score.notes = {midi_note(0, 480, 60), midi_note(480, 480, 60)};
    EXPECT_EQ(bytes, make_midi(score));
}

/// Seven bits a byte, built another way than the writer does.
TEST(Midi, DeltasOfEverySize) {
    const std::vector<std::pair<std::int64_t, std::string>> known = {{1, "01"},
                                                                     {0x40, "40"},
                                                                     {0x7F, "7F"},
                                                                     {0x80, "8100"},
                                                                     {0x2000, "C000"},
                                                                     {0x3FFF, "FF7F"},
                                                                     {0x4000, "818000"},
                                                                     {0x100000, "C08000"},
                                                                     {0x1FFFFF, "FFFF7F"},
                                                                     {0x200000, "81808000"},
                                                                     {0x8000000, "C0808000"},
                                                                     {0xFFFFFFF, "FFFFFF7F"}};
    for (const auto& [ticks, digits] : known) {
        MidiScore score{.head = midi_head(), .notes = {midi_note(ticks, ticks, 60)}, .end = 2 * ticks};
        const std::string bytes = make_midi(score);
        EXPECT_TRUE(bytes.ends_with(hex_bytes("00 C0 49" + digits + "90 3C 50" + digits + "80 3C 40 00 FF 2F 00")))
            << ticks;
        EXPECT_EQ(midi_faults(bytes), "");
        EXPECT_EQ(read_midi(bytes).ends.back(), 2 * ticks);
    }
}

TEST(Midi, ChannelsLeaveOutTheDrums) {
    MidiScore score;
    score.head = midi_head(15);
    for (int voice = 14; voice >= 0; --voice) score.notes.push_back(midi_note(0, 480, 60, voice));
    score.end = 480;
    const MidiFile file = read_midi(make_midi(score));
    std::vector<int> channels;
    for (const MidiNote& note : file.notes) channels.push_back(note.channel);
    EXPECT_EQ(channels, (std::vector<int>{0, 1, 2, 3, 4, 5, 6, 7, 8, 10, 11, 12, 13, 14, 15}));
    for (const MidiNote& note : file.notes) EXPECT_EQ(note.channel, midi_channel(note.track - 1));
}

TEST(Midi, OfMoreVoicesFifteenMaySound) {
    MidiScore score;
    score.head = midi_head(40);
    for (int i = 0; i < 15; ++i) score.notes.push_back(midi_note(0, 480, 60, 39 - 2 * i));
    score.end = 480;
    const std::string bytes = make_midi(score);
    EXPECT_EQ(midi_faults(bytes), "");
    const MidiFile file = read_midi(bytes);
    ASSERT_EQ(file.notes.size(), 15u);
    // Tracks are by number, channels by arrival.
    for (const MidiNote& note : file.notes) EXPECT_EQ(note.channel, midi_channel(15 - note.track));
    score.notes.push_back(midi_note(0, 480, 60, 0));
    expect_refused([&] { make_midi(score); }, "too many voices: a MIDI file has channels for 15");
}

TEST(Midi, PartsNameTheirVoices) {
    MidiScore score;
    score.head = midi_head(2);
    Part part;
    part.name = "Bass";
    part.program = 32;
    score.head.parts.push_back(part);
    // The first voice is silent and has no track, so the other needs no number.
    score.notes = {midi_note(0, 480, 60, 2), midi_note(0, 480, 72, 1)};
    score.end = 480;
    for (const auto& [format, type] : {std::pair{1, 3}, {0, 4}}) {
        MidiOptions options{.format = format};
        const MidiFile file = read_midi(make_midi(score, options));
        EXPECT_EQ(file.ends.size(), format == 1 ? 3u : 1u);
        std::vector<std::pair<std::string, int>> found;
        for (const MidiEvent& event : file.events) {
            if (event.type == type && event.data != "A test") found.push_back({event.data, -1});
        }
        std::size_t voice = 0;
        for (const MidiEvent& event : file.events) {
            if ((event.status & 0xF0) == 0xC0) found.at(voice++).second = event.data[0];
        }
        EXPECT_EQ(found, (std::vector<std::pair<std::string, int>>{{"Flute", 73}, {"Bass", 32}}));
    }
}

/// Meta, controllers, program, note-offs, tuning, note-ons.
int rank_of(const MidiEvent& event) {
    if (event.type == 0x2F) return 9;
    switch (event.status & 0xF0) {
        case 0xB0:
            return 1;
        case 0xC0:
            return 2;
        case 0x80:
            return 3;
        case 0xE0:
            return 4;
        case 0x90:
            return 5;
        default:
            return event.status == 0xF0 ? 4 : 0;
    }
}

/// Events by tick and rank, without tracks and places; names of voices differ between formats.
std::vector<MidiEvent> merged(const MidiFile& file) {
    std::vector<MidiEvent> events;
    for (MidiEvent event : file.events) {
        if (event.type == 0x2F) continue;
        if (event.type == 4 || (event.type == 3 && event.track > 0)) event.type = 4;
        event.at = 0;
        events.push_back(event);
    }
    std::stable_sort(events.begin(), events.end(), [](const MidiEvent& a, const MidiEvent& b) {
        return std::pair(a.tick, rank_of(a)) < std::pair(b.tick, rank_of(b));
    });
    for (MidiEvent& event : events) event.track = 0;
    return events;
}

/// How far a bend may be off: half a step of a range of two semitones, and what is left out.
constexpr double bend_tolerance = 0.005 + 1.0 / 8192 + 1e-9;

void expect_notes(const MidiFile& file, const MidiScore& score) {
    const std::vector<Note> expected = by_onset(score.notes);
    ASSERT_EQ(file.notes.size(), expected.size());
    for (std::size_t i = 0; i < expected.size(); ++i) {
        const MidiNote& note = file.notes[i];
        ASSERT_EQ(note.onset, expected[i].onset) << i;
        ASSERT_EQ(note.duration, expected[i].duration) << i;
        ASSERT_EQ(note.channel, midi_channel(expected[i].voice)) << i;
        ASSERT_EQ(note.velocity, expected[i].velocity) << i;
        ASSERT_NEAR(note.key + note.bend, expected[i].key, bend_tolerance) << i;
        ASSERT_LE(std::abs(note.bend), 0.5 + 1e-9) << i;
    }
}

class RandomMidi : public ::testing::TestWithParam<int> {};

TEST_P(RandomMidi, RoundTrip) {
    const int voices = GetParam();
    std::mt19937 chance(static_cast<unsigned>(voices));
    for (int round = 0; round < 12; ++round) {
        const bool has_fractions = round % 3 > 0;
        const MidiScore score = random_midi_score(chance, voices, 1 + round * 60, has_fractions);
        MidiOptions options;
        if (has_fractions) options = microtonal(round % 3 == 1 ? Tuning::bend : Tuning::mts);
        if (round % 4 == 1) options.bend_range = 12;
        const std::string bytes = make_midi(score, options);
        EXPECT_EQ(midi_faults(bytes), "");
        const MidiFile file = read_midi(bytes);
        const double wider = options.bend_range > 2 ? 6.0 / 8192 : 0.0;
        const std::vector<Note> expected = by_onset(score.notes);
        if (wider == 0.0) {
            expect_notes(file, score);
        } else {
            ASSERT_EQ(file.notes.size(), expected.size());
            for (std::size_t i = 0; i < expected.size(); ++i) {
                ASSERT_NEAR(file.notes[i].key + file.notes[i].bend, expected[i].key, bend_tolerance + wider);
            }
        }
        std::set<int> sounding;
        for (const Note& note : score.notes) sounding.insert(note.voice);
        EXPECT_EQ(file.ends, std::vector<std::int64_t>(sounding.size() + 1, score.end));
        EXPECT_LE(bytes.size(), most_midi_bytes(score.notes.size(), score.head, options));

        // Blocks do not matter, nor what the notes of other voices come between.
        EXPECT_EQ(make_midi(score, options, 1), bytes);
        MidiScore sorted = score;
        sorted.notes = by_onset(score.notes);
        EXPECT_EQ(make_midi(sorted, options, 7), bytes);

        // Order at one tick, in each track.
        options.format = 0;
        const std::string single = make_midi(score, options);
        EXPECT_EQ(midi_faults(single), "");
        EXPECT_LE(single.size(), most_midi_bytes(score.notes.size(), score.head, options));
        const MidiFile single_file = read_midi(single);
        EXPECT_EQ(single_file.ends, std::vector<std::int64_t>{score.end});
        for (const MidiFile* each : {&file, &single_file}) {
            for (std::size_t i = 1; i < each->events.size(); ++i) {
                const MidiEvent& before = each->events[i - 1];
                const MidiEvent& event = each->events[i];
                if (before.track != event.track) continue;
                ASSERT_LE(before.tick, event.tick);
                if (before.tick == event.tick) {
                    ASSERT_LE(rank_of(before), rank_of(event)) << event.at;
                }
            }
        }
        EXPECT_EQ(single_file.format, 0);
        EXPECT_EQ(merged(single_file), merged(file));
    }
}

INSTANTIATE_TEST_SUITE_P(Voices, RandomMidi, ::testing::Range(1, 16));

/// Long melodies of the first voice go to the sink while they come.
TEST(Midi, LongMelodiesAreStreamed) {
    std::mt19937 chance(3);
    MidiScore score = random_midi_score(chance, 1, 100'000, false);
    const std::string streamed = make_midi(score);
    ASSERT_GT(streamed.size(), std::size_t{800'000});
    EXPECT_EQ(midi_faults(streamed), "");
    const MidiFile file = read_midi(streamed);
    expect_notes(file, score);
    EXPECT_EQ(make_midi(score, {}, 1), streamed);
    MidiMemory memory;
    const auto writer = write_midi(score.head, memory);
    writer->notes(score.notes);
    EXPECT_GT(memory.bytes().size(), streamed.size() - 100'000) << "most of it is there before the end";
    EXPECT_LE(memory.largest(), std::size_t{1} << 16);

    // The same melody as the second voice waits in memory and comes out the same but for its channel and name.
    MidiScore second = score;
    second.head.parts.front().voices = 2;
    for (Note& note : second.notes) note.voice = 1;
    MidiFile waited = read_midi(make_midi(second));
    ASSERT_EQ(waited.events.size(), file.events.size());
    EXPECT_EQ(waited.ends, file.ends);
    for (std::size_t i = 0; i < file.events.size(); ++i) {
        MidiEvent event = waited.events[i];
        if (event.status < 0xF0) event.status -= 1;
        ASSERT_EQ(event.tick, file.events[i].tick);
        ASSERT_EQ(event.status, file.events[i].status);
        if (event.type != 3) {
            ASSERT_EQ(event.data, file.events[i].data);
        }
    }

    // Streamed or not: other voices, and format 0.
    MidiScore both = random_midi_score(chance, 3, 60'000, true);
    const std::string tracks = make_midi(both, microtonal(Tuning::bend));
    EXPECT_EQ(midi_faults(tracks), "");
    expect_notes(read_midi(tracks), both);
    const std::string single = make_midi(both, microtonal(Tuning::bend, 0));
    EXPECT_EQ(midi_faults(single), "");
    EXPECT_TRUE(merged(read_midi(single)) == merged(read_midi(tracks)));
}

/// Longer than one delta can tell: the melody goes on, the first track ends before.
TEST(Midi, ScoresMayBeLongerThanADelta) {
    MidiScore score;
    score.head = midi_head();
    for (std::int64_t i = 0; i < 3; ++i) score.notes.push_back(midi_note(i * 200'000'000, 200'000'000, 60));
    score.end = 600'000'000;
    for (const int format : {0, 1}) {
        MidiOptions options{.format = format};
        const std::string bytes = make_midi(score, options);
        EXPECT_EQ(midi_faults(bytes), "");
        EXPECT_EQ(read_midi(bytes).ends.back(), score.end);
        expect_notes(read_midi(bytes), score);
    }
    EXPECT_EQ(read_midi(make_midi(score)).ends.front(), (1 << 28) - 1);
}

TEST(Midi, TheForecastIsNearAndNeverTooSmall) {
    MidiScore score;
    score.head = midi_head();
    // The largest: every delta has four bytes, every note another bend.
    for (std::int64_t i = 0; i < 1000; ++i) {
        score.notes.push_back(midi_note(i * 6'000'000 + 3'000'000, 3'000'000, i % 2 == 0 ? 60.25 : 60.0));
    }
    score.end = 6'000'000'000;
    for (const Tuning tuning : {Tuning::bend, Tuning::mts}) {
        const auto most = most_midi_bytes(score.notes.size(), score.head, microtonal(tuning));
        const std::size_t size = make_midi(score, microtonal(tuning)).size();
        EXPECT_LE(size, most);
        EXPECT_GT(size + 2000, most) << "but for what fifteen voices would need";
    }
    EXPECT_EQ(most_midi_bytes(std::numeric_limits<std::uint64_t>::max()), std::numeric_limits<std::uint64_t>::max());
    EXPECT_GT(most_midi_bytes(1'000'000'000), std::uint64_t{14'000'000'000});
}

// --- other people's readers ---------------------------------------------------------------------------------------

TEST(MidiReaders, MidicsvReadsTheTinyScore) {
    NEEDS("midicsv");
    const ScratchFolder folder;
    const ToolOutcome outcome = run_tool("midicsv '" + folder.write("tiny.mid", make_midi(tiny_score())) + "'");
    EXPECT_TRUE(outcome.ok);
    EXPECT_EQ(outcome.text,
              "0, 0, Header, 1, 2, 480\n"
              "1, 0, Start_track\n"
              "1, 0, Title_t, \"A test\"\n"
              "1, 0, Text_t, \"axiom: F\\012\"\n"
              "1, 0, Text_t, \"sikku 0.1.0, -n 4\"\n"
              "1, 0, Tempo, 500000\n"
              "1, 0, Time_signature, 6, 3, 12, 8\n"
              "1, 0, Key_signature, -3, \"minor\"\n"
              "1, 20000, End_track\n"
              "2, 0, Start_track\n"
              "2, 0, Title_t, \"Flute\"\n"
              "2, 0, Program_c, 0, 73\n"
              "2, 0, Note_on_c, 0, 60, 80\n"
              "2, 480, Note_off_c, 0, 60, 64\n"
              "2, 480, Note_on_c, 0, 62, 80\n"
              "2, 576, Note_off_c, 0, 62, 64\n"
              "2, 704, Note_on_c, 0, 127, 1\n"
              "2, 17088, Note_off_c, 0, 127, 64\n"
              "2, 20000, End_track\n"
              "0, 0, End_of_file\n");
}

/// Onset, duration, key, bend, velocity and channel of each note, as mido reads them.
constexpr const char* mido_script = R"(
import sys
import mido

for name in sys.argv[1:]:
    middle = mido.MidiFile(name, clip=False)
    notes = []
    for track in middle.tracks:
        tick, bend, sounding = 0, {}, {}
        for message in track:
            tick += message.time
            if message.type == 'pitchwheel':
                bend[message.channel] = message.pitch
            elif message.type == 'note_on' and message.velocity > 0:
                assert (message.channel, message.note) not in sounding, 'struck twice'
                sounding[message.channel, message.note] = (tick, bend.get(message.channel, 0), message.velocity)
            elif message.type == 'note_off':
                onset, bent, velocity = sounding.pop((message.channel, message.note))
                notes.append((onset, message.channel, message.note, tick - onset, bent, velocity))
        assert not sounding, 'a note does not end'
        assert track[-1].type == 'end_of_track'
    print('file', middle.type, middle.ticks_per_beat, len(middle.tracks), len(notes))
    for note in sorted(notes):
        print(*note)
)";

TEST(MidiReaders, MidoReadsRandomScores) {
    if (!run_tool("/usr/bin/python3 -c 'import mido'").ok) GTEST_SKIP() << "python3-mido is not installed";
    const ScratchFolder folder;
    std::mt19937 chance(11);
    std::vector<MidiScore> scores;
    std::string command = "/usr/bin/python3 '" + folder.write("read.py", mido_script) + "'";
    for (int voices = 1; voices <= 15; ++voices) {
        for (const int format : {0, 1}) {
            scores.push_back(random_midi_score(chance, voices, 100, true));
            command += " '" +
                       folder.write(std::to_string(scores.size()) + ".mid",
                                    make_midi(scores.back(), microtonal(Tuning::bend, format))) +
                       "'";
        }
    }
    const ToolOutcome outcome = run_tool(command);
    ASSERT_TRUE(outcome.ok) << outcome.text.substr(0, 2000);
    std::istringstream text(outcome.text);
    for (std::size_t i = 0; i < scores.size(); ++i) {
        const MidiScore& score = scores[i];
        std::string word;
        int format = -1;
        int division = 0;
        std::size_t tracks = 0;
        std::size_t notes = 0;
        text >> word >> format >> division >> tracks >> notes;
        ASSERT_EQ(word, "file");
        EXPECT_EQ(format, i % 2);
        EXPECT_EQ(division, 480);
        std::set<int> voices;
        for (const Note& note : score.notes) voices.insert(note.voice);
        EXPECT_EQ(tracks, format == 0 ? 1 : voices.size() + 1);
        ASSERT_EQ(notes, score.notes.size());
        for (const Note& note : by_onset(score.notes)) {
            std::int64_t onset = 0;
            std::int64_t duration = 0;
            int channel = 0;
            int key = 0;
            int bend = 0;
            int velocity = 0;
            text >> onset >> channel >> key >> duration >> bend >> velocity;
            ASSERT_EQ(onset, note.onset);
            ASSERT_EQ(duration, note.duration);
            ASSERT_EQ(channel, midi_channel(note.voice));
            ASSERT_EQ(velocity, note.velocity);
            ASSERT_NEAR(key + bend * 2.0 / 8192, note.key, bend_tolerance);
        }
    }
}

/// The strongest pitch near A4, in cents from it: the power at each of many, by Goertzel's recursion.
/// @param samples  at 44100 Hz
double pitch_of(const std::vector<double>& samples) {
    const auto power = [&](double cents) {
        const double factor = 2.0 * std::cos(2.0 * std::acos(-1.0) * 440.0 * std::exp2(cents / 1200.0) / 44100.0);
        double last = 0.0;
        double before = 0.0;
        for (const double sample : samples) before = std::exchange(last, sample + factor * last - before);
        return last * last + before * before - factor * last * before;
    };
    double best = -100.0;
    double most = 0.0;
    for (double cents = -100.0; cents <= 100.0; cents += 1.0) {
        if (const double here = power(cents); here > most) {
            most = here;
            best = cents;
        }
    }
    return best;
}

/// Microtones are where they belong when a synthesizer plays them.
TEST(MidiReaders, FluidsynthSoundsMicrotones) {
    constexpr const char* soundfont = "/usr/share/sounds/sf2/TimGM6mb.sf2";
    if (!has_program("fluidsynth") || !std::filesystem::exists(soundfont)) {
        GTEST_SKIP() << "fluidsynth or timgm6mb-soundfont is not installed";
    }
    const ScratchFolder folder;
    const auto pitch = [&](double key, int voice, Tuning tuning) {
        MidiScore score;
        score.head = midi_head(3);
        score.head.parts.front().program = 79;  // an ocarina: hardly any overtones
        // The note before makes a channel that is bent already.
        score.notes = {midi_note(0, 240, key + 1.25, voice), midi_note(240, 480 * 4, key, voice, 100)};
        score.end = 480 * 5;
        const std::string raw = folder.file("sound.raw");
        const ToolOutcome outcome =
            run_tool("fluidsynth -ni -q -g 2 -r 44100 -R 0 -C 0 -O s16 -T raw -F '" + raw + "' " + soundfont + " '" +
                     folder.write("sound.mid", make_midi(score, microtonal(tuning))) + "'");
        EXPECT_TRUE(outcome.ok) << outcome.text;
        const std::string bytes = contents(raw);
        std::vector<double> samples;
        // The left of two channels, from 0.75 s on for a second, faded in and out.
        constexpr std::size_t count = 44100;
        for (std::size_t i = 0; i < count; ++i) {
            const std::size_t at = 4 * (33075 + i);
            const int value =
                static_cast<unsigned char>(bytes.at(at)) | static_cast<signed char>(bytes.at(at + 1)) * 256;
            samples.push_back(value * std::sin(std::acos(-1.0) * static_cast<double>(i) / count));
        }
        return pitch_of(samples);
    };
    for (const Tuning tuning : {Tuning::bend, Tuning::mts, Tuning::mpe}) {
        const double plain = pitch(69.0, 0, tuning);
        EXPECT_NEAR(plain, 0.0, 5.0);
        EXPECT_NEAR(pitch(69.5, 0, tuning) - plain, 50.0, 2.0);
        EXPECT_NEAR(pitch(68.67, 2, tuning) - plain, -33.0, 2.0);
    }
}

TEST(MidiTempo, FallsTowardsTheEnd) {
    for (const std::int64_t notes : {40, 20'000}) {  // of the longer score, the first track is written before the end
        for (const int format : {0, 1}) {
            MidiScore score;
            score.head.parts.resize(1);
            score.head.ritardando = 3840;
            for (std::int64_t i = 0; i < notes; ++i) score.notes.push_back(midi_note(i * 240, 240, 60, 0));
            score.end = notes * 240;
            MidiOptions options{.format = format};
            const std::string bytes = make_midi(score, options);
            EXPECT_EQ(midi_faults(bytes), "");
            std::vector<std::int64_t> ticks;
            std::vector<int> tempos;
            for (const MidiEvent& event : read_midi(bytes).events) {
                if (event.status != 0xFF || event.type != 0x51) continue;
                int micro = 0;
                for (const char byte : event.data) micro = micro * 256 + static_cast<unsigned char>(byte);
                ticks.push_back(event.tick);
                tempos.push_back(micro);
            }
            ASSERT_EQ(ticks.size(), 9U);
            EXPECT_EQ(ticks[1], score.end - 3840);
            EXPECT_EQ(ticks[8], score.end - 480);
            EXPECT_TRUE(std::is_sorted(tempos.begin(), tempos.end()));
            EXPECT_EQ(tempos.front(), 500'000);
            EXPECT_EQ(tempos.back(), 833'333);
        }
    }
}

}  // namespace sikku::midi_test
