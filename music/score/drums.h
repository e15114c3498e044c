// music/score/drums.h: the percussion of General MIDI: keys, names, and how drums are written on a staff.
#pragma once

#include <array>
#include <span>
#include <string_view>

namespace sikku {

enum class NoteHead { normal, cross, diamond, triangle };

/// A drum of General MIDI.
struct Drum {
    int key = 35;               ///< MIDI key on channel 10, 35 to 81
    std::string_view name;      ///< General MIDI name
    std::string_view alias;     ///< another name, or empty
    std::string_view lilypond;  ///< its name in LilyPond
    std::string_view strudel;   ///< nearest sample of Strudel
    int letter = 0;             ///< its place on the staff as of a treble clef: 0 (C) to 6 (B)
    int octave = 5;             ///< the octave of that place
    NoteHead head = NoteHead::normal;
};

/// All drums by key.
std::span<const Drum> drums();

/// The drum of a MIDI key; the nearest for other keys.
const Drum& drum_of(int key);

/// The drum of that name or number (35 to 81), or null: `bass drum`, `Hi-Mid Tom`, `36`. Case and hyphens do not
/// matter; `hi` and `high` are the same.
const Drum* find_drum(std::string_view name);

}  // namespace sikku
