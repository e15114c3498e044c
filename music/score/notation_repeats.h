// music/score/notation_repeats.h: clefs and 8va lines at repeat signs.
#pragma once

#include "music/score/notation.h"
#include "music/score/repeats.h"

#include <span>
#include <vector>

namespace sikku {

/// Makes clefs and 8va lines correct in each pass: an 8va line begins anew where a repeat or an ending begins or
/// ends, and a second ending states its clef if the first one has changed it.
void restate_clefs(std::vector<StaffChange>& changes, std::span<const PrintedRepeat> repeats);

}  // namespace sikku
