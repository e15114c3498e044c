// engine/import/fractint_pattern.cpp: writes an entry of a Fractint collection as a pattern.
#include "engine/base/text.h"
#include "engine/import/fractint_effects.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <set>
#include <utility>

namespace sikku::fractint {
namespace {

constexpr std::size_t most_pattern = std::size_t{4} << 20;  // bytes that one entry may become
constexpr double most_term_digits = 150;                    // for the powers in an expression
constexpr int palette_size = 16;
constexpr int first_colour = 15;
constexpr const char* palette =
    "#000000 #0000aa #00aa00 #00aaaa #aa0000 #aa00aa #aa5500 #aaaaaa #555555 #5555ff #55ff55 #55ffff #ff5555 #ff55ff "
    "#ffff55 #ffffff";

/// A symbol of the pattern: a letter, or one with a number, unchanged or with left and right exchanged.
struct SymbolKey {
    char letter = 0;
    double number = 0.0;
    bool flipped = false;
    auto operator<=>(const SymbolKey&) const = default;  // NOLINT(modernize-use-nullptr): no pointer is compared
};

std::string repeated(char letter, std::int64_t times) {
    return std::string(static_cast<std::size_t>(times), letter);
}

/// Translates a colour command without a rule; `c10` sets a colour.
std::string colour_command(char letter, double number) {
    const auto n = static_cast<std::int64_t>(number);
    if (letter == 'c') return fmt::format(";({})", n);
    return repeated(letter == '<' ? ';' : ',', n % palette_size);
}

struct Line {
    std::string left;
    std::vector<std::string> right;  ///< by the remaining steps of the successor, from 0
};

bool all_same(const std::vector<std::string>& list) {
    return std::all_of(list.begin(), list.end(), [&](const std::string& one) { return one == list.front(); });
}

class PatternWriter {
public:
    PatternWriter(const Entry& entry, const Effects& effects, const SourcePointer& file, Diagnostics& diagnostics,
                  ImportLosses& losses, std::size_t& room)
        : entry_(entry), effects_(effects), file_(file), diagnostics_(diagnostics), losses_(losses), room_(room) {}

    std::string write() {
        // Names are known only after all words were written; then blanks separate the symbols.
        std::vector<Line> lines = write_lines();
        if (!names_.empty()) {
            names_used_ = true;
            wanted_.clear();
            written_ = 0;
            lines = write_lines();
        }
        const bool begins_late = !all_same(lines.front().right);
        const bool has_tables =
            std::any_of(lines.begin() + 1, lines.end(), [](const Line& line) { return !all_same(line.right); }) ||
            begins_late;
        std::string text = head(begins_late, has_tables && !effects_.is_settled());
        if (begins_late) {
            lines.front().left = begin_symbol();
            text += "axiom: " + lines.front().left + '\n';
        } else {
            text += "axiom: " + lines.front().right.front() + '\n';
        }
        for (std::size_t i = begins_late ? 0 : 1; i < lines.size(); ++i) {
            if (all_same(lines[i].right)) text += lines[i].left + " --> " + lines[i].right.front() + '\n';
        }
        if (has_tables) {
            const auto table = [&](const std::string& name, std::size_t level) {
                text += "\ntable " + name + ":\n";
                for (std::size_t i = begins_late ? 0 : 1; i < lines.size(); ++i) {
                    if (all_same(lines[i].right)) continue;
                    text += lines[i].left + " --> " + lines[i].right[level] + '\n';
                    check_size(text.size());
                }
            };
            std::string schedule = "\nschedule:";
            std::size_t level = effects_.levels();
            if (effects_.is_settled()) {
                table("grow", --level);
                schedule += fmt::format(" grow*(n-{})", level);
            }
            while (level-- > 0) {
                table(fmt::format("last{}", level + 1), level);
                schedule += fmt::format(" last{}", level + 1);
            }
            text += schedule + '\n';
        }
        text += interpretation();
        check_size(text.size());
        return text;
    }

private:
    [[noreturn]] void fail(const std::string& message) const {
        fractint::fail(file_, diagnostics_, entry_.at, message);
    }
    SymbolKey key_of(const Token& token, bool flipped) const {
        const bool numbered = takes_number(token.letter);
        return {token.letter, numbered ? token.number : 0.0,
                flipped && entry_.rule_of(token.letter) && effects_.leads_to_turns(token.letter)};
    }

    /// Name of a symbol that has a rule or no meaning of its own.
    std::string symbol(const SymbolKey& key) {
        if (is_plain(key.letter) && !(takes_number(key.letter) && entry_.rule_of(key.letter))) {
            if (is_letter(key.letter)) {
                return std::string(1, key.flipped ? key.letter : static_cast<char>(key.letter - 'a' + 'A'));
            }
            if (!key.flipped) return std::string(1, key.letter);
        }
        // C10, or a character that words of patterns cannot contain.
        std::string name = fmt::format("{}{:x}", key.flipped ? 'q' : 'p', index_of(key.letter));
        if (takes_number(key.letter)) {
            const char first = key.letter == 'c' ? 'C' : key.letter == '<' ? 'U' : 'V';
            name = fmt::format("{}{}", key.flipped ? lower_case(std::string(1, first)) : std::string(1, first),
                               static_cast<std::int64_t>(key.number));
        }
        names_.insert(name);
        return name;
    }

    /// Writes a length: its base times powers of the factors, such as `s*sqrt(3)/2`.
    std::string length(std::string_view base, const std::vector<std::int64_t>& halves) const {
        const std::vector<double>& factors = entry_.factors.values;
        std::string over, under;
        double digits = 0;  // before or after the point, at most, of an intermediate result
        for (std::size_t i = 0; i < halves.size(); ++i) {
            const std::int64_t power = std::abs(halves[i]);
            if (power == 0) continue;
            digits += 0.5 * static_cast<double>(power) * std::fabs(std::log10(factors[i]));
            std::string term = fmt::format("{}", factors[i]);
            if (power == 1) {
                term = fmt::format("sqrt({})", term);
            } else if (power > 2) {
                term += power % 2 == 0 ? fmt::format("^{}", power / 2) : fmt::format("^{}.5", power / 2);
            }
            (halves[i] > 0 ? over : under) += (halves[i] > 0 ? "*" : "/") + term;
        }
        if (digits > most_term_digits) {
            const double value = product_of_powers(factors, halves);
            // Infinite lengths cannot be drawn; orders that need them are refused where they are used.
            const std::string product = std::isfinite(value) ? fmt::format("{:.15g}", value) : "1e308*1e308";
            return base == "1" ? product : fmt::format("{}*{}", base, product);
        }
        if (base == "1" && !over.empty()) return over.substr(1) + under;
        return std::string(base) + over + under;
    }

    /// Writes the heading of D and M relative to the turtle's, which is that of F and G: `d+30`.
    std::string heading(bool is_relative, const Effect& state) const {
        const double lead = lead_of(state, entry_);
        if (!is_relative) return fmt::format("{}", lead);
        return lead == 0 ? "d" : fmt::format("d{:+}", lead);
    }

    void grow(std::string& text, std::string_view more) {
        if (!names_used_ || text.empty() || more.empty()) {
            text += more;
        } else {
            text += ' ';
            text += more;
        }
        const std::size_t bytes = more.size() + 1;
        if (bytes > room_) fail("the patterns of this collection exceed 16 MB plus twice the size of the file");
        room_ -= bytes;
        written_ += bytes;
        check_size(written_);
    }

    bool has_colours() const { return effects_.has('c') || effects_.has('<') || effects_.has('>'); }
    bool inert(char letter) const {
        return !entry_.rule_of(letter) && !is_step(letter) && !effects_.turns_count(letter) && letter != '[' &&
               letter != ']' && letter != '@' && letter != '!' && letter != 'c' && letter != '<' && letter != '>' &&
               !(letter == '|' && effects_.turns_around());
    }

    /// Translates a word whose symbols have `level` remaining steps.
    std::string word(const Tokens& tokens, std::string_view base, bool flipped, std::size_t level) {
        const std::map<char, Effect>& below = effects_.at(level);
        Effect state;
        state.halves.assign(entry_.factors.values.size(), 0);
        state.flips = flipped;
        std::vector<Effect> stack;
        std::string text;
        for (const Token& token : tokens) {
            const char letter = token.letter;
            const bool has_rule = entry_.rule_of(letter) != nullptr;
            const bool steps = effects_.leads_to_steps(letter);
            if (has_rule || is_step(letter)) {
                const SymbolKey key = key_of(token, state.flips);
                if (has_rule && wanted_.insert(key).second) pending_.push_back(key);
                std::string name = symbol(key);
                if (is_step(letter)) step_letters_.insert({letter, name});
                std::string parameters;
                if (effects_.is_sized() && steps) parameters = length(base, state.halves);
                if (effects_.leads_to_second(letter)) {
                    parameters += (parameters.empty() ? "" : ",") + heading(base != "1", state);
                }
                if (!parameters.empty()) name += '(' + parameters + ')';
                grow(text, name);
            } else if (letter == '[') {
                stack.push_back(state);
                grow(text, "[");
            } else if (letter == ']') {
                state = std::move(stack.back());
                stack.pop_back();
                grow(text, "]");
            } else if (inert(letter)) {
                if (is_plain(letter)) {
                    grow(text, symbol({letter, 0.0, false}));
                } else {
                    dropped_.insert(letter);
                }
            } else if (letter == '+' || letter == '-') {
                grow(text, (letter == '+') != state.flips ? "+" : "-");
            } else if (letter == '\\' || letter == '/') {
                // With two headings, this one is a parameter.
                if (token.number != 0 && !effects_.has_two_headings()) {
                    grow(text, fmt::format("{}({})", (letter == '\\') != state.flips ? '+' : '-', token.number));
                }
            } else if (letter == '|') {
                has_turn_around_ = true;
                grow(text, "|");
            } else if (letter == 'c' || letter == '<' || letter == '>') {
                grow(text, colour_command(letter, token.number));
            }
            apply(token, entry_, below, state);
        }
        return text.empty() ? "*" : text;
    }

    void check_size(std::size_t bytes) {
        if (bytes > most_pattern) fail("the pattern of this system exceeds 4 MB");
    }

    /// Writes the axiom, then a line for each symbol that is reached and has a rule.
    std::vector<Line> write_lines() {
        const std::size_t levels = effects_.levels();
        std::vector<Line> lines;
        Line first;
        for (std::size_t level = 0; level < levels; ++level) {
            std::string axiom = word(entry_.axiom, "1", false, level);
            if (has_colours()) axiom = fmt::format(";({}) {}", first_colour, axiom == "*" ? "" : axiom);
            first.right.push_back(std::move(axiom));
        }
        lines.push_back(std::move(first));
        while (!pending_.empty()) {
            const SymbolKey key = pending_.back();
            pending_.pop_back();
            Line line;
            line.left = symbol(key) + formals(key.letter);
            for (std::size_t level = 0; level < levels; ++level) {
                line.right.push_back(word(*entry_.rule_of(key.letter), "s", key.flipped, level));
            }
            lines.push_back(std::move(line));
        }
        std::sort(lines.begin() + 1, lines.end(), [](const Line& a, const Line& b) { return a.left < b.left; });
        return lines;
    }

    /// `(s)`, `(d)` or `(s,d)`: length of steps and second heading.
    std::string formals(char letter) const {
        const bool sized = effects_.is_sized() && effects_.leads_to_steps(letter);
        const bool led = effects_.leads_to_second(letter);
        return sized && led ? "(s,d)" : sized ? "(s)" : led ? "(d)" : "";
    }

    /// Returns an unused symbol.
    std::string begin_symbol() {
        Flags used;
        const auto look = [&](const Tokens& word) {
            for (const Token& token : word) used.set(index_of(token.letter));
        };
        look(entry_.axiom);
        for (const auto& [letter, rule] : entry_.rules) {
            used.set(index_of(letter));
            look(rule);
        }
        for (const char letter : std::string_view("sabeijklnopqrtuvwxyzh0123456789_")) {
            if (!used.test(index_of(letter))) return symbol({letter, 0.0, false});
        }
        fail("all letters are in use, but the axiom needs one more");
    }

    std::string head(bool begins_late, bool is_cut_off) {
        std::string comments;
        const auto comment = [&](const std::string& text) { comments += "// " + pattern_line(text) + '\n'; };
        comment(fmt::format("Fractint's order is the derivation length{}: -n {} is order 3.",
                            begins_late ? " less one" : "", begins_late ? 4 : 3));
        if (effects_.is_sized()) comment("The parameter is the length of steps, which @ multiplies.");
        if (effects_.has_two_headings()) {
            comment("The parameter d is the heading of D and M, in degrees to the left of that of F and G.");
        }
        std::string twins;
        for (const SymbolKey& key : wanted_) {
            if (key.flipped) twins += (twins.empty() ? "" : " ") + symbol(key);
        }
        if (!twins.empty()) comment("With left and right exchanged by an exclamation mark: " + twins);
        for (const SymbolKey& key : wanted_) {
            if (is_plain(key.letter) && !takes_number(key.letter)) continue;
            comment(fmt::format(
                "{} is Fractint's {}", symbol(key),
                takes_number(key.letter) ? fmt::format("{}{}", key.letter, key.number) : std::string(1, key.letter)));
        }
        if (!dropped_.empty()) {
            std::string list;
            for (const char letter : dropped_) list += fmt::format(" {}", letter);
            comment("Left out, as they do nothing:" + list);
        }
        if (effects_.has('<') || effects_.has('>')) {
            losses_.add(entry_.first_of("<>"), "cycles of colours that skip colour 0");
        }
        if (is_cut_off) {
            comment(fmt::format("What @ and ! do depends on the steps left to go; there are tables for {} of them.",
                                effects_.levels()));
        }
        std::string source = fmt::format("{}, line {}", import_base_name(file_->name()), losses_.line(entry_.at));
        if (!entry_.comments.empty()) source += ": " + entry_.comments;
        std::string text = import_head(entry_.name, source, "Imported from a Fractint collection.", losses_.list());
        text += '\n' + comments;
        text += fmt::format("\nderivation length: {}\nangle factor: {}\nturn: left\nheading: 0\n",
                            begins_late ? 3 : 2, entry_.angle);
        std::string forward, move;
        for (const auto& [letter, name] : step_letters_) {
            (letter == 'f' || letter == 'd' ? forward : move) += ' ' + name;
        }
        // The default of `move:` is f, which is the twin of F here.
        if (!forward.empty()) text += "forward:" + forward + '\n';
        if (!move.empty()) text += "move:" + move + '\n';
        if (!names_.empty()) {
            text += "symbols:";
            for (const std::string& name : names_) text += ' ' + name;
            text += '\n';
        }
        if (has_colours()) text += fmt::format("palette: {}\nground: black\n", palette);
        return text;
    }

    std::string interpretation() {
        std::string lines;
        if (has_turn_around_ && entry_.angle % 2 == 1) {
            // Half a turn clockwise, rounded down to whole steps; ! does not exchange it.
            lines += "| --> " + repeated('-', entry_.angle / 2) + '\n';
        }
        for (const auto& [letter, name] : step_letters_) {
            if (!effects_.leads_to_second(letter)) continue;
            const std::string step = name + (effects_.is_sized() ? "(s)" : "");
            const bool is_second = letter == 'd' || letter == 'm';
            lines += fmt::format("{}{} --> {}\n", name, formals(letter), is_second ? "+(d)" + step + "-(d)" : step);
        }
        for (const SymbolKey& key : wanted_) {
            if (!takes_number(key.letter)) continue;
            const std::string command = colour_command(key.letter, key.number);
            lines += symbol(key) + " --> " + (command.empty() ? "*" : command) + '\n';
        }
        return lines.empty() ? "" : "\ninterpret:\n" + lines;
    }

    const Entry& entry_;
    const Effects& effects_;
    const SourcePointer& file_;
    Diagnostics& diagnostics_;
    ImportLosses& losses_;
    std::size_t& room_;
    std::set<SymbolKey> wanted_;
    std::vector<SymbolKey> pending_;
    std::set<std::string> names_;
    bool names_used_ = false;
    std::set<std::pair<char, std::string>> step_letters_;
    std::set<char> dropped_;
    bool has_turn_around_ = false;
    std::size_t written_ = 0;
};

}  // namespace

std::string write_pattern(const Entry& entry, const Effects& effects, const SourcePointer& file,
                          Diagnostics& diagnostics, ImportLosses& losses, std::size_t& room) {
    return PatternWriter(entry, effects, file, diagnostics, losses, room).write();
}

}  // namespace sikku::fractint
