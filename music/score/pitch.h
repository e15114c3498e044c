// music/score/pitch.h: pitches as they are written.
#pragma once

#include "music/score/score.h"

#include <array>

namespace sikku {

/// A pitch as it is written. `quarters`: its sign in quarter tones, -4 (two flats) to 4 (two sharps).
struct Pitch {
    int letter = 0;  ///< 0 (C) to 6 (B)
    int octave = 4;  ///< from C to B, that of middle C is 4; -2 to 9
    int quarters = 0;

    /// The MIDI key.
    double key() const;
    /// Letters above C0.
    int height() const { return 7 * octave + letter; }
    bool operator==(const Pitch&) const = default;
};

/// The letter, octave and sign of a key, by Part::spelling.
Pitch spelled(double key, const std::array<Spelling, 12>& spelling);

}  // namespace sikku
