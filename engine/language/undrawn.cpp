#include "engine/language/undrawn.h"

#include "engine/base/keys.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

namespace sikku {
namespace {

constexpr std::size_t most_named = 12;  // maximum number of letters in a message

/// Roles of a letter in a grammar.
struct LetterFacts {
    bool is_skipped = true;       ///< by a turtle, in all its forms
    bool is_reached = false;      ///< words of the system contain it
    bool has_rule = false;        ///< by itself
    bool is_context = false;      ///< of a production, or ignored as one
    bool draws = false;           ///< makes a step that draws
    bool moves = false;           ///< makes a step that does not, in words of the system
    bool is_in_step = false;      ///< a step's successor contains it, outside of brackets
    bool contains_self = false;   ///< a successor of its own does, outside of brackets
    bool contains_other = false;  ///< a successor of its own contains other letters
    bool multiplies = false;      ///< a successor of its own has several symbols
};

/// Finds the roles of the letters of a grammar.
class Letters {
public:
    explicit Letters(const Grammar& grammar) : grammar_(grammar), facts_(grammar.letters().size()) {
        const std::vector<char> reached = grammar.reachable();
        for (Symbol symbol = 0; symbol < reached.size(); ++symbol) {
            const Action action = grammar.symbols()[symbol].command.action;
            LetterFacts& letter = facts_[letter_of(symbol)];
            if (action != Action::pass) letter.is_skipped = false;
            if (action == Action::draw) letter.draws = true;
            // Splines are drawn through moves, too.
            if (is_ink(action) || action == Action::move) draws_ = true;
            if (!reached[symbol]) continue;
            letter.is_reached = true;
            if (action == Action::move) letter.moves = true;
            if (action == Action::turn) turns_ = true;
            if (grammar.ignored(symbol)) letter.is_context = true;
        }
        for (const Table& table : grammar.tables()) {
            for (const Production& production : table.productions()) read(production);
        }
        // Letters with productions under `interpret:` are not skipped.
        if (!grammar.interpretation()) return;
        for (const Production& production : grammar.interpretation()->productions()) {
            facts_[letter_of(production.predecessor.front())].is_skipped = false;
        }
    }

    bool draws() const { return draws_; }
    bool turns() const { return turns_; }

    /// The letters of which a predicate holds, sorted.
    template <class Holds>
    std::vector<std::string> find(Holds holds) const {
        std::vector<std::string> list;
        for (std::size_t i = 0; i < facts_.size(); ++i) {
            if (holds(facts_[i])) list.push_back(grammar_.letters()[i]);
        }
        std::sort(list.begin(), list.end());
        return list;
    }

private:
    std::uint32_t letter_of(Symbol symbol) const { return grammar_.symbols()[symbol].letter_index; }

    void read(const Production& production) {
        for (const Word* context : {&production.left, &production.right}) {
            for (const Symbol symbol : *context) facts_[letter_of(symbol)].is_context = true;
        }
        if (production.predecessor.size() != 1) return;
        const std::uint32_t own = letter_of(production.predecessor.front());
        facts_[own].has_rule = true;
        if (production.successor.size() > 1) facts_[own].multiplies = true;
        std::int64_t depth = 0;
        for (const Symbol symbol : production.successor) {
            const Action action = grammar_.symbols()[symbol].command.action;
            if (action == Action::push) ++depth;
            if (action == Action::pop) --depth;
            const std::uint32_t letter = letter_of(symbol);
            if (letter != own) facts_[own].contains_other = true;
            if (depth != 0) continue;
            if (letter == own) facts_[own].contains_self = true;
            if (facts_[own].draws) facts_[letter].is_in_step = true;
        }
    }

    const Grammar& grammar_;
    std::vector<LetterFacts> facts_;
    bool draws_ = false;
    bool turns_ = false;
};

bool is_candidate(const LetterFacts& letter) {
    return letter.is_skipped && letter.is_reached && letter.has_rule;
}

/// True if the pattern states which symbols draw, or its symbols are notes.
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

/// The letters that move in a system none of whose words draw anything.
std::vector<std::string> moves_without_ink(const Letters& letters, const Grammar& grammar) {
    if (can_draw(grammar)) return {};
    return letters.find([](const LetterFacts& letter) { return letter.moves; });
}

/// True if moves only add points to the line of this pattern.
bool moves_draw(const Pattern& pattern) {
    const Key* line = pattern.find("line");
    return line && line->value.view() == "spline";
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

/// `forward: F G`: the key with the letters that have that effect, and with `names`.
std::string key_with(std::string_view key, Action action, const Grammar& grammar,
                     const std::vector<std::string>& names) {
    std::set<std::string> steps;
    for (const SymbolInfo& symbol : grammar.symbols()) {
        if (symbol.command.action == action) steps.insert(symbol.letter);
    }
    std::string list = fmt::format("{}:", key);
    for (const std::string& step : steps) list += ' ' + step;
    for (std::size_t i = 0; i < std::min(names.size(), most_named); ++i) list += ' ' + names[i];
    if (names.size() > most_named) list += " …";
    return list;
}

/// `'f' moves without drawing; 'forward: f' makes it a step, F draws`
std::string moves_message(const Grammar& grammar, const std::vector<std::string>& names) {
    const bool is_one = names.size() == 1;
    const bool has_f = std::find(names.begin(), names.end(), "F") != names.end();
    return fmt::format("{} {} without drawing; '{}' makes {}{}", enumerated(names, "'"), is_one ? "moves" : "move",
                       key_with("forward", Action::draw, grammar, names), is_one ? "it a step" : "them steps",
                       has_f ? "" : ", F draws");
}

}  // namespace

bool is_ink(Action action) {
    return action == Action::draw || action == Action::disc || action == Action::polygon_end ||
           action == Action::edge_end || action == Action::surface || action == Action::label;
}

std::vector<std::string> meant_as_steps(const Pattern& pattern, const Grammar& grammar) {
    if (grammar.map() || states_meaning(pattern)) return {};
    const Letters letters(grammar);
    std::vector<std::string> found = letters.find([&](const LetterFacts& letter) {
        const bool is_like_a_step = letter.is_in_step && letter.contains_self;
        const bool only_multiplies = letter.multiplies && !letter.contains_other;
        return is_candidate(letter) &&
               (letters.draws() ? !letter.is_context && (is_like_a_step || only_multiplies) : letters.turns());
    });
    return found.empty() && !moves_draw(pattern) ? moves_without_ink(letters, grammar) : found;
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
    if (moves_without_ink(Letters(grammar), grammar) == names) {
        return diagnostics.warning(where, moves_message(grammar, names));
    }
    const bool is_one = names.size() == 1;
    std::string message =
        fmt::format("{} {} nothing; '{}' makes {}", enumerated(names, "'"), is_one ? "draws" : "draw",
                    key_with("forward", Action::draw, grammar, names), is_one ? "it a step" : "them steps");
    // If other letters draw, these may be gaps.
    if (can_draw(grammar)) {
        message += fmt::format(", '{}' a step without ink", key_with("move", Action::move, grammar, names));
    }
    diagnostics.warning(where, message);
}

bool can_draw(const Grammar& grammar) {
    return grammar.leads_to(is_ink);
}

bool may_draw(const Grammar& grammar) {
    constexpr std::size_t most_visits = std::size_t{1} << 20;  // symbols of successors
    const std::vector<SymbolInfo>& symbols = grammar.symbols();
    std::size_t visits = 0;
    std::vector<char> present(symbols.size(), 0);
    for (const Symbol symbol : grammar.axiom()) present[symbol] = 1;
    /// Finds the symbols after a step. A symbol also stays if its productions have further requirements.
    const auto advance = [&](const Table& table) {
        std::vector<char> next(symbols.size(), 0);
        const auto add = [&](const Word& word) {
            visits += word.size() + 1;
            for (const Symbol symbol : word) next[symbol] = 1;
        };
        for (Symbol symbol = 0; symbol < present.size(); ++symbol) {
            if (!present[symbol]) continue;
            if (table.context_free() && grammar.is_plain()) {
                const Word* successor = table.successor(symbol);
                successor ? add(*successor) : add({symbol});
                continue;
            }
            add({symbol});
            for (const std::uint32_t i : table.candidates(symbol)) add(table.production(i).successor);
        }
        visits += symbols.size();
        const bool is_same = next == present;
        present = std::move(next);
        return is_same;
    };
    for (const ScheduleRun& run : grammar.schedule()) {
        for (std::int64_t step = 0; step < run.steps; ++step) {
            if (visits > most_visits) return can_draw(grammar);
            if (advance(grammar.tables()[run.table])) break;
        }
    }
    if (grammar.interpretation()) advance(*grammar.interpretation());
    for (Symbol symbol = 0; symbol < present.size(); ++symbol) {
        if (present[symbol] && is_ink(symbols[symbol].command.action)) return true;
    }
    return false;
}

std::string undrawn_hint(const Grammar& grammar) {
    if (grammar.map() || can_draw(grammar)) return {};
    const Letters letters(grammar);
    if (const std::vector<std::string> moves = moves_without_ink(letters, grammar); !moves.empty()) {
        return "; " + moves_message(grammar, moves);
    }
    const std::vector<std::string> names = letters.find(is_candidate);
    if (names.empty()) return {};
    return fmt::format("; '{}' makes {} {}", key_with("forward", Action::draw, grammar, names), enumerated(names, ""),
                       names.size() == 1 ? "a step" : "steps");
}

}  // namespace sikku
