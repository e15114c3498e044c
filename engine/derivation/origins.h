// engine/derivation/origins.h: which symbol of which production a symbol of the word comes from.
#pragma once

#include "engine/base/monitor.h"
#include "engine/language/document.h"

#include <cstdint>
#include <span>
#include <vector>

namespace sikku {

/// A symbol in the text of a pattern: in the axiom or in a successor.
struct Origin {
    Span symbol;
    Span production;  ///< the whole production; empty for the axiom
};

/// Finds the places in the text that made symbols of the word, `interpret:` applied: in the successor of the last
/// production that applied, or in the axiom.
/// @param positions  in the word, counted from 1; the origin of a position beyond the word is empty
/// Cost: O(steps x length of the successors) for each position, and O(symbols x steps) once.
/// @throws std::runtime_error for productions with contexts, parameters or random choices, and for more than 10,000
/// steps; Stopped
std::vector<Origin> origins(const Document& document, std::span<const std::uint64_t> positions,
                            const Monitor& monitor = {});

}  // namespace sikku
