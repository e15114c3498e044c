#include "engine/base/threads.h"
#include "engine/derivation/choice.h"
#include "engine/derivation/drawn_successors.h"
#include "engine/derivation/levels.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <utility>
#include <vector>

namespace sikku {
namespace {

constexpr std::size_t most_pending = std::size_t{1} << 27;  // parameters, while words are streamed

// Words are expanded by one thread until so many nodes were visited, and then by several.
constexpr std::uint64_t long_word = std::uint64_t{1} << 21;
// Nodes that a thread expands before its next batch: about so many, and at most, in addition to one module's.
constexpr std::uint64_t usual_batch = std::uint64_t{1} << 14;
constexpr std::uint64_t largest_batch = std::uint64_t{1} << 16;
constexpr std::int64_t most_measured_levels = 4096;

/// Modules that are expanded one after another.
struct Batch {
    struct Module {
        Symbol symbol;
        std::int64_t level;  // tables still to be applied
        std::uint64_t place;
    };
    std::vector<Module> modules;
    std::vector<double> arguments;  // of each module, in order
    std::size_t growing = 0;        // modules with tables still to be applied

    void clear() {
        modules.clear();
        arguments.clear();
        growing = 0;
    }
};

/// Keeps the runs of a part of a word.
class RunKeeper : public SymbolSink {
public:
    void symbols(const Run& run) override {
        symbols_.insert(symbols_.end(), run.symbols.begin(), run.symbols.end());
        arguments_.insert(arguments_.end(), run.arguments.begin(), run.arguments.end());
        sizes_.emplace_back(run.symbols.size(), run.arguments.size());
    }
    void clear() {
        symbols_.clear();
        arguments_.clear();
        sizes_.clear();
    }
    /// Calls take(run) for each.
    template <class Take>
    void for_each(const Take& take) const {
        std::size_t symbol = 0;
        std::size_t argument = 0;
        for (const auto& [symbols, arguments] : sizes_) {
            take(Run{std::span(symbols_).subspan(symbol, symbols), -1,
                     std::span(arguments_).subspan(argument, arguments)});
            symbol += symbols;
            argument += arguments;
        }
    }

private:
    Word symbols_;
    std::vector<double> arguments_;
    std::vector<std::pair<std::size_t, std::size_t>> sizes_;  // of each run: symbols, arguments
};

/// Expands words depth first through `levels` if modules differ: with parameters or random choices. Long words are
/// divided into batches of modules, which several threads expand, and which are handed over in order. What becomes of
/// a module depends only on its arguments and its place, so the word does not depend on the threads.
class ModuleStreamer {
public:
    ModuleStreamer(const Grammar& grammar, const Levels& levels, const DerivationOptions& options, SymbolSink& sink)
        : grammar_(grammar),
          levels_(levels),
          first_step_(grammar.steps_done() + 1),
          has_places_(grammar.is_stochastic()),
          options_(options),
          sink_(&sink),
          measured_(static_cast<std::size_t>(std::min(levels.count(), most_measured_levels)) + 1) {
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
        word_ = &word;
        next_argument_ = word.arguments.data();
        while (is_more() && visited_ < long_word) step();
        if (is_more() && divide()) in_parallel();
        while (is_more()) step();
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
        std::uint64_t place;    // place of the parent
        std::uint64_t visited;  // nodes before it
    };

    /// Nodes of the expansions of modules.
    struct Measured {
        std::uint64_t count = 0, nodes = 0;
        double mean() const { return count == 0 ? 0.0 : static_cast<double>(nodes) / static_cast<double>(count); }
    };
    struct Part;
    /// Hands over for another streamer.
    class Through : public SymbolSink {
    public:
        explicit Through(ModuleStreamer& to) : to_(to) {}
        void symbols(const Run& run) override { to_.send(run); }

    private:
        ModuleStreamer& to_;
    };

    bool is_more() const { return !frames_.empty() || next_ < word_->symbols.size(); }

    /// Goes on with the word.
    void step() {
        if (!frames_.empty()) return advance();
        top_ = 0;
        const Word& symbols = word_->symbols;
        const std::size_t begin = next_;
        const double* const first = next_argument_;
        while (next_ < symbols.size() && next_ - begin < longest_run && !active_[symbols[next_]]) {
            next_argument_ += arity_[symbols[next_++]];
        }
        emit(symbols.data() + begin, next_ - begin, first);
        if (next_ == symbols.size() || !active_[symbols[next_]]) return;
        const std::uint64_t place = has_places_ ? grammar_.place_of(*word_, next_) : 0;
        expand_next({symbols[next_], levels_.count(), place});
    }

    /// Expands the next module of the word or the batch.
    void expand_next(const Batch::Module& module) {
        const std::uint32_t arity = arity_[module.symbol];
        top_ = 0;
        std::copy(next_argument_, next_argument_ + arity, room(arity));
        next_argument_ += arity;
        ++next_;
        top_ = arity;
        expand(module.symbol, 0, module.place, module.level);
    }

    /// Chooses the level at which the rest of the word is divided; false if that is of no use.
    bool divide() {
        if (available_threads() < 2) return false;
        for (std::size_t level = 1; level < measured_.size(); ++level) {
            const double mean = measured_[level].mean();
            if (mean > 0 && mean <= static_cast<double>(usual_batch) / 2) divided_ = static_cast<std::int64_t>(level);
        }
        constexpr double least = 64;
        if (divided_ == 0 || measured_[static_cast<std::size_t>(divided_)].mean() < least) return false;
        // The limits of the system may allow no more threads.
        const int others = available_threads() - 1;
        return startable_threads(others) == others;
    }

    void in_parallel();

    void begin(const Batch& batch, SymbolSink& sink) {
        sink_ = &sink;
        next_ = 0;
        next_argument_ = batch.arguments.data();
        frames_.clear();
        top_ = count_ = argument_count_ = 0;
        visited_ = handed_over_ = 0;
        next_look_ = UINT64_MAX;
    }

    /// Expands a batch until so many nodes were visited; false if nothing is left.
    bool go_on(const Batch& batch, std::uint64_t most) {
        while (visited_ < most && (!frames_.empty() || next_ < batch.modules.size())) {
            if (!frames_.empty()) {
                advance();
            } else {
                expand_next(batch.modules[next_]);
            }
        }
        flush();
        return !frames_.empty() || next_ < batch.modules.size();
    }

    void add_to_batch(Symbol symbol, const double* arguments, std::uint64_t place, std::int64_t level) {
        batch_->modules.push_back({symbol, level, place});
        batch_->arguments.insert(batch_->arguments.end(), arguments, arguments + arity_[symbol]);
        if (level > 0) ++batch_->growing;
    }

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
            if (const auto level = static_cast<std::size_t>(frame.level) + 1; level < measured_.size()) {
                ++measured_[level].count;
                measured_[level].nodes += visited_ - frame.visited;
            }
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
            if (batch_ && level <= divided_) {
                add_to_batch(symbol, stack_.data() + argument, place, level);
                top_ = top;
                return;
            }
            const Table& rules = table(level);
            const Chance chance{place, first_step_ + levels_.count() - level};
            const auto candidates = rules.candidates(symbol);
            if (candidates.empty()) {
                // A symbol that is unchanged once stays unchanged under the same table.
                level = rules.has_random_conditions() ? level - 1 : table_begin_;
                continue;
            }
            visit(1);
            std::span<const Symbol> successor;
            std::span<const Expression> own;
            if (choices_->is_usable()) {
                const Choices::Successor& chosen = choices_->of(symbol, chance);
                // The last two steps at once.
                if (level == 2 && chosen.is_split && table_begin_ == 0) {
                    if (count_ + Choices::most_written > longest_run) flush();
                    const std::size_t written =
                        choices_->write(chosen, place, chance.step + 1, symbols_.data() + count_);
                    visit(written);
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
                visit(successor.size());
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
                    frames_.push_back({first, first, first + successor.size(), top, top_, level, place, visited_});
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
        if (batch_) {
            for (; count > 0; --count, arguments += arity_[*symbols++]) add_to_batch(*symbols, arguments, 0, 0);
            return;
        }
        visit(count);
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

    void visit(std::size_t nodes) {
        visited_ += nodes;
        if (visited_ >= next_look_) look();
    }

    void look() {
        next_look_ = visited_ + between_watches;
        if (static_cast<double>(visited_) > options_.most_nodes) {
            throw BudgetError(fmt::format("deriving the word (n = {}) visits more nodes than the budget of {:.0f}",
                                          grammar_.steps(), options_.most_nodes));
        }
        if (options_.watch) options_.watch(0);
    }

    void flush() {
        if (count_ == 0) return;
        send({std::span(symbols_).first(count_), -1, std::span(arguments_).first(argument_count_)});
        count_ = 0;
        argument_count_ = 0;
    }

    void send(const Run& run) {
        handed_over_ += run.symbols.size();
        sink_->symbols(run);
        if (options_.watch) options_.watch(run.symbols.size());
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
    SymbolSink* sink_;
    // The word, or the batch, and what of it comes next.
    const ModuleWord* word_ = nullptr;
    std::size_t next_ = 0;
    const double* next_argument_ = nullptr;
    // While the word is divided: modules with up to `divided_` tables still to be applied are added to the batch.
    Batch* batch_ = nullptr;
    std::int64_t divided_ = 0;
    std::vector<Measured> measured_;  // by the tables still to be applied
    std::vector<std::uint32_t> arity_;
    std::vector<char> active_;  // symbols that some table rewrites
    std::vector<Frame> frames_;
    std::vector<double> stack_;  // arguments of the symbols in the frames
    std::size_t top_ = 0;        // top of the stack
    Word symbols_;               // symbols of the next run
    std::size_t count_ = 0;
    std::vector<double> arguments_;
    std::size_t argument_count_ = 0;
    std::uint64_t visited_ = 0;
    std::uint64_t next_look_ = between_watches;
    std::uint64_t handed_over_ = 0;
    std::map<const Table*, std::unique_ptr<Choices>> choices_of_;  // for the tables used so far
    // The table of the level last requested and of the levels above table_begin_.
    const Table* table_ = nullptr;
    const Choices* choices_ = nullptr;
    std::int64_t table_begin_ = 0;
    std::int64_t table_end_ = 0;
};

/// A batch, and who expands it.
struct ModuleStreamer::Part {
    Part(const Grammar& grammar, const Levels& levels, const DerivationOptions& options)
        : streamer(grammar, levels, options, keeper) {}
    Batch batch;
    RunKeeper keeper;
    ModuleStreamer streamer;
    bool is_more = false;
    bool has_failed = false;
};

void ModuleStreamer::in_parallel() {
    flush();
    const DerivationOptions unlimited;
    const std::size_t places = 2 * static_cast<std::size_t>(available_threads()) + 2;
    std::vector<std::unique_ptr<Part>> parts;
    for (std::size_t i = 0; i < places; ++i) parts.push_back(std::make_unique<Part>(grammar_, levels_, unlimited));
    const double mean = measured_[static_cast<std::size_t>(divided_)].mean();
    const auto growing = static_cast<std::size_t>(static_cast<double>(usual_batch) / mean) + 1;
    const auto prepare = [&](std::size_t place) {
        batch_ = &parts[place]->batch;
        batch_->clear();
        while (is_more() && batch_->growing < growing && batch_->modules.size() < usual_batch) step();
        return !batch_->modules.empty();
    };
    const auto work = [&](std::size_t place) {
        Part& part = *parts[place];
        try {
            part.keeper.clear();
            part.streamer.begin(part.batch, part.keeper);
            part.is_more = part.streamer.go_on(part.batch, largest_batch);
            part.has_failed = false;
        } catch (...) {
            part.has_failed = true;
        }
    };
    const auto deliver = [&](std::size_t place) {
        Part& part = *parts[place];
        Through through(*this);
        if (part.has_failed) {
            // Fails again, and tells where in the word.
            part.streamer.begin(part.batch, through);
            part.is_more = true;
        } else {
            visit(std::exchange(part.streamer.visited_, 0));
            part.keeper.for_each([this](const Run& run) { send(run); });
            part.streamer.sink_ = &through;
        }
        part.streamer.handed_over_ = handed_over_;
        while (part.is_more) {
            part.is_more = part.streamer.go_on(part.batch, between_watches);
            visit(std::exchange(part.streamer.visited_, 0));
        }
    };
    hand_over_in_order(places, prepare, work, deliver);
    batch_ = nullptr;
}

}  // namespace

void stream_modules(const Grammar& grammar, const Levels& levels, const DerivationOptions& options,
                    SymbolSink& sink) {
    ModuleStreamer(grammar, levels, options, sink).stream(grammar.axiom_modules());
}

}  // namespace sikku
