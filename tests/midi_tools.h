// tests/midi_tools.h: what the tests of MIDI files share: scores by chance, files in memory, events by hand.
#pragma once

#include "music/score/midi.h"
#include "music/score/midi_check.h"
#include "tests/midi_reader.h"

#include <algorithm>
#include <cstdint>
#include <random>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

namespace sikku {

/// A file in memory.
class MidiMemory final : public MemoryOutput {
public:
    void write(std::string_view bytes) override {
        MemoryOutput::write(bytes);
        largest_ = std::max(largest_, bytes.size());
    }
    void overwrite(std::uint64_t position, std::string_view bytes) override {
        if (position + bytes.size() > size()) throw std::logic_error("nothing was written there yet");
        MemoryOutput::overwrite(position, bytes);
    }
    /// The most bytes written at once.
    std::size_t largest() const { return largest_; }

private:
    std::size_t largest_ = 0;
};

std::span<const std::uint8_t> midi_span(const std::string& bytes);
std::vector<MidiFault> check_midi(const std::string& bytes);

/// What check_midi says, one line each.
std::string midi_faults(const std::string& bytes);

/// A score whole in memory.
struct MidiScore {
    ScoreHead head;
    std::vector<Note> notes;
    std::int64_t end = 0;
};

/// @param block  notes handed over at once
std::string make_midi(const MidiScore& score, const MidiOptions& options = {}, std::size_t block = 4096);

ScoreHead midi_head(int voices = 1);

Note midi_note(std::int64_t onset, std::int64_t duration, double key, int voice = 0, int velocity = 80);

/// Notes by chance: rests or none, every size of delta, voices in turns of any length.
MidiScore random_midi_score(std::mt19937& chance, int voices, int notes, bool microtonal);

/// The notes as a reader of the file should find them.
std::vector<Note> by_onset(std::vector<Note> notes);

/// The channel of a voice where there are at most fifteen; channel 10 (9 from 0) is the drums'.
int midi_channel(int voice);

/// Bytes from hexadecimal digits; blanks between them do not matter.
std::string hex_bytes(std::string_view digits);

/// A chunk with the length it has.
std::string midi_chunk(std::string_view kind, const std::string& data);

}  // namespace sikku
