#include "engine/import/fractint_effects.h"

#include <cmath>
#include <cstdlib>
#include <utility>

namespace sikku::fractint {
namespace {

constexpr std::size_t most_levels = 20;                           // that differ
constexpr double most_length_digits = 300;                        // in a length, before or after the point
constexpr std::int64_t whole_turn = 360'000'000'000;              // billionths of degrees
constexpr std::int64_t largest_exponent = std::int64_t{1} << 40;  // exponent of a factor that is nearly 1

}  // namespace

Effects::Effects(const Entry& entry) : entry_(entry) {
    find_reached();
    followed_steps_ = followed(leads_to_steps_);
    followed_turns_ = followed(leads_to_turns_);
    followed_second_ = followed(leads_to_second_);
    is_sized_ = followed_steps_.test(index_of('@')) && has('@');
    compose();
}

void Effects::find_reached() {
    // The letters that each letter with a rule leads to, including itself.
    std::map<char, Flags> leads;
    for (const auto& [letter, rule] : entry_.rules) {
        leads[letter].set(index_of(letter));
        for (const Token& token : rule) leads[letter].set(index_of(token.letter));
    }
    for (const auto& [middle, its] : std::map(leads)) {
        for (auto& [letter, flags] : leads) {
            if (flags.test(index_of(middle))) flags |= leads[middle];
        }
    }
    for (const Token& token : entry_.axiom) {
        reached_.set(index_of(token.letter));
        if (entry_.rule_of(token.letter)) reached_ |= leads[token.letter];
    }
    has_own_steps_ = has('f') || has('g');
    has_other_steps_ = has('d') || has('m');
    leads_to_steps_ = flags_of("fgdm");
    leads_to_turns_ = flags_of(turns());
    leads_to_second_ = flags_of("dm");
    for (const auto& [letter, flags] : leads) {
        leads_to_steps_[index_of(letter)] = (flags & flags_of("fgdm")).any();
        leads_to_turns_[index_of(letter)] = (flags & flags_of(turns())).any();
        leads_to_second_[index_of(letter)] = (flags & flags_of("dm")).any();
    }
}

/// Returns the turns that ! exchanges and that affect headings of steps in the system.
std::string_view Effects::turns() const {
    return has_own_steps_ && has_other_steps_ ? "+-/\\" : has_other_steps_ ? "/\\" : "+-";
}

/// Finds the letters that are followed by a sensitive letter before the end of their branch.
Flags Effects::followed(const Flags& sensitive) const {
    Flags result;
    const auto look = [&](const Tokens& word, bool after) {
        std::vector<std::pair<bool, bool>> outer;  // `after` and `in_branch` of the enclosing branches
        bool in_branch = false;
        for (std::size_t i = word.size(); i-- > 0;) {
            const Token& token = word[i];
            if (token.letter == ']') {
                outer.emplace_back(after, in_branch);
                after = in_branch = false;
            } else if (token.letter == '[') {
                const bool inside = in_branch;
                after = outer.back().first || inside;
                in_branch = outer.back().second || inside;
                outer.pop_back();
            } else {
                if (after) result.set(index_of(token.letter));
                if (sensitive.test(index_of(token.letter))) after = in_branch = true;
            }
        }
    };
    look(entry_.axiom, false);
    for (std::size_t before = Flags().size() + 1; before != result.count();) {
        before = result.count();
        for (const auto& [letter, rule] : entry_.rules) {
            if (has(letter)) look(rule, result.test(index_of(letter)));
        }
    }
    return result;
}

/// Composes effects for an increasing number of remaining steps, until they no longer change.
void Effects::compose() {
    std::map<char, Effect> none;
    for (const auto& [letter, rule] : entry_.rules) none[letter].halves.assign(entry_.factors.values.size(), 0);
    levels_.push_back(std::move(none));
    while (true) {
        std::map<char, Effect> next;
        bool is_small = true;
        for (const auto& [letter, rule] : entry_.rules) {
            Effect& effect = next[letter];
            effect.halves.assign(entry_.factors.values.size(), 0);
            std::size_t depth = 0;
            for (const Token& token : rule) {
                if (token.letter == '[') ++depth;
                if (token.letter == ']') --depth;
                if (depth == 0) apply(token, entry_, levels_.back(), effect);
            }
            if (!followed_turns_.test(index_of(letter))) effect.flips = false;
            if (!has_two_headings() || !followed_second_.test(index_of(letter))) {
                effect.steps = effect.around = effect.billionths = 0;
            }
            if (!is_sized_ || !followed_steps_.test(index_of(letter))) {
                effect.halves.assign(entry_.factors.values.size(), 0);
            }
            double digits = 0;
            for (std::size_t i = 0; i < entry_.factors.values.size(); ++i) {
                digits += 0.5 * static_cast<double>(effect.halves[i]) * std::log10(entry_.factors.values[i]);
                if (std::abs(effect.halves[i]) > largest_exponent) is_small = false;
            }
            // Lengths may become 0, as in Fractint.
            if (!(digits < most_length_digits)) is_small = false;
        }
        is_settled_ = next == levels_.back();
        if (is_settled_ || levels_.size() >= most_levels || !is_small) return;
        levels_.push_back(std::move(next));
    }
}

void apply(const Token& token, const Entry& entry, const std::map<char, Effect>& below, Effect& effect) {
    const std::int64_t side = effect.flips ? -1 : 1;
    const auto add = [](std::int64_t& sum, std::int64_t more, std::int64_t whole) {
        sum = ((sum + more) % whole + whole) % whole;
    };
    if (token.letter == '@') {
        const std::vector<std::int32_t>& exponents = entry.factors.exponents[token.base];
        for (std::size_t i = 0; i < exponents.size(); ++i) {
            effect.halves[i] += std::int64_t{token.root} * exponents[i];
        }
    } else if (token.letter == '!') {
        effect.flips = !effect.flips;
    } else if (token.letter == '+' || token.letter == '-') {
        add(effect.steps, token.letter == '+' ? side : -side, entry.angle);
    } else if (token.letter == '|') {
        // Half a turn clockwise, rounded down to whole steps of the angle.
        add(effect.around, -(entry.angle / 2), entry.angle);
    } else if (token.letter == '\\' || token.letter == '/') {
        const auto turn = std::llround(std::fmod(token.number, 360) * 1e9);
        add(effect.billionths, token.letter == '\\' ? side * turn : -side * turn, whole_turn);
    }
    const auto found = below.find(token.letter);
    if (found == below.end()) return;
    const Effect& inner = found->second;
    effect.flips = effect.flips != inner.flips;
    for (std::size_t i = 0; i < effect.halves.size(); ++i) effect.halves[i] += inner.halves[i];
    add(effect.steps, side * inner.steps, entry.angle);
    add(effect.around, inner.around, entry.angle);
    add(effect.billionths, side * inner.billionths, whole_turn);
}

double lead_of(const Effect& effect, const Entry& entry) {
    const auto turned = static_cast<double>((effect.steps + effect.around) % entry.angle) / entry.angle * 360;
    return std::remainder(static_cast<double>(effect.billionths) / 1e9 - turned, 360);
}

}  // namespace sikku::fractint
