// engine/derivation/rewriting.h: one step of a derivation, on a whole word.
#pragma once

#include "engine/derivation/neighbourhood.h"

namespace sikku {

/// Rewrites a word as the public function does, and counts what it compares in `work`.
ModuleWord rewrite(const Grammar& grammar, const Table& table, const ModuleWord& given, std::int64_t step,
                   const DerivationOptions& options, MatchingWork& work);

}  // namespace sikku
