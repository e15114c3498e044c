// music/score/abc.h: writes scores in ABC notation.
#pragma once

#include "engine/base/output.h"
#include "music/score/notation.h"
#include "music/score/score.h"

namespace sikku {

/// Writes ABC 2.1: the pattern and what made it as comments, then one tune with a voice for each voice of each staff.
/// Lengths are in eighths. Clefs with an octave become those without. Accidentals hold for one note as for all of its
/// letter in the bar, so that readers of any rule agree. Quarter tones are `^/` and `_/`. @throws what `out` throws
void write_abc(const Notation& notation, const ScoreHead& head, Output& out);

}  // namespace sikku
