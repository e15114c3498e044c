// music/score/syllables.h: syllables for degrees of the scale, printed under notes.
#pragma once

#include "music/score/notation.h"
#include "music/score/turns.h"

#include <string_view>

namespace sikku {

/// The syllable of a written pitch, counted in letters from the tonic. Sargam: S r R g G m M P d D n N, small letters
/// for lowered degrees and M for the raised fourth. Degrees: 1 to 7, with a sign where they differ from the major
/// scale. Both have a dot for each octave above or below that of the tonic, up to two. Solfa: do re mi fa sol la ti,
/// lowered ra me le te, raised di ri fi si li. Empty for Syllables::none. The text has static storage.
std::string_view syllable_of(Syllables kind, const Pitch& pitch, const KeyOfBars& key);

}  // namespace sikku
