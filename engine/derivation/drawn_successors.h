// engine/derivation/drawn_successors.h: precomputed random choice among successors with constant weights.
#pragma once

#include "engine/language/grammar.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <numeric>
#include <optional>
#include <span>
#include <vector>

namespace sikku {

/// Successors under one table of symbols without parameters, chosen at random by constant weights, as by choose().
class Choices {
public:
    static constexpr std::size_t longest = 16;  // maximum length of a successor
    static constexpr std::size_t longest_tail = 8;
    static constexpr std::size_t most_symbols = 4096, most_alternatives = 32;  // above these, is_usable() is false
    static constexpr std::size_t most_written = longest + longest * (longest + longest_tail);  // by write()

    struct Successor {
        std::array<Symbol, longest> symbols{};
        std::uint32_t size = 0;
        // The successor after another step by this table, split into its symbols with a random choice and the fixed
        // symbols between them.
        bool is_split = false;
        struct Drawn {
            std::uint32_t child = 0;  ///< index into `symbols`
            std::uint32_t choice = 0;
            std::uint32_t tail_size = 0;
            std::array<Symbol, longest_tail> tail{};  ///< fixed symbols after it
        };
        std::array<Symbol, longest> lead{};
        std::uint32_t lead_size = 0;
        std::vector<Drawn> drawn;
    };

    /// is_usable() is false if weights or conditions have to be computed, or if successors are long.
    Choices(const Grammar& grammar, const Table& table) {
        const std::size_t symbols = grammar.symbols().size();
        is_usable_ = !grammar.is_parametric() && grammar.is_stochastic() && symbols <= most_symbols;
        for (Symbol symbol = 0; symbol < symbols && is_usable_; ++symbol) add(symbol, table);
        for (std::size_t i = 0; i < successors_.size() && is_usable_; ++i) split(successors_[i]);
    }
    bool is_usable() const { return is_usable_; }

    /// The successors of a symbol, and the least bits of Chance that choose the second one, the third one, …
    std::span<const Successor> all(Symbol symbol) const {
        return std::span(successors_).subspan(choices_[symbol].first, choices_[symbol].count);
    }
    std::span<const std::uint64_t> begins(Symbol symbol) const {
        return std::span(begins_).subspan(choices_[symbol].first, choices_[symbol].count - 1);
    }

    const Successor& of(Symbol symbol, const Chance& chance) const { return drawn(choices_[symbol], chance); }

    /// Writes the next step of a split successor, whose parent has that place, and at most `longest` symbols more.
    /// @return  number of symbols written, without those
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
            // Branchless, because processors could not predict the branches.
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
            // The first of several groups applies.
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
        // The random number grows with the bits: finds the least bits for which weighted_choice() skips the first
        // k + 1.
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
    std::vector<std::uint64_t> begins_;  // for each successor, the least bits that choose the next one
};

}  // namespace sikku
