// What Fractint does with a system: it walks down the rules depth first and obeys each command as it meets it. Its
// state is place, two headings (one of + - | for F and G, one of \ / for D and M), step length, whether ! has
// exchanged left and right, and colour; brackets keep it all. A pattern's turtle has no step length to multiply and
// exchanges nothing. So lengths go into parameters, symbols that ! exchanges get twins, and both must be known where
// a symbol is written: each symbol's effect on them, for every number of steps that it has left to go, is composed
// beforehand.
#include "engine/import/import.h"

#include "engine/base/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <bitset>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <map>
#include <set>
#include <utility>

namespace sikku {
namespace {

constexpr std::size_t most_entries = 10'000;
constexpr std::size_t most_word_bytes = std::size_t{1} << 20;  // of all words of an entry
constexpr std::size_t most_pattern = std::size_t{4} << 20;     // bytes that one entry may become
constexpr std::size_t most_written = std::size_t{32} << 20;    // for all of them, some twice; 4 times the file more
constexpr std::size_t most_factors = 32;                       // different numbers after @
constexpr std::size_t most_levels = 20;                        // that differ
constexpr double most_digits = 300;                            // of a length, before or after the point
constexpr std::int64_t largest_exponent = std::int64_t{1} << 40;  // of a factor that is nearly 1
constexpr int palette_size = 16;
constexpr int first_colour = 15;
constexpr const char* palette =
    "#000000 #0000aa #00aa00 #00aaaa #aa0000 #aa00aa #aa5500 #aaaaaa #555555 #5555ff #55ff55 #55ffff #ff5555 #ff55ff "
    "#ffff55 #ffffff";

/// A command or symbol; `[` and `]` too.
struct Token {
    char letter = 0;
    std::int8_t root = 0;    ///< of @: exponent of the factor in halves
    std::uint16_t base = 0;  ///< of @: which factor
    std::uint32_t at = 0;
    double number = 0.0;  ///< of \ / c < >
};
using Tokens = std::vector<Token>;

bool is_step(char letter) {
    return letter == 'f' || letter == 'g' || letter == 'd' || letter == 'm';
}
bool is_letter(char letter) {
    return letter >= 'a' && letter <= 'z';
}
bool is_plain(char letter) {
    return is_letter(letter) || (letter >= '0' && letter <= '9') || letter == '_';
}
bool takes_number(char letter) {
    return letter == '@' || letter == '\\' || letter == '/' || letter == 'c' || letter == '<' || letter == '>';
}
std::size_t index_of(char letter) {
    return static_cast<unsigned char>(letter);
}

/// The first `wanted` in [begin, end), or `end`.
std::size_t find_before(const std::string& text, char wanted, std::size_t begin, std::size_t end) {
    const std::size_t found = std::string_view(text).substr(0, end).find(wanted, begin);
    return std::min(found, end);
}

/// What going through a symbol leaves behind: the step length multiplied by powers of the factors, in halves, and
/// left and right exchanged.
struct Effect {
    std::vector<std::int64_t> halves;
    bool flips = false;
    bool operator==(const Effect&) const = default;
};

/// The entry has a mistake, which was told.
struct BadEntry {};

class Entry {
public:
    /// @param room  bytes that may still be written; what is written is taken from it
    Entry(const SourcePointer& file, Diagnostics& diagnostics, ImportLosses& losses, std::string name, std::size_t at,
          std::size_t& room)
        : file_(file), diagnostics_(diagnostics), losses_(losses), name_(std::move(name)), at_(at), room_(room) {}

    /// Reads what stands between the braces and writes the pattern. @throws BadEntry
    std::string pattern(std::size_t begin, std::size_t end) {
        read(begin, end);
        find_reached();
        find_followed();
        compose_effects();
        return write();
    }

private:
    static constexpr std::size_t letters = 256;
    using Flags = std::bitset<letters>;

    [[noreturn]] void fail(std::size_t at, const std::string& message) {
        diagnostics_.error({file_, at, 1}, message);
        throw BadEntry();
    }

    // --- reading -------------------------------------------------------------------------------------------

    void read(std::size_t begin, std::size_t end) {
        const std::string& text = file_->text();
        bool has_axiom = false;
        while (begin < end) {
            const std::size_t next = find_before(text, '\n', begin, end);
            const std::size_t stop = find_before(text, ';', begin, next);
            if (stop < next) note_comment(std::string_view(text).substr(stop, next - stop));
            if (read_line(begin, stop)) has_axiom = true;
            begin = next + 1;
        }
        if (!has_axiom || axiom_.empty()) fail(at_, fmt::format("the entry '{}' has no axiom", name_));
        if (angle_ == 0) fail(at_, fmt::format("the entry '{}' has no angle", name_));
    }

    void note_comment(std::string_view comment) {
        while (!comment.empty() && (comment.front() == ';' || comment.front() == ' ')) comment.remove_prefix(1);
        if (comments_.size() > 300 || comment.empty()) return;
        comments_ += (comments_.empty() ? "" : " ") + import_text(comment, 200);
    }

    /// True if it is the axiom.
    bool read_line(std::size_t begin, std::size_t end) {
        const std::string& text = file_->text();
        const auto is_blank = [&](std::size_t i) { return text[i] == ' ' || text[i] == '\t' || text[i] == '\r'; };
        const auto skip = [&](std::size_t i) {
            while (i < end && is_blank(i)) ++i;
            return i;
        };
        const auto word_end = [&](std::size_t i) {
            while (i < end && !is_blank(i)) ++i;
            return i;
        };
        begin = skip(begin);
        if (begin >= end) return false;
        std::size_t at = begin;
        while (at < end && !is_blank(at) && text[at] != '=') ++at;
        const std::string key = lower_case(std::string_view(text).substr(begin, at - begin));
        at = skip(at);
        if (at < end && text[at] == '=') at = skip(at + 1);
        const std::size_t stop = word_end(at);
        if (skip(stop) < end) fail(skip(stop), "text after the word: a word holds no blanks");
        if (key == "axiom") {
            axiom_ = tokens(at, stop);
            return true;
        }
        if (key == "angle") {
            const auto [last, error] = std::from_chars(text.data() + at, text.data() + stop, angle_);
            if (error != std::errc() || last != text.data() + stop || angle_ < 3 || angle_ > 50) {
                fail(std::min(at, end - 1), "expected a whole number from 3 to 50: the turn is 360/n degrees");
            }
            return false;
        }
        if (key.size() != 1) fail(begin, "expected 'Angle n', 'Axiom word' or a rule 'c=word'");
        // Older Fractints take rules for colours.
        if (std::string_view("+-/\\@|!][").find(key) != std::string_view::npos) {
            fail(begin, fmt::format("a rule for the command '{}' is not allowed", key));
        }
        if (index_of(key[0]) >= 0x80 || index_of(key[0]) < 0x20) {
            fail(begin, "a rule is for one character of ASCII");
        }
        Tokens body = tokens(at, stop);
        // Rules for the same character follow one another.
        Tokens& rule = rules_[key[0]];
        rule.insert(rule.end(), body.begin(), body.end());
        return false;
    }

    Tokens tokens(std::size_t begin, std::size_t end) {
        const std::string& text = file_->text();
        word_bytes_ += end - begin;
        if (word_bytes_ > most_word_bytes) fail(begin, "the words of an entry are at most 1 MB");
        Tokens result;
        std::vector<std::size_t> open;
        for (std::size_t at = begin; at < end;) {
            Token token;
            token.at = static_cast<std::uint32_t>(at);
            token.letter = lower_case(std::string_view(text).substr(at, 1))[0];
            if (index_of(token.letter) >= 0x80 || index_of(token.letter) < 0x20) {
                fail(at, "words are made of ASCII characters");
            }
            ++at;
            if (takes_number(token.letter)) read_number_of(token, at, end);
            if (token.letter == '[') {
                open.push_back(token.at);
            } else if (token.letter == ']' && open.empty()) {
                diagnostics_.warning({file_, token.at, 1}, "']' without '[': Fractint reads this word no further");
                return result;
            } else if (token.letter == ']') {
                open.pop_back();
            }
            result.push_back(token);
        }
        if (!open.empty()) fail(open.back(), "this '[' is not closed in its line");
        return result;
    }

    /// `Q` and `I`, in any order, then digits and points, the decimal number.
    void read_number_of(Token& token, std::size_t& at, std::size_t end) {
        const std::string& text = file_->text();
        bool root = false;
        bool inverse = false;
        for (int i = 0; i < 2 && at < end; ++i) {
            const char byte = lower_case(std::string_view(text).substr(at, 1))[0];
            if (byte != 'q' && byte != 'i') break;
            (byte == 'q' ? root : inverse) = true;
            ++at;
        }
        const std::size_t begin = at;
        while (at < end && ((text[at] >= '0' && text[at] <= '9') || text[at] == '.')) ++at;
        double number = 0;
        if (at > begin) {
            const auto [last, error] = std::from_chars(text.data() + begin, text.data() + at, number);
            if (error != std::errc() || last != text.data() + at) fail(begin, "this is no decimal number");
        }
        if (token.letter == '@') {
            if (!(number > 0)) fail(token.at, "expected a number above 0 after '@': the step would have no length");
            const auto known = std::find(factors_.begin(), factors_.end(), number);
            token.base = static_cast<std::uint16_t>(known - factors_.begin());
            if (known == factors_.end()) factors_.push_back(number);
            if (factors_.size() > most_factors) fail(token.at, "more than 32 different numbers after '@'");
            token.root = static_cast<std::int8_t>(number == 1 ? 0 : (root ? 1 : 2) * (inverse ? -1 : 1));
            return;
        }
        if (number > 0 && root) number = std::sqrt(number);
        if (number > 0 && inverse) number = 1 / number;
        if (!(number < 1e9)) fail(token.at, "expected a number below 1000000000 here");
        const bool is_angle = token.letter == '\\' || token.letter == '/';
        token.number = is_angle ? number : std::floor(number);
    }

    // --- what leads to what --------------------------------------------------------------------------------

    const Tokens* rule_of(char letter) const {
        const auto found = rules_.find(letter);
        return found == rules_.end() ? nullptr : &found->second;
    }

    void find_reached() {
        // What each letter with a rule leads to, itself included: as the commands of all of them.
        std::map<char, Flags> leads;
        for (const auto& [letter, rule] : rules_) {
            leads[letter].set(index_of(letter));
            for (const Token& token : rule) leads[letter].set(index_of(token.letter));
        }
        for (const auto& [middle, its] : std::map(leads)) {
            for (auto& [letter, flags] : leads) {
                if (flags.test(index_of(middle))) flags |= leads[middle];
            }
        }
        for (const Token& token : axiom_) {
            reached_.set(index_of(token.letter));
            if (rule_of(token.letter)) reached_ |= leads[token.letter];
        }
        has_own_steps_ = has('f') || has('g');
        has_other_steps_ = has('d') || has('m');
        if (has_own_steps_ && has_other_steps_) {
            losses_.add(
                first_of("dm"),
                "F and G go one way and D and M another, each with turns of its own; the turtle has one heading");
        }
        leads_to_steps_ = flags_of("fgdm");
        leads_to_turns_ = flags_of(turns());
        for (const auto& [letter, flags] : leads) {
            leads_to_steps_[index_of(letter)] = (flags & flags_of("fgdm")).any();
            leads_to_turns_[index_of(letter)] = (flags & flags_of(turns())).any();
        }
    }

    bool has(char letter) const { return reached_.test(index_of(letter)); }
    static Flags flags_of(std::string_view list) {
        Flags flags;
        for (const char letter : list) flags.set(index_of(letter));
        return flags;
    }
    /// The commands whose sides ! exchanges, of the headings that steps of the system take.
    std::string_view turns() const {
        return has_own_steps_ && has_other_steps_ ? "+-/\\" : has_other_steps_ ? "/\\" : "+-";
    }
    bool turns_count(char letter) const { return turns().find(letter) != std::string_view::npos; }

    std::size_t first_of(std::string_view list) const {
        std::size_t first = at_;
        bool found = false;
        const auto look = [&](const Tokens& word) {
            for (const Token& token : word) {
                if (list.find(token.letter) == std::string_view::npos || (found && token.at >= first)) continue;
                first = token.at;
                found = true;
            }
        };
        look(axiom_);
        for (const auto& [letter, rule] : rules_) look(rule);
        return first;
    }

    /// Which letters are followed, up to the end of their branch, by what their effect bears upon.
    void find_followed() {
        followed_steps_ = followed(leads_to_steps_);
        followed_turns_ = followed(leads_to_turns_);
        is_sized_ = followed_steps_.test(index_of('@')) && has('@');
    }

    Flags followed(const Flags& sensitive) const {
        Flags result;
        const auto look = [&](const Tokens& word, bool after) {
            std::vector<std::pair<bool, bool>> outer;  // what follows the branch; is anything in it sensitive
            bool in_branch = false;
            for (auto token = word.rbegin(); token != word.rend(); ++token) {
                if (token->letter == ']') {
                    outer.emplace_back(after, in_branch);
                    after = in_branch = false;
                } else if (token->letter == '[') {
                    const bool inside = in_branch;
                    after = outer.back().first || inside;
                    in_branch = outer.back().second || inside;
                    outer.pop_back();
                } else {
                    if (after) result.set(index_of(token->letter));
                    if (sensitive.test(index_of(token->letter))) after = in_branch = true;
                }
            }
        };
        look(axiom_, false);
        for (std::size_t before = letters + 1; before != result.count();) {
            before = result.count();
            for (const auto& [letter, rule] : rules_) {
                if (has(letter)) look(rule, result.test(index_of(letter)));
            }
        }
        return result;
    }

    // --- effects -------------------------------------------------------------------------------------------

    /// effects_[k]: of each letter with a rule and k steps to go, as far as they bear upon what follows. If they
    /// settle, the last of them are those of more steps, too.
    void compose_effects() {
        std::map<char, Effect> none;
        for (const auto& [letter, rule] : rules_) {
            none[letter].halves.assign(factors_.size(), 0);
        }
        effects_.push_back(std::move(none));
        while (true) {
            std::map<char, Effect> next;
            bool is_small = true;
            for (const auto& [letter, rule] : rules_) {
                Effect& effect = next[letter];
                effect.halves.assign(factors_.size(), 0);
                std::size_t depth = 0;
                for (const Token& token : rule) {
                    if (token.letter == '[') ++depth;
                    if (token.letter == ']') --depth;
                    if (depth == 0) apply(token, effects_.back(), effect);
                }
                if (!followed_turns_.test(index_of(letter))) effect.flips = false;
                if (!is_sized_ || !followed_steps_.test(index_of(letter))) {
                    effect.halves.assign(factors_.size(), 0);
                }
                double digits = 0;
                for (std::size_t i = 0; i < factors_.size(); ++i) {
                    const double share = 0.5 * static_cast<double>(effect.halves[i]) * std::log10(factors_[i]);
                    digits += share;
                    const bool is_much = std::abs(effect.halves[i]) > largest_exponent;
                    if (is_much || !(std::fabs(share) < most_digits)) is_small = false;
                }
                if (!(std::fabs(digits) < most_digits)) is_small = false;
            }
            is_settled_ = next == effects_.back();
            if (is_settled_ || effects_.size() >= most_levels || !is_small) return;
            effects_.push_back(std::move(next));
        }
    }

    /// Goes through one token, its rule having the effects `below`.
    void apply(const Token& token, const std::map<char, Effect>& below, Effect& effect) const {
        if (token.letter == '@') effect.halves[token.base] += token.root;
        if (token.letter == '!') effect.flips = !effect.flips;
        const auto found = below.find(token.letter);
        if (found == below.end()) return;
        effect.flips = effect.flips != found->second.flips;
        for (std::size_t i = 0; i < effect.halves.size(); ++i) effect.halves[i] += found->second.halves[i];
    }

    // --- writing -------------------------------------------------------------------------------------------

    /// A symbol of the pattern: a letter, or one with a number, as it is or with left and right exchanged.
    struct Key {
        char letter = 0;
        double number = 0.0;
        bool flipped = false;
        auto operator<=>(const Key&) const = default;
    };

    Key key_of(const Token& token, bool flipped) const {
        const bool numbered = takes_number(token.letter);
        return {token.letter, numbered ? token.number : 0.0,
                flipped && rule_of(token.letter) && leads_to_turns_.test(index_of(token.letter))};
    }

    /// How a symbol with a rule, or without a meaning of its own, is called.
    std::string symbol(const Key& key) {
        if (is_plain(key.letter) && !(takes_number(key.letter) && rule_of(key.letter))) {
            if (is_letter(key.letter)) {
                return std::string(1, key.flipped ? key.letter : static_cast<char>(key.letter - 'a' + 'A'));
            }
            if (!key.flipped) return std::string(1, key.letter);
        }
        // C10, or a character that words of patterns cannot hold.
        std::string name = fmt::format("{}{:x}", key.flipped ? 'q' : 'p', index_of(key.letter));
        if (takes_number(key.letter)) {
            const char first = key.letter == 'c' ? 'C' : key.letter == '<' ? 'U' : 'V';
            name = fmt::format("{}{}", key.flipped ? lower_case(std::string(1, first)) : std::string(1, first),
                               static_cast<std::int64_t>(key.number));
        }
        names_.insert(name);
        return name;
    }

    static std::string repeated(char letter, std::int64_t times) {
        return std::string(static_cast<std::size_t>(times), letter);
    }

    /// What the turtle does on a command without a rule; `c10` sets a colour.
    static std::string colour_command(char letter, double number) {
        const auto n = static_cast<std::int64_t>(number);
        if (letter == 'c') return fmt::format(";({})", n);
        return repeated(letter == '<' ? ';' : ',', n % palette_size);
    }

    /// Base of the length, and powers of the factors: `s*sqrt(3)/2`.
    std::string length(std::string_view base, const std::vector<std::int64_t>& halves) const {
        std::string over;
        std::string under;
        for (std::size_t i = 0; i < halves.size(); ++i) {
            const std::int64_t power = std::abs(halves[i]);
            if (power == 0) continue;
            std::string term = fmt::format("{}", factors_[i]);
            if (power == 1) {
                term = fmt::format("sqrt({})", term);
            } else if (power > 2) {
                term += power % 2 == 0 ? fmt::format("^{}", power / 2) : fmt::format("^{}.5", power / 2);
            }
            (halves[i] > 0 ? over : under) += (halves[i] > 0 ? "*" : "/") + term;
        }
        if (base == "1" && !over.empty()) return over.substr(1) + under;
        return std::string(base) + over + under;
    }

    void grow(std::string& text, std::string_view more) {
        if (!names_used_ || text.empty() || more.empty()) {
            text += more;
        } else {
            text += ' ';
            text += more;
        }
        const std::size_t bytes = more.size() + 1;
        if (bytes > room_) fail(at_, "the patterns of this collection are longer than 16 MB and twice the file");
        room_ -= bytes;
        written_ += bytes;
        check_size(written_);
    }

    bool inert(char letter) const {
        return !rule_of(letter) && !is_step(letter) && !turns_count(letter) && letter != '[' && letter != ']' &&
               letter != '@' && letter != '!' && letter != 'c' && letter != '<' && letter != '>' &&
               !(letter == '|' && (has_own_steps_ || !has_other_steps_));
    }

    /// The word as the turtle is to get it, its symbols having `level` steps to go.
    std::string word(const Tokens& tokens, std::string_view base, bool flipped, std::size_t level) {
        const std::map<char, Effect>& below = effects_[level];
        Effect state;
        state.halves.assign(factors_.size(), 0);
        state.flips = flipped;
        std::vector<Effect> stack;
        std::string text;
        for (const Token& token : tokens) {
            const char letter = token.letter;
            const bool has_rule = rule_of(letter) != nullptr;
            const bool steps = leads_to_steps_.test(index_of(letter));
            if (has_rule || is_step(letter)) {
                const Key key = key_of(token, state.flips);
                if (has_rule && wanted_.insert(key).second) pending_.push_back(key);
                std::string name = symbol(key);
                if (is_sized_ && steps) name += '(' + length(base, state.halves) + ')';
                if (is_step(letter)) step_letters_.insert({letter, name.substr(0, name.find('('))});
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
                if (token.number != 0) {
                    grow(text, fmt::format("{}({})", (letter == '\\') != state.flips ? '+' : '-', token.number));
                }
            } else if (letter == '|') {
                has_turn_around_ = true;
                grow(text, "|");
            } else if (letter == 'c' || letter == '<' || letter == '>') {
                grow(text, colour_command(letter, token.number));
            }
            apply(token, below, state);
        }
        return text.empty() ? "*" : text;
    }

    struct Line {
        std::string left;
        std::vector<std::string> right;  ///< by the steps that the successor has to go, 0 first
    };

    std::string write() {
        // Names are known once all words were written; then blanks go between symbols.
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
        std::string text = head(begins_late, has_tables && !is_settled_);
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
            std::size_t level = effects_.size();
            if (is_settled_) {
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

    void check_size(std::size_t bytes) {
        if (bytes > most_pattern) fail(at_, "this system makes a pattern longer than 4 MB");
    }

    static bool all_same(const std::vector<std::string>& list) {
        return std::all_of(list.begin(), list.end(), [&](const std::string& one) { return one == list.front(); });
    }

    /// The axiom, then a line for each symbol that is reached and has a rule.
    std::vector<Line> write_lines() {
        const std::size_t levels = effects_.size();
        std::vector<Line> lines;
        Line first;
        const bool has_colours = has('c') || has('<') || has('>');
        for (std::size_t level = 0; level < levels; ++level) {
            std::string axiom = word(axiom_, "1", false, level);
            if (has_colours) axiom = fmt::format(";({}) {}", first_colour, axiom == "*" ? "" : axiom);
            first.right.push_back(std::move(axiom));
        }
        lines.push_back(std::move(first));
        while (!pending_.empty()) {
            const Key key = pending_.back();
            pending_.pop_back();
            Line line;
            const bool sized = is_sized_ && leads_to_steps_.test(index_of(key.letter));
            line.left = symbol(key) + (sized ? "(s)" : "");
            for (std::size_t level = 0; level < levels; ++level) {
                line.right.push_back(word(*rule_of(key.letter), "s", key.flipped, level));
            }
            lines.push_back(std::move(line));
        }
        std::sort(lines.begin() + 1, lines.end(), [](const Line& a, const Line& b) { return a.left < b.left; });
        return lines;
    }

    /// A letter that nothing else is called by.
    std::string begin_symbol() {
        Flags used;
        const auto look = [&](const Tokens& word) {
            for (const Token& token : word) used.set(index_of(token.letter));
        };
        look(axiom_);
        for (const auto& [letter, rule] : rules_) {
            used.set(index_of(letter));
            look(rule);
        }
        for (const char letter : std::string_view("sabeijklnopqrtuvwxyzh0123456789_")) {
            if (!used.test(index_of(letter))) return symbol({letter, 0.0, false});
        }
        fail(at_, "all letters are in use, and one more is needed to begin with");
    }

    std::string head(bool begins_late, bool is_cut_off) {
        std::string comments;
        const auto comment = [&](const std::string& text) { comments += "// " + import_text(text) + '\n'; };
        comment(fmt::format("Fractint's order is the derivation length{}: -n {} is order 3.",
                            begins_late ? " less one" : "", begins_late ? 4 : 3));
        if (is_sized_) comment("The parameter is the length of steps, which @ multiplies.");
        std::string twins;
        for (const Key& key : wanted_) {
            if (key.flipped) twins += (twins.empty() ? "" : " ") + symbol(key);
        }
        if (!twins.empty()) comment("With left and right exchanged by an exclamation mark: " + twins);
        for (const Key& key : wanted_) {
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
        if (has('<') || has('>')) {
            losses_.add(first_of("<>"), "that stepping through the colours passes over colour 0");
        }
        if (is_cut_off) {
            comment(fmt::format("What @ and ! do depends on the steps left to go; there are tables for {} of them.",
                                effects_.size()));
        }
        std::string source = fmt::format("{}, line {}", import_base_name(file_->name()), losses_.line(at_));
        if (!comments_.empty()) source += ": " + comments_;
        std::string text = import_head(name_, source, "Imported from a Fractint collection.", losses_.list());
        text += '\n' + comments;
        text += fmt::format("\nderivation length: {}\nangle factor: {}\nturn: left\nheading: 0\n",
                            begins_late ? 3 : 2, angle_);
        std::string forward;
        std::string move;
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
        if (has('c') || has('<') || has('>')) text += fmt::format("palette: {}\nground: black\n", palette);
        return text;
    }

    std::string interpretation() {
        std::string lines;
        if (has_turn_around_ && angle_ % 2 == 1) {
            // As far as whole turns go, clockwise, whatever ! says.
            lines += "| --> " + repeated('-', angle_ / 2) + '\n';
        }
        for (const Key& key : wanted_) {
            if (!takes_number(key.letter)) continue;
            const std::string command = colour_command(key.letter, key.number);
            lines += symbol(key) + " --> " + (command.empty() ? "*" : command) + '\n';
        }
        return lines.empty() ? "" : "\ninterpret:\n" + lines;
    }

    const SourcePointer& file_;
    Diagnostics& diagnostics_;
    ImportLosses& losses_;
    std::string name_;
    std::size_t at_;
    std::string comments_;
    int angle_ = 0;
    Tokens axiom_;
    std::map<char, Tokens> rules_;
    std::vector<double> factors_;
    std::size_t word_bytes_ = 0;
    Flags reached_;
    Flags leads_to_steps_;
    Flags leads_to_turns_;
    Flags followed_steps_;
    Flags followed_turns_;
    bool has_own_steps_ = false;
    bool has_other_steps_ = false;
    bool is_sized_ = false;
    std::vector<std::map<char, Effect>> effects_;
    bool is_settled_ = false;
    std::set<Key> wanted_;
    std::vector<Key> pending_;
    std::set<std::string> names_;
    bool names_used_ = false;
    std::set<std::pair<char, std::string>> step_letters_;
    std::set<char> dropped_;
    bool has_turn_around_ = false;
    std::size_t& room_;
    std::size_t written_ = 0;
};

}  // namespace

std::vector<ImportedSystem> import_fractint(const SourcePointer& file, Diagnostics& diagnostics) {
    std::vector<ImportedSystem> systems;
    const std::string& text = file->text();
    if (text.size() > most_import_bytes) {
        diagnostics.unreadable({file, 0, 0}, "a file to import is at most 64 MB");
        return systems;
    }
    if (const std::size_t nul = text.find('\0'); nul != std::string::npos) {
        diagnostics.unreadable({file, nul, 1}, "a NUL byte: this is no collection of L-systems");
        return systems;
    }
    ImportLosses losses(file, diagnostics);
    std::size_t room = most_written + 4 * text.size();
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t line_end = find_before(text, '\n', at, text.size());
        const std::size_t brace = find_before(text, '{', at, line_end);
        if (brace == line_end || find_before(text, ';', at, brace) < brace) {
            at = line_end + 1;
            continue;
        }
        std::size_t begin = at;
        while (begin < brace && (text[begin] == ' ' || text[begin] == '\t')) ++begin;
        std::string name = text.substr(begin, brace - begin);
        name.resize(std::min(name.find_first_of(" \t(["), name.size()));
        std::size_t end = brace + 1;  // of the entry: a brace that is not in a comment
        while (end < text.size() && text[end] != '}') {
            end = text[end] == ';' ? find_before(text, '\n', end, text.size()) : end + 1;
        }
        at = std::min(end + 1, text.size());
        if (name.empty() || lower_case(name) == "comment") continue;
        if (systems.size() >= most_entries) {
            diagnostics.unreadable({file, begin, 1}, "there are more than 10,000 entries");
            return {};
        }
        ImportedSystem system;
        system.name = printable(name, 80);
        system.line = losses.line(begin);
        if (end >= text.size()) {
            diagnostics.error({file, brace, 1}, fmt::format("the entry '{}' has no end: expected '}}'", system.name));
        } else {
            try {
                system.pattern = Entry(file, diagnostics, losses, system.name, begin, room).pattern(brace + 1, end);
                if (!import_compiles(system.name, system.pattern, {file, begin, 1}, diagnostics)) {
                    system.pattern.clear();
                }
            } catch (const BadEntry&) {
            }
        }
        system.losses = losses.take();
        systems.push_back(std::move(system));
    }
    if (systems.empty() && !diagnostics.has_errors()) {
        diagnostics.error({file, 0, 0}, "there is no entry 'NAME {' in this file");
    }
    return systems;
}

}  // namespace sikku
