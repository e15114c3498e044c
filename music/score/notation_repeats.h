// music/score/notation_repeats.h: clefs and lines of 8va at repeat signs.
#pragma once

#include "music/score/notation.h"
#include "music/score/repeats.h"

#include <span>
#include <vector>

namespace sikku {

/// Prints clefs and lines of 8va so that they can be read from sign to sign: a line begins anew where a repeat or an
/// ending begins or ends, and a second ending states its clef if the first one has changed it.
void restate_clefs(std::vector<StaffChange>& changes, std::span<const PrintedRepeat> repeats);

}  // namespace sikku
