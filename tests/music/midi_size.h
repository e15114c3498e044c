// tests/music/midi_size.h: the largest size that a MIDI file may have.
#pragma once

#include "music/score/labels.h"
#include "music/score/midi.h"
#include "music/score/midi_conductor.h"
#include "music/score/midi_voice.h"

#include <algorithm>
#include <cstdint>
#include <limits>

namespace sikku {

constexpr std::uint64_t plain_note_bytes = 14;
// Bytes before a note that needs a program, bend or tuning, with the delta of one byte that the note-on then has.
constexpr std::uint64_t program_bytes = 3;
constexpr std::uint64_t bend_bytes = 4;
constexpr std::uint64_t tuning_bytes = 14;
static_assert(midi::note_room >= plain_note_bytes + tuning_bytes);

/// Upper bound of the size of a file with `notes` notes, without curves and glides, in bytes.
inline std::uint64_t most_midi_bytes(std::uint64_t notes, const ScoreHead& head = {},
                                     const MidiOptions& options = {}) {
    constexpr std::uint64_t text_bytes = 7;  // delta, FF, type, length
    constexpr std::uint64_t end_bytes = 7;
    std::uint64_t fixed = 14 + 8 + 8 * 11 + 3 * text_bytes + head.title.size() + head.pattern.size() +
                          head.made.size() + 7 + 8 + 6 + end_bytes;
    std::uint64_t longest_name = 0;
    for (const Label& label : labels_of(head.parts)) {
        longest_name = std::max(longest_name, std::uint64_t{label.name.size()});
    }
    // Up to ten controllers, the program, and a number after the name.
    fixed += midi::most_pitched_channels * (8 + text_bytes + longest_name + 12 + 10 * 4 + 3 + end_bytes);
    const bool is_mpe = options.tuning == Tuning::mpe;
    if (is_mpe) fixed += midi::messages_now(midi::mpe_setup()).size();
    const std::uint64_t each = plain_note_bytes + (is_mpe                           ? program_bytes + bend_bytes
                                                   : !options.microtonal            ? 0
                                                   : options.tuning == Tuning::bend ? bend_bytes
                                                                                    : tuning_bytes);
    if (notes > (std::numeric_limits<std::uint64_t>::max() - fixed) / each) {
        return std::numeric_limits<std::uint64_t>::max();
    }
    return fixed + notes * each;
}

}  // namespace sikku
