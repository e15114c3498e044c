// music/score/midi_check.h: finds faults in a MIDI file.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace sikku {

/// A fault at a byte, counted from 0. The text names track (from 1), tick and channel (from 1).
struct MidiFault {
    std::uint64_t at = 0;
    std::string what;
    bool is_remark = false;  ///< the format permits it
};

constexpr std::size_t most_midi_faults = 50;

/// Finds all faults of a Standard MIDI File that its bytes reveal, by place; stops after the 50th.
///
/// Stricter than any player: besides violations of the format, faults are contents that some programs cannot handle
/// or that cannot be intended: notes without length, a key that is struck while it sounds, a note-on before the
/// note-off of the same key at one tick, notes that do not end. Format 2, and an end-of-track an hour after the last
/// event, are legal, and only remarked upon. Longer headers and chunks of other kinds are legal. After a fault the
/// check continues where possible: a chunk whose length is wrong is read up to its end-of-track, a data byte above
/// 127 counts as data. Cost: one pass; memory only for notes that sound.
std::vector<MidiFault> check_midi(std::span<const std::uint8_t> bytes);

}  // namespace sikku
