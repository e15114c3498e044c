// music/midi_check.h: what is wrong with a MIDI file, and what is in it.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace sikku {

/// One thing wrong at one byte, counted from 0. The text names track (from 1), tick and channel (from 1).
struct MidiFault {
    std::uint64_t at = 0;
    std::string what;
};

constexpr std::size_t most_midi_faults = 50;

/// Every fault of a Standard MIDI File that can be told from its bytes, by place; after the 50th it stops looking.
///
/// Stricter than any program that plays: what the format forbids is a fault, and so is what some programs stumble
/// over or nobody can have meant: format 2, notes without length, a key that is struck while it sounds, a note-on
/// before the note-off of the same key at one tick, notes that do not end, an end-of-track an hour after the last
/// event. Longer headers and chunks of other kinds are legal. After a fault it goes on where that makes sense: a
/// chunk whose length is wrong is read up to its end-of-track, a data byte above 127 counts as data.
/// Cost: one pass; memory only for notes that sound.
std::vector<MidiFault> check_midi(std::span<const std::uint8_t> bytes);

/// One event.
struct MidiEvent {
    int track = 0;          ///< counted from 0
    std::int64_t tick = 0;  ///< from the beginning
    std::uint64_t at = 0;   ///< the byte where it begins, after its delta
    int status = 0;         ///< 0x80 to 0xEF with the channel, 0xF0, 0xF7 or 0xFF (meta)
    int type = -1;          ///< of a meta event
    std::string data;       ///< without status, type and length
    bool operator==(const MidiEvent&) const = default;
};

/// A note as it sounds.
struct MidiNote {
    std::int64_t onset = 0;
    std::int64_t duration = 0;
    int key = 0;
    double bend = 0.0;  ///< semitones above the key: pitch bend in its range, single note tunings
    int velocity = 0;
    int channel = 0;  ///< counted from 0
    int track = 0;
};

struct MidiFile {
    int format = 0;
    int division = 0;                ///< ticks a quarter; negative: of SMPTE, as in the file
    int declared_tracks = 0;         ///< what the header tells
    std::vector<MidiEvent> events;   ///< track after track, end-of-tracks too
    std::vector<std::int64_t> ends;  ///< tick of the end of each track
    std::vector<MidiNote> notes;     ///< by onset, then channel, then key
    std::string title;               ///< the name of the first track
    std::string pattern;             ///< its first text
    std::string made;                ///< its second text
};

/// What a MIDI file holds, as far as it can be read; notes that do not end are left out. Keeps all of it in memory.
MidiFile read_midi(std::span<const std::uint8_t> bytes);

}  // namespace sikku
