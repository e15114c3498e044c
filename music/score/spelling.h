// music/score/spelling.h: spells pitch classes with letters and signs; key signatures, names of notes.
#pragma once

#include "music/scale/scale.h"
#include "music/score/score.h"

#include <array>
#include <optional>
#include <string>
#include <string_view>

namespace sikku {

/// The note a scale stands on.
struct Tonic {
    Spelling spelling;
    double key = 60.0;  ///< MIDI key; of a name as it stands, perhaps beyond 0 to 127
};

/// Semitones of a letter, 0 (C) to 6 (B), above C.
int letter_semitones(int letter);

/// The spelling of each pitch class from C. Where the ascent of `scale` has seven notes, or else its descent, each
/// degree has a letter of its own, counted from the tonic; notes of the other direction that differ keep their
/// degree's letter. What that leaves open (all, in most other scales) is taken from twelve neighbours on the line of
/// fifths around the tonic, those that give the scale most letters of its own; flats are preferred, most of all for
/// blues and for scales with a minor third alone, and E#, B#, Cb and Fb are avoided.
/// Scales that do not close at the octave are spelled as the chromatic one. `tonic`: alteration -2 to 2.
std::array<Spelling, 12> spell(const Scale& scale, Spelling tonic);

/// Of major, minor and the modes from dorian to locrian, recognised by their pitches (within 25 cents), where seven
/// signs are enough; else nothing. `minor` is told of minor itself only.
std::optional<KeySignature> key_signature(const Scale& scale, Spelling tonic);

/// The signature that scores are printed with: of a mode on the tonic that agrees with the letters of the scale in
/// all degrees but one, or but two of seven, and saves signs; major and minor are preferred. Nullopt for scales of
/// fewer than five notes or more than eight, with quarter tones, or which need more signs, such as whole tones.
std::optional<KeySignature> print_signature(const Scale& scale, Spelling tonic);

/// `C4`, `F#3`, `Bb5`: C4 is key 60. Of a key with a fraction the name of the nearest semitone.
std::string note_name(double key, const std::array<Spelling, 12>& spelling);

/// `C4`, `F#3`, `Eb5`, `Bb` (octave 4): a letter in either case, up to two `#` or `b` (or one of U+266F, U+266D),
/// an octave from -1 to 9; nothing else. The range of the key is the caller's matter: `Cb-1` is -1.
std::optional<Tonic> parse_note(std::string_view text);

}  // namespace sikku
