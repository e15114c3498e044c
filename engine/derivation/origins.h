// engine/derivation/origins.h: which symbol of which production a symbol of the word comes from.
#pragma once

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

/// Traces symbols of the word, after the homomorphism, back to the text: for each position, the symbol of the axiom
/// and then the symbol in each production that was applied, in order.
/// @param positions  in the word, counted from 1; a position beyond the word has no origins
/// Cost: O(steps) for each position, and O(symbols x steps) once.
/// @throws std::runtime_error for productions with contexts, parameters or random choices, or more than 10,000 steps
std::vector<std::vector<Origin>> origins(const Document& document, std::span<const std::uint64_t> positions);

}  // namespace sikku
