// engine/derivation.h: from a grammar to the symbols of its derived word, storing no word where that can be avoided.
#pragma once

#include "engine/grammar.h"

#include <cstdint>
#include <functional>
#include <span>
#include <stdexcept>

namespace sikku {

/// A stretch of neighbouring symbols of the derived word, in order. Valid during the call only, but for the
/// contents of a block: a part that recurs is handed out again and again under the same number, so that a reader
/// may keep what it made of it.
struct Run {
    std::span<const Symbol> symbols;
    std::int32_t block = -1;  ///< >= 0: the block's number; blocks are counted from 0
};

/// What every reader of a word implements: turtle, counter, printer. Virtual and still cheap, because a call carries
/// a run of symbols and not one.
class SymbolSink {
public:
    virtual ~SymbolSink() = default;
    virtual void symbols(const Run& run) = 0;
    /// Called once after the last run.
    virtual void finish() {}
};

/// The word would be larger than the budget allows, or than memory holds.
class BudgetError : public std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// Something about the word, at one of its symbols, that an interpreter cannot read.
class WordError : public std::runtime_error {
    using std::runtime_error::runtime_error;
};

struct DerivationOptions {
    /// Apply `interpret:` to the finished word.
    bool interpreted = false;
    /// Most symbols of a word that has to be kept whole (contexts); more is a BudgetError. Words that are streamed
    /// are not limited here: forecast() tells their cost beforehand.
    std::uint64_t budget = UINT64_MAX;
    /// Most symbols that the blocks hold together: what is kept to be handed out again.
    std::size_t block_memory = std::size_t{1} << 20;
    /// Called after each run with its number of symbols (and with 0 after each step on a whole word); may throw, to
    /// stop the derivation.
    std::function<void(std::uint64_t symbols)> watch;
};

/// Most symbols of a word kept whole for a budget of nodes: keeping one takes the memory and time of about 40.
inline std::uint64_t whole_word_budget(double nodes) {
    return nodes < 1e19 ? static_cast<std::uint64_t>(nodes / 40) : UINT64_MAX;
}

/// Hands the word after grammar.steps() derivation steps to `sink`, left to right.
///
/// Memory: O(steps) frames, the blocks, and, only if a production looks at its neighbours, the word of the last step
/// that does so, with the step before. Time: O(nodes visited); a part whose expansion is short is expanded once.
/// @throws what `sink` throws; BudgetError
/// Source: Prusinkiewicz & Hanan 1989, sections 1.2 and 3.4.
void derive(const Grammar& grammar, SymbolSink& sink, const DerivationOptions& options = {});

/// One derivation step applied to a whole word: the slow and obvious way, needed where contexts are looked at.
/// Memory: the word twice, and a table of brackets if there are contexts. BudgetError above `budget` symbols.
Word rewrite(const Grammar& grammar, const Table& table, const Word& word, std::uint64_t budget = UINT64_MAX);

}  // namespace sikku
