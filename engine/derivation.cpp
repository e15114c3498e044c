#include "engine/derivation.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <map>
#include <vector>

namespace sikku {
namespace {

constexpr std::size_t longest_run = 4096;
constexpr std::size_t shortest_block = 32;  // below this a block is copied into the run being gathered
constexpr std::size_t most_entries = std::size_t{1} << 21;

/// The tables from the last level upwards: level 0 is the finished word, level r has r tables still to come.
/// Adjacent levels of one table are one stretch, so that a million steps cost nothing to describe.
class Levels {
public:
    Levels(const Grammar& grammar, std::int64_t whole_word_steps, bool interpreted) {
        if (interpreted && grammar.interpretation()) add(grammar.interpretation(), 1);
        std::int64_t before = grammar.steps();
        for (std::size_t i = grammar.schedule().size(); i > 0; --i) {
            const ScheduleRun& run = grammar.schedule()[i - 1];
            before -= run.steps;
            add(&grammar.tables()[run.table], run.steps - std::max<std::int64_t>(0, whole_word_steps - before));
        }
    }
    std::int64_t count() const { return count_; }
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
        const auto most_levels = static_cast<std::int64_t>(most_entries / std::max<std::size_t>(symbols_, 1));
        while (levels_ < std::min(levels.count(), most_levels) && any_short_) {
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
        while (std::int64_t{2} << (strides_.size() - 1) <= longest) {
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
          sink_(sink) {
        pending_.reserve(longest_run);
    }

    void stream(const Word& word) {
        push(word, levels_.count());
        while (!frames_.empty()) {
            Frame& frame = frames_.back();
            const Symbol symbol = *frame.next++;
            const std::int64_t level = frame.level;
            // A frame is left before its last child is entered: right recursion needs no stack.
            if (frame.next == frame.end) frames_.pop_back();
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
        return chains_.try_emplace(&table, table, symbols_, levels_.count()).first->second;
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
    SymbolSink& sink_;
    std::vector<Frame> frames_;
    Word pending_;
};

/// Looks at the neighbours of a place of a word, across branches, as the pfg program does.
/// Source: Prusinkiewicz & Hanan 1989, section 3.4 and appendix A.
class Neighbourhood {
public:
    Neighbourhood(const Grammar& grammar, const Word& word) : grammar_(grammar), word_(word) {
        // Where each bracket's partner is; the end of the word for an unclosed one, npos for an unopened one.
        std::vector<std::size_t> open;
        for (std::size_t i = 0; i < word.size(); ++i) {
            const bool push = grammar.is_push(word[i]);
            if (!push && !grammar.is_pop(word[i])) continue;
            if (partner_.empty()) partner_.assign(word.size(), 0);
            if (push) {
                open.push_back(i);
                partner_[i] = word.size();
            } else if (open.empty()) {
                partner_[i] = npos;
            } else {
                partner_[i] = open.back();
                partner_[open.back()] = i;
                open.pop_back();
            }
        }
    }

    bool left_matches(const Word& context, std::size_t at) const {
        std::size_t i = at;  // one past the symbol looked at
        for (std::size_t k = context.size(); k > 0;) {
            if (i == 0) return false;
            const Symbol symbol = word_[i - 1];
            if (grammar_.ignored(symbol) || grammar_.is_push(symbol)) {
                --i;
            } else if (grammar_.is_pop(symbol)) {
                i = partner_[i - 1];
                if (i == npos) return false;
            } else if (symbol == context[k - 1]) {
                --k;
                --i;
            } else {
                return false;
            }
        }
        return true;
    }

    bool right_matches(const Word& context, std::size_t at) const {
        for (std::size_t k = 0; k < context.size();) {
            if (at >= word_.size()) return false;
            const Symbol symbol = word_[at];
            if (grammar_.ignored(symbol)) {
                ++at;
            } else if (grammar_.is_push(symbol)) {
                at = partner_[at] + (partner_[at] < word_.size() ? 1 : 0);
            } else if (symbol == context[k]) {
                ++k;
                ++at;
            } else {
                return false;
            }
        }
        return true;
    }

private:
    static constexpr std::size_t npos = std::numeric_limits<std::size_t>::max();
    const Grammar& grammar_;
    const Word& word_;
    std::vector<std::size_t> partner_;
};

}  // namespace

Word rewrite(const Grammar& grammar, const Table& table, const Word& word, std::uint64_t budget) {
    const auto refuse = [&] { throw BudgetError(fmt::format("the word has more than {} symbols", budget)); };
    Word result;
    const auto append = [&](const Word& successor) {
        if (result.size() + successor.size() > budget) refuse();
        result.insert(result.end(), successor.begin(), successor.end());
    };
    result.reserve(word.size());
    if (table.context_free()) {
        for (const Symbol symbol : word) {
            if (const Word* successor = table.successor(symbol)) {
                append(*successor);
            } else {
                append({symbol});
            }
        }
        return result;
    }
    const Neighbourhood neighbourhood(grammar, word);
    for (std::size_t at = 0; at < word.size();) {
        const Production* chosen = nullptr;
        for (const std::uint32_t i : table.candidates(word[at])) {
            const Production& production = table.production(i);
            const std::size_t end = at + production.predecessor.size();
            if (end > word.size() || !std::equal(production.predecessor.begin(), production.predecessor.end(),
                                                 word.begin() + static_cast<std::ptrdiff_t>(at))) {
                continue;
            }
            if (neighbourhood.left_matches(production.left, at) &&
                neighbourhood.right_matches(production.right, end)) {
                chosen = &production;
                break;
            }
        }
        if (chosen) {
            append(chosen->successor);
            at += chosen->predecessor.size();
        } else {
            if (result.size() >= budget) refuse();
            result.push_back(word[at++]);
        }
    }
    return result;
}

void derive(const Grammar& grammar, SymbolSink& sink, const DerivationOptions& options) {
    const std::int64_t whole = grammar.whole_word_steps();
    const Word* word = &grammar.axiom();
    Word rewritten;
    std::int64_t step = 0;
    for (const ScheduleRun& run : grammar.schedule()) {
        for (std::int64_t i = 0; i < run.steps && step < whole; ++i, ++step) {
            Word next;
            try {
                next = rewrite(grammar, grammar.tables()[run.table], *word, options.budget);
            } catch (const BudgetError&) {
                throw BudgetError(
                    fmt::format("productions that look at their neighbours need whole words, and that of step {} (of "
                                "n = {}) would "
                                "have more than {} symbols; the largest derivation length that fits is {}",
                                step + 1, grammar.steps(), options.budget, step));
            }
            // A word that came back unchanged under the same table stays so for the rest of its run.
            const bool unchanged = next == *word;
            rewritten = std::move(next);
            word = &rewritten;
            if (options.watch) options.watch(0);
            if (unchanged) {
                step += std::min(run.steps - i, whole - step) - 1;
                i = run.steps;
            }
        }
    }
    const Levels levels(grammar, whole, options.interpreted);
    Streamer(grammar, levels, options, sink).stream(*word);
    sink.finish();
}

}  // namespace sikku
