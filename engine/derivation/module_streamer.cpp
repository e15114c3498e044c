#include "engine/derivation/choice.h"
#include "engine/derivation/drawn_successors.h"
#include "engine/derivation/levels.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <memory>
#include <span>
#include <vector>

namespace sikku {
namespace {

constexpr std::size_t most_pending = std::size_t{1} << 27;  // parameters, while words are streamed

/// Expands words depth first through `levels` if modules differ: with parameters or random choices.
class ModuleStreamer {
public:
    ModuleStreamer(const Grammar& grammar, const Levels& levels, const DerivationOptions& options, SymbolSink& sink)
        : grammar_(grammar),
          levels_(levels),
          first_step_(grammar.steps_done() + 1),
          has_places_(grammar.is_stochastic()),
          options_(options),
          sink_(sink),
          visited_(grammar, options) {
        for (const SymbolInfo& symbol : grammar.symbols()) arity_.push_back(symbol.arity);
        active_.assign(arity_.size(), 0);
        for (std::int64_t level = levels.count(); level > 0; level = levels.stretch_begin(level)) {
            for (Symbol symbol = 0; symbol < active_.size(); ++symbol) {
                if (!levels.table(level).candidates(symbol).empty()) active_[symbol] = 1;
            }
        }
        symbols_.resize(longest_run);
        const auto largest = std::max_element(arity_.begin(), arity_.end());
        arguments_.resize(longest_run * (largest == arity_.end() ? 0 : *largest));
    }

    void stream(const ModuleWord& word) {
        const double* next = word.arguments.data();
        const std::size_t size = word.symbols.size();
        for (std::size_t i = 0; i < size;) {
            const std::size_t begin = i;
            const double* first = next;
            while (i < size && i - begin < longest_run && !active_[word.symbols[i]])
                next += arity_[word.symbols[i++]];
            emit(word.symbols.data() + begin, i - begin, first);
            if (i == size || !active_[word.symbols[i]]) continue;
            const Symbol symbol = word.symbols[i];
            const std::uint64_t place = has_places_ ? grammar_.place_of(word, i) : 0;
            double* const own = room(arity_[symbol]);
            std::copy(next, next + arity_[symbol], own);
            top_ += arity_[symbol];
            next += arity_[symbol];
            ++i;
            expand(symbol, 0, place, levels_.count());
            while (!frames_.empty()) advance();
            top_ = 0;
        }
        flush();
    }

private:
    struct Frame {
        const Symbol* first;
        const Symbol* next;
        const Symbol* end;
        std::size_t begin;     // size of the stack after the frame
        std::size_t argument;  // first argument of the next child
        std::int64_t level;
        std::uint64_t place;  // place of the parent
    };

    /// Returns space for `count` values at the top of the stack.
    double* room(std::size_t count) {
        if (top_ + count > stack_.size()) {
            if (top_ + count > most_pending) throw BudgetError("too many parameters are pending at a time");
            stack_.resize(2 * (top_ + count) + 64);
        }
        return stack_.data() + top_;
    }

    const Table& table(std::int64_t level) {
        if (level <= table_begin_ || level > table_end_) {
            table_ = &levels_.table(level);
            std::unique_ptr<Choices>& choices = choices_of_[table_];
            if (!choices) choices = std::make_unique<Choices>(grammar_, *table_);
            choices_ = choices.get();
            table_begin_ = levels_.stretch_begin(level);
            table_end_ = level;
        }
        return *table_;
    }

    /// Emits the unchanged children of the last frame up to the next one with productions, and expands that.
    void advance() {
        Frame& frame = frames_.back();
        const Symbol* const begin = frame.next;
        const Symbol* next = begin;
        std::size_t own = 0;
        while (next != frame.end && !active_[*next]) own += arity_[*next++];
        if (next != begin) emit(begin, static_cast<std::size_t>(next - begin), stack_.data() + frame.argument);
        if (next == frame.end) {
            top_ = frame.begin;
            frames_.pop_back();
            return;
        }
        const Symbol symbol = *next;
        const std::uint64_t place =
            has_places_ ? child_place(frame.place, static_cast<std::uint64_t>(next - frame.first)) : 0;
        const std::size_t argument = frame.argument + own;
        frame.next = next + 1;
        frame.argument = argument + arity_[symbol];
        expand(symbol, argument, place, frame.level);
    }

    /// Expands a module whose arguments are in the stack at `argument`, with `level` tables still to be applied.
    void expand(Symbol symbol, std::size_t argument, std::uint64_t place, std::int64_t level) {
        const std::size_t top = top_;
        while (level > 0) {
            const Table& rules = table(level);
            const Chance chance{place, first_step_ + levels_.count() - level};
            const auto candidates = rules.candidates(symbol);
            if (candidates.empty()) {
                // A symbol that is unchanged once stays unchanged under the same table.
                level = rules.has_random_conditions() ? level - 1 : table_begin_;
                continue;
            }
            visited_.add(1);
            std::span<const Symbol> successor;
            std::span<const Expression> own;
            if (choices_->is_usable()) {
                const Choices::Successor& chosen = choices_->of(symbol, chance);
                // The last two steps at once.
                if (level == 2 && chosen.is_split && table_begin_ == 0) {
                    if (count_ + Choices::most_written > longest_run) flush();
                    const std::size_t written =
                        choices_->write(chosen, place, chance.step + 1, symbols_.data() + count_);
                    visited_.add(written);
                    count_ += written;
                    top_ = top;
                    return;
                }
                successor = std::span(chosen.symbols).first(chosen.size);
            } else {
                std::span<const double> formals(stack_.data() + argument, arity_[symbol]);
                const Production* const production = choose(
                    rules, candidates, chance, [&](const char* message) { tell(symbol, argument, chance, message); },
                    formals, [](const Production&) { return true; });
                if (!production) {
                    level = rules.has_random_conditions() ? level - 1 : table_begin_;
                    continue;
                }
                successor = production->successor;
                own = production->arguments;
            }
            --level;
            if (level == 0 && successor.size() <= longest_run) {
                // The last step is written directly into the run.
                if (count_ + successor.size() > longest_run) flush();
                visited_.add(successor.size());
                std::copy(successor.begin(), successor.end(), symbols_.begin() + static_cast<std::ptrdiff_t>(count_));
                count_ += successor.size();
                const std::span<const double> formals(stack_.data() + argument, arity_[symbol]);
                double* next = arguments_.data() + argument_count_;
                for (const Expression& expression : own) *next++ = expression.evaluate(formals, chance);
                argument_count_ += own.size();
                top_ = top;
                return;
            }
            double* const values = room(own.size());
            const std::span<const double> formals(stack_.data() + argument, arity_[symbol]);
            for (std::size_t i = 0; i < own.size(); ++i) values[i] = own[i].evaluate(formals, chance);
            if (successor.size() != 1) {
                if (successor.empty()) {
                    top_ = top;
                } else {
                    const Symbol* const first = successor.data();
                    frames_.push_back({first, first, first + successor.size(), top, top_, level, place});
                    top_ += own.size();
                }
                return;
            }
            // A unit successor replaces its parent.
            symbol = successor.front();
            if (has_places_) place = child_place(place, 0);
            std::copy(values, values + own.size(), stack_.begin() + static_cast<std::ptrdiff_t>(top));
            top_ = top + own.size();
            argument = top;
        }
        emit(&symbol, 1, stack_.data() + argument);
        top_ = top;
    }

    void emit(const Symbol* symbols, std::size_t count, const double* arguments) {
        if (count == 0) return;
        visited_.add(count);
        while (count > 0) {
            if (count_ + count > longest_run) flush();
            const std::size_t taken = std::min(count, longest_run);
            for (std::size_t i = 0; i < taken; ++i) {
                symbols_[count_ + i] = symbols[i];
                for (std::uint32_t k = arity_[symbols[i]]; k > 0; --k) arguments_[argument_count_++] = *arguments++;
            }
            count_ += taken;
            symbols += taken;
            count -= taken;
        }
    }

    void flush() {
        if (count_ == 0) return;
        handed_over_ += count_;
        sink_.symbols({std::span(symbols_).first(count_), -1, std::span(arguments_).first(argument_count_)});
        if (options_.watch) options_.watch(count_);
        count_ = 0;
        argument_count_ = 0;
    }

    [[noreturn]] void tell(Symbol symbol, std::size_t argument, const Chance& chance, const char* message) {
        throw WordError(fmt::format(
            "step {}: what becomes symbol {} of the word, '{}': {}", chance.step, handed_over_ + count_ + 1,
            symbol_text(grammar_.symbols()[symbol], {stack_.data() + argument, arity_[symbol]}), message));
    }

    const Grammar& grammar_;
    const Levels& levels_;
    std::int64_t first_step_;
    bool has_places_;
    const DerivationOptions& options_;
    SymbolSink& sink_;
    std::vector<std::uint32_t> arity_;
    std::vector<char> active_;  // symbols that some table rewrites
    std::vector<Frame> frames_;
    std::vector<double> stack_;  // arguments of the symbols in the frames
    std::size_t top_ = 0;        // top of the stack
    Word symbols_;               // symbols of the next run
    std::size_t count_ = 0;
    std::vector<double> arguments_;
    std::size_t argument_count_ = 0;
    VisitedNodes visited_;
    std::uint64_t handed_over_ = 0;
    std::map<const Table*, std::unique_ptr<Choices>> choices_of_;  // for the tables used so far
    // The table of the level last requested and of the levels above table_begin_.
    const Table* table_ = nullptr;
    const Choices* choices_ = nullptr;
    std::int64_t table_begin_ = 0;
    std::int64_t table_end_ = 0;
};

}  // namespace

void VisitedNodes::look() {
    next_look_ = count_ + between_watches;
    if (static_cast<double>(count_) > options_.most_nodes) {
        throw BudgetError(fmt::format("deriving the word (n = {}) visits more nodes than the budget of {:.0f}",
                                      grammar_.steps(), options_.most_nodes));
    }
    if (options_.watch) options_.watch(0);
}

void stream_modules(const Grammar& grammar, const Levels& levels, const DerivationOptions& options,
                    SymbolSink& sink) {
    ModuleStreamer(grammar, levels, options, sink).stream(grammar.axiom_modules());
}

}  // namespace sikku
