// engine/derivation/derivation.h: derives the word of a grammar as a stream of symbols, storing whole words only if
// necessary.
#pragma once

#include "engine/language/grammar.h"

#include <cstdint>
#include <functional>
#include <limits>
#include <span>
#include <stdexcept>
#include <string_view>
#include <utility>

namespace sikku {

/// Consecutive symbols of the derived word. Valid only during the call, except for the contents of a block: a
/// recurring part, which is passed each time under the same number, so that a reader can cache its results.
struct Run {
    std::span<const Symbol> symbols;
    std::int32_t block = -1;              ///< number of the block, from 0; -1: not a block
    std::span<const double> arguments{};  ///< SymbolInfo::arity values for each symbol, in order
};

/// Interface of readers of a word, such as turtle, counter and printer. A virtual call is cheap, as it passes a run
/// of symbols.
class SymbolSink {
public:
    virtual ~SymbolSink() = default;
    virtual void symbols(const Run& run) = 0;
    /// Called once after the last run.
    virtual void finish() {}
    /// The byte of each symbol, for readers that only concatenate bytes; empty for other readers. If it is not empty,
    /// parts of the word may be passed to text() instead of symbols().
    virtual std::string_view bytes() const { return {}; }
    virtual void text(std::string_view) {}
};

/// Thrown if the word would exceed the budget or the memory.
class BudgetError : public std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// Thrown for a word that an interpreter cannot read, usually because of one of its symbols.
class WordError : public std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// Skips parts of the word for a reader that accounts for them otherwise, such as those before the first bar to be
/// played or outside of the page.
class Pruner {
public:
    virtual ~Pruner() = default;
    /// Returns true to skip the expansion of a symbol with `level` tables still to be applied. Called before the
    /// symbol is expanded, when all symbols before it were passed on or skipped. A part that is kept for reuse is
    /// skipped as a whole or not at all.
    virtual bool passes_over(Symbol symbol, std::int64_t level) = 0;
    bool active = true;  ///< while false, nothing is skipped
};

/// Called by all readers of words. @throws WordError for the grammar of a map, which has no word
void require_word(const Grammar& grammar);

struct DerivationOptions {
    /// True to apply `interpret:` to the finished word.
    bool interpreted = false;
    /// Maximum number of symbols of a word that has to be kept whole (contexts), and of all such words together; more
    /// is a BudgetError. Words that are streamed are not limited here: forecast() computes their cost beforehand.
    std::uint64_t longest_word = UINT64_MAX;
    std::uint64_t whole_words = UINT64_MAX;
    /// Maximum number of symbols compared in matching contexts and long predecessors, over all steps, plus 8 for each
    /// symbol of those words; more is a BudgetError.
    std::uint64_t compared = UINT64_MAX;
    /// Maximum number of symbols in all blocks together.
    std::size_t block_memory = std::size_t{1} << 20;
    /// Maximum number of derivation nodes visited in a system that cannot be forecast (parameters, random choices).
    double most_nodes = std::numeric_limits<double>::infinity();
    /// Null: nothing is skipped. Words kept whole, and systems that cannot be forecast, are not pruned.
    Pruner* pruner = nullptr;
    /// Called after each run with its number of symbols, and with 0 from time to time while no symbols are passed on;
    /// may throw to stop the derivation.
    std::function<void(std::uint64_t symbols)> watch = {};

    /// Options for the word after `interpret:`, within a budget of nodes.
    static DerivationOptions within(double nodes, std::function<void(std::uint64_t symbols)> watch = {}) {
        DerivationOptions options;
        options.interpreted = true;
        options.watch = std::move(watch);
        options.limit_whole_words(nodes);
        return options;
    }
    /// Limits words kept whole, and systems that cannot be forecast, to a budget of nodes. Keeping a symbol takes the
    /// memory and time of about 40 nodes, comparing two symbols that of about 4.
    void limit_whole_words(double nodes) {
        most_nodes = nodes;
        if (nodes >= 1e19) return;
        longest_word = static_cast<std::uint64_t>(nodes / 40);
        whole_words = static_cast<std::uint64_t>(nodes);
        compared = static_cast<std::uint64_t>(nodes / 4);
    }
};

/// Passes the word after grammar.steps() derivation steps to `sink`, from left to right.
///
/// Memory: O(steps) frames, the blocks, and, if productions look at their neighbours, the word of the last step that
/// does so and the one before. Time: O(nodes visited); a part whose expansion is short is expanded once, unless the
/// system has parameters or random choices.
/// @throws exceptions of `sink`; BudgetError; WordError for invalid weights
/// Source: Prusinkiewicz & Hanan 1989, sections 1.2 and 3.4.
void derive(const Grammar& grammar, SymbolSink& sink, const DerivationOptions& options = {});

/// Returns a grammar with the same derived word in which no remaining step looks at its neighbours: `grammar` itself,
/// or its remaining steps with the word after the last such step as the axiom.
/// Memory: that word, the one before it, and 8 bytes a symbol (up to 16 with parameters or brackets in contexts).
/// Time: linear in the symbols of the words and in the symbols compared. Calls `options.watch`, and ignores the
/// members of `options` that are not limits of whole words. @throws BudgetError above these limits
Grammar resolve_contexts(Grammar grammar, const DerivationOptions& options);

/// Returns a plain grammar without remaining steps whose word is that of `grammar`, `interpret:` applied, so that
/// readers of plain systems can read any word. @throws BudgetError above `options.longest_word` symbols or 524,288
/// different modules
Grammar write_out(const Grammar& grammar, DerivationOptions options);

/// Applies one derivation step to a whole word of a plain grammar, for productions that look at neighbours.
/// @throws BudgetError above `options.longest_word` symbols
Word rewrite(const Grammar& grammar, const Table& table, const Word& word, const DerivationOptions& options = {});

/// Applies the derivation step of that number, counted from 1, to a word of any grammar. Memory: 4 bytes a symbol, 8
/// for each of its own arguments, 8 for its place if the system is stochastic; and that of resolve_contexts().
/// @param parents  receives, for each symbol of the result, the index of its predecessor in `word`, or of the first
/// symbol of a longer predecessor
ModuleWord rewrite(const Grammar& grammar, const Table& table, const ModuleWord& word, std::int64_t step,
                   const DerivationOptions& options = {}, std::vector<std::uint32_t>* parents = nullptr);

/// Number of levels above the finished word for which short expansions are kept. Empty expansions cost nothing at
/// these levels.
inline std::int64_t kept_levels(std::size_t symbols) {
    constexpr std::size_t most_entries = std::size_t{1} << 21;
    return static_cast<std::int64_t>(most_entries / (symbols > 0 ? symbols : 1));
}

}  // namespace sikku
