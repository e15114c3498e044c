// engine/derivation/derivation.h: derives the word of a grammar as a stream of symbols, storing whole words only if
// necessary.
#pragma once

#include "engine/language/grammar.h"

#include <cstdint>
#include <functional>
#include <limits>
#include <span>
#include <stdexcept>

namespace sikku {

/// A stretch of neighbouring symbols of the derived word, in order. Valid during the call only, but for the
/// contents of a block: a part that recurs is handed out again and again under the same number, so that a reader
/// may keep what it made of it.
struct Run {
    std::span<const Symbol> symbols;
    std::int32_t block = -1;              ///< >= 0: the block's number; blocks are counted from 0
    std::span<const double> arguments{};  ///< SymbolInfo::arity values for each symbol, in order
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

/// Lets a reader pass over parts of the word that it can account for otherwise: what lies before the bar to be
/// played, what lies outside the page.
class Pruner {
public:
    virtual ~Pruner() = default;
    /// Asked before a symbol with `level` tables still to come is expanded, when every symbol before it was handed
    /// over or passed over. True: its expansion is left out. Parts that are kept for reuse are asked about as one.
    virtual bool passes_over(Symbol symbol, std::int64_t level) = 0;
    bool active = true;  ///< while false, nothing is asked
};

/// @throws WordError if the grammar is that of a map, which has no word. All that reads words calls it.
void require_word(const Grammar& grammar);

struct DerivationOptions {
    /// Apply `interpret:` to the finished word.
    bool interpreted = false;
    /// Most symbols of a word that has to be kept whole (contexts), and of all such words together; more is a
    /// BudgetError. Words that are streamed are not limited here: forecast() tells their cost beforehand.
    std::uint64_t longest_word = UINT64_MAX;
    std::uint64_t whole_words = UINT64_MAX;
    /// Maximum number of symbols compared in matching contexts and long predecessors, over all steps, plus 8 for each
    /// symbol of those words; more is a BudgetError.
    std::uint64_t compared = UINT64_MAX;
    /// Most symbols that the blocks hold together: what is kept to be handed out again.
    std::size_t block_memory = std::size_t{1} << 20;
    /// Most nodes of the derivation tree of a system that cannot be forecast (parameters, chance) that are visited.
    double most_nodes = std::numeric_limits<double>::infinity();
    /// Null: everything is handed over. Words kept whole, and systems that cannot be forecast, are not pruned.
    Pruner* pruner = nullptr;
    /// Called after each run with its number of symbols, and with 0 from time to time where nothing is handed over;
    /// may throw, to stop the derivation.
    std::function<void(std::uint64_t symbols)> watch;

    /// Limits the words kept whole, and systems that cannot be forecast, to a budget of nodes: keeping a symbol takes
    /// the memory and time of about 40, comparing two that of about 4.
    void limit_whole_words(double nodes) {
        most_nodes = nodes;
        if (nodes >= 1e19) return;
        longest_word = static_cast<std::uint64_t>(nodes / 40);
        whole_words = static_cast<std::uint64_t>(nodes);
        compared = static_cast<std::uint64_t>(nodes / 4);
    }
};

/// Hands the word after grammar.steps() derivation steps to `sink`, left to right.
///
/// Memory: O(steps) frames, the blocks, and, only if a production looks at its neighbours, the word of the last step
/// that does so, with the step before. Time: O(nodes visited); a part whose expansion is short is expanded once,
/// unless parameters or chance are in play.
/// @throws what `sink` throws; BudgetError; WordError for weights that cannot be chosen among
/// Source: Prusinkiewicz & Hanan 1989, sections 1.2 and 3.4.
void derive(const Grammar& grammar, SymbolSink& sink, const DerivationOptions& options = {});

/// A grammar with the same derived word in which no step that is left looks at its neighbours: `grammar` itself, or
/// what is left of it when the word after the last step that does so takes the place of the axiom.
/// Memory: that word, the one before it, and 8 bytes a symbol (up to 16 with parameters or brackets in contexts).
/// Time: linear in the symbols of the words and in the symbols compared. @throws BudgetError above the limits of
/// `options`, whose other members are ignored.
Grammar resolve_contexts(Grammar grammar, const DerivationOptions& options);

/// A plain grammar with nothing left to derive whose word is that of `grammar`, `interpret:` applied, so that readers
/// of plain systems read any. BudgetError above `options.longest_word` symbols, or 524,288 different modules.
Grammar write_out(const Grammar& grammar, DerivationOptions options);

/// One derivation step applied to a whole word of a plain grammar, needed where contexts are looked at. BudgetError
/// above `options.longest_word` symbols.
Word rewrite(const Grammar& grammar, const Table& table, const Word& word, const DerivationOptions& options = {});

/// The same for any grammar, in the derivation step of that number, counted from 1. Memory: 4 bytes a symbol, 8 for
/// each argument of its own, 8 for its place if the system is stochastic; and what resolve_contexts() tells.
/// @param parents  receives for each symbol of the result the index of its predecessor in `word`, the first symbol if
/// there are several
ModuleWord rewrite(const Grammar& grammar, const Table& table, const ModuleWord& word, std::int64_t step,
                   const DerivationOptions& options = {}, std::vector<std::uint32_t>* parents = nullptr);

/// The number of levels above the finished word up to which short expansions are kept: those that are empty cost
/// nothing there.
inline std::int64_t kept_levels(std::size_t symbols) {
    constexpr std::size_t most_entries = std::size_t{1} << 21;
    return static_cast<std::int64_t>(most_entries / (symbols > 0 ? symbols : 1));
}

}  // namespace sikku
