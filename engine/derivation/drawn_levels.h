// engine/derivation/drawn_levels.h: precomputed levels of an expansion whose only choices have constant weights.
#pragma once

#include "engine/derivation/drawn_successors.h"
#include "engine/derivation/levels.h"

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

namespace sikku {

/// A module of an expansion. Modules of one kind have the same symbol and the same text on both sides: the symbols
/// that do not depend on chance, one byte each.
struct DrawnModule {
    std::uint64_t key = 0;  ///< scrambled() maps it to the module's place
    std::uint32_t kind = 0;
};

/// One level: the alternatives that replace each kind of module.
struct DrawnLevel {
    struct Child {
        std::uint64_t add = 0;  ///< added to base(), gives its key
        std::uint32_t kind = 0;
    };
    std::int64_t step = 0;
    std::size_t alternatives = 1;       ///< of each kind, including those that are never chosen
    std::vector<std::uint64_t> begins;  ///< for each kind, the least bits that choose the second alternative, …
    std::vector<std::uint64_t> keeps;   ///< for each kind, all bits if it keeps its place, else 0
    std::size_t most = 0;               ///< most children of an alternative
    std::vector<Child> children;        ///< for each alternative, `most`
    std::vector<std::uint32_t> counts;  ///< for each alternative, how many of them it has
    std::vector<std::string> texts;     ///< at level 1, for each alternative
    std::vector<double> means;          ///< for each kind, the expected number of symbols of the word
    std::vector<double> rooms;          ///< for each kind, the most memory that its expansion takes, in modules

    std::size_t kinds() const { return keeps.size(); }
    /// Number of the alternative that replaces a module with that place.
    std::size_t chosen(std::uint32_t kind, std::uint64_t place) const {
        const std::uint64_t bits = Chance{place, step}.bits(0);
        const std::uint64_t* const begin = begins.data() + kind * (alternatives - 1);
        std::size_t alternative = kind * alternatives;
        // Branchless, because processors could not predict the branches.
        for (std::size_t k = 0; k + 1 < alternatives; ++k) alternative += bits >= begin[k] ? 1 : 0;
        return alternative;
    }
    std::uint64_t base(const DrawnModule& module, std::uint64_t place) const {
        return place ^ ((place ^ module.key) & keeps[module.kind]);
    }
};

class DrawnLevels {
public:
    static constexpr std::size_t longest_text = 64;  ///< of an alternative

    /// Usable if the word is expected to be long and the grammar has at most 256 symbols, no parameters, and only
    /// constant weights. Cost: a few microseconds for words that are not long.
    /// @param bytes  the byte of each symbol
    DrawnLevels(const Grammar& grammar, const Levels& levels, std::string_view bytes);
    bool is_usable() const { return is_usable_; }

    std::int64_t count() const { return levels_.count(); }
    const DrawnLevel& level(std::int64_t level) const { return drawn_[static_cast<std::size_t>(level)]; }
    /// The kind of a symbol of the axiom, at the highest level.
    std::uint32_t axiom_kind(Symbol symbol) const { return axiom_kinds_[symbol]; }
    /// The highest level up to which the expansion of a module takes little memory whatever is chosen, and is
    /// expected to yield few symbols. `means` and `rooms` end at this level or the next.
    std::int64_t low() const { return low_; }

private:
    using Text = std::optional<std::string>;
    /// The symbol, or `none` for text alone; the text before it; the text after it.
    using Kind = std::tuple<Symbol, std::string, std::string>;
    struct Part {
        std::uint64_t add;
        Kind kind;
    };

    const Choices& choices(std::int64_t level) const { return *choices_.at(&levels_.table(level)); }
    bool is_rewritten(Symbol symbol, std::int64_t level) const {
        return !levels_.table(level).candidates(symbol).empty();
    }
    bool is_long() const;
    void find_texts();
    bool make_levels();
    bool add_alternatives(std::int64_t level);
    void add_alternative(std::int64_t level, const Kind& kind, const Choices::Successor* successor,
                         std::vector<std::vector<Part>>& parts);
    std::uint32_t number(const Kind& kind, std::int64_t level);
    void find_sizes();

    const Grammar& grammar_;
    const Levels& levels_;
    std::string_view bytes_;
    bool is_usable_ = false;
    std::map<const Table*, std::unique_ptr<Choices>> choices_;
    std::vector<std::vector<Text>> texts_;                // by level and symbol, its short text if it has only one
    std::vector<std::map<Kind, std::uint32_t>> numbers_;  // by level
    std::vector<std::vector<Kind>> kinds_;                // by level
    std::size_t kind_count_ = 0;
    std::vector<DrawnLevel> drawn_;
    std::vector<std::uint32_t> axiom_kinds_;
    std::int64_t low_ = 1;
};

}  // namespace sikku
