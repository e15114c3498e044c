// music/score/midi_texts.h: reads the pattern and the recipe of a score from a MIDI file.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>

namespace sikku {

struct MidiTexts {
    std::string pattern;  ///< the first text of the first track
    std::string made;     ///< its second text
};

/// True if a regular file is a MIDI file, whatever its name.
bool is_midi_file(const std::filesystem::path& file);

/// Reads the texts that write_midi puts first into a Standard MIDI File; missing texts stay empty. The bytes may end
/// after the texts. Memory: the texts. Cost: at most one pass over the first track.
/// @throws std::runtime_error, whose text continues "this MIDI file …", if the file is damaged before the second text
/// or if a text exceeds 64 MB
MidiTexts read_midi_texts(std::span<const std::uint8_t> bytes);

/// Reads the texts of a MIDI file. Returns nullopt if it is not a MIDI file.
/// @throws std::runtime_error, naming the file, if it contains no pattern or is damaged
std::optional<MidiTexts> read_midi_file_texts(const std::filesystem::path& file);

}  // namespace sikku
