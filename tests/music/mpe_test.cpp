#include "music/score/mpe.h"

#include "music/score/midi.h"
#include "tests/checks.h"
#include "tests/files.h"
#include "tests/midi_tools.h"
#include "tests/music/midi_size.h"
#include "tests/tools.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace sikku::mpe_test {

MidiOptions mpe(int format = 1) {
    MidiOptions options{.format = format, .tuning = Tuning::mpe};
    return options;
}

/// Half a step of a bend over 48 semitones, and half a cent, which counts as none.
constexpr double tolerance = 0.005 + 48.0 / 8192 / 2 + 1e-9;

/// Controllers 101, 100, 6, 38 and 101, 100 of one channel at tick 0, as hexadecimal digits.
std::string parameter(int channel, int number, int value) {
    std::ostringstream text;
    text << std::hex << std::uppercase;
    const auto controller = [&](int which, int amount) {
        text << "00B" << channel << (which < 16 ? "0" : "") << which << (amount < 16 ? "0" : "") << amount;
    };
    controller(101, 0);
    controller(100, number);
    controller(6, value);
    controller(38, 0);
    controller(101, 127);
    controller(100, 127);
    return text.str();
}

/// The configuration message: registered parameter 6 of channel 1 is 15, the number of channels of notes. Then their
/// bends range over 48 semitones. (MIDI Polyphonic Expression 1.0, sections 2.1 and 2.4.)
TEST(Mpe, TheFirstTrackConfiguresTheZone) {
    MidiScore score{.head = midi_head(), .notes = {midi_note(0, 480, 60.5)}, .end = 480};
    std::string digits = parameter(0, 6, 15);
    for (int channel = 1; channel < 16; ++channel) {
        if (channel != 9) digits += parameter(channel, 0, 48);
    }
    // Program, bend of half a semitone (8192 + 8192 / 96 = 8277), note.
    const std::string voice = "00C149 00E15540 00913C50 8360813C40 00FF2F00";
    for (const int format : {0, 1}) {
        const std::string bytes = make_midi(score, mpe(format));
        EXPECT_TRUE(has(bytes, hex_bytes(digits))) << format;
        EXPECT_EQ(bytes.find(hex_bytes("00B06500 00B06406")), bytes.rfind(hex_bytes("00B06500 00B06406")));
        EXPECT_EQ(midi_faults(bytes), "");
    }
    // 60.5 is key 61, a quarter tone lower.
    const std::string lower = "00C149 00E12B3F 00913D50 8360813D4000FF2F00";
    EXPECT_TRUE(make_midi(score, mpe()).ends_with(hex_bytes(lower)));
    score.notes = {midi_note(0, 480, 60.4999)};
    EXPECT_TRUE(make_midi(score, mpe()).ends_with(hex_bytes(voice)));
}

TEST(Mpe, FourteenNotesSoundAtOnce) {
    MidiScore score;
    score.head = midi_head(15);
    for (int voice = 0; voice < most_mpe_notes; ++voice) score.notes.push_back(midi_note(0, 480, 60 + voice, voice));
    score.end = 960;
    std::set<int> channels;
    for (const MidiNote& note : read_midi(make_midi(score, mpe())).notes) channels.insert(note.channel);
    EXPECT_EQ(channels, (std::set<int>{1, 2, 3, 4, 5, 6, 7, 8, 10, 11, 12, 13, 14, 15}));
    score.notes.push_back(midi_note(480, 480, 90, 14));
    EXPECT_EQ(midi_faults(make_midi(score, mpe())), "");
    score.notes.back().onset = 479;
    EXPECT_TRUE(has(error_of<ScoreError>([&] { make_midi(score, mpe()); }), "more than 14 notes at the same time"));
}

/// The release of a note is not bent with the next one.
TEST(Mpe, AChannelRestsForAsLongAsPossible) {
    MidiScore score;
    score.head = midi_head();
    for (int i = 0; i < 50; ++i) score.notes.push_back(midi_note(i * 10, 10, 40 + i));
    score.end = 500;
    const MidiFile file = read_midi(make_midi(score, mpe()));
    for (std::size_t i = 0; i + 14 < file.notes.size(); ++i) {
        EXPECT_EQ(file.notes[i].channel, file.notes[i + 14].channel);
        for (std::size_t later = i + 1; later < i + 14; ++later) {
            EXPECT_NE(file.notes[i].channel, file.notes[later].channel);
        }
    }
}

/// Instruments of synthesizers without MPE are those of the parts.
TEST(Mpe, RandomScoresSoundAsWritten) {
    std::mt19937 chance(5);
    for (int round = 0; round < 40; ++round) {
        const int voices = 1 + round % 13;
        MidiScore score = random_midi_score(chance, voices, 1 + round * 20, round % 3 > 0);
        Part second = score.head.parts.front();
        score.head.parts.front().voices = (voices + 1) / 2;
        second.voices = voices / 2;
        second.program = 32;
        second.key.reset();
        score.head.parts.push_back(second);
        for (const int format : {0, 1}) {
            const std::string bytes = make_midi(score, mpe(format));
            EXPECT_EQ(midi_faults(bytes), "");
            EXPECT_EQ(make_midi(score, mpe(format), 3), bytes);
            EXPECT_LE(bytes.size(), most_midi_bytes(score.notes.size(), score.head, mpe(format)));
            const MidiFile file = read_midi(bytes);
            std::vector<Note> expected = score.notes;
            std::vector<MidiNote> found = file.notes;
            std::sort(expected.begin(), expected.end(), [](const Note& a, const Note& b) {
                return std::tie(a.onset, a.key, a.duration) < std::tie(b.onset, b.key, b.duration);
            });
            std::sort(found.begin(), found.end(), [](const MidiNote& a, const MidiNote& b) {
                return std::pair(a.onset, a.key + a.bend) < std::pair(b.onset, b.key + b.bend);
            });
            ASSERT_EQ(found.size(), expected.size());
            std::map<int, std::int64_t> until;  // of each channel
            for (std::size_t i = 0; i < expected.size(); ++i) {
                ASSERT_EQ(found[i].onset, expected[i].onset);
                ASSERT_NEAR(found[i].key + found[i].bend, expected[i].key, tolerance);
                ASSERT_TRUE(is_mpe_member(found[i].channel));
                ASSERT_GE(found[i].onset, until[found[i].channel]) << "two notes on one channel";
                until[found[i].channel] = found[i].onset + found[i].duration;
            }
            if (format == 1) continue;
            std::map<int, int> programs;
            std::multiset<int> sounding;
            for (const MidiEvent& event : file.events) {
                const int channel = event.status & 0x0F;
                if ((event.status & 0xF0) == 0xC0) programs[channel] = event.data[0];
                if ((event.status & 0xF0) == 0x90) sounding.insert(programs.at(channel));
            }
            const auto of_second =
                static_cast<std::size_t>(std::count_if(score.notes.begin(), score.notes.end(), [&](const Note& note) {
                    return note.voice >= score.head.parts.front().voices;
                }));
            EXPECT_EQ(sounding.count(32), of_second);
            EXPECT_EQ(sounding.count(73), score.notes.size() - of_second);
        }
    }
}

/// Two voices hand a key over at one tick: not on one channel, where the order would be that of the tracks.
TEST(Mpe, AKeyPassesFromVoiceToVoice) {
    MidiScore score;
    score.head = midi_head(14);
    for (int voice = 0; voice < 13; ++voice) score.notes.push_back(midi_note(0, 960, 40 + voice, voice + 1));
    score.notes.push_back(midi_note(0, 480, 39, 13));
    score.notes.back().voice = 0;
    score.notes.push_back(midi_note(480, 480, 39, 0));
    score.end = 960;
    EXPECT_EQ(midi_faults(make_midi(score, mpe())), "");
    MpeChannels channels;
    EXPECT_EQ(channels.take(0, 10, 60, 0), 1);
    for (int channel = 2; channel < 15; ++channel) channels.take(0, 100, 60, channel);
    EXPECT_EQ(channels.take(10, 20, 60, 1), -1);
    EXPECT_EQ(channels.take(10, 20, 61, 1), 1);
    channels.release(1, 15);
    EXPECT_EQ(channels.take(15, 20, 61, 1), 1);
}

/// Onset, channel, key, bend: as mido reads them from a file with its tracks merged.
constexpr const char* script = R"(
import sys
import mido
tick, bend, ranges, parameter, members = 0, {}, {}, {}, 0
for message in mido.merge_tracks(mido.MidiFile(sys.argv[1], clip=False).tracks):
    tick += message.time
    if message.type == 'pitchwheel':
        bend[message.channel] = message.pitch
    elif message.type == 'control_change':
        c = message.channel
        if message.control in (100, 101):
            parameter.setdefault(c, {})[message.control] = message.value
        elif message.control == 6 and parameter[c] == {101: 0, 100: 0}:
            ranges[c] = message.value
        elif message.control == 6 and parameter[c] == {101: 0, 100: 6}:
            assert c == 0
            members = message.value
    elif message.type == 'note_on' and message.velocity > 0:
        c = message.channel
        print(tick, c, message.note + bend[c] / 8192 * ranges[c])
assert members == 15
)";

TEST(MpeReaders, MidoHearsTheSamePitches) {
    if (!run_tool("/usr/bin/python3 -c 'import mido'").ok) GTEST_SKIP() << "python3-mido is not installed";
    const ScratchFolder folder;
    std::mt19937 chance(6);
    for (const int format : {0, 1}) {
        const MidiScore score = random_midi_score(chance, 9, 500, true);
        const std::string file = folder.write("x.mid", make_midi(score, mpe(format)));
        const ToolOutcome outcome =
            run_tool("/usr/bin/python3 '" + folder.write("read.py", script) + "' '" + file + "'");
        ASSERT_TRUE(outcome.ok) << outcome.text;
        std::istringstream text(outcome.text);
        std::vector<std::pair<std::int64_t, double>> found;
        std::int64_t onset = 0;
        int channel = 0;
        double key = 0;
        while (text >> onset >> channel >> key) found.emplace_back(onset, key);
        std::vector<std::pair<std::int64_t, double>> expected;
        for (const Note& note : score.notes) expected.emplace_back(note.onset, note.key);
        std::sort(found.begin(), found.end());
        std::sort(expected.begin(), expected.end());
        ASSERT_EQ(found.size(), expected.size());
        for (std::size_t i = 0; i < found.size(); ++i) {
            EXPECT_EQ(found[i].first, expected[i].first);
            EXPECT_NEAR(found[i].second, expected[i].second, tolerance);
        }
    }
}

}  // namespace sikku::mpe_test
