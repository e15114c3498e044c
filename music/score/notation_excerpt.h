// music/score/notation_excerpt.h: bars cut out of a printed part.
#pragma once

#include "music/score/notation.h"

#include <cstdint>

namespace sikku {

/// Keeps what begins between two bar lines, counted from the first. Ties, slides and hairpins end at the cuts; the
/// key, the clefs, 8va lines and dynamics in force apply from the first on. Beams and accents stay as they are.
/// Second voices of a staff that are silent there are left out.
void cut_bars(NotatedPart& part, std::int64_t from, std::int64_t to);

/// The chords from one tick to another, with the one that is in force at its beginning.
std::vector<ChordMark> cut_chords(const std::vector<ChordMark>& chords, std::int64_t from, std::int64_t to);

}  // namespace sikku
