// music/score/syllables.h: what is sung under notes: the degrees of the scale.
#pragma once

#include "music/score/notation.h"
#include "music/score/turns.h"

#include <string_view>

namespace sikku {

/// The syllable of a written pitch: S R G M P D N, counted in letters from the tonic and with a dot for each octave
/// above or below its own; 1 to 7, likewise, with a sign if it is not that of the major scale; do re mi fa sol la ti.
/// Empty if nothing is sung. Static.
std::string_view syllable_of(Syllables kind, const Pitch& pitch, const KeyOfBars& key);

}  // namespace sikku
