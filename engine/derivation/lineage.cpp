#include "engine/derivation/lineage.h"

#include "engine/derivation/forecast.h"
#include "engine/derivation/neighbourhood.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace sikku {
namespace {

/// Derives word after word, within the limits.
class LineageMaker {
public:
    LineageMaker(const Grammar& grammar, std::int64_t first, const WordLineageLimits& limits, const Monitor& monitor)
        : grammar_(grammar),
          first_(first),
          limits_(limits),
          monitor_(monitor),
          options_(
              DerivationOptions::within(limits.nodes, [this](std::uint64_t symbols) { monitor_.advance(symbols); })),
          work_(options_),
          longest_(options_.longest_word) {
        words_.push_back({0, false, grammar.axiom_modules(), {}, {}, nullptr});
        count();
    }

    void step(const Table& table, bool is_interpretation) {
        LineageWord& before = words_.back();
        StepOrigins origins;
        LineageWord after;
        after.steps = before.steps + (is_interpretation ? 0 : 1);
        after.is_interpreted = is_interpretation;
        // Words that are not shown are limited only by the budget, also the one that becomes the first that is.
        options_.longest_word = longest_;
        if (after.steps >= first_) {
            options_.longest_word =
                std::min(longest_, std::max<std::uint64_t>(limits_.symbols, before.word.symbols.size()));
        }
        try {
            after.word = rewrite(grammar_, table, before.word, before.steps + 1, options_, work_, origins);
        } catch (const BudgetError& error) {
            throw BudgetError(fmt::format("step {}: {}", before.steps + 1, error.what()));
        }
        if (before.steps >= first_) {
            before.applied = std::move(origins.applied);
            before.next = &table;
            after.parents = std::move(origins.parents);
        } else {
            words_.clear();
        }
        words_.push_back(std::move(after));
        count();
    }

    std::vector<LineageWord> words() { return std::move(words_); }

private:
    void count() {
        const LineageWord& last = words_.back();
        const std::size_t size = last.word.symbols.size();
        visited_ += static_cast<double>(size) + 1;
        if (visited_ > limits_.nodes) {
            throw BudgetError(
                fmt::format("step {}: the words have more than {:.0f} symbols in all", last.steps, limits_.nodes));
        }
        if (last.steps < first_) return;
        symbols_ += size;
        if (symbols_ > limits_.symbols) {
            throw BudgetError(
                fmt::format("step {}: the words have more than {} symbols in all", last.steps, limits_.symbols));
        }
    }

    const Grammar& grammar_;
    std::int64_t first_;
    WordLineageLimits limits_;
    const Monitor& monitor_;
    DerivationOptions options_;
    MatchingWork work_;
    std::uint64_t longest_;  ///< symbols of a word that is not shown
    std::vector<LineageWord> words_;
    std::uint64_t symbols_ = 0;
    double visited_ = 0;
};

}  // namespace

std::vector<LineageWord> word_lineage(const Grammar& grammar, std::int64_t first, std::int64_t last, bool interpreted,
                                      const WordLineageLimits& limits, const Monitor& monitor) {
    require_word(grammar);
    LineageMaker maker(grammar, first, limits, monitor);
    std::int64_t done = 0;
    for (const ScheduleRun& run : grammar.schedule()) {
        for (std::int64_t i = 0; i < run.steps && done < last; ++i, ++done) {
            monitor.check();
            maker.step(grammar.tables()[run.table], false);
        }
    }
    if (interpreted && grammar.interpretation()) maker.step(*grammar.interpretation(), true);
    return maker.words();
}

}  // namespace sikku
