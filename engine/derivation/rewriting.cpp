// engine/derivation/rewriting.cpp: applies one step of a derivation to a whole word.
#include "engine/derivation/choice.h"
#include "engine/derivation/neighbourhood.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <optional>
#include <vector>

namespace sikku {
namespace {

bool looks_into_branches(const Grammar& grammar, const Table& table) {
    return std::any_of(table.productions().begin(), table.productions().end(), [&](const Production& production) {
        return std::any_of(production.right.begin(), production.right.end(),
                           [&](Symbol symbol) { return grammar.is_push(symbol); });
    });
}

/// For each symbol of a new word, the index of its predecessor.
using Parents = std::vector<std::uint32_t>;

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

/// Makes one step of a system with parameters or random choices.
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

    /// @param parents  may be null
    ModuleWord run(std::uint64_t longest, const std::function<void()>& refuse, Parents* parents) {
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
            const auto candidates = table_.candidates(symbol);
            const Production* production = nullptr;
            if (!candidates.empty()) {
                production = choose(table_, candidates, chance, fault, formals_,
                                    [this](const Production& candidate) { return matches(candidate); });
            }
            if (!production) {
                if (result.symbols.size() >= longest) refuse();
                result.symbols.push_back(symbol);
                if (parents) parents->push_back(static_cast<std::uint32_t>(at_));
                const double* own = word_.arguments.data() + argument_;
                result.arguments.insert(result.arguments.end(), own, own + info(at_).arity);
                if (has_places) result.places.push_back(place);
                argument_ += info(at_++).arity;
                continue;
            }
            if (result.symbols.size() + production->successor.size() > longest) refuse();
            result.symbols.insert(result.symbols.end(), production->successor.begin(), production->successor.end());
            if (parents) parents->resize(result.symbols.size(), static_cast<std::uint32_t>(at_));
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
    std::vector<std::uint32_t> begin_;  // index of each symbol's first argument; empty unless contexts need it
    std::size_t at_ = 0;
    std::size_t argument_ = 0;  // first argument of the symbol at_
    std::span<const double> formals_;
    std::vector<std::uint32_t> seen_;
    std::vector<double> gathered_;
};

Word rewrite_plain(const Grammar& grammar, const Table& table, const Word& word, const DerivationOptions& options,
                   MatchingWork& work, Parents* parents) {
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
        if (parents) parents->resize(result.size(), static_cast<std::uint32_t>(at));
        at += replaced;
    }
    return result;
}

ModuleWord rewrite_whole(const Grammar& grammar, const Table& table, const ModuleWord& given, std::int64_t step,
                         const DerivationOptions& options, MatchingWork& work, Parents* parents) {
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
            return {rewrite_plain(grammar, table, word.symbols, options, work, parents), {}, {}};
        }
        // Places are counted in 32 bits.
        const std::uint64_t longest = std::min<std::uint64_t>(options.longest_word, UINT32_MAX - 1);
        const auto refuse = [&] { throw BudgetError(fmt::format("the word has more than {} symbols", longest)); };
        if (word.symbols.size() > longest) refuse();
        return ModuleRewriter(grammar, table, word, step, work).run(longest, refuse, parents);
    };
    ModuleWord result = rewritten();
    if (trimmed && parents) {
        for (std::uint32_t& parent : *parents) parent = kept[parent];
    }
    return result;
}

}  // namespace

ModuleWord rewrite(const Grammar& grammar, const Table& table, const ModuleWord& word, std::int64_t step,
                   const DerivationOptions& options, MatchingWork& work) {
    return rewrite_whole(grammar, table, word, step, options, work, nullptr);
}

Word rewrite(const Grammar& grammar, const Table& table, const Word& word, const DerivationOptions& options) {
    MatchingWork work(options);
    work.begin_step(1, word.size());
    return rewrite_plain(grammar, table, word, options, work, nullptr);
}

ModuleWord rewrite(const Grammar& grammar, const Table& table, const ModuleWord& word, std::int64_t step,
                   const DerivationOptions& options, std::vector<std::uint32_t>* parents) {
    if (parents) parents->clear();
    MatchingWork work(options);
    return rewrite_whole(grammar, table, word, step, options, work, parents);
}

}  // namespace sikku
