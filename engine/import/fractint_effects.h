// engine/import/fractint_effects.h: computes the effects of a Fractint entry's letters on the symbols after them.
#pragma once

#include "engine/import/fractint_entry.h"

#include <cstdint>
#include <map>
#include <string_view>
#include <vector>

namespace sikku::fractint {

/// What going through a symbol leaves behind: the step length multiplied by powers of the factors, in halves, and
/// left and right exchanged.
struct Effect {
    std::vector<std::int64_t> halves;
    bool flips = false;
    bool operator==(const Effect&) const = default;
};

/// Keeps a reference to the entry.
class Effects {
public:
    /// @param losses  receives the features that patterns do not support
    Effects(const Entry& entry, ImportLosses& losses);

    /// True if the letter can be derived from the axiom.
    bool has(char letter) const { return reached_.test(index_of(letter)); }
    bool leads_to_steps(char letter) const { return leads_to_steps_.test(index_of(letter)); }
    bool leads_to_turns(char letter) const { return leads_to_turns_.test(index_of(letter)); }
    /// True if the letter turns the heading of the steps that the system uses.
    bool turns_count(char letter) const { return turns().find(letter) != std::string_view::npos; }
    /// True if '|' turns the turtle around.
    bool turns_around() const { return has_own_steps_ || !has_other_steps_; }
    /// True if an @ changes the length of any step.
    bool is_sized() const { return is_sized_; }

    /// Number of levels (remaining steps) with different effects.
    std::size_t levels() const { return levels_.size(); }
    /// True if all further levels have the effects of the last one.
    bool is_settled() const { return is_settled_; }
    /// The effects of each letter with a rule and `level` remaining steps, as far as later symbols depend on them.
    const std::map<char, Effect>& at(std::size_t level) const { return levels_[level]; }

private:
    void find_reached(ImportLosses& losses);
    std::string_view turns() const;
    Flags followed(const Flags& sensitive) const;
    void compose();

    const Entry& entry_;
    Flags reached_;
    Flags leads_to_steps_;
    Flags leads_to_turns_;
    Flags followed_steps_;
    Flags followed_turns_;
    bool has_own_steps_ = false;
    bool has_other_steps_ = false;
    bool is_sized_ = false;
    std::vector<std::map<char, Effect>> levels_;
    bool is_settled_ = false;
};

/// Goes through one token, its rule having the effects `below`.
void apply(const Token& token, const std::map<char, Effect>& below, Effect& effect);

}  // namespace sikku::fractint
