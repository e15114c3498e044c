#include "music/score/midi_check.h"

#include "tests/files.h"
#include "tests/fuzz/file_targets.h"
#include "tests/midi_tools.h"
#include "tests/program.h"

#include <gtest/gtest.h>

#include <random>
#include <string>
#include <utility>
#include <vector>

namespace sikku::midi_check_test {

// A header of 14 bytes, a conductor whose events begin at byte 22 and fill 19 bytes, a melody that begins at 41, its
// events at 49: two quarters C4 and D4.
const std::string header = midi_chunk("MThd", hex_bytes("0001 0002 01E0"));
const std::string conductor_events = hex_bytes("00 FF51 03 07A120  00 FF58 04 04021808  00 FF2F 00");
const std::string conductor = midi_chunk("MTrk", conductor_events);
const std::string melody_events = hex_bytes("00 90 3C 50  83 60 80 3C 40  00 90 3E 50  83 60 80 3E 40  00 FF 2F 00");

std::string melody(std::string_view digits) {
    return header + conductor + midi_chunk("MTrk", hex_bytes(digits));
}
std::string good_file() {
    return header + conductor + midi_chunk("MTrk", melody_events);
}
std::string with_byte(std::string bytes, std::size_t at, int value) {
    bytes.at(at) = static_cast<char>(value);
    return bytes;
}

constexpr std::size_t melody_at = 41;
constexpr std::size_t events_at = melody_at + 8;

/// A file, and all that is said of it: bytes and pieces of the texts.
struct Case {
    std::string name;
    std::string bytes;
    std::vector<std::pair<std::uint64_t, std::string>> faults;
};

void expect_faults(const Case& expected) {
    const auto faults = check_midi(expected.bytes);
    EXPECT_EQ(faults.size(), expected.faults.size()) << expected.name << "\n" << midi_faults(expected.bytes);
    for (std::size_t i = 0; i < std::min(faults.size(), expected.faults.size()); ++i) {
        EXPECT_EQ(faults[i].at, expected.faults[i].first) << expected.name << ": " << faults[i].what;
        EXPECT_TRUE(has(faults[i].what, expected.faults[i].second))
            << expected.name << ": " << faults[i].what << "\nexpected: " << expected.faults[i].second;
    }
}

TEST(MidiCheck, TempoBelongsToTheFirstTrack) {
    expect_faults({"late tempo",
                   melody("00 FF51 03 03D090  00 90 3C 50  83 60 80 3C 40  00 FF 2F 00"),
                   {{events_at + 1, "track 2, tick 0: a tempo outside the first track"}}});
}

TEST(MidiCheck, AGoodFileHasNoFaults) {
    ASSERT_EQ(conductor.size(), 8u + 19u);
    EXPECT_EQ(header.size() + conductor.size(), melody_at);
    EXPECT_EQ(midi_faults(good_file()), "");
}

TEST(MidiCheck, TheNineteenClassicFaults) {
    const std::string good = good_file();
    std::string long_header = good;
    long_header.replace(0, 14, midi_chunk("MThd", hex_bytes("0001 0002 01E0 CAFE")));
    const std::string alien = header + midi_chunk("XFIH", "anything \xFF\x2F") + conductor + midi_chunk("ABCD", "") +
                              midi_chunk("MTrk", melody_events) + midi_chunk("last", "x");
    const std::string one_note = "00 90 3C 50  83 60 80 3C 40 ";
    const std::vector<Case> cases = {
        {"1 no end-of-track", melody(one_note), {{58, "track 2, tick 480: it has no end-of-track"}}},
        {"2 hanging note",
         melody(one_note + "00 90 3E 50  00 FF 2F 00"),
         {{59, "track 2, tick 480: a note of channel 1, key 62 that does not end"}}},
        {"3 truncated", good.substr(0, 56), {{56, "track 2, tick 0: the file ends within it; 15 bytes missing"}}},
        {"3 truncated between events",
         good.substr(0, 58),
         {{58, "track 2, tick 480: the file ends within it; 13 bytes missing"}}},
        {"4 length too long",
         with_byte(good, melody_at + 7, 100),
         {{45,
           "track 2: its length is given as 100 bytes, but its end-of-track, and with it the file, comes after 22"}}},
        {"4 length too long, a track follows",
         with_byte(good, 21, 19 + 10),
         {{18, "track 1: its length is given as 29 bytes, but its end-of-track comes after 19"}}},
        {"4 length too long by two tracks",
         with_byte(good, 20, 1),
         {{18, "track 1: its length is given as 275 bytes, but its end-of-track comes after 19"}}},
        {"5 length too short",
         with_byte(good, melody_at + 7, 20),
         {{45, "track 2: its length is given as 20 bytes, but its events go on after that"}}},
        {"5 length too short, within an event",
         with_byte(good, melody_at + 7, 7),
         {{45, "track 2: its length is given as 7 bytes"}}},
        {"5 length too short, a track follows",
         with_byte(good, 21, 9),
         {{18, "track 1: its length is given as 9 bytes, but its events go on"}}},
        {"6 running status after meta",
         melody("00 90 3C 50  00 FF 01 01 61  83 60 3C 00  00 3E 50  10 3E 00  00 FF 2F 00"),
         {{60, "track 2, tick 480: data byte 3C where the status of an event is needed: running status ends"}}},
        {"6 running status after sysex",
         melody("00 90 3C 50  00 F0 02 01 F7  83 60 3C 00  00 FF 2F 00"),
         {{60, "running status ends with a meta or sysex event"}}},
        {"7 on before off, same tick",
         melody("00 90 3C 50  83 60 90 3C 50  00 80 3C 40  83 60 80 3C 40  00 FF 2F 00"),
         {{55, "track 2, tick 480: a note-on of channel 1, key 60 before the note-off of the same tick"}}},
        {"8 header says 3 tracks, has 2",
         with_byte(good, 11, 3),
         {{10, "header: it declares 3 tracks, but there are 2"}}},
        {"8 header says 1 track, has 2", with_byte(good, 11, 1), {{10, "it declares 1 track, but there are 2"}}},
        {"9 data byte > 7F", with_byte(good, 52, 0x90), {{52, "track 2, tick 0: data byte 90 is above 7F"}}},
        {"10 two end-of-tracks",
         melody(one_note + "00 FF 2F 00  00 FF 2F 00"),
         {{63, "track 2, tick 480: a second end-of-track"}}},
        {"11 events after end-of-track",
         melody(one_note + "00 FF 2F 00  00 90 3C 50  10 80 3C 40"),
         {{63, "track 2, tick 480: something comes after its end-of-track"}}},
        {"10 and 11",
         melody(one_note + "00 FF 2F 00  00 90 3C 50  00 FF 2F 00"),
         {{63, "something comes after"}, {67, "a second end-of-track"}}},
        {"11 nonsense after end-of-track", melody(one_note + "00 FF 2F 00  80"), {{62, "something comes after"}}},
        {"12 format 0, 2 tracks", with_byte(good, 9, 0), {{8, "header: format 0 has one track, and not 2"}}},
        {"13 five-byte VLQ",
         melody(one_note + "81 80 80 80 00 FF 2F 00"),
         {{58, "a variable-length number of 5 bytes, but 4 is the most"}, {63, "hours after the last event"}}},
        {"13 five-byte VLQ of a small value",
         melody("80 80 80 80 00 90 3C 50  83 60 80 3C 40  00 FF 2F 00"),
         {{49, "a variable-length number of 5 bytes, but 4 is the most"}}},
        {"13 five-byte VLQ as a length",
         melody(one_note + "00 FF 01 80 80 80 80 01 61  00 FF 2F 00"),
         {{61, "a variable-length number of 5 bytes, but 4 is the most"}}},
        {"14 two ons, one off",
         melody("00 90 3C 50  10 90 3C 50  10 80 3C 40  00 FF 2F 00"),
         {{54, "track 2, tick 16: a note-on of channel 1, key 60, which sounds since tick 0"},
          {54, "track 2, tick 16: a note of channel 1, key 60 that does not end"}}},
        {"15 division 0",
         with_byte(with_byte(good, 12, 0), 13, 0),
         {{12, "header: a division of 0 ticks a quarter"}}},
        {"16 end-of-track 77 h later",
         melody(one_note + "FF FF FF 7F FF 2F 00"),
         {{62, "track 2, tick 268435935: its end-of-track comes 77.7 hours after the last event"}}},
        {"17 header of 8 bytes", long_header, {}},
        {"18 alien chunk", alien, {}},
        {"19 tempo 0",
         with_byte(with_byte(with_byte(good, 26, 0), 27, 0), 28, 0),
         {{26, "track 1, tick 0: a tempo of 0 microseconds a quarter"}}}};
    for (const Case& expected : cases) expect_faults(expected);
}

TEST(MidiCheck, AnHourIsCountedInTheLastTempo) {
    // 7200 quarters are an hour at 120 a minute: 3,456,000 ticks.
    EXPECT_EQ(midi_faults(melody("00 90 3C 50  83 60 80 3C 40  81 D2 F8 00 FF 2F 00")), "");
    expect_faults({"a tick more",
                   melody("00 90 3C 50  83 60 80 3C 40  81 D2 F8 01 FF 2F 00"),
                   {{62, "comes 1.0 hours after"}}});
    // At double speed it is half an hour.
    const std::string fast = midi_chunk("MTrk", hex_bytes("00 FF51 03 03D090  00 FF2F 00"));
    const std::string held = midi_chunk("MTrk", hex_bytes("00 90 3C 50  83 60 80 3C 40  81 D2 F8 01 FF 2F 00"));
    EXPECT_EQ(midi_faults(header + fast + held), "");
    // Other tracks go on meanwhile: nothing is silent.
    const std::string slow = hex_bytes("00 90 3C 50  FF FF FF 7F 80 3C 40  00 FF 2F 00");
    EXPECT_EQ(midi_faults(header + midi_chunk("MTrk", hex_bytes("FF FF FF 7F FF 2F 00")) + midi_chunk("MTrk", slow)),
              "");
    // Of SMPTE: 25 frames of 40 ticks are a second; 3,600,000 ticks an hour.
    const std::string smpte = midi_chunk("MThd", hex_bytes("0000 0001 E728"));
    EXPECT_EQ(midi_faults(smpte + midi_chunk("MTrk", hex_bytes("81 DB DD 00 FF 2F 00"))), "");
    EXPECT_NE(midi_faults(smpte + midi_chunk("MTrk", hex_bytes("81 DB DD 01 FF 2F 00"))), "");
}

TEST(MidiCheck, HeadersAndChunks) {
    const std::string good = good_file();
    const std::string rest = good.substr(14);
    const std::vector<Case> cases = {
        {"empty", "", {{0, "this is not a MIDI file: it is empty"}}},
        {"text", "axiom: F\n", {{0, "this is not a MIDI file: it does not begin with MThd"}}},
        {"RIFF", "RIFF\x10", {{0, "this is a RIFF file"}}},
        {"four bytes", "MThd", {{4, "header: the file ends within it"}}},
        {"thirteen bytes", good.substr(0, 13), {{13, "header: the file ends within it"}}},
        {"short header", midi_chunk("MThd", "abcde") + rest, {{4, "header: a length of 5 bytes, but 6 are needed"}}},
        {"huge header", with_byte(good, 4, 0xFF), {{4, "but the file ends after 63"}}},
        {"format 2", with_byte(good, 9, 2), {{8, "format 2"}}},
        {"format 3", with_byte(good, 9, 3), {{8, "format 3, but there are only 0, 1 and 2"}}},
        {"no tracks", header, {{10, "it declares 2 tracks, but there are 0"}}},
        {"no tracks, as told", with_byte(header, 11, 0), {{10, "header: it declares no tracks"}}},
        {"SMPTE of 24 frames", with_byte(with_byte(good, 12, 0xE8), 13, 100), {}},
        {"SMPTE of 29.97 frames", with_byte(with_byte(good, 12, 0xE3), 13, 100), {}},
        {"SMPTE of 26 frames", with_byte(with_byte(good, 12, 0xE6), 13, 100), {{12, "26 SMPTE frames a second"}}},
        {"SMPTE without ticks", with_byte(with_byte(good, 12, 0xE7), 13, 0), {{13, "0 ticks a SMPTE frame"}}},
        {"bytes after the last track", good + "\x01\x02", {{71, "after track 2: 2 bytes that form no chunk"}}},
        {"zeros after the last track", good + std::string(100, '\0'), {{71, "100 bytes that form no chunk"}}},
        {"bytes between tracks",
         header + conductor + std::string(5, '\0') + midi_chunk("MTrk", melody_events),
         {{41, "after track 1: 5 bytes that form no chunk"}}},
        {"bytes after the header",
         header + "\xFF" + good.substr(14),
         {{14, "after the header: 1 byte that forms no chunk"}}},
        {"half a chunk head", good + "MTrk", {{71, "4 bytes that form no chunk"}}},
        {"two files", good + good, {{10, "declares 2 tracks, but there are 4"}, {71, "a second header"}}},
        {"an empty track", header + conductor + midi_chunk("MTrk", ""), {{49, "it has no end-of-track"}}}};
    for (const Case& expected : cases) expect_faults(expected);
}

/// RP-001: an SMPTE offset is a time of a day, at the beginning of the first track.
TEST(MidiCheck, SmpteOffsets) {
    const auto conducted = [](const std::string& events) {
        return header + midi_chunk("MTrk", hex_bytes(events + " 00 FF2F 00")) +
               midi_chunk("MTrk", hex_bytes("00 FF2F 00"));
    };
    const std::size_t at = 14 + 8;
    const std::vector<Case> cases = {
        {"23:59:59, 29 frames", conducted("00 FF 54 05 77 3B 3B 1D 63"), {}},
        {"25:60",
         conducted("00 FF 54 05 79 3C 00 00 00"),
         {{at + 4, "of 25 hours, but 23"}, {at + 5, "of 60 minutes"}}},
        {"60 s", conducted("00 FF 54 05 00 00 3C 00 00"), {{at + 6, "of 60 seconds, but 59"}}},
        {"24 frames of 24",
         conducted("00 FF 54 05 00 00 00 18 64"),
         {{at + 7, "of 24 frames, but 23"}, {at + 8, "of 100 hundredths of a frame"}}},
        {"24 frames of 25", conducted("00 FF 54 05 20 00 00 18 00"), {}},
        {"after an event", conducted("00 C0 05 00 FF 54 05 00 00 00 00 00"), {{at + 4, "an SMPTE offset after the"}}},
        {"in the second track",
         melody("00 FF 54 05 00 00 00 00 00 00 FF 2F 00"),
         {{events_at + 1, "outside the first"}}}};
    for (const Case& expected : cases) expect_faults(expected);
}

TEST(MidiCheck, Events) {
    const std::string end = " 00 FF 2F 00";
    const auto at = [](std::size_t i) { return std::uint64_t{events_at + i}; };
    const std::vector<Case> cases = {
        {"all channel messages",
         melody("00 90 3C 50 00 A0 3C 10 00 B0 07 64 00 C0 05 00 D0 10 00 E0 00 40 10 80 3C 00" + end),
         {}},
        {"running status", melody("00 90 3C 50 10 3C 00 10 3E 50 10 3E 00 00 C0 01 00 02" + end), {}},
        {"velocity 0 ends a note", melody("00 90 3C 50 10 90 3C 00" + end), {}},
        {"note without length",
         melody("00 90 3C 50 00 80 3C 40" + end),
         {{at(1), "a note without length of channel"}}},
        {"note without length, by velocity 0",
         melody("00 95 3C 50 00 95 3C 00" + end),
         {{at(1), "a note without length of channel 6, key 60"}}},
        {"off without on", melody("10 83 3C 40" + end), {{at(1), "tick 16: a note-off of channel 4, key 60, which"}}},
        {"off of another channel",
         melody("00 90 3C 50 10 81 3C 40" + end),
         {{at(1), "that does not end"}, {at(5), "channel 2, key 60, which does not sound"}}},
        {"two overlap",
         melody("00 90 3C 50 10 90 3C 50 10 80 3C 40 10 80 3C 40" + end),
         {{at(5), "which sounds since tick 0"}}},
        {"other keys and channels do not",
         melody("00 90 3C 50 00 91 3C 50 00 90 3D 50 10 80 3C 40 00 81 3C 40 00 80 3D 40" + end),
         {}},
        {"data without status",
         melody("00 3C 50" + end),
         {{at(1), "data byte 3C where the status of an event is needed; the rest of the track is ignored"}}},
        {"undefined status bytes",
         melody("00 F1 10 00 F2 10 20 00 F3 01 00 F4 00 F5 00 F6 00 F8 00 FE" + end),
         {{at(1), "status byte F1, which no"},
          {at(4), "F2"},
          {at(8), "F3"},
          {at(11), "F4"},
          {at(13), "F5"},
          {at(15), "F6"},
          {at(17), "F8"},
          {at(19), "FE"}}},
        {"tempo of 2 bytes", melody("00 FF 51 02 07 A1" + end), {{at(3), "tempo of 2 bytes instead of 3"}}},
        {"time signature of 3 bytes", melody("00 FF 58 03 04 02 18" + end), {{at(3), "time signature of 3 bytes"}}},
        {"time signature of no beats", melody("00 FF 58 04 00 02 18 08" + end), {{at(4), "no beats"}}},
        {"time signature of 1/2^8", melody("00 FF 58 04 04 08 18 08" + end), {{at(5), "units of 1/2^8"}}},
        {"key signature of 3 bytes", melody("00 FF 59 03 00 00 00" + end), {{at(3), "key signature of 3 bytes"}}},
        {"7 flats and 7 sharps", melody("00 FF 59 02 F9 01 00 FF 59 02 07 00" + end), {}},
        {"8 flats", melody("00 FF 59 02 F8 00" + end), {{at(4), "a key signature of -8 fifths"}}},
        {"8 sharps", melody("00 FF 59 02 08 00" + end), {{at(4), "a key signature of 8 fifths"}}},
        {"mode 2", melody("00 FF 59 02 00 02" + end), {{at(5), "mode 2"}}},
        {"end-of-track of 1 byte", melody("00 FF 2F 01 00"), {{at(3), "end-of-track of 1 byte instead of 0"}}},
        {"channel prefix", melody("00 FF 20 01 0F 00 FF 20 01 10" + end), {{at(9), "a channel prefix of 16"}}},
        {"sequence number",
         melody("00 FF 00 02 00 01 00 FF 00 01 00" + end),
         {{at(9), "sequence number of 1 byte instead"}}},
        {"meta of type 80", melody("00 FF 80 00" + end), {{at(2), "type 80"}}},
        {"unknown meta", melody("00 FF 7F 03 41 42 FF 00 FF 60 00" + end), {}},
        {"sysex", melody("00 F0 03 7D 01 F7 00 F7 02 F8 FF" + end), {}},
        {"sysex in packets", melody("00 F0 02 7D 01 10 F7 01 02 10 F7 02 03 F7" + end), {}},
        {"sequence number after an event",
         melody("00 90 3C 50 00 FF 00 02 00 01 10 80 3C 00" + end),
         {{at(5), "track 2, tick 0: a sequence number after the beginning of its track"}}},
        {"sequence number after a rest",
         melody("10 FF 00 02 00 01" + end),
         {{at(1), "track 2, tick 16: a sequence number after the beginning"}}},
        {"sysex without end", melody("00 F0 02 7D 01" + end), {{at(1), "is not ended by F7"}}},
        {"sysex without end, then a note",
         melody("10 F0 02 7D 01 83 60 90 3C 50 10 80 3C 00" + end),
         {{at(1), "track 2, tick 16: a sysex message that is not ended by F7"}}},
        {"sysex without end, another follows",
         melody("00 F0 02 7D 01 00 F0 02 7D F7" + end),
         {{at(1), "is not ended by F7"}}},
        {"byte above 7F in a sysex", melody("00 F0 03 7D 91 F7" + end), {{at(4), "byte 91 within a sysex"}}},
        {"text beyond the chunk", melody("00 FF 01 20 41" + end), {{at(0), "its chunk ends within an event"}}},
        {"delta beyond the chunk", melody("00 FF 01 01 41 81"), {{at(5), "its chunk ends within an event"}}}};
    for (const Case& expected : cases) expect_faults(expected);
}

TEST(MidiCheck, TellsAllFaultsByPlaceAndAtMostFifty) {
    expect_faults(
        {"several",
         with_byte(with_byte(melody("00 90 3C 50 10 81 3C 40 00 FF 59 02 09 00 00 FF 2F 00"), 11, 7), 26, 0),
         {{10, "declares 7"}, {50, "does not end"}, {54, "does not sound"}, {61, "9 fifths"}}});
    std::string many;
    for (int i = 0; i < 1000; ++i) many += "00 80 3C 40 ";
    const auto faults = check_midi(melody(many + "00 FF 2F 00"));
    ASSERT_EQ(faults.size(), most_midi_faults);
    EXPECT_EQ(faults.back().at, events_at + 49 * 4 + 1);
}

TEST(MidiCheck, EveryTruncationIsSeen) {
    const std::string good = good_file();
    for (std::size_t size = 0; size < good.size(); ++size) {
        const auto faults = check_midi(good.substr(0, size));
        EXPECT_FALSE(faults.empty()) << size;
        for (const MidiFault& fault : faults) EXPECT_LE(fault.at, size);
    }
}

/// Anything may come; nothing crashes, and what is told has a place in the file and is in order.
TEST(MidiCheck, MutationsDoNoHarm) {
    std::mt19937 chance(7);
    MidiOptions options{.microtonal = true};
    std::vector<std::string> good = {good_file()};
    for (const Tuning tuning : {Tuning::bend, Tuning::mts}) {
        options.tuning = tuning;
        good.push_back(make_midi(random_midi_score(chance, 3, 40, true), options));
    }
    const auto below = [&](std::size_t end) {
        return std::uniform_int_distribution<std::size_t>(0, end - 1)(chance);
    };
    std::size_t without_fault = 0;
    for (int i = 0; i < 20'000; ++i) {
        std::string bytes = good[below(good.size())];
        for (std::size_t changes = below(4) + 1; changes > 0; --changes) {
            switch (below(6)) {
                case 0:
                    bytes.resize(below(bytes.size()) + 1);
                    break;
                case 1:
                    bytes.erase(below(bytes.size()), below(8));
                    break;
                case 2:
                    bytes.insert(below(bytes.size() + 1), 1, static_cast<char>(below(256)));
                    break;
                case 3:
                    bytes += bytes.substr(below(bytes.size() + 1));
                    break;
                default:
                    if (bytes.empty()) bytes = "M";
                    bytes[below(bytes.size())] ^= static_cast<char>(1 << below(8));
            }
            if (bytes.empty()) bytes = "MThd";
        }
        const auto faults = check_midi(bytes);
        without_fault += faults.empty();
        ASSERT_LE(faults.size(), most_midi_faults);
        for (std::size_t k = 0; k < faults.size(); ++k) {
            ASSERT_LE(faults[k].at, bytes.size());
            ASSERT_FALSE(faults[k].what.empty());
            ASSERT_TRUE(k == 0 || faults[k - 1].at <= faults[k].at);
        }
        ASSERT_NO_THROW(try_midi(bytes));
    }
    // Some flips are in velocities, deltas and texts.
    EXPECT_GT(without_fault, 500u);
    EXPECT_LT(without_fault, 10'000u);
}

TEST(MidiRead, TellsEventsAndNotes) {
    const MidiFile file =
        read_midi(melody("00 FF 03 01 61  00 90 3C 50  83 60 3C 00  00 E0 00 60  00 91 3E 7F  00 90 3E 01  "
                         "10 81 3E 40  10 80 3E 40  00 FF 2F 00"));
    EXPECT_EQ(file.format, 1);
    EXPECT_EQ(file.division, 480);
    EXPECT_EQ(file.declared_tracks, 2);
    EXPECT_EQ(file.ends, (std::vector<std::int64_t>{0, 512}));
    ASSERT_EQ(file.events.size(), 12u);
    EXPECT_EQ(file.events[0], (MidiEvent{0, 0, 23, 0xFF, 0x51, "\x07\xA1\x20"}));
    EXPECT_EQ(file.events[5], (MidiEvent{1, 480, 60, 0x90, -1, std::string("\x3C\0", 2)}));
    ASSERT_EQ(file.notes.size(), 3u);
    const auto expect_note = [&](std::size_t i, std::int64_t onset, std::int64_t duration, int key, double bend,
                                 int velocity, int channel) {
        const MidiNote& note = file.notes[i];
        EXPECT_EQ(note.onset, onset);
        EXPECT_EQ(note.duration, duration);
        EXPECT_EQ(note.key, key);
        EXPECT_DOUBLE_EQ(note.bend, bend);
        EXPECT_EQ(note.velocity, velocity);
        EXPECT_EQ(note.channel, channel);
        EXPECT_EQ(note.track, 1);
    };
    expect_note(0, 0, 480, 60, 0.0, 80, 0);
    expect_note(1, 480, 32, 62, 1.0, 1, 0);  // half of the two semitones that a bend has at first
    expect_note(2, 480, 16, 62, 0.0, 127, 1);
}

TEST(MidiTexts, AreReadFromTheFirstTrackAlone) {
    const auto texts = [](const std::string& bytes) { return read_midi_texts(midi_span(bytes)); };
    const std::string head = hex_bytes("4D 54 68 64 00 00 00 06 00 01 00 02 01 E0");
    const std::string other = hex_bytes("58 46 49 48 00 00 00 02 00 00");
    const std::string first = hex_bytes(
        "4D 54 72 6B 00 00 00 20  00 FF 03 01 61  00 90 3C 50  10 3C 00  00 F0 02 7E F7  "
        "00 FF 01 02 78 0A  00 FF 01 01 79  00 FF 01 01 7A  00 FF 2F 00");
    EXPECT_EQ(texts(head + other + first).pattern, "x\n");
    EXPECT_EQ(texts(head + first).made, "y");
    // What comes after the second text does not matter.
    const std::size_t needed = head.size() + 8 + 5 + 4 + 3 + 5 + 6 + 5;
    for (std::size_t length = 4; length < needed; ++length) {
        if (length != head.size()) {
            EXPECT_THROW(texts((head + first).substr(0, length)), std::runtime_error) << length;
        }
    }
    EXPECT_EQ(texts((head + first).substr(0, needed)).made, "y");
    EXPECT_EQ(texts(head).pattern, "") << "no track";
    const std::string empty = hex_bytes("4D 54 72 6B 00 00 00 04  00 FF 2F 00");
    EXPECT_EQ(texts(head + empty + first).pattern, "") << "the texts of another track";
}

TEST(MidiCheckProgram, TellsFaultsAndExitsWithOne) {
    const ScratchFolder folder;
    const std::string good = folder.write("good.mid", good_file());
    const std::string bad = folder.write("bad.MID", with_byte(good_file(), 11, 3));
    Outcome outcome = run({"check", good});
    EXPECT_EQ(outcome.status, 0) << outcome.errors;
    EXPECT_EQ(outcome.output + outcome.errors, "");
    const std::string songs = folder.write("songs.mid", with_byte(good_file(), 9, 2));
    outcome = run({"check", songs});
    EXPECT_EQ(outcome.status, 0) << outcome.errors;
    EXPECT_TRUE(has(outcome.output, "byte 8: warning: header: format 2"));
    outcome = run({"check", bad, good});
    EXPECT_EQ(outcome.status, 1);
    EXPECT_EQ(outcome.output, bad + ": byte 10: header: it declares 3 tracks, but there are 2\n");
    EXPECT_EQ(outcome.errors, "");
    std::string many;
    for (int i = 0; i < 60; ++i) many += "00 80 3C 40 ";
    outcome = run({"check", folder.write("many.mid", melody(many + "00 FF 2F 00"))});
    EXPECT_EQ(outcome.status, 1);
    EXPECT_TRUE(has(outcome.output, "only the first 50 errors and warnings are listed"));
    outcome = run({"check", folder.file("none.mid")});
    EXPECT_EQ(outcome.status, 2);
    EXPECT_TRUE(has(outcome.errors, "none.mid: No such file or directory"));
    std::filesystem::create_directory(folder / "folder.mid");
    outcome = run({"check", folder.file("folder.mid")});
    EXPECT_EQ(outcome.status, 2);
    EXPECT_TRUE(has(outcome.errors, "folder.mid is a folder"));
}

}  // namespace sikku::midi_check_test
