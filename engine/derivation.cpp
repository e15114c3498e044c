#include "engine/derivation.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <vector>

namespace sikku {
namespace {

constexpr std::size_t longest_run = 4096;
constexpr std::size_t shortest_block = 32;  // below this a block is copied into the run being gathered
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

/// Looks at the neighbours of a place of a word, across branches, as the pfg program does.
/// For each place it knows the next symbol to the left and to the right that contexts see, so that a long stretch of
/// ignored symbols, or a large branch, is passed in one step.
/// Source: Prusinkiewicz & Hanan 1989, section 3.4 and appendix A.
class Neighbourhood {
public:
    Neighbourhood(const Grammar& grammar, const Word& word) : word_(word) {
        const auto size = static_cast<std::uint32_t>(word.size());
        before_.resize(word.size() + 1);
        after_.resize(word.size() + 1);
        std::vector<std::uint32_t> open;
        before_[0] = nothing;
        for (std::uint32_t i = 0; i < size; ++i) {
            const Symbol symbol = word[i];
            before_[i + 1] = i;
            if (grammar.is_push(symbol)) open.push_back(before_[i]);
            // What came before a branch is seen after it; its end closes it even where brackets are ignored.
            std::uint32_t opened = nothing;
            if (grammar.is_pop(symbol) && !open.empty()) {
                opened = open.back();
                open.pop_back();
            }
            if (grammar.ignored(symbol) || grammar.is_push(symbol)) {
                before_[i + 1] = before_[i];
            } else if (grammar.is_pop(symbol)) {
                before_[i + 1] = opened;
            }
        }
        open.clear();
        after_[size] = nothing;
        for (std::uint32_t i = size; i-- > 0;) {
            const Symbol symbol = word[i];
            after_[i] = i;
            if (grammar.is_pop(symbol)) open.push_back(after_[i + 1]);
            std::uint32_t closed = nothing;
            if (grammar.is_push(symbol) && !open.empty()) {
                closed = open.back();
                open.pop_back();
            }
            if (grammar.ignored(symbol)) {
                after_[i] = after_[i + 1];
            } else if (grammar.is_push(symbol)) {
                after_[i] = closed;
            }
        }
    }

    bool left_matches(const Word& context, std::size_t at) const {
        for (std::size_t k = context.size(); k > 0; --k) {
            const std::uint32_t seen = before_[at];
            if (seen == nothing || word_[seen] != context[k - 1]) return false;
            at = seen;
        }
        return true;
    }

    bool right_matches(const Word& context, std::size_t at) const {
        for (const Symbol wanted : context) {
            const std::uint32_t seen = after_[at];
            if (seen == nothing || word_[seen] != wanted) return false;
            at = std::size_t{seen} + 1;
        }
        return true;
    }

private:
    static constexpr std::uint32_t nothing = std::numeric_limits<std::uint32_t>::max();
    const Word& word_;
    std::vector<std::uint32_t> before_;  // the place seen from the left end of each symbol
    std::vector<std::uint32_t> after_;   // the place seen from there to the right, its own included
};

}  // namespace

Word rewrite(const Grammar& grammar, const Table& table, const Word& word, const DerivationOptions& options) {
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
    const auto choose =
        [&, neighbourhood = context_free ? std::nullopt : std::optional<Neighbourhood>(std::in_place, grammar, word)](
            std::size_t at) -> const Production* {
        for (const std::uint32_t i : table.candidates(word[at])) {
            const Production& production = table.production(i);
            const std::size_t end = at + production.predecessor.size();
            if (end > word.size() || !std::equal(production.predecessor.begin(), production.predecessor.end(),
                                                 word.begin() + static_cast<std::ptrdiff_t>(at))) {
                continue;
            }
            if (neighbourhood->left_matches(production.left, at) &&
                neighbourhood->right_matches(production.right, end)) {
                return &production;
            }
        }
        return nullptr;
    };
    std::uint64_t visited = 0;
    for (std::size_t at = 0; at < word.size();) {
        if (++visited % between_watches == 0 && options.watch) options.watch(0);
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

Grammar resolve_contexts(Grammar grammar, const DerivationOptions& options) {
    const std::int64_t whole = grammar.whole_word_steps();
    if (whole == 0) return grammar;
    std::shared_ptr<const Word> word;
    std::int64_t step = 0;
    std::uint64_t visited = 0;
    for (const ScheduleRun& run : grammar.schedule()) {
        for (std::int64_t i = 0; i < run.steps && step < whole; ++i, ++step) {
            const Word& before = word ? *word : grammar.axiom();
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
            visited += before.size();
            if (visited > options.whole_words) refuse("all words up to that", options.whole_words);
            Word next;
            try {
                next = rewrite(grammar, grammar.tables()[run.table], before, options);
            } catch (const BudgetError&) {
                refuse("that", options.longest_word);
            }
            // A word that came back unchanged under the same table stays so for the rest of its run.
            const bool unchanged = next == before;
            word = std::make_shared<const Word>(std::move(next));
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
    Streamer(given, levels, options, sink).stream(given.axiom());
    sink.finish();
}

}  // namespace sikku
