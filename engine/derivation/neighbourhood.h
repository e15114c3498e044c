// engine/derivation/neighbourhood.h: matches contexts around a symbol of a word and counts the cost.
#pragma once

#include "engine/derivation/derivation.h"

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

namespace sikku {

/// Thrown if matching compares more symbols than the options allow.
class MatchingError : public BudgetError {
    using BudgetError::BudgetError;
};

/// Counts the symbols compared in matching, over all steps of a derivation, so that the budget limits long contexts
/// at many places. A few comparisons for each symbol of a word are free.
class MatchingWork {
public:
    explicit MatchingWork(const DerivationOptions& options)
        : options_(options), most_(options.compared), next_look_(between_looks) {}

    /// Starts rewriting a word of this many symbols in the given step.
    void begin_step(std::int64_t step, std::size_t symbols) {
        step_ = step;
        const std::uint64_t free = free_comparisons * std::uint64_t{symbols};
        most_ = most_ > std::numeric_limits<std::uint64_t>::max() - free ? std::numeric_limits<std::uint64_t>::max()
                                                                         : most_ + free;
    }
    /// Counts compared symbols. @throws MatchingError; exceptions of `watch` of the options
    void add(std::uint64_t compared) {
        count_ += compared;
        if (count_ >= next_look_) look();
    }

private:
    void look() {
        next_look_ = count_ + between_looks;
        if (count_ > most_) {
            throw MatchingError("matching contexts compares more than " + std::to_string(options_.compared) +
                                " symbols by step " + std::to_string(step_) + ", which is above the budget");
        }
        if (options_.watch) options_.watch(0);
    }

    static constexpr std::uint64_t between_looks = std::uint64_t{1} << 16;
    static constexpr std::uint64_t free_comparisons = 8;  // for each symbol
    const DerivationOptions& options_;
    std::uint64_t most_;
    std::uint64_t count_ = 0;
    std::uint64_t next_look_;
    std::int64_t step_ = 0;
};

/// Finds the neighbours of a symbol in a word, across branches, as the pfg program does.
/// Stores for each position the nearest symbols to the left and right that contexts can see, so that a long run of
/// ignored symbols, or a large branch, is skipped in one step.
/// Source: Prusinkiewicz & Hanan 1989, section 3.4 and appendix A.
class Neighbourhood {
public:
    Neighbourhood(const Grammar& grammar, const Word& word, bool with_branches, MatchingWork& work)
        : grammar_(grammar), word_(word), work_(work) {
        if (with_branches) find_branches();
        const auto size = static_cast<std::uint32_t>(word.size());
        before_.resize(word.size() + 1);
        after_.resize(word.size() + 1);
        std::vector<std::uint32_t> open;
        before_[0] = nothing;
        for (std::uint32_t i = 0; i < size; ++i) {
            const Symbol symbol = word[i];
            before_[i + 1] = i;
            if (grammar.is_push(symbol)) open.push_back(before_[i]);
            // After a branch, the symbol before it is visible; `]` closes it even where brackets are ignored.
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

    /// True if `context` matches to the left of position `at`. Writes the positions of its symbols, from left to
    /// right, to `seen_at` unless it is null.
    bool left_matches(const Word& context, std::size_t at, std::uint32_t* seen_at = nullptr) const {
        std::size_t k = context.size();
        for (; k > 0; --k) {
            const std::uint32_t seen = before_[at];
            if (seen == nothing || word_[seen] != context[k - 1]) break;
            if (seen_at) seen_at[k - 1] = seen;
            at = seen;
        }
        work_.add(context.size() - k);
        return k == 0;
    }

    bool right_matches(const Word& context, std::size_t at, std::uint32_t* seen_at = nullptr) {
        const std::size_t matched = count_right(context, at, seen_at);
        work_.add(matched);
        return matched == context.size();
    }

private:
    /// Number of leading context symbols that match.
    std::size_t count_right(const Word& context, std::size_t at, std::uint32_t* seen_at) {
        ends_.clear();
        for (std::size_t k = 0; k < context.size(); ++k) {
            const Symbol wanted = context[k];
            if (!branch_.empty() && grammar_.is_push(wanted)) {
                // Only ignored symbols may precede the branch.
                const std::size_t begin =
                    at < word_.size() && !grammar_.is_push(word_[at]) ? std::size_t{branch_[at]} : at;
                if (begin >= word_.size()) return k;
                ends_.push_back(branch_[begin]);
                at = begin + 1;
                if (seen_at) *seen_at++ = nothing;
            } else if (!branch_.empty() && grammar_.is_pop(wanted)) {
                at = ends_.back() == nothing ? word_.size() : std::size_t{ends_.back()} + 1;
                ends_.pop_back();
                if (seen_at) *seen_at++ = nothing;
            } else {
                const std::uint32_t seen = after_[at];
                if (seen == nothing || word_[seen] != wanted) return k;
                if (seen_at) *seen_at++ = seen;
                at = std::size_t{seen} + 1;
            }
        }
        return context.size();
    }

    /// Stores for each '[' its ']', and for each other position the next '[' if only ignored symbols precede it.
    void find_branches() {
        branch_.assign(word_.size(), nothing);
        std::vector<std::uint32_t> closed;
        for (auto i = static_cast<std::uint32_t>(word_.size()); i-- > 0;) {
            const Symbol symbol = word_[i];
            if (grammar_.is_pop(symbol)) {
                closed.push_back(i);
            } else if (grammar_.is_push(symbol)) {
                if (!closed.empty()) {
                    branch_[i] = closed.back();
                    closed.pop_back();
                }
            } else if (grammar_.ignored(symbol) && std::size_t{i} + 1 < word_.size()) {
                branch_[i] = grammar_.is_push(word_[i + 1]) ? i + 1 : branch_[i + 1];
            }
        }
    }

    static constexpr std::uint32_t nothing = std::numeric_limits<std::uint32_t>::max();
    const Grammar& grammar_;
    const Word& word_;
    MatchingWork& work_;
    std::vector<std::uint32_t> before_;  // position visible to the left of each symbol
    std::vector<std::uint32_t> after_;   // position visible to the right, its own included
    std::vector<std::uint32_t> branch_;  // empty if no context looks into branches
    std::vector<std::uint32_t> ends_;    // ends of the branches in the context being matched
};

/// Rewrites a word as the public function does, and counts the symbols compared in `work`.
ModuleWord rewrite(const Grammar& grammar, const Table& table, const ModuleWord& given, std::int64_t step,
                   const DerivationOptions& options, MatchingWork& work);

}  // namespace sikku
