#include "engine/derivation/derivation.h"

#include "engine/base/bits.h"
#include "engine/derivation/levels.h"
#include "engine/derivation/nearest_steps.h"
#include "engine/derivation/neighbourhood.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
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

/// The word of a derivation that keeps whole words: as bytes if possible, otherwise as modules.
class KeptWord {
public:
    KeptWord(const Grammar& grammar, const DerivationOptions& options)
        : grammar_(grammar), options_(options), work_(options) {}

    std::size_t size() const {
        return has_bytes_ ? bytes_.size() : is_axiom_ ? grammar_.axiom().size() : modules_.symbols.size();
    }

    /// Makes a step, counted from 1. Returns false if the table changes the word neither now nor later.
    /// @throws BudgetError
    bool rewrite(const Table& table, std::int64_t step) {
        NearestSteps& nearest = nearest_.try_emplace(&table, grammar_, table).first->second;
        return nearest.is_usable() ? rewrite_bytes(nearest, step) : rewrite_modules(table, step);
    }

    ModuleWord modules() && {
        leave_bytes();
        if (is_axiom_) return grammar_.axiom_modules();
        return std::move(modules_);
    }

private:
    bool rewrite_bytes(NearestSteps& nearest, std::int64_t step) {
        if (!has_bytes_) {
            const Word& symbols = is_axiom_ ? grammar_.axiom() : modules_.symbols;
            bytes_.resize(symbols.size());
            std::transform(symbols.begin(), symbols.end(), bytes_.data(),
                           [](Symbol symbol) { return static_cast<std::uint8_t>(symbol); });
            modules_ = {};
            has_bytes_ = true;
            is_axiom_ = false;
        }
        work_.begin_step(step, bytes_.size());
        work_.add(bytes_.size());
        const std::uint64_t longest = longest_word(options_);
        const auto watch = [this] {
            if (options_.watch) options_.watch(0);
        };
        if (bytes_.size() > longest || nearest.rewrite(bytes_, next_, longest, watch) > longest) {
            throw BudgetError(fmt::format("the word has more than {} symbols", longest));
        }
        const bool is_same =
            next_.size() == bytes_.size() && std::equal(next_.data(), next_.data() + next_.size(), bytes_.data());
        std::swap(bytes_, next_);
        return !is_same;
    }

    bool rewrite_modules(const Table& table, std::int64_t step) {
        leave_bytes();
        const ModuleWord& before = is_axiom_ ? grammar_.axiom_modules() : modules_;
        ModuleWord next = sikku::rewrite(grammar_, table, before, step, options_, work_);
        const bool is_changed = grammar_.is_stochastic() || !is_same(next, before);
        std::swap(modules_, next);
        work_.memory.spare = std::move(next.symbols);
        is_axiom_ = false;
        return is_changed;
    }

    void leave_bytes() {
        if (!has_bytes_) return;
        modules_.symbols.assign(bytes_.data(), bytes_.data() + bytes_.size());
        bytes_ = {};
        next_ = {};
        has_bytes_ = false;
    }

    const Grammar& grammar_;
    const DerivationOptions& options_;
    MatchingWork work_;
    std::map<const Table*, NearestSteps> nearest_;
    bool is_axiom_ = true;  // no step was made
    bool has_bytes_ = false;
    ModuleWord modules_;
    ByteWord bytes_, next_;
};

}  // namespace

void require_word(const Grammar& grammar) {
    if (grammar.map()) throw WordError("this pattern is a map; it has no word that a turtle could read");
}

Grammar resolve_contexts(Grammar grammar, const DerivationOptions& options) {
    require_word(grammar);
    const std::int64_t whole = grammar.whole_word_steps();
    if (whole == 0) return grammar;
    KeptWord word(grammar, options);
    const std::int64_t done = grammar.steps_done();
    std::int64_t step = 0;
    std::uint64_t visited = 0;
    for (const ScheduleRun& run : grammar.schedule()) {
        for (std::int64_t i = 0; i < run.steps && step < whole; ++i, ++step) {
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
            visited += word.size();
            if (visited > options.whole_words) refuse("all words up to that", options.whole_words);
            bool is_changed = true;
            try {
                is_changed = word.rewrite(grammar.tables()[run.table], done + step + 1);
            } catch (const MatchingError&) {
                throw;
            } catch (const BudgetError&) {
                refuse("that", options.longest_word);
            }
            if (options.watch) options.watch(0);
            // If a table does not change the word, it does not change it in the rest of its run either.
            if (!is_changed) {
                step += std::min(run.steps - i, whole - step) - 1;
                i = run.steps;
            }
        }
    }
    return std::move(grammar).after(whole, std::make_shared<const ModuleWord>(std::move(word).modules()));
}

void derive(const Grammar& given, SymbolSink& sink, const DerivationOptions& options) {
    require_word(given);
    if (given.whole_word_steps() > 0) return derive(resolve_contexts(given, options), sink, options);
    const Levels levels(given, options.interpreted);
    if (given.is_plain()) {
        stream_symbols(given, levels, options, sink);
    } else if (!stream_drawn(given, levels, options, sink)) {
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
