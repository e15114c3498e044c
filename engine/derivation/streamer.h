// engine/derivation/streamer.h: expands words depth first, without keeping them.
#pragma once

#include "engine/derivation/derivation.h"
#include "engine/derivation/levels.h"

namespace sikku {

/// Expands the axiom of a plain grammar through `levels`. Does not finish the sink.
void stream_symbols(const Grammar& grammar, const Levels& levels, const DerivationOptions& options, SymbolSink& sink);

/// Expands the axiom of a grammar with parameters or random choices, module by module. Does not finish the sink.
/// @throws BudgetError, WordError
void stream_modules(const Grammar& grammar, const Levels& levels, const DerivationOptions& options, SymbolSink& sink);

}  // namespace sikku
