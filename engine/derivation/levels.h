// engine/derivation/levels.h: selects the table for each level of an expansion, and expands words depth first,
// without keeping them.
#pragma once

#include "engine/derivation/derivation.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace sikku {

/// Maximum length of a run of symbols passed to a sink.
constexpr std::size_t longest_run = 4096;

/// Number of symbols or frames between two calls of DerivationOptions::watch.
constexpr std::uint64_t between_watches = std::uint64_t{1} << 16;

/// Counts the nodes that a derivation visits.
class VisitedNodes {
public:
    VisitedNodes(const Grammar& grammar, const DerivationOptions& options) : grammar_(grammar), options_(options) {}
    /// Every `between_watches` nodes, compares the count with the budget and calls DerivationOptions::watch.
    /// @throws BudgetError
    void add(std::uint64_t nodes) {
        count_ += nodes;
        if (count_ >= next_look_) look();
    }

private:
    void look();

    const Grammar& grammar_;
    const DerivationOptions& options_;
    std::uint64_t count_ = 0;
    std::uint64_t next_look_ = between_watches;
};

/// Tables by level: level 0 is the finished word; at level r, r tables are still to be applied. Adjacent levels of
/// one table are stored as one stretch, so that a million steps take no memory.
class Levels {
public:
    Levels(const Grammar& grammar, bool interpreted) {
        if (interpreted && grammar.interpretation()) add(grammar.interpretation(), 1);
        for (std::size_t i = grammar.schedule().size(); i > 0; --i) {
            const ScheduleRun& run = grammar.schedule()[i - 1];
            add(&grammar.tables()[run.table], run.steps);
        }
    }
    std::int64_t count() const { return count_; }
    /// Largest number of adjacent levels of `table`.
    std::int64_t longest_stretch(const Table& table) const {
        std::int64_t longest = 0;
        for (std::size_t i = 0; i < stretches_.size(); ++i) {
            if (stretches_[i].table != &table) continue;
            longest = std::max(longest, stretches_[i].end - (i == 0 ? 0 : stretches_[i - 1].end));
        }
        return longest;
    }
    /// The table that rewrites a symbol at `level` >= 1.
    const Table& table(std::int64_t level) const { return *stretches_[stretch(level)].table; }

    /// The last level of the stretch below that of `level`; 0 if there is none.
    std::int64_t stretch_begin(std::int64_t level) const {
        const std::size_t i = stretch(level);
        return i == 0 ? 0 : stretches_[i - 1].end;
    }

private:
    struct Stretch {
        const Table* table;
        std::int64_t end;
    };
    std::size_t stretch(std::int64_t level) const {
        const auto found = std::lower_bound(stretches_.begin(), stretches_.end(), level,
                                            [](const Stretch& one, std::int64_t wanted) { return one.end < wanted; });
        return static_cast<std::size_t>(found - stretches_.begin());
    }
    void add(const Table* table, std::int64_t steps) {
        if (steps <= 0) return;
        count_ += steps;
        stretches_.push_back({table, count_});
    }
    std::vector<Stretch> stretches_;
    std::int64_t count_ = 0;
};

/// Expands the axiom of a plain grammar through `levels`. Does not finish the sink.
void stream_symbols(const Grammar& grammar, const Levels& levels, const DerivationOptions& options, SymbolSink& sink);

/// Expands the axiom of a grammar with parameters or random choices, module by module. Does not finish the sink.
/// @throws BudgetError, WordError
void stream_modules(const Grammar& grammar, const Levels& levels, const DerivationOptions& options, SymbolSink& sink);

/// Expands the axiom of a grammar whose random choices have constant weights, if the word is expected to be long.
/// Several threads expand parts; the calling thread delivers them in order. The result does not depend on the number
/// of threads. For other grammars, does nothing and returns false. Does not finish the sink.
/// Memory: usually half a megabyte for each thread, at most about 12. @throws BudgetError
bool stream_drawn(const Grammar& grammar, const Levels& levels, const DerivationOptions& options, SymbolSink& sink);

}  // namespace sikku
