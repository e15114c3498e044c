// engine/derivation/neighbourhood.h: matches contexts around a symbol of a word and counts the cost.
#pragma once

#include "engine/derivation/context_choices.h"
#include "engine/derivation/derivation.h"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <map>
#include <string>
#include <vector>

namespace sikku {

struct StepOrigins;

/// Thrown if matching compares more symbols than the options allow.
class MatchingError : public BudgetError {
    using BudgetError::BudgetError;
};

/// Counts the symbols compared in matching, over all steps of a derivation, so that the budget limits long contexts
/// at many places. A few comparisons for each symbol of a word are free. Keeps the choices of the tables.
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

    /// Memory that steps reuse.
    struct Memory {
        std::vector<std::uint32_t> before, after, branch;
        std::vector<std::uint8_t> classes;
        Word spare;  ///< a word that is not needed any more
    };
    Memory memory;

    /// Of the grammar of the derivation.
    const ContextChoices& choices(const Grammar& grammar, const Table& table) {
        return choices_.try_emplace(&table, grammar, table).first->second;
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
    std::map<const Table*, ContextChoices> choices_;
};

/// Finds the neighbours of a symbol in a word, across branches, as the pfg program does.
/// Stores for each position the nearest symbols to the left and right that contexts can see, so that a long run of
/// ignored symbols, or a large branch, is skipped in one step.
/// Source: Prusinkiewicz & Hanan 1989, section 3.4 and appendix A.
class Neighbourhood {
public:
    Neighbourhood(const ContextChoices& choices, const Word& word, MatchingWork& work)
        : choices_(choices),
          word_(word),
          work_(work),
          before_(work.memory.before),
          after_(work.memory.after),
          branch_(work.memory.branch) {
        before_.resize(word.size() + 1);
        after_.resize(word.size() + 1);
        branch_.resize(choices.looks_into_branches() ? word.size() : 0);
        look_left();
        look_right();
    }

    /// Index of the productions whose contexts begin as the neighbours of the symbol at a position.
    std::size_t index(std::size_t at) const {
        const std::uint32_t left = before_[at];
        const std::uint32_t right = after_[at + 1];
        return choices_.index(kind(at), left == nothing ? std::uint8_t{0} : kind(left).left,
                              right == nothing ? std::uint8_t{0} : kind(right).right);
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
            if (!branch_.empty() && choices_.kind(wanted).is_push) {
                // Only ignored symbols may precede the branch.
                const std::size_t begin = at < word_.size() && !kind(at).is_push ? std::size_t{branch_[at]} : at;
                if (begin >= word_.size()) return k;
                ends_.push_back(branch_[begin]);
                at = begin + 1;
                if (seen_at) *seen_at++ = nothing;
            } else if (!branch_.empty() && choices_.kind(wanted).is_pop) {
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

    const ContextChoices::Kind& kind(std::size_t at) const { return choices_.kind(word_[at]); }

    void look_left() {
        std::vector<std::uint32_t> open;
        std::uint32_t seen = nothing;
        for (std::uint32_t i = 0; i < word_.size(); ++i) {
            before_[i] = seen;
            const ContextChoices::Kind& here = kind(i);
            if (!here.is_special) {
                seen = i;
                continue;
            }
            // After a branch, the symbol before it is visible; `]` closes it even where brackets are ignored.
            if (here.is_push) open.push_back(seen);
            std::uint32_t opened = nothing;
            if (here.is_pop && !open.empty()) {
                opened = open.back();
                open.pop_back();
            }
            if (here.is_pop && !here.is_ignored) seen = opened;
        }
        before_[word_.size()] = seen;
    }

    /// Also stores for each '[' its ']', and for each other position the next '[' if only ignored symbols precede it.
    void look_right() {
        struct Branch {
            std::uint32_t end, after;
        };
        std::vector<Branch> open;
        std::uint32_t seen = nothing;
        after_[word_.size()] = nothing;
        for (auto i = static_cast<std::uint32_t>(word_.size()); i-- > 0;) {
            const ContextChoices::Kind& here = kind(i);
            if (here.is_special) {
                if (here.is_pop) open.push_back({i, seen});
                Branch branch{nothing, nothing};
                if (here.is_push && !open.empty()) {
                    branch = open.back();
                    open.pop_back();
                }
                if (!here.is_ignored) seen = here.is_push ? branch.after : i;
                if (!branch_.empty()) {
                    branch_[i] = nothing;
                    if (here.is_push) {
                        branch_[i] = branch.end;
                    } else if (!here.is_pop && std::size_t{i} + 1 < word_.size()) {
                        branch_[i] = kind(i + 1).is_push ? i + 1 : branch_[i + 1];
                    }
                }
            } else {
                seen = i;
                if (!branch_.empty()) branch_[i] = nothing;
            }
            after_[i] = seen;
        }
    }

    static constexpr std::uint32_t nothing = std::numeric_limits<std::uint32_t>::max();
    const ContextChoices& choices_;
    const Word& word_;
    MatchingWork& work_;
    std::vector<std::uint32_t>& before_;  // position visible to the left of each symbol
    std::vector<std::uint32_t>& after_;   // position visible to the right, its own included
    std::vector<std::uint32_t>& branch_;  // empty if no context looks into branches
    std::vector<std::uint32_t> ends_;     // ends of the branches in the context being matched
};

/// The most symbols of a word that is kept whole: places are counted in 32 bits.
inline std::uint64_t longest_word(const DerivationOptions& options) {
    return std::min<std::uint64_t>(options.longest_word, UINT32_MAX - 1);
}

/// Rewrites a word as the public function does, and counts the symbols compared in `work`.
ModuleWord rewrite(const Grammar& grammar, const Table& table, const ModuleWord& given, std::int64_t step,
                   const DerivationOptions& options, MatchingWork& work);
/// @param origins  receives where the symbols of the result come from
ModuleWord rewrite(const Grammar& grammar, const Table& table, const ModuleWord& word, std::int64_t step,
                   const DerivationOptions& options, MatchingWork& work, StepOrigins& origins);

}  // namespace sikku
