// engine/derivation/streamer.cpp: expands words of plain grammars, as levels.h declares it.
#include "engine/derivation/levels.h"

#include <algorithm>
#include <functional>
#include <limits>
#include <map>
#include <span>
#include <vector>

namespace sikku {
namespace {

constexpr std::size_t shortest_block = 32;  // shorter blocks are copied into the run being gathered

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
                // never requested
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
            // Erasing symbols may take long without producing a run.
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

    /// Lowers `level` to the next one whose table rewrites the symbol; true if there is none.
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
    std::map<const Table*, UnitChains> chains_;  // created for a table with a long chain
    Blocks blocks_;
    const std::function<void(std::uint64_t)>& watch_;
    Pruner* pruner_;
    SymbolSink& sink_;
    std::vector<Frame> frames_;
    Word pending_;
};

}  // namespace

void stream_symbols(const Grammar& grammar, const Levels& levels, const DerivationOptions& options,
                    SymbolSink& sink) {
    if (levels.count() > 0 || options.pruner) {
        Streamer(grammar, levels, options, sink).stream(grammar.axiom());
        return;
    }
    const std::span<const Symbol> word(grammar.axiom());
    for (std::size_t i = 0; i < word.size(); i += longest_run) {
        const auto run = word.subspan(i, std::min(longest_run, word.size() - i));
        sink.symbols({run, -1});
        if (options.watch) options.watch(run.size());
    }
}

}  // namespace sikku
