// music/midi_texts.h: what a score was made from, read back from a MIDI file.
#pragma once

#include <cstdint>
#include <span>
#include <string>

namespace sikku {

struct MidiTexts {
    std::string pattern;  ///< the first text of the first track
    std::string made;     ///< its second text
};

/// Reads the texts that write_midi puts first into a Standard MIDI File; what a file does not have stays empty. The
/// bytes may end after the texts. Memory: the texts. Cost: one pass over the first track at most.
/// @throws std::runtime_error, whose text continues "this MIDI file …", if the file is damaged before the second text
/// or if a text is longer than 64 MB
MidiTexts read_midi_texts(std::span<const std::uint8_t> bytes);

}  // namespace sikku
