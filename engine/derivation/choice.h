// engine/derivation/choice.h: selects the production that applies from those that match.
#pragma once

#include "engine/language/grammar.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>

namespace sikku {

/// Chooses by weight among the candidates in the group of the first one whose conditions hold; the first one is known
/// to match. Calls `fault(message)`, which throws, for invalid weights.
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

/// Returns the production that applies, or null. `match(production)` is true if predecessor and contexts match, and
/// then sets `formals`; it is called once for successive candidates of one group.
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

}  // namespace sikku
