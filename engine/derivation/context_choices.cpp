#include "engine/derivation/context_choices.h"

#include <algorithm>

namespace sikku {
namespace {

constexpr std::size_t most_classes = 200;
constexpr std::size_t most_candidates = 30'000;  // in all lists together; indices fit in 16 bits

}  // namespace

ContextChoices::ContextChoices(const Grammar& grammar, const Table& table) : kinds_(grammar.symbols().size()) {
    for (Symbol symbol = 0; symbol < kinds_.size(); ++symbol) {
        Kind& kind = kinds_[symbol];
        kind.is_push = grammar.is_push(symbol);
        kind.is_pop = grammar.is_pop(symbol);
        kind.is_ignored = grammar.ignored(symbol);
        kind.is_special = kind.is_push || kind.is_pop || kind.is_ignored;
    }
    std::vector<Symbol> rows, lefts, rights;
    const auto looks_into = [&](const Production& production) {
        return std::any_of(production.right.begin(), production.right.end(),
                           [&](Symbol symbol) { return kinds_[symbol].is_push; });
    };
    // The symbol that has to be nearest on that side, if it is known.
    const auto nearest_left = [](const Production& production) {
        return production.left.empty() ? nullptr : &production.left.back();
    };
    const auto nearest_right = [&](const Production& production) {
        const bool is_known = production.predecessor.size() == 1 && !production.right.empty() &&
                              !kinds_[production.right.front()].is_push;
        return is_known ? &production.right.front() : nullptr;
    };
    for (const Production& production : table.productions()) {
        rows.push_back(production.predecessor.front());
        if (const Symbol* symbol = nearest_left(production)) lefts.push_back(*symbol);
        if (const Symbol* symbol = nearest_right(production)) rights.push_back(*symbol);
        looks_at_nearest_ = looks_at_nearest_ && production.predecessor.size() == 1 && production.left.size() <= 1 &&
                            production.right.size() <= 1;
        looks_into_branches_ = looks_into_branches_ || looks_into(production);
    }
    const auto make_set = [](std::vector<Symbol>& symbols) {
        std::sort(symbols.begin(), symbols.end());
        symbols.erase(std::unique(symbols.begin(), symbols.end()), symbols.end());
    };
    for (auto* set : {&rows, &lefts, &rights}) make_set(*set);
    std::size_t candidates = table.productions().size();
    for (auto* set : {&lefts, &rights}) {
        if (set->size() > most_classes || candidates * (set->size() + 1) > most_candidates) {
            set->clear();
            looks_at_nearest_ = false;
        }
        candidates *= set->size() + 1;
    }
    for (std::size_t i = 0; i < lefts.size(); ++i) kinds_[lefts[i]].left = static_cast<std::uint8_t>(i + 1);
    for (std::size_t i = 0; i < rights.size(); ++i) kinds_[rights[i]].right = static_cast<std::uint8_t>(i + 1);
    lefts_ = lefts.size() + 1;
    rights_ = rights.size() + 1;
    begin_.assign(lefts_ * rights_, 0);
    for (const Symbol row : rows) {
        kinds_[row].row = static_cast<std::uint32_t>(begin_.size());
        for (std::size_t left = 0; left < lefts_; ++left) {
            for (std::size_t right = 0; right < rights_; ++right) {
                begin_.push_back(static_cast<std::uint32_t>(list_.size()));
                for (const std::uint32_t i : table.candidates(row)) {
                    const Production& production = table.production(i);
                    const Symbol* const on_left = nearest_left(production);
                    const Symbol* const on_right = nearest_right(production);
                    if (on_left && !lefts.empty() && kinds_[*on_left].left != left) continue;
                    if (on_right && !rights.empty() && kinds_[*on_right].right != right) continue;
                    list_.push_back(i);
                }
            }
        }
    }
    begin_.push_back(static_cast<std::uint32_t>(list_.size()));
}

}  // namespace sikku
