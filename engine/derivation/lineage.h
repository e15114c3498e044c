// engine/derivation/lineage.h: the words of successive steps, and the parent of each symbol.
#pragma once

#include "engine/base/monitor.h"
#include "engine/derivation/derivation.h"

#include <cstdint>
#include <vector>

namespace sikku {

/// Where the symbols of one step come from.
struct StepOrigins {
    static constexpr std::uint32_t stays = UINT32_MAX;       ///< no production applies
    static constexpr std::uint32_t is_cut = UINT32_MAX - 1;  ///< removed by a cut

    /// For each symbol of the new word, the index of its predecessor in the word before, or of the first symbol of a
    /// longer predecessor.
    std::vector<std::uint32_t> parents;
    /// For each symbol of the word before, the production that replaces it, as an index into the table, or one of the
    /// constants above.
    std::vector<std::uint32_t> applied;
};

/// The word after a step of a derivation.
struct LineageWord {
    std::int64_t steps = 0;
    bool is_interpreted = false;  ///< the last word, with `interpret:` applied
    ModuleWord word;
    std::vector<std::uint32_t> parents;  ///< as in StepOrigins, in the word before; empty for the first word
    std::vector<std::uint32_t> applied;  ///< as in StepOrigins, in the step after; empty for the last word
    const Table* next = nullptr;         ///< table of the step after, in the grammar; null for the last
};

struct WordLineageLimits {
    std::uint64_t symbols = UINT64_MAX;  ///< of all words from the first to the last together
    double nodes = 200e6;                ///< symbols visited, as a budget; includes words before the first
};

/// Derives the words after `first`, `first` + 1, … `last` steps of `grammar`, whose derivation length is `last`; with
/// `interpreted`, also the last word with `interpret:` applied, if the pattern has it.
/// @throws BudgetError that names the step; WordError; Stopped
std::vector<LineageWord> word_lineage(const Grammar& grammar, std::int64_t first, std::int64_t last, bool interpreted,
                                      const WordLineageLimits& limits, const Monitor& monitor = {});

}  // namespace sikku
