// music/score/strokes.h: arranges strokes of drums in the lines of a percussion staff.
#pragma once

#include "music/score/bar_lines.h"
#include "music/score/score.h"

#include <cstdint>
#include <span>
#include <vector>

namespace sikku {

/// Strokes by onset, one at a time.
struct StrokeLine {
    std::vector<Note> strokes;                ///< each with the key of one drum
    std::vector<std::vector<double>> others;  ///< for each stroke, keys of the drums struck with it
};

struct StrokeLines {
    std::vector<StrokeLine> lines;  ///< the highest first; at least one
    std::uint64_t merged = 0;       ///< strokes left out because another voice has the same stroke
};

/// Arranges the strokes of all voices of a part in two lines, as for a drum set: hands above, feet (the bass drum and
/// the pedal hi-hat) below. A line that does not fit any grid of bars and tuplets stays divided into its voices.
///
/// A stroke has no length of its own: it is written up to the next one of its line, the end of its beat, or, if it
/// lasts for whole beats, its end. Dynamics that the pattern states for several drums are the balance between them,
/// so strokes keep them only where there is a single drum. Cost: O(n log n).
StrokeLines stroke_lines(std::span<const std::vector<Note>> voices, const BarLines& bars);

}  // namespace sikku
