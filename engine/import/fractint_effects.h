// engine/import/fractint_effects.h: computes the effects of a Fractint entry's letters on the symbols after them, and
// writes the pattern.
#pragma once

#include "engine/import/fractint_entry.h"

#include <cstdint>
#include <map>
#include <string_view>
#include <vector>

namespace sikku::fractint {

/// The effect of a symbol on the turtle after it: the step length multiplied by powers of the factors, in halves;
/// left and right exchanged; and the heading of D and M relative to that of F and G.
struct Effect {
    std::vector<std::int64_t> halves;
    bool flips = false;
    std::int64_t steps = 0;       ///< turns of + and -, in units of 360 degrees / angle: 0 to angle - 1
    std::int64_t around = 0;      ///< the same for |, which ! does not exchange
    std::int64_t billionths = 0;  ///< turns of \\ and /, in billionths of degrees, below 360 degrees
    bool operator==(const Effect&) const = default;
};

/// Computes the effects of the letters of an entry. Keeps a reference to it.
class Effects {
public:
    explicit Effects(const Entry& entry);

    /// True if the letter can be derived from the axiom.
    bool has(char letter) const { return reached_.test(index_of(letter)); }
    bool leads_to_steps(char letter) const { return leads_to_steps_.test(index_of(letter)); }
    bool leads_to_turns(char letter) const { return leads_to_turns_.test(index_of(letter)); }
    /// True if the letter turns the heading of the steps that the system uses.
    bool turns_count(char letter) const { return turns().find(letter) != std::string_view::npos; }
    /// True if steps of F or G and steps of D or M, which have separate headings, both occur.
    bool has_two_headings() const { return has_own_steps_ && has_other_steps_; }
    /// True if the letter leads to steps of the second heading.
    bool leads_to_second(char letter) const { return has_two_headings() && leads_to_second_.test(index_of(letter)); }
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
    void find_reached();
    std::string_view turns() const;
    Flags followed(const Flags& sensitive) const;
    void compose();

    const Entry& entry_;
    Flags reached_;
    Flags leads_to_steps_;
    Flags leads_to_turns_;
    Flags leads_to_second_;
    Flags followed_steps_;
    Flags followed_turns_;
    Flags followed_second_;
    bool has_own_steps_ = false;
    bool has_other_steps_ = false;
    bool is_sized_ = false;
    std::vector<std::map<char, Effect>> levels_;
    bool is_settled_ = false;
};

/// Applies the effect of one token. @param below  effects of the letters with rules
void apply(const Token& token, const Entry& entry, const std::map<char, Effect>& below, Effect& effect);

/// The heading of D and M minus that of F and G, in degrees.
double lead_of(const Effect& effect, const Entry& entry);

/// Returns the text of a pattern file.
/// @param room  bytes that may still be written; reduced by those written
/// @throws BadEntry after reporting an error
std::string write_pattern(const Entry& entry, const Effects& effects, const SourcePointer& file,
                          Diagnostics& diagnostics, ImportLosses& losses, std::size_t& room);

}  // namespace sikku::fractint
