// music/score/abc.h: writes scores in ABC notation.
#pragma once

#include "engine/base/output.h"
#include "music/score/notation.h"
#include "music/score/score.h"

namespace sikku {

/// Writes ABC 2.1: the recipe and the pattern as comments, then one tune with a voice for each voice of each staff.
/// Lengths are in eighths. Clefs with an octave are replaced by those without. Accidentals are written so that rules
/// by which they apply to one note or to its letter in the bar agree. Quarter tones are `^/` and `_/`.
/// @throws exceptions of `out`
void write_abc(const Notation& notation, const ScoreHead& head, Output& out);

}  // namespace sikku
