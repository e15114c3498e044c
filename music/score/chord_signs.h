// music/score/chord_signs.h: kinds of chords and their names in each format of print.
#pragma once

#include "music/score/score.h"

#include <array>
#include <span>
#include <string_view>

namespace sikku {

/// A kind of chord.
struct ChordQuality {
    std::string_view name;      ///< in patterns, without signs: `m7b5`; `maj` for major
    std::array<int, 5> tones;   ///< semitones above the root, which is first; -1: no more
    std::string_view printed;   ///< what follows the root: nothing for major
    std::string_view musicxml;  ///< the `kind` of MusicXML
    std::string_view lilypond;  ///< in LilyPond's \chordmode, after the duration
    int added = 0;              ///< degree of MusicXML that the `kind` lacks; 0: none
};

/// All kinds. The accompaniment sounds the first three tones, so that sevenths come before fifths.
std::span<const ChordQuality> chord_qualities();

/// The index of the kind with these semitones above the root in equal temperament, within 30 cents of each; -1 if
/// there is none. @param cents  the root first
int quality_with(std::span<const double> cents);

}  // namespace sikku
