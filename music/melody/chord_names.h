// music/melody/chord_names.h: chords by numeral and by name.
#pragma once

#include "music/melody/harmony.h"

#include <optional>
#include <string_view>

namespace sikku {

/// Reads a chord: a numeral (`IV`, `ii7`, `bVII`, `V7/V`, `vii°`) or a name (`Am`, `F#m7b5`, `Bbmaj7`, `C/G`).
/// Numerals in capitals without a suffix are the triads of the scale; in small letters they are minor. Suffixes: maj,
/// m, dim, aug, 5, sus2, sus4, 6, m6, 7, maj7, m7, mmaj7, m7b5, dim7, 7sus4, add9, madd9, 9, maj9, m9, mmaj9; °, ø, Δ
/// and +. A numeral after a slash is the tonic of the one before; a name after a slash is the bass.
/// @param tonic  MIDI key of the scale's tonic, possibly fractional
/// @return nullopt if this is not a chord
std::optional<Chord> named_chord(std::string_view name, const Scale& scale, double tonic);

/// True for names that could also be notes, such as `C`, `C7` and `Bb6`.
bool is_chord_and_note(std::string_view name);

}  // namespace sikku
