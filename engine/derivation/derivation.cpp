#include "engine/derivation/derivation.h"

#include "engine/derivation/neighbourhood.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <map>
#include <memory>
#include <numeric>
#include <optional>
#include <vector>

namespace sikku {
namespace {

constexpr std::size_t longest_run = 4096;
constexpr std::size_t shortest_block = 32;  // below this a block is copied into the run being gathered
constexpr std::size_t most_pending = std::size_t{1} << 27;         // parameters, while words are streamed
constexpr std::uint64_t between_watches = std::uint64_t{1} << 16;  // symbols or frames

/// The tables from the last level upwards: level 0 is the finished word, level r has r tables still to come.
/// Adjacent levels of one table are one stretch, so that a million steps cost nothing to describe.
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
    /// The largest number of neighbouring levels that `table` rules.
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

    /// The last level below `level` that another stretch rules; 0 if there is none.
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

/// Expansions of (symbol, level) that are short enough to be kept, as pieces of one arena.
class Blocks {
public:
    struct Entry {
        std::uint32_t offset = 0;
        std::uint32_t length = large;
        std::int32_t number = -1;
    };
    static constexpr std::uint32_t large = std::numeric_limits<std::uint32_t>::max();

    Blocks(const Grammar& grammar, const Levels& levels, std::size_t memory)
        : symbols_(grammar.symbols().size()), memory_(memory) {
        const std::vector<char> needed = grammar.reachable();
        for (Symbol symbol = 0; symbol < symbols_; ++symbol) {
            entries_.push_back(needed[symbol] ? append(std::span(&symbol, 1)) : Entry{});
        }
        // Above a level without short expansions only a symbol that is erased has one.
        const bool erasing = std::any_of(grammar.tables().begin(), grammar.tables().end(), [&](const Table& table) {
            for (Symbol symbol = 0; symbol < symbols_; ++symbol) {
                if (const Word* successor = table.successor(symbol); successor && successor->empty()) return true;
            }
            return false;
        });
        while (levels_ < std::min(levels.count(), kept_levels(symbols_)) && (any_short_ || erasing)) {
            add_level(levels.table(++levels_), needed);
        }
    }

    /// Null if the expansion is not kept.
    const Entry* find(Symbol symbol, std::int64_t level) const {
        if (level > levels_) return nullptr;
        const Entry& entry = entries_[static_cast<std::size_t>(level) * symbols_ + symbol];
        return entry.length == large ? nullptr : &entry;
    }
    std::span<const Symbol> symbols(const Entry& entry) const {
        return std::span(arena_).subspan(entry.offset, entry.length);
    }

private:
    Entry append(std::span<const Symbol> word) {
        const Entry entry{static_cast<std::uint32_t>(arena_.size()), static_cast<std::uint32_t>(word.size()),
                          word.size() >= shortest_block ? number_++ : -1};
        arena_.insert(arena_.end(), word.begin(), word.end());
        return entry;
    }

    void add_level(const Table& table, const std::vector<char>& needed) {
        const std::size_t below = entries_.size() - symbols_;
        any_short_ = false;
        Word expansion;
        for (Symbol symbol = 0; symbol < symbols_; ++symbol) {
            const Word* successor = table.successor(symbol);
            Entry entry;
            if (!needed[symbol]) {
                // never asked for
            } else if (!successor) {
                entry = entries_[below + symbol];
            } else if (successor->size() == 1) {
                entry = entries_[below + successor->front()];
            } else {
                std::size_t length = 0;
                for (const Symbol child : *successor) {
                    length += std::min(entries_[below + child].length, std::uint32_t{longest_run + 1});
                }
                if (length <= longest_run && arena_.size() + length <= memory_) {
                    expansion.clear();
                    for (const Symbol child : *successor) {
                        const auto part = symbols(entries_[below + child]);
                        expansion.insert(expansion.end(), part.begin(), part.end());
                    }
                    entry = append(expansion);
                }
            }
            if (entry.length != large) any_short_ = true;
            entries_.push_back(entry);
        }
    }

    std::size_t symbols_;
    std::size_t memory_;
    std::int64_t levels_ = 0;
    std::int32_t number_ = 0;
    bool any_short_ = true;
    std::vector<Entry> entries_;
    Word arena_;
};

/// Long chains of units (b --> c, c --> b) under one table, taken in strides of powers of two.
class UnitChains {
public:
    UnitChains(const Table& table, std::size_t symbols, std::int64_t longest) {
        std::vector<Symbol> one(symbols);
        for (Symbol symbol = 0; symbol < symbols; ++symbol) {
            const Word* successor = table.successor(symbol);
            one[symbol] = !successor ? symbol : successor->size() == 1 ? successor->front() : none;
        }
        strides_.push_back(std::move(one));
        while (std::int64_t{1} << (strides_.size() - 1) <= longest / 2) {
            const std::vector<Symbol>& half = strides_.back();
            std::vector<Symbol> whole(symbols);
            for (Symbol symbol = 0; symbol < symbols; ++symbol) {
                whole[symbol] = half[symbol] == none ? none : half[half[symbol]];
            }
            strides_.push_back(std::move(whole));
        }
    }

    /// Rewrites `symbol` up to `steps` times while its successor is a unit; returns how often.
    std::int64_t follow(Symbol& symbol, std::int64_t steps) const {
        std::int64_t taken = 0;
        for (std::size_t k = strides_.size(); k > 0; --k) {
            const std::int64_t stride = std::int64_t{1} << (k - 1);
            while (steps - taken >= stride && strides_[k - 1][symbol] != none) {
                symbol = strides_[k - 1][symbol];
                taken += stride;
            }
        }
        return taken;
    }

private:
    static constexpr Symbol none = std::numeric_limits<Symbol>::max();
    std::vector<std::vector<Symbol>> strides_;
};

/// Depth-first expansion of `word` through `levels`.
class Streamer {
public:
    Streamer(const Grammar& grammar, const Levels& levels, const DerivationOptions& options, SymbolSink& sink)
        : symbols_(grammar.symbols().size()),
          levels_(levels),
          blocks_(grammar, levels, options.block_memory),
          watch_(options.watch),
          pruner_(options.pruner),
          sink_(sink) {
        pending_.reserve(longest_run);
    }

    void stream(const Word& word) {
        push(word, levels_.count());
        for (std::uint64_t visited = 1; !frames_.empty(); ++visited) {
            // Erased symbols may take long without a run.
            if (visited % between_watches == 0 && watch_) watch_(0);
            Frame& frame = frames_.back();
            const Symbol symbol = *frame.next++;
            const std::int64_t level = frame.level;
            // A frame is left before its last child is entered: right recursion needs no stack.
            if (frame.next == frame.end) frames_.pop_back();
            if (pruner_ && pruner_->active) {
                flush();
                if (pruner_->passes_over(symbol, level)) continue;
            }
            if (const Blocks::Entry* entry = blocks_.find(symbol, level)) {
                if (entry->length > 0) hand_over(*entry);
            } else {
                descend(symbol, level);
            }
        }
        flush();
    }

private:
    struct Frame {
        const Symbol* next;
        const Symbol* end;
        std::int64_t level;
    };

    void push(const Word& word, std::int64_t level) {
        if (!word.empty()) frames_.push_back({word.data(), word.data() + word.size(), level});
    }

    /// Follows unit successors without a frame for each.
    void descend(Symbol symbol, std::int64_t level) {
        for (int steps = 0; level > 0; ++steps) {
            const Table& table = levels_.table(level);
            if (steps >= long_chain) {
                level -= chains(table).follow(symbol, level - levels_.stretch_begin(level));
                steps = 0;
                if (level == 0) break;
                if (&levels_.table(level) != &table) continue;
            }
            const Word* successor = table.successor(symbol);
            --level;
            if (!successor) {
                if (stays_below(symbol, level)) break;
            } else if (successor->size() == 1) {
                symbol = successor->front();
            } else {
                push(*successor, level);
                return;
            }
            if (const Blocks::Entry* entry = blocks_.find(symbol, level)) {
                if (entry->length > 0) hand_over(*entry);
                return;
            }
        }
        gather(std::span(&symbol, 1));
    }

    const UnitChains& chains(const Table& table) {
        const auto found = chains_.find(&table);
        if (found != chains_.end()) return found->second;
        return chains_.try_emplace(&table, table, symbols_, levels_.longest_stretch(table)).first->second;
    }

    /// A symbol that no table rewrites below `level` stays for good.
    bool stays_below(Symbol symbol, std::int64_t& level) const {
        while (level > 0 && !levels_.table(level).successor(symbol)) level = levels_.stretch_begin(level);
        return level == 0;
    }

    void hand_over(const Blocks::Entry& entry) {
        const auto symbols = blocks_.symbols(entry);
        if (entry.number < 0) return gather(symbols);
        flush();
        send({symbols, entry.number});
    }

    void gather(std::span<const Symbol> symbols) {
        if (pending_.size() + symbols.size() > longest_run) flush();
        pending_.insert(pending_.end(), symbols.begin(), symbols.end());
    }

    void send(const Run& run) {
        sink_.symbols(run);
        if (watch_) watch_(run.symbols.size());
    }

    void flush() {
        if (pending_.empty()) return;
        send({pending_, -1});
        pending_.clear();
    }

    static constexpr int long_chain = 64;

    std::size_t symbols_;
    const Levels& levels_;
    std::map<const Table*, UnitChains> chains_;  // made when a long chain is met
    Blocks blocks_;
    const std::function<void(std::uint64_t)>& watch_;
    Pruner* pruner_;
    SymbolSink& sink_;
    std::vector<Frame> frames_;
    Word pending_;
};

bool looks_into_branches(const Grammar& grammar, const Table& table) {
    return std::any_of(table.productions().begin(), table.productions().end(), [&](const Production& production) {
        return std::any_of(production.right.begin(), production.right.end(),
                           [&](Symbol symbol) { return grammar.is_push(symbol); });
    });
}

/// One of those candidates of the group that match, the first of which does. `fault` throws, told what is wrong with
/// weights.
template <class Fault>
const Production& weighted_choice(const Table& table, std::span<const std::uint32_t> candidates,
                                  std::span<const double> formals, const Chance& chance, const Fault& fault) {
    const std::uint32_t group = table.production(candidates.front()).group;
    const auto each = [&](auto take) {
        for (std::size_t k = 0; k < candidates.size(); ++k) {
            const Production& production = table.production(candidates[k]);
            if (production.group != group) continue;
            if (k > 0 && production.condition && production.condition->evaluate(formals, chance) == 0) continue;
            if (take(production, production.weight->evaluate(formals, chance))) return;
        }
    };
    double sum = 0;
    each([&](const Production&, double weight) {
        if (!(weight >= 0)) fault("a weight is negative or no number");
        sum += weight;
        return false;
    });
    if (sum == 0) fault("the weights are all 0");
    if (!std::isfinite(sum)) fault("the weights have no finite sum");
    double left = chance.uniform(0) * sum;
    const Production* chosen = nullptr;
    each([&](const Production& production, double weight) {
        if (weight > 0) chosen = &production;
        left -= weight;
        return left < 0;
    });
    return *chosen;
}

/// The production that applies, or null. `match` tells of a production whether predecessor and contexts fit and,
/// then, sets `formals`; it is asked once for neighbouring candidates of one group.
template <class Match, class Fault>
const Production* choose(const Table& table, std::span<const std::uint32_t> candidates, const Chance& chance,
                         const Fault& fault, std::span<const double>& formals, Match match) {
    std::uint32_t asked = 0;  // groups are counted from 1
    bool fits = false;
    for (std::size_t k = 0; k < candidates.size(); ++k) {
        const Production& production = table.production(candidates[k]);
        if (production.group != asked) {
            fits = match(production);
            asked = production.group;
        }
        if (!fits || (production.condition && production.condition->evaluate(formals, chance) == 0)) continue;
        if (!production.weight) return &production;
        return &weighted_choice(table, candidates.subspan(k), formals, chance, fault);
    }
    return nullptr;
}

/// The word without its cut symbols and what follows them in their branches.
/// Source: Prusinkiewicz, Hammel, Hanan & Mech 1996, equation 13.
ModuleWord without_cuts(const Grammar& grammar, const ModuleWord& word) {
    ModuleWord result;
    const double* next = word.arguments.data();
    for (std::size_t at = 0; at < word.symbols.size(); ++at) {
        const auto pass = [&] { next += grammar.symbols()[word.symbols[at]].arity; };
        if (word.symbols[at] == *grammar.cut()) {
            for (std::size_t depth = 0; at < word.symbols.size(); ++at) {
                if (grammar.is_pop(word.symbols[at]) && depth-- == 0) break;
                if (grammar.is_push(word.symbols[at])) ++depth;
                pass();
            }
            if (at == word.symbols.size()) break;
        }
        const std::uint32_t arity = grammar.symbols()[word.symbols[at]].arity;
        result.symbols.push_back(word.symbols[at]);
        result.arguments.insert(result.arguments.end(), next, next + arity);
        if (grammar.is_stochastic()) {
            result.places.push_back(word.places.empty() ? axiom_place(grammar.seed(), at) : word.places[at]);
        }
        pass();
    }
    return result;
}

/// Does the predecessor, of which the first symbol is known to be there, stand in the word at that place?
bool stands_at(const Word& predecessor, const Word& word, std::size_t at, MatchingWork& work) {
    if (predecessor.size() == 1) return true;
    if (predecessor.size() > word.size() - at) return false;
    const auto [end, there] =
        std::mismatch(predecessor.begin() + 1, predecessor.end(), word.begin() + static_cast<std::ptrdiff_t>(at) + 1);
    work.add(static_cast<std::uint64_t>(end - predecessor.begin()));
    return end == predecessor.end();
}

/// One step of a system with parameters or chance.
class ModuleRewriter {
public:
    ModuleRewriter(const Grammar& grammar, const Table& table, const ModuleWord& word, std::int64_t step,
                   MatchingWork& work)
        : grammar_(grammar), table_(table), word_(word), step_(step), work_(work) {
        if (!table.context_free()) {
            neighbourhood_.emplace(grammar, word.symbols, looks_into_branches(grammar, table), work);
        }
        if (grammar.is_parametric() && neighbourhood_) {
            if (word.arguments.size() > UINT32_MAX) throw BudgetError("the word has more than 2^32 parameters");
            begin_.reserve(word.symbols.size());
            std::uint32_t next = 0;
            for (const Symbol symbol : word.symbols) {
                begin_.push_back(next);
                next += grammar.symbols()[symbol].arity;
            }
        }
    }

    ModuleWord run(std::uint64_t longest, const std::function<void()>& refuse) {
        ModuleWord result;
        result.symbols.reserve(word_.symbols.size());
        result.arguments.reserve(word_.arguments.size());
        const bool has_places = grammar_.is_stochastic();
        if (has_places) result.places.reserve(word_.symbols.size());
        const auto fault = [&](const char* message) {
            throw WordError(fmt::format("step {}: symbol {} of the word before it, '{}': {}", step_, at_ + 1,
                                        symbol_text(info(at_), {word_.arguments.data() + argument_, info(at_).arity}),
                                        message));
        };
        while (at_ < word_.symbols.size()) {
            work_.add(1);
            const Symbol symbol = word_.symbols[at_];
            const std::uint64_t place = !has_places            ? 0
                                        : word_.places.empty() ? axiom_place(grammar_.seed(), at_)
                                                               : word_.places[at_];
            const Chance chance{place, step_};
            const auto candidates = table_.candidates(symbol);
            const Production* production = nullptr;
            if (!candidates.empty()) {
                production = choose(table_, candidates, chance, fault, formals_,
                                    [this](const Production& candidate) { return matches(candidate); });
            }
            if (!production) {
                if (result.symbols.size() >= longest) refuse();
                result.symbols.push_back(symbol);
                const double* own = word_.arguments.data() + argument_;
                result.arguments.insert(result.arguments.end(), own, own + info(at_).arity);
                if (has_places) result.places.push_back(place);
                argument_ += info(at_++).arity;
                continue;
            }
            if (result.symbols.size() + production->successor.size() > longest) refuse();
            result.symbols.insert(result.symbols.end(), production->successor.begin(), production->successor.end());
            for (const Expression& argument : production->arguments) {
                result.arguments.push_back(argument.evaluate(formals_, chance));
            }
            if (has_places) {
                for (std::size_t i = 0; i < production->successor.size(); ++i) {
                    result.places.push_back(child_place(place, i));
                }
            }
            for (std::size_t i = 0; i < production->predecessor.size(); ++i) argument_ += info(at_++).arity;
        }
        return result;
    }

private:
    const SymbolInfo& info(std::size_t at) const { return grammar_.symbols()[word_.symbols[at]]; }

    bool matches(const Production& production) {
        const std::size_t end = at_ + production.predecessor.size();
        work_.add(1);
        if (!stands_at(production.predecessor, word_.symbols, at_, work_)) return false;
        std::size_t own = 0;
        for (std::size_t i = at_; i < end; ++i) own += info(i).arity;
        formals_ = std::span(word_.arguments).subspan(argument_, own);
        if (!production.has_context()) return true;
        if (begin_.empty()) {
            return neighbourhood_->left_matches(production.left, at_) &&
                   neighbourhood_->right_matches(production.right, end);
        }
        seen_.resize(production.left.size() + production.right.size());
        if (!neighbourhood_->left_matches(production.left, at_, seen_.data()) ||
            !neighbourhood_->right_matches(production.right, end, seen_.data() + production.left.size())) {
            return false;
        }
        gathered_.clear();
        const auto gather = [&](std::uint32_t place, Symbol symbol) {
            const std::uint32_t arity = grammar_.symbols()[symbol].arity;
            if (arity == 0) return;
            const double* first = word_.arguments.data() + begin_[place];
            gathered_.insert(gathered_.end(), first, first + arity);
        };
        for (std::size_t i = 0; i < production.left.size(); ++i) gather(seen_[i], production.left[i]);
        gathered_.insert(gathered_.end(), formals_.begin(), formals_.end());
        for (std::size_t i = 0; i < production.right.size(); ++i) {
            gather(seen_[production.left.size() + i], production.right[i]);
        }
        formals_ = gathered_;
        return true;
    }

    const Grammar& grammar_;
    const Table& table_;
    const ModuleWord& word_;
    std::int64_t step_;
    MatchingWork& work_;
    std::optional<Neighbourhood> neighbourhood_;
    std::vector<std::uint32_t> begin_;  // of each symbol's arguments, where contexts ask for them
    std::size_t at_ = 0;
    std::size_t argument_ = 0;  // of the symbol at_
    std::span<const double> formals_;
    std::vector<std::uint32_t> seen_;
    std::vector<double> gathered_;
};

/// What a table makes of symbols without parameters, where it draws among constant weights. It chooses as choose()
/// does.
class Choices {
public:
    static constexpr std::size_t longest = 16;  // of successors
    static constexpr std::size_t longest_tail = 8;
    static constexpr std::size_t most_symbols = 4096, most_alternatives = 32;  // of more it is of no use
    static constexpr std::size_t most_written = longest + longest * (longest + longest_tail);  // by write()

    struct Successor {
        std::array<Symbol, longest> symbols{};
        std::uint32_t size = 0;
        // The same for another step by this table: its symbols that are drawn for, and what lies between them, in
        // which nothing is drawn.
        bool is_split = false;
        struct Drawn {
            std::uint32_t child = 0;  ///< which of the symbols
            std::uint32_t choice = 0;
            std::uint32_t tail_size = 0;
            std::array<Symbol, longest_tail> tail{};  ///< what follows it
        };
        std::array<Symbol, longest> lead{};
        std::uint32_t lead_size = 0;
        std::vector<Drawn> drawn;
    };

    /// Of no use (is_usable()) where weights or conditions are to be computed, or successors are long.
    Choices(const Grammar& grammar, const Table& table) {
        const std::size_t symbols = grammar.symbols().size();
        is_usable_ = !grammar.is_parametric() && grammar.is_stochastic() && symbols <= most_symbols;
        for (Symbol symbol = 0; symbol < symbols && is_usable_; ++symbol) add(symbol, table);
        for (std::size_t i = 0; i < successors_.size() && is_usable_; ++i) split(successors_[i]);
    }
    bool is_usable() const { return is_usable_; }

    const Successor& of(Symbol symbol, const Chance& chance) const { return drawn(choices_[symbol], chance); }

    /// Writes what becomes of the symbols of a successor that is split, in that place, and at most `longest` more.
    /// @return how many there are
    std::size_t write(const Successor& parent, std::uint64_t place, std::int64_t step, Symbol* out) const {
        Symbol* const begin = out;
        std::memcpy(out, parent.lead.data(), sizeof(parent.lead));
        out += parent.lead_size;
        for (const Successor::Drawn& child : parent.drawn) {
            const Successor& successor = drawn(choices_[child.choice], {child_place(place, child.child), step});
            std::memcpy(out, successor.symbols.data(), sizeof(successor.symbols));
            out += successor.size;
            std::memcpy(out, child.tail.data(), sizeof(child.tail));
            out += child.tail_size;
        }
        return static_cast<std::size_t>(out - begin);
    }

private:
    struct Choice {
        std::uint32_t first = 0, count = 0;
    };

    const Successor& drawn(const Choice& choice, const Chance& chance) const {
        std::size_t chosen = choice.first;
        if (choice.count > 1) {
            const std::uint64_t bits = chance.bits(0);
            // Without branches, as nobody can foretell them.
            for (std::size_t k = 0; k + 1 < choice.count; ++k) chosen += bits >= begins_[choice.first + k] ? 1 : 0;
        }
        return successors_[chosen];
    }

    void add(Symbol symbol, const Table& table) {
        Choice choice;
        choice.first = static_cast<std::uint32_t>(successors_.size());
        const auto candidates = table.candidates(symbol);
        is_usable_ = candidates.size() <= most_alternatives;
        if (!is_usable_) return;
        std::vector<double> weights;
        const auto take = [&](std::span<const Symbol> word, double weight) {
            is_usable_ = is_usable_ && word.size() <= longest;
            if (!is_usable_) return;
            Successor& successor = successors_.emplace_back();
            std::copy(word.begin(), word.end(), successor.symbols.begin());
            successor.size = static_cast<std::uint32_t>(word.size());
            weights.push_back(weight);
        };
        for (const std::uint32_t index : candidates) {
            const Production& production = table.production(index);
            // Of several groups the first one applies.
            if (production.group != table.production(candidates.front()).group) break;
            const auto weight = production.weight ? production.weight->constant() : std::optional(1.0);
            is_usable_ = is_usable_ && !production.condition && weight && *weight >= 0 && !production.has_context() &&
                         production.predecessor.size() == 1;
            if (!is_usable_) return;
            if (*weight > 0) take(production.successor, *weight);
            if (!production.weight) break;
        }
        if (candidates.empty()) take(std::span(&symbol, 1), 1.0);
        choice.count = static_cast<std::uint32_t>(weights.size());
        const double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
        is_usable_ = is_usable_ && choice.count > 0 && std::isfinite(sum);
        choices_.push_back(choice);
        // What is drawn grows with the bits: the least for which weighted_choice() passes over the first k + 1.
        for (std::size_t k = 0; k < weights.size() && is_usable_; ++k) {
            std::uint64_t low = 0, high = std::uint64_t{1} << 53;
            while (low < high) {
                const std::uint64_t middle = (low + high) / 2;
                double left = static_cast<double>(middle) * 0x1p-53 * sum;
                for (std::size_t i = 0; i <= k && left >= 0; ++i) left -= weights[i];
                (left < 0 ? low : high) = left < 0 ? middle + 1 : middle;
            }
            begins_.push_back(low);
        }
    }

    void split(Successor& successor) const {
        Symbol* out = successor.lead.data();
        std::uint32_t* size = &successor.lead_size;
        std::size_t room = longest;
        for (std::uint32_t child = 0; child < successor.size; ++child) {
            const Choice& choice = choices_[successor.symbols[child]];
            if (choice.count > 1) {
                successor.drawn.push_back({child, successor.symbols[child], 0, {}});
                out = successor.drawn.back().tail.data();
                size = &successor.drawn.back().tail_size;
                room = longest_tail;
                continue;
            }
            const Successor& stays = successors_[choice.first];
            if (*size + stays.size > room) return;
            std::copy_n(stays.symbols.begin(), stays.size, out + *size);
            *size += stays.size;
        }
        successor.is_split = true;
    }

    bool is_usable_ = false;
    std::vector<Choice> choices_;  // by symbol
    std::vector<Successor> successors_;
    std::vector<std::uint64_t> begins_;  // of the next of these, in what is drawn
};

/// Depth-first expansion through `levels` where each module is another: parameters, chance.
class ModuleStreamer {
public:
    ModuleStreamer(const Grammar& grammar, const Levels& levels, const DerivationOptions& options, SymbolSink& sink)
        : grammar_(grammar),
          levels_(levels),
          first_step_(grammar.steps_done() + 1),
          has_places_(grammar.is_stochastic()),
          options_(options),
          sink_(sink) {
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
            const std::uint64_t place = !has_places_          ? 0
                                        : word.places.empty() ? axiom_place(grammar_.seed(), i)
                                                              : word.places[i];
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
        std::size_t begin;     // where the stack ends when the frame is done
        std::size_t argument;  // of the next child
        std::int64_t level;
        std::uint64_t place;  // of the parent
    };

    /// Room for so many values at the top of the stack.
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

    /// Hands over what stays of the children of the last frame, up to one that is expanded.
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

    /// A module whose arguments lie in the stack at `argument`, with `level` tables to come.
    void expand(Symbol symbol, std::size_t argument, std::uint64_t place, std::int64_t level) {
        const std::size_t top = top_;
        while (level > 0) {
            const Table& rules = table(level);
            const Chance chance{place, first_step_ + levels_.count() - level};
            const auto candidates = rules.candidates(symbol);
            if (candidates.empty()) {
                // What stays once stays under the same table.
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
                // The last step goes into the run at once.
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
                    frames_.push_back({first, first, first + successor.size(), top, top_, level, place});
                    top_ += own.size();
                }
                return;
            }
            // A unit takes the place of its parent.
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
    std::vector<double> stack_;  // arguments of what the frames hold
    std::size_t top_ = 0;        // of the stack
    Word symbols_;               // of the next run
    std::size_t count_ = 0;
    std::vector<double> arguments_;
    std::size_t argument_count_ = 0;
    std::uint64_t visited_ = 0;
    std::uint64_t next_look_ = between_watches;
    std::uint64_t handed_over_ = 0;
    std::map<const Table*, std::unique_ptr<Choices>> choices_of_;  // of those that were asked for
    // The table that rewrites at the level last asked for, and at those above table_begin_.
    const Table* table_ = nullptr;
    const Choices* choices_ = nullptr;
    std::int64_t table_begin_ = 0;
    std::int64_t table_end_ = 0;
};

}  // namespace

namespace {

Word rewrite(const Grammar& grammar, const Table& table, const Word& word, const DerivationOptions& options,
             MatchingWork& work) {
    // Places are counted in 32 bits.
    const std::uint64_t longest = std::min<std::uint64_t>(options.longest_word, UINT32_MAX - 1);
    const auto refuse = [&] { throw BudgetError(fmt::format("the word has more than {} symbols", longest)); };
    if (word.size() > longest) refuse();
    Word result;
    const auto append = [&](const Word& successor) {
        if (result.size() + successor.size() > longest) refuse();
        result.insert(result.end(), successor.begin(), successor.end());
    };
    result.reserve(word.size());
    const bool context_free = table.context_free();
    auto choose = [&, neighbourhood = context_free
                                          ? std::nullopt
                                          : std::optional<Neighbourhood>(std::in_place, grammar, word,
                                                                         looks_into_branches(grammar, table), work)](
                      std::size_t at) mutable -> const Production* {
        for (const std::uint32_t i : table.candidates(word[at])) {
            const Production& production = table.production(i);
            work.add(1);
            if (!stands_at(production.predecessor, word, at, work)) continue;
            if (neighbourhood->left_matches(production.left, at) &&
                neighbourhood->right_matches(production.right, at + production.predecessor.size())) {
                return &production;
            }
        }
        return nullptr;
    };
    for (std::size_t at = 0; at < word.size();) {
        work.add(1);
        const Word* successor = nullptr;
        std::size_t replaced = 1;
        if (context_free) {
            successor = table.successor(word[at]);
        } else if (const Production* production = choose(at)) {
            successor = &production->successor;
            replaced = production->predecessor.size();
        }
        if (successor) {
            append(*successor);
        } else {
            if (result.size() >= longest) refuse();
            result.push_back(word[at]);
        }
        at += replaced;
    }
    return result;
}

ModuleWord rewrite(const Grammar& grammar, const Table& table, const ModuleWord& given, std::int64_t step,
                   const DerivationOptions& options, MatchingWork& work) {
    std::optional<ModuleWord> trimmed;
    if (grammar.cut() &&
        std::find(given.symbols.begin(), given.symbols.end(), *grammar.cut()) != given.symbols.end()) {
        trimmed = without_cuts(grammar, given);
    }
    const ModuleWord& word = trimmed ? *trimmed : given;
    work.begin_step(step, word.symbols.size());
    if (grammar.is_plain()) return {rewrite(grammar, table, word.symbols, options, work), {}, {}};
    // Places are counted in 32 bits.
    const std::uint64_t longest = std::min<std::uint64_t>(options.longest_word, UINT32_MAX - 1);
    const auto refuse = [&] { throw BudgetError(fmt::format("the word has more than {} symbols", longest)); };
    if (word.symbols.size() > longest) refuse();
    return ModuleRewriter(grammar, table, word, step, work).run(longest, refuse);
}

}  // namespace

Word rewrite(const Grammar& grammar, const Table& table, const Word& word, const DerivationOptions& options) {
    MatchingWork work(options);
    work.begin_step(1, word.size());
    return rewrite(grammar, table, word, options, work);
}

ModuleWord rewrite(const Grammar& grammar, const Table& table, const ModuleWord& word, std::int64_t step,
                   const DerivationOptions& options) {
    MatchingWork work(options);
    return rewrite(grammar, table, word, step, options, work);
}

namespace {

/// To the bit: -0 is not 0.
bool is_same(const ModuleWord& one, const ModuleWord& other) {
    return one.symbols == other.symbols &&
           std::equal(
               one.arguments.begin(), one.arguments.end(), other.arguments.begin(), other.arguments.end(),
               [](double a, double b) { return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b); });
}

}  // namespace

Grammar resolve_contexts(Grammar grammar, const DerivationOptions& options) {
    const std::int64_t whole = grammar.whole_word_steps();
    if (whole == 0) return grammar;
    std::shared_ptr<const ModuleWord> word;
    const std::int64_t done = grammar.steps_done();
    std::int64_t step = 0;
    std::uint64_t visited = 0;
    MatchingWork work(options);
    for (const ScheduleRun& run : grammar.schedule()) {
        for (std::int64_t i = 0; i < run.steps && step < whole; ++i, ++step) {
            const ModuleWord& before = word ? *word : grammar.axiom_modules();
            const auto refuse = [&](const std::string& what, std::uint64_t most) {
                // With a schedule a shorter derivation takes other steps.
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
            // A word that came back unchanged under the same table stays so for the rest of its run.
            const bool unchanged = !grammar.is_stochastic() && is_same(next, before);
            word = std::make_shared<const ModuleWord>(std::move(next));
            if (options.watch) options.watch(0);
            if (unchanged) {
                step += std::min(run.steps - i, whole - step) - 1;
                i = run.steps;
            }
        }
    }
    return std::move(grammar).after(whole, std::move(word));
}

void derive(const Grammar& given, SymbolSink& sink, const DerivationOptions& options) {
    if (given.whole_word_steps() > 0) return derive(resolve_contexts(given, options), sink, options);
    const Levels levels(given, options.interpreted);
    if (given.is_plain()) {
        Streamer(given, levels, options, sink).stream(given.axiom());
    } else {
        ModuleStreamer(given, levels, options, sink).stream(given.axiom_modules());
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
