#include "engine/language/undrawn.h"

#include "engine/base/keys.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

namespace sikku {
namespace {

constexpr std::size_t most_named = 12;  // of the letters in a message

bool is_ink(Action action) {
    return action == Action::draw || action == Action::disc || action == Action::polygon_end ||
           action == Action::edge_end || action == Action::surface || action == Action::label;
}

/// What the letters of a grammar do.
class Letters {
public:
    explicit Letters(const Grammar& grammar)
        : grammar_(grammar),
          skipped_(grammar.letters().size(), 1),
          reached_(grammar.letters().size(), 0),
          has_rule_(grammar.letters().size(), 0),
          in_context_(grammar.letters().size(), 0) {
        const std::vector<char> reached = grammar.reachable();
        for (Symbol symbol = 0; symbol < reached.size(); ++symbol) {
            const Action action = grammar.symbols()[symbol].command.action;
            const std::uint32_t letter = letter_of(symbol);
            if (action != Action::pass) skipped_[letter] = 0;
            // Splines are drawn through moves, too.
            if (is_ink(action) || action == Action::move) draws_ = true;
            if (!reached[symbol]) continue;
            reached_[letter] = 1;
            if (action == Action::turn) turns_ = true;
            if (grammar.ignored(symbol)) in_context_[letter] = 1;
        }
        for (const Table& table : grammar.tables()) {
            for (const Production& production : table.productions()) {
                if (production.predecessor.size() == 1) has_rule_[letter_of(production.predecessor.front())] = 1;
                for (const Word* context : {&production.left, &production.right}) {
                    for (const Symbol symbol : *context) in_context_[letter_of(symbol)] = 1;
                }
            }
        }
        // What is drawn in its place is what counts.
        if (!grammar.interpretation()) return;
        for (const Production& production : grammar.interpretation()->productions()) {
            skipped_[letter_of(production.predecessor.front())] = 0;
        }
    }

    std::uint32_t letter_of(Symbol symbol) const { return grammar_.symbols()[symbol].letter_index; }
    bool draws() const { return draws_; }
    bool turns() const { return turns_; }
    bool is_candidate(std::uint32_t letter) const {
        return skipped_[letter] && reached_[letter] && has_rule_[letter];
    }
    bool is_context(std::uint32_t letter) const { return in_context_[letter] != 0; }

    /// All its productions consist of the letter, one of them several times.
    bool only_multiplies(std::uint32_t letter) const {
        bool multiplies = false;
        for (const Table& table : grammar_.tables()) {
            for (const Production& production : table.productions()) {
                if (!is_rule_of(production, letter)) continue;
                for (const Symbol symbol : production.successor) {
                    if (letter_of(symbol) != letter) return false;
                }
                multiplies = multiplies || production.successor.size() > 1;
            }
        }
        return multiplies;
    }

    /// One of its productions contains the other letter outside of brackets.
    bool derives(std::uint32_t letter, std::uint32_t other) const {
        for (const Table& table : grammar_.tables()) {
            for (const Production& production : table.productions()) {
                if (is_rule_of(production, letter) && contains(production.successor, other)) return true;
            }
        }
        return false;
    }

    bool is_derived_from_a_step(std::uint32_t letter) const {
        std::set<std::uint32_t> steps;
        for (const SymbolInfo& symbol : grammar_.symbols()) {
            if (symbol.command.action == Action::draw) steps.insert(symbol.letter_index);
        }
        return std::any_of(steps.begin(), steps.end(), [&](std::uint32_t step) { return derives(step, letter); });
    }

    std::vector<std::string> names(const std::vector<std::uint32_t>& letters) const {
        std::vector<std::string> list;
        for (const std::uint32_t letter : letters) list.push_back(grammar_.letters()[letter]);
        std::sort(list.begin(), list.end());
        return list;
    }

private:
    bool is_rule_of(const Production& production, std::uint32_t letter) const {
        return production.predecessor.size() == 1 && letter_of(production.predecessor.front()) == letter;
    }

    bool contains(const Word& word, std::uint32_t letter) const {
        std::int64_t depth = 0;
        for (const Symbol symbol : word) {
            const Action action = grammar_.symbols()[symbol].command.action;
            if (action == Action::push) ++depth;
            if (action == Action::pop) --depth;
            if (depth == 0 && letter_of(symbol) == letter) return true;
        }
        return false;
    }

    const Grammar& grammar_;
    std::vector<char> skipped_;
    std::vector<char> reached_;
    std::vector<char> has_rule_;
    std::vector<char> in_context_;
    bool draws_ = false;
    bool turns_ = false;
};

/// The pattern states what draws, or its symbols are notes.
bool states_meaning(const Pattern& pattern) {
    const Key* mapping = pattern.find("mapping");
    if (pattern.find("forward") || (mapping && mapping->value.view() == "symbols")) return true;
    const Key* named = pattern.find("named notes");
    if (named && named->value.view() == "yes") return true;
    return std::any_of(pattern.keys.begin(), pattern.keys.end(), [](const Key& key) {
        const KeyInfo* known = find_language_key(key.name);
        return known && known->is_for_symbols() && known->owner == KeyOwner::music;
    });
}

/// `A`, `A and B`, `A, B and C`
std::string enumerated(const std::vector<std::string>& names, std::string_view quote) {
    std::string text;
    const std::size_t shown = std::min(names.size(), most_named);
    for (std::size_t i = 0; i < shown; ++i) {
        if (i > 0) text += i + 1 == names.size() ? " and " : ", ";
        text += fmt::format("{0}{1}{0}", quote, names[i]);
    }
    if (shown < names.size()) text += fmt::format(" and {} more", names.size() - shown);
    return text;
}

/// `forward: F G`: the key with the letters that have that effect and these, too.
std::string key_with(std::string_view key, Action action, const Grammar& grammar,
                     const std::vector<std::string>& names) {
    std::set<std::string> steps;
    for (const SymbolInfo& symbol : grammar.symbols()) {
        if (symbol.command.action == action) steps.insert(symbol.letter);
    }
    std::string list = fmt::format("{}:", key);
    for (const std::string& step : steps) list += ' ' + step;
    for (const std::string& name : names) list += ' ' + name;
    return list;
}

}  // namespace

std::vector<std::string> meant_as_steps(const Pattern& pattern, const Grammar& grammar) {
    if (grammar.map() || states_meaning(pattern)) return {};
    const Letters letters(grammar);
    std::vector<std::uint32_t> found;
    for (std::uint32_t letter = 0; letter < grammar.letters().size(); ++letter) {
        if (!letters.is_candidate(letter)) continue;
        if (!letters.draws()) {
            if (letters.turns()) found.push_back(letter);
        } else if (!letters.is_context(letter)) {
            const bool is_like_a_step = letters.derives(letter, letter) && letters.is_derived_from_a_step(letter);
            if (is_like_a_step || letters.only_multiplies(letter)) found.push_back(letter);
        }
    }
    return letters.names(found);
}

void warn_of_undrawn(const Pattern& pattern, const Grammar& grammar, Diagnostics& diagnostics) {
    const std::vector<std::string> names = meant_as_steps(pattern, grammar);
    if (names.empty()) return;
    Span where{pattern.source, 0, 0};
    const auto find = [&](const std::vector<ProductionText>& productions) {
        for (const ProductionText& production : productions) {
            const std::string_view text = production.predecessor.view();
            const std::string& name = names.front();
            if (text != name && !(text.starts_with(name) && text.substr(name.size()).starts_with('('))) continue;
            where = production.predecessor;
            return true;
        }
        return false;
    };
    if (!find(pattern.common)) {
        std::any_of(pattern.tables.begin(), pattern.tables.end(),
                    [&](const TableText& table) { return find(table.productions); });
    }
    const bool is_one = names.size() == 1;
    std::string message =
        fmt::format("{} {} nothing; '{}' makes {}", enumerated(names, "'"), is_one ? "draws" : "draw",
                    key_with("forward", Action::draw, grammar, names), is_one ? "it a step" : "them steps");
    // Where others draw, these may be gaps.
    if (can_draw(grammar)) {
        message += fmt::format(", '{}' a step without ink", key_with("move", Action::move, grammar, names));
    }
    diagnostics.warning(where, message);
}

bool can_draw(const Grammar& grammar) {
    const std::vector<char> reached = grammar.reachable();
    for (Symbol symbol = 0; symbol < reached.size(); ++symbol) {
        if (reached[symbol] && is_ink(grammar.symbols()[symbol].command.action)) return true;
    }
    return false;
}

std::string undrawn_hint(const Grammar& grammar) {
    const Letters letters(grammar);
    if (grammar.map() || letters.draws()) return {};
    std::vector<std::uint32_t> found;
    for (std::uint32_t letter = 0; letter < grammar.letters().size(); ++letter) {
        if (letters.is_candidate(letter)) found.push_back(letter);
    }
    if (found.empty()) return {};
    const std::vector<std::string> names = letters.names(found);
    return fmt::format("; '{}' makes {} {}", key_with("forward", Action::draw, grammar, names), enumerated(names, ""),
                       names.size() == 1 ? "a step" : "steps");
}

}  // namespace sikku
