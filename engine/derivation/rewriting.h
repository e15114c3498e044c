// engine/derivation/rewriting.h: applies one step of a derivation to a whole word.
#pragma once

#include "engine/derivation/neighbourhood.h"

namespace sikku {

/// Rewrites a word as the public function does, and counts the symbols compared in `work`.
ModuleWord rewrite(const Grammar& grammar, const Table& table, const ModuleWord& given, std::int64_t step,
                   const DerivationOptions& options, MatchingWork& work);

}  // namespace sikku
