// engine/derivation/context_choices.h: selects the productions of a table that may apply, by classes of symbols.
#pragma once

#include "engine/language/grammar.h"

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace sikku {

/// Decides by the nearest symbols that contexts see on both sides which productions of a table can apply, so that
/// most are never compared. Symbols that no context looks at are of one class. Depends only on the grammar and the
/// table.
class ContextChoices {
public:
    /// Properties of a symbol that matching needs.
    struct Kind {
        std::uint32_t row = 0;    ///< in the tables; 0 for all symbols that no production rewrites
        std::uint8_t left = 0;    ///< class as the nearest symbol to the left
        std::uint8_t right = 0;   ///< class as the nearest symbol to the right
        bool is_special = false;  ///< any of the following
        bool is_push : 1 = false, is_pop : 1 = false, is_ignored : 1 = false;
    };

    ContextChoices(const Grammar& grammar, const Table& table);

    const Kind& kind(Symbol symbol) const { return kinds_[symbol]; }
    /// True if productions look at one symbol on a side at most, and rewrite one symbol each.
    bool looks_at_nearest() const { return looks_at_nearest_; }
    bool looks_into_branches() const { return looks_into_branches_; }

    /// Index for the classes of the nearest symbols; 0 is the class of a missing symbol.
    std::size_t index(const Kind& kind, std::uint8_t left, std::uint8_t right) const {
        return kind.row + left * rights_ + right;
    }
    /// The productions whose contexts begin so, in the order in which they are tried.
    std::span<const std::uint32_t> candidates(std::size_t index) const {
        return std::span(list_).subspan(begin_[index], begin_[index + 1] - begin_[index]);
    }
    std::size_t size() const { return begin_.size() - 1; }
    /// Numbers of classes.
    std::size_t lefts() const { return lefts_; }
    std::size_t rights() const { return rights_; }

private:
    bool looks_at_nearest_ = true;
    bool looks_into_branches_ = false;
    std::size_t lefts_ = 1, rights_ = 1;
    std::vector<Kind> kinds_;
    std::vector<std::uint32_t> begin_;
    std::vector<std::uint32_t> list_;
};

}  // namespace sikku
