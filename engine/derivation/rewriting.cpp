// engine/derivation/rewriting.cpp: applies one step of a derivation to a whole word.
#include "engine/derivation/choice.h"
#include "engine/derivation/lineage.h"
#include "engine/derivation/neighbourhood.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstring>
#include <optional>
#include <vector>

namespace sikku {
namespace {

/// For each symbol of a new word, the index of its predecessor.
using Parents = std::vector<std::uint32_t>;

/// Receives the origins of the symbols of a new word; each pointer may be null.
struct Trace {
    Parents* parents = nullptr;
    std::vector<std::uint32_t>* applied = nullptr;  ///< as in StepOrigins

    /// Notes what replaces the next `replaced` symbols of the word, of which the first is at `at`, when the new word
    /// has `size` symbols.
    void note(std::size_t at, std::size_t size, std::uint32_t production, std::size_t replaced) const {
        if (parents) parents->resize(size, static_cast<std::uint32_t>(at));
        if (applied) applied->resize(at + replaced, production);
    }
};

std::uint32_t index_of(const Table& table, const Production* production) {
    if (!production) return StepOrigins::stays;
    return static_cast<std::uint32_t>(production - table.productions().data());
}

/// Returns the word without its cut symbols and the symbols after them in their branches.
/// Source: Prusinkiewicz, Hammel, Hanan & Mech 1996, equation 13.
ModuleWord without_cuts(const Grammar& grammar, const ModuleWord& word, Parents& kept) {
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
        kept.push_back(static_cast<std::uint32_t>(at));
        result.arguments.insert(result.arguments.end(), next, next + arity);
        if (grammar.is_stochastic()) {
            result.places.push_back(grammar.place_of(word, at));
        }
        pass();
    }
    return result;
}

/// True if the predecessor, whose first symbol is known to match, occurs in the word at `at`.
bool stands_at(const Word& predecessor, const Word& word, std::size_t at, MatchingWork& work) {
    if (predecessor.size() == 1) return true;
    if (predecessor.size() > word.size() - at) return false;
    const auto [end, there] =
        std::mismatch(predecessor.begin() + 1, predecessor.end(), word.begin() + static_cast<std::ptrdiff_t>(at) + 1);
    work.add(static_cast<std::uint64_t>(end - predecessor.begin()));
    return end == predecessor.end();
}

/// Throws for words that are too long.
class LengthLimit {
public:
    explicit LengthLimit(const DerivationOptions& options) : longest_(longest_word(options)) {}
    void check(std::uint64_t size) const {
        if (size > longest_) throw BudgetError(fmt::format("the word has more than {} symbols", longest_));
    }

private:
    std::uint64_t longest_;
};

/// Makes one step of a system with parameters or random choices.
class ModuleRewriter {
public:
    ModuleRewriter(const Grammar& grammar, const Table& table, const ModuleWord& word, std::int64_t step,
                   MatchingWork& work)
        : grammar_(grammar), table_(table), word_(word), step_(step), work_(work) {
        if (!table.context_free()) {
            choices_ = &work.choices(grammar, table);
            neighbourhood_.emplace(*choices_, word.symbols, work);
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

    ModuleWord run(const LengthLimit& limit, const Trace& trace) {
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
            const std::uint64_t place = has_places ? grammar_.place_of(word_, at_) : 0;
            const Chance chance{place, step_};
            const auto candidates =
                choices_ ? choices_->candidates(neighbourhood_->index(at_)) : table_.candidates(symbol);
            const Production* production = nullptr;
            if (!candidates.empty()) {
                production = choose(table_, candidates, chance, fault, formals_,
                                    [this](const Production& candidate) { return matches(candidate); });
            }
            if (!production) {
                limit.check(result.symbols.size() + 1);
                result.symbols.push_back(symbol);
                trace.note(at_, result.symbols.size(), StepOrigins::stays, 1);
                const double* own = word_.arguments.data() + argument_;
                result.arguments.insert(result.arguments.end(), own, own + info(at_).arity);
                if (has_places) result.places.push_back(place);
                argument_ += info(at_++).arity;
                continue;
            }
            limit.check(result.symbols.size() + production->successor.size());
            result.symbols.insert(result.symbols.end(), production->successor.begin(), production->successor.end());
            trace.note(at_, result.symbols.size(), index_of(table_, production), production->predecessor.size());
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
    const ContextChoices* choices_ = nullptr;  // null if no production looks at neighbours
    std::optional<Neighbourhood> neighbourhood_;
    std::vector<std::uint32_t> begin_;  // index of each symbol's first argument; empty unless contexts need it
    std::size_t at_ = 0;
    std::size_t argument_ = 0;  // first argument of the symbol at_
    std::span<const double> formals_;
    std::vector<std::uint32_t> seen_;
    std::vector<double> gathered_;
};

/// What may replace symbols, by numbers: successors, or, as number 0, the symbol itself.
class Outcomes {
public:
    static constexpr std::size_t room = 8;

    std::uint16_t add(const Word& successor) {
        outcomes_.push_back({pool_.size() - room, successor.size()});
        pool_.insert(pool_.end() - room, successor.begin(), successor.end());
        return static_cast<std::uint16_t>(outcomes_.size() - 1);
    }
    std::size_t length(std::uint16_t number) const { return outcomes_[number].size; }
    /// Writes an outcome, and arbitrary symbols up to `room`. Returns the end.
    Symbol* write(std::uint16_t number, Symbol symbol, Symbol* out) const {
        const Outcome outcome = outcomes_[number];
        const Symbol* const from = pool_.data() + outcome.begin;
        std::memcpy(out, from, room * sizeof(Symbol));
        if (outcome.size > room) std::memcpy(out, from, outcome.size * sizeof(Symbol));
        out[0] = number == 0 ? symbol : out[0];
        return out + outcome.size;
    }

private:
    struct Outcome {
        std::size_t begin, size;
    };
    std::vector<Outcome> outcomes_ = {{0, 1}};
    Word pool_ = Word(room);
};

/// For productions that rewrite one symbol and look at most at the nearest one on each side. Stores only the classes
/// of the neighbours, and looks up the outcomes.
Word rewrite_by_nearest(const ContextChoices& choices, const Table& table, const Word& word, const LengthLimit& limit,
                        MatchingWork& work) {
    using Kind = ContextChoices::Kind;
    constexpr std::size_t block = 2048;
    Outcomes outcomes;
    std::vector<std::uint16_t> outcome_of(choices.size());
    std::vector<std::uint16_t> known(table.productions().size());
    for (std::size_t i = 0; i < choices.size(); ++i) {
        const auto candidates = choices.candidates(i);
        if (candidates.empty()) continue;
        std::uint16_t& number = known[candidates.front()];
        if (number == 0) number = outcomes.add(table.production(candidates.front()).successor);
        outcome_of[i] = number;
    }
    // Classes of the nearest symbols to the right, from right to left.
    std::vector<std::uint8_t>& classes = work.memory.classes;
    classes.resize(word.size());
    std::vector<std::uint8_t> open;
    std::uint8_t seen = 0;
    for (std::size_t at = word.size(); at-- > 0;) {
        classes[at] = seen;
        const Kind kind = choices.kind(word[at]);
        if (!kind.is_special) {
            seen = kind.right;
            continue;
        }
        if (kind.is_pop) open.push_back(seen);
        std::uint8_t closed = 0;
        if (kind.is_push && !open.empty()) {
            closed = open.back();
            open.pop_back();
        }
        if (!kind.is_ignored) seen = kind.is_push ? closed : kind.right;
    }
    open.clear();
    seen = 0;
    Word result = std::move(work.memory.spare);
    std::size_t size = 0;
    std::array<std::uint16_t, block> marks;
    for (std::size_t begin = 0; begin < word.size(); begin += block) {
        const std::size_t end = std::min(begin + block, word.size());
        work.add(end - begin);
        std::size_t more = 0;
        for (std::size_t at = begin; at < end; ++at) {
            const Kind kind = choices.kind(word[at]);
            const std::uint16_t outcome = outcome_of[choices.index(kind, seen, classes[at])];
            marks[at - begin] = outcome;
            more += outcomes.length(outcome);
            if (!kind.is_special) {
                seen = kind.left;
                continue;
            }
            if (kind.is_push) open.push_back(seen);
            std::uint8_t opened = 0;
            if (kind.is_pop && !open.empty()) {
                opened = open.back();
                open.pop_back();
            }
            if (kind.is_pop && !kind.is_ignored) seen = opened;
        }
        limit.check(size + more);
        // Grows by doubling, and never shrinks before the end.
        if (result.size() < size + more + Outcomes::room) {
            result.resize(
                std::max(size + more + Outcomes::room, begin == 0 ? word.size() + block : 2 * result.size()));
        }
        Symbol* const first = result.data();
        Symbol* out = first + size;
        for (std::size_t at = begin; at < end; ++at) {
            out = outcomes.write(marks[at - begin], word[at], out);
        }
        size += more;
    }
    result.resize(size);
    return result;
}

Word rewrite_context_free(const Table& table, const Word& word, const LengthLimit& limit, MatchingWork& work,
                          const Trace& trace) {
    std::vector<std::uint32_t> known;  // by symbol, the first of its productions
    for (std::size_t i = trace.applied ? table.productions().size() : 0; i > 0; --i) {
        const Symbol symbol = table.productions()[i - 1].predecessor.front();
        if (symbol >= known.size()) known.resize(std::size_t{symbol} + 1, StepOrigins::stays);
        known[symbol] = static_cast<std::uint32_t>(i - 1);
    }
    Word result;
    result.reserve(word.size());
    for (std::size_t at = 0; at < word.size(); ++at) {
        work.add(1);
        const Word* const successor = table.successor(word[at]);
        limit.check(result.size() + (successor ? successor->size() : 1));
        if (successor) {
            result.insert(result.end(), successor->begin(), successor->end());
        } else {
            result.push_back(word[at]);
        }
        trace.note(at, result.size(), word[at] < known.size() ? known[word[at]] : StepOrigins::stays, 1);
    }
    return result;
}

Word rewrite_plain(const Grammar& grammar, const Table& table, const Word& word, const DerivationOptions& options,
                   MatchingWork& work, const Trace& trace) {
    const LengthLimit limit(options);
    limit.check(word.size());
    if (table.context_free()) return rewrite_context_free(table, word, limit, work, trace);
    const ContextChoices& choices = work.choices(grammar, table);
    if (choices.looks_at_nearest() && !trace.parents) return rewrite_by_nearest(choices, table, word, limit, work);
    Neighbourhood neighbourhood(choices, word, work);
    const auto choose = [&](std::size_t at) -> const Production* {
        for (const std::uint32_t i : choices.candidates(neighbourhood.index(at))) {
            const Production& production = table.production(i);
            work.add(1);
            if (!stands_at(production.predecessor, word, at, work)) continue;
            if (neighbourhood.left_matches(production.left, at) &&
                neighbourhood.right_matches(production.right, at + production.predecessor.size())) {
                return &production;
            }
        }
        return nullptr;
    };
    Word result;
    result.reserve(word.size());
    for (std::size_t at = 0; at < word.size();) {
        work.add(1);
        const Production* const production = choose(at);
        limit.check(result.size() + (production ? production->successor.size() : 1));
        if (production) {
            result.insert(result.end(), production->successor.begin(), production->successor.end());
        } else {
            result.push_back(word[at]);
        }
        const std::size_t replaced = production ? production->predecessor.size() : 1;
        trace.note(at, result.size(), index_of(table, production), replaced);
        at += replaced;
    }
    return result;
}

ModuleWord rewrite_whole(const Grammar& grammar, const Table& table, const ModuleWord& given, std::int64_t step,
                         const DerivationOptions& options, MatchingWork& work, const Trace& trace) {
    std::optional<ModuleWord> trimmed;
    Parents kept;
    if (grammar.cut() &&
        std::find(given.symbols.begin(), given.symbols.end(), *grammar.cut()) != given.symbols.end()) {
        trimmed = without_cuts(grammar, given, kept);
    }
    const ModuleWord& word = trimmed ? *trimmed : given;
    work.begin_step(step, word.symbols.size());
    const auto rewritten = [&]() -> ModuleWord {
        if (grammar.is_plain()) {
            return {rewrite_plain(grammar, table, word.symbols, options, work, trace), {}, {}};
        }
        const LengthLimit limit(options);
        limit.check(word.symbols.size());
        return ModuleRewriter(grammar, table, word, step, work).run(limit, trace);
    };
    ModuleWord result = rewritten();
    if (trimmed && trace.parents) {
        for (std::uint32_t& parent : *trace.parents) parent = kept[parent];
    }
    if (trimmed && trace.applied) {
        std::vector<std::uint32_t> all(given.symbols.size(), StepOrigins::is_cut);
        for (std::size_t i = 0; i < kept.size(); ++i) all[kept[i]] = (*trace.applied)[i];
        *trace.applied = std::move(all);
    }
    return result;
}

}  // namespace

ModuleWord rewrite(const Grammar& grammar, const Table& table, const ModuleWord& word, std::int64_t step,
                   const DerivationOptions& options, MatchingWork& work) {
    return rewrite_whole(grammar, table, word, step, options, work, {});
}

Word rewrite(const Grammar& grammar, const Table& table, const Word& word, const DerivationOptions& options) {
    MatchingWork work(options);
    work.begin_step(1, word.size());
    return rewrite_plain(grammar, table, word, options, work, {});
}

ModuleWord rewrite(const Grammar& grammar, const Table& table, const ModuleWord& word, std::int64_t step,
                   const DerivationOptions& options, std::vector<std::uint32_t>* parents) {
    if (parents) parents->clear();
    MatchingWork work(options);
    return rewrite_whole(grammar, table, word, step, options, work, {parents});
}

ModuleWord rewrite(const Grammar& grammar, const Table& table, const ModuleWord& word, std::int64_t step,
                   const DerivationOptions& options, MatchingWork& work, StepOrigins& origins) {
    origins.parents.clear();
    origins.applied.clear();
    return rewrite_whole(grammar, table, word, step, options, work, {&origins.parents, &origins.applied});
}

}  // namespace sikku
