// music/score/transposing.h: parts of transposing instruments at written pitch.
#pragma once

#include "music/score/notation.h"
#include "music/score/turns.h"

namespace sikku {

/// Moves the notes, keys and spellings of a part up to where its players read them. Keys of more than seven signs
/// become those with fewer, and so do signs of parts without a key.
void transpose(PrintedPart& part, const Transposition& by);

}  // namespace sikku
