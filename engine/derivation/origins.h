// engine/derivation/origins.h: which production made a symbol of the word, and which of its symbols it is.
#pragma once

#include "engine/language/document.h"

#include <cstdint>
#include <span>
#include <vector>

namespace sikku {

/// A symbol in the text of a pattern: of the axiom or of a successor.
struct Origin {
    Span symbol;
    Span production;  ///< the whole production; empty for the axiom
};

/// Traces symbols of the word, `interpret:` applied, back to the text: for each the symbol of the axiom that it comes
/// from, then that of each production that rewrote it, the last one last.
/// @param positions  in the word, counted from 1; a position beyond the word has no origins
/// Cost: O(steps) for each position, and O(symbols x steps) once.
/// @throws std::runtime_error for productions with contexts, parameters or random choices, and for more than 10,000
/// steps
std::vector<std::vector<Origin>> origins(const Document& document, std::span<const std::uint64_t> positions);

}  // namespace sikku
