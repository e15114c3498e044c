// music/score/spelling.h: spells pitch classes with letters and signs; key signatures, names of notes.
#pragma once

#include "music/scale/scale.h"
#include "music/score/score.h"

#include <array>
#include <optional>
#include <string>
#include <string_view>

namespace sikku {

/// The tonic of a scale.
struct Tonic {
    Spelling spelling;
    double key = 60.0;  ///< MIDI key; for a parsed name possibly beyond 0 to 127
};

/// Semitones of a letter, 0 (C) to 6 (B), above C.
int letter_semitones(int letter);

/// The spelling of each pitch class from C. Where the ascent of `scale` has seven notes, or else its descent, each
/// degree has a letter of its own, counted from the tonic; notes of the other direction that differ keep their
/// degree's letter. The other pitch classes (all, in most other scales) are spelled by twelve neighbours on the line
/// of fifths around the tonic, those that give the scale the most distinct letters; flats are preferred, most of all
/// for blues and for scales with a minor third alone, and E#, B#, Cb and Fb are avoided.
/// Scales that do not close at the octave are spelled like the chromatic scale. `tonic`: alteration -2 to 2.
std::array<Spelling, 12> spell(const Scale& scale, Spelling tonic);

/// The signature of major, minor or a mode from dorian to locrian, recognised by its pitches (within 25 cents);
/// nullopt for other scales, and if it needs more than seven signs. `minor` is set for minor itself only.
std::optional<KeySignature> key_signature(const Scale& scale, Spelling tonic);

/// The signature that scores are printed with: that of a mode on the tonic that agrees with the letters of the scale
/// in all degrees but one, or but two of seven, and saves signs; major and minor are preferred. Nullopt for scales of
/// fewer than five notes or more than eight, with quarter tones, or which need more signs, such as whole tones.
std::optional<KeySignature> print_signature(const Scale& scale, Spelling tonic);

/// Name of a key: `C4` (60), `F#3`, `Bb5`; for a key with a fraction that of the nearest semitone.
std::string note_name(double key, const std::array<Spelling, 12>& spelling);

/// Parses `C4`, `F#3`, `Eb5` or `Bb` (octave 4): a letter in either case, up to two `#` or `b` (or one of U+266F,
/// U+266D), an octave from -1 to 9. The range of the key is not checked: `Cb-1` is -1. Nullopt for anything else.
std::optional<Tonic> parse_note(std::string_view text);

}  // namespace sikku
