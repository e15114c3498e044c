#include "engine/derivation/derivation.h"

#include "engine/base/bits.h"
#include "engine/derivation/levels.h"
#include "engine/derivation/neighbourhood.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <utility>

namespace sikku {
namespace {

/// Compares arguments bit by bit: -0 is not 0.
bool is_same(const ModuleWord& one, const ModuleWord& other) {
    return one.symbols == other.symbols &&
           std::equal(one.arguments.begin(), one.arguments.end(), other.arguments.begin(), other.arguments.end(),
                      [](double a, double b) { return bit_cast<std::uint64_t>(a) == bit_cast<std::uint64_t>(b); });
}

}  // namespace

void require_word(const Grammar& grammar) {
    if (grammar.map()) throw WordError("this pattern is a map; it has no word that a turtle could read");
}

Grammar resolve_contexts(Grammar grammar, const DerivationOptions& options) {
    require_word(grammar);
    const std::int64_t whole = grammar.whole_word_steps();
    if (whole == 0) return grammar;
    ModuleWord word;  // after the first step
    const std::int64_t done = grammar.steps_done();
    std::int64_t step = 0;
    std::uint64_t visited = 0;
    MatchingWork work(options);
    for (const ScheduleRun& run : grammar.schedule()) {
        for (std::int64_t i = 0; i < run.steps && step < whole; ++i, ++step) {
            const ModuleWord& before = step > 0 ? word : grammar.axiom_modules();
            const auto refuse = [&](const std::string& what, std::uint64_t most) {
                // With a schedule, a shorter derivation consists of different steps.
                const std::string advice = grammar.has_schedule()
                                               ? ""
                                               : fmt::format("; the largest derivation length that fits is {}", step);
                throw BudgetError(fmt::format(
                    "productions that look at their neighbours need whole words, and {} of step {} (of n = "
                    "{}) would have more than {} symbols{}",
                    what, step + 1, grammar.steps(), most, advice));
            };
            visited += before.symbols.size();
            if (visited > options.whole_words) refuse("all words up to that", options.whole_words);
            ModuleWord next;
            try {
                next = rewrite(grammar, grammar.tables()[run.table], before, done + step + 1, options, work);
            } catch (const MatchingError&) {
                throw;
            } catch (const BudgetError&) {
                refuse("that", options.longest_word);
            }
            // If a table does not change the word, it does not change it in the rest of its run either.
            const bool unchanged = !grammar.is_stochastic() && is_same(next, before);
            std::swap(word, next);
            work.memory.spare = std::move(next.symbols);
            if (options.watch) options.watch(0);
            if (unchanged) {
                step += std::min(run.steps - i, whole - step) - 1;
                i = run.steps;
            }
        }
    }
    return std::move(grammar).after(whole, std::make_shared<const ModuleWord>(std::move(word)));
}

void derive(const Grammar& given, SymbolSink& sink, const DerivationOptions& options) {
    require_word(given);
    if (given.whole_word_steps() > 0) return derive(resolve_contexts(given, options), sink, options);
    const Levels levels(given, options.interpreted);
    if (given.is_plain()) {
        stream_symbols(given, levels, options, sink);
    } else {
        stream_modules(given, levels, options, sink);
    }
    sink.finish();
}

Grammar write_out(const Grammar& given, DerivationOptions options) {
    class Writer : public SymbolSink {
    public:
        explicit Writer(std::uint64_t longest) : longest_(longest) {}
        void symbols(const Run& run) override {
            if (run.symbols.size() > longest_ - word.symbols.size()) {
                throw BudgetError(fmt::format("the word has more than {} symbols", longest_));
            }
            word.symbols.insert(word.symbols.end(), run.symbols.begin(), run.symbols.end());
            word.arguments.insert(word.arguments.end(), run.arguments.begin(), run.arguments.end());
        }
        ModuleWord word;

    private:
        std::uint64_t longest_;
    } writer(options.longest_word);
    options.interpreted = true;
    options.pruner = nullptr;
    derive(given, writer, options);
    auto written = given.written_out(writer.word);
    if (!written) throw BudgetError("the word has more than 524,288 different modules");
    return std::move(*written);
}

}  // namespace sikku
