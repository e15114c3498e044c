// studio/editor/measures.h: sizes of drawings, measured fast enough to be shown while the user types.
#pragma once

#include "engine/base/monitor.h"
#include "engine/language/document.h"

#include <array>
#include <optional>
#include <string>

namespace sikku {

/// Sizes of a word or a map. The texts are numbers of any length: `1365`, `about 10^24081`; empty: unknown.
struct QuickMeasures {
    std::string symbols;   ///< of a word
    std::string cells;     ///< of a map
    std::string edges;     ///< of a map
    std::string segments;  ///< drawn; of splines, moves
    /// Bounds of the drawing in turtle steps: x0, y0, x1, y1.
    std::optional<std::array<std::string, 4>> extent;
    bool is_derivable = true;  ///< within the budget of a drawing
    std::string most;          ///< if it is not: the largest derivation length that is
};

/// Measures a pattern in at most 3 million nodes, or a map whose steps have at most 100,000 edges together; sizes
/// that need more stay unknown.
/// @throws Stopped
QuickMeasures measure_quickly(const Document& document, const Monitor& monitor = {});

/// The same as a line: `1,365 symbols, 1,024 segments, 31 x 31 steps`; `32 cells, 109 edges` for a map, which is
/// derived if its maps have at most 100,000 edges together. Empty if nothing is known. @throws Stopped
std::string measures_text(const Document& document, const Monitor& monitor = {});

}  // namespace sikku
