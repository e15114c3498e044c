#include "engine/language/foreign_line.h"

#include "engine/base/characters.h"
#include "engine/base/diagnostic.h"
#include "engine/base/keys.h"
#include "engine/base/text.h"
#include "engine/language/angle.h"
#include "engine/language/grammar.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <unordered_map>
#include <utility>

namespace sikku {
namespace {

constexpr std::size_t most_advised_bytes = 4096;  // bytes of a line; longer ones are not examined
constexpr int most_levels = 8;                    // of brackets and lists within lists
constexpr std::size_t nothing = std::string_view::npos;

struct OtherNames {
    std::string_view key;
    std::string_view names;  ///< separated by commas
};
/// Names of keys in other programs, in the literature and in everyday English.
constexpr std::array<OtherNames, 11> other_names = {
    {{"angle increment",
      "angle,angles,ang,turn angle,turning angle,rotation angle,default angle,delta,theta,degrees,\u03B4,\u03B8"},
     {"derivation length",
      "n,steps,iteration,iterations,iters,iter,order,generation,generations,recursion,recursions,recursion depth,"
      "depth,level,levels"},
     {"axiom",
      "start,start word,starting word,start string,initial,initial word,initial string,initiator,premise,omega,"
      "\u03C9,\u03A9"},
     {"heading", "start angle,initial angle,starting angle"},
     {"stroke", "colour,color,line width,width"},
     {"ground", "background"},
     {"tempo", "bpm"},
     {"tonic", "key"},
     {"title", "name"},
     {"source", "author"},
     {"description", "comment"}}};
/// Lists that patterns do not need, and headings.
constexpr std::array<std::string_view, 18> needless_names = {
    "variables", "variable",    "vars",      "constants",   "constant", "consts",
    "alphabet",  "config",      "terminals", "lsystem",     "l-system", "step size",
    "stepsize",  "step length", "step",      "line length", "distance", "length"};
constexpr std::array<std::string_view, 4> length_factors = {"length factor", "length scale", "line length scale",
                                                            "step factor"};
/// Names of predecessors, where a program writes `{a: "F", b: "FF"}`.
constexpr std::array<std::string_view, 9> predecessor_names = {"a",      "from", "symbol", "predecessor", "char",
                                                               "letter", "in",   "key",    "input"};
constexpr std::array<std::string_view, 8> rule_names = {
    "rules", "rule", "productions", "production", "production rules", "p", "rewrite", "rewriting rules"};

struct OtherSigns {
    const char* ascii;
    std::string_view signs;
};
constexpr std::array<OtherSigns, 12> other_signs = {
    {{"-", "\u2212\u2010\u2011\u2012\u2013\u2014\uFE63\uFF0D"},
     {"+", "\uFF0B\uFE62"},
     {"^", "\u2227\u02C6"},
     {"'", "\u2018\u2019\u2032"},
     {"|", "\u2223\uFF5C"},
     {"/", "\u2215\u2044"},
     {"\\", "\u2216"},
     {"-->", "\u2192\u27F6\u21D2\u27F9\u21A6"},
     {"[", "\uFF3B"},
     {"]", "\uFF3D"},
     {" ", "\u00A0\u2002\u2003\u2004\u2005\u2006\u2007\u2008\u2009\u200A\u202F\u205F\u3000"},
     {"", "\u200B\u200C\u2060\uFEFF\u00AD\u201C\u201D\u201E"}}};

/// Longer ones precede their prefixes.
constexpr std::array<std::string_view, 19> arrows = {
    "--&gt;", "-&gt;",  "=&gt;",   "&rarr;",  "|->",     "\u2192", "\u27F6", "\u21D2", "\u27F9", "\u21A6",
    "\u2794", "\u279C", "\u2013>", "\u2014>", "\u2212>", "->",     "=>",     "::=",    ":="};

bool is_word_byte(char byte) {
    return is_letter(byte) || static_cast<unsigned char>(byte) >= 0x80;
}

/// True for words with punctuation, without signs of a turtle.
bool is_prose(std::string_view text) {
    return !text.empty() && is_word_byte(text.front()) && std::all_of(text.begin(), text.end(), [](char byte) {
        return is_word_byte(byte) || is_digit(byte) || is_blank(byte) ||
               std::string_view(".,:!?'").find(byte) != nothing;
    });
}

std::string folded_name(std::string_view name) {
    std::string result;
    for (const char byte : lower_case(trimmed(name))) {
        const char plain = byte == '_' || byte == '\t' ? ' ' : byte;
        if (plain != ' ' || !result.ends_with(' ')) result += plain;
    }
    return result;
}

/// Replaces typographic characters by ASCII signs.
std::string plain(std::string_view text) {
    std::string result;
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t length = std::max<std::size_t>(utf8_length(text.substr(at)), 1);
        const std::string_view point = text.substr(at, length);
        const char* ascii = ascii_of(point);
        result += ascii ? std::string_view(ascii) : point;
        at += length;
    }
    return result;
}

/// The depth of brackets and quotes, byte by byte.
class Nesting {
public:
    /// True if the byte stands outside of all brackets and quotes. Unpaired quotation marks do not count.
    bool is_outside(std::string_view text, std::size_t at) {
        const char byte = text[at];
        if (quote_ != 0) {
            if (byte == quote_) quote_ = 0;
            return false;
        }
        if (byte == '"' && text.find('"', at + 1) != nothing) {
            quote_ = byte;
            return false;
        }
        if (byte == '(' || byte == '{' || byte == '[') {
            ++depth_;
            return false;
        }
        if ((byte == ')' || byte == '}' || byte == ']') && depth_ > 0) {
            --depth_;
            return false;
        }
        return depth_ == 0;
    }

private:
    char quote_ = 0;
    int depth_ = 0;
};

std::size_t find_top(std::string_view text, std::string_view bytes) {
    Nesting nesting;
    for (std::size_t at = 0; at < text.size(); ++at) {
        if (nesting.is_outside(text, at) && bytes.find(text[at]) != nothing) return at;
    }
    return nothing;
}

std::vector<std::string_view> split_top(std::string_view text, std::string_view separators) {
    std::vector<std::string_view> parts;
    Nesting nesting;
    std::size_t begin = 0;
    for (std::size_t at = 0; at < text.size(); ++at) {
        if (!nesting.is_outside(text, at) || separators.find(text[at]) == nothing) continue;
        parts.push_back(trimmed(text.substr(begin, at - begin)));
        begin = at + 1;
    }
    parts.push_back(trimmed(text.substr(begin)));
    return parts;
}

/// The text between a pair of brackets or quotes around all of it; nullopt if there is none.
std::optional<std::string_view> enclosed(std::string_view text) {
    if (text.size() < 2) return std::nullopt;
    const std::string_view inner = text.substr(1, text.size() - 2);
    const char first = text.front();
    if (first == '"' || first == '\'' || first == '`') {
        if (text.back() != first || inner.find(first) != nothing) return std::nullopt;
        return trimmed(inner);
    }
    const std::string_view pairs = "(){}[]";
    const std::size_t pair = pairs.find(first);
    if (pair == nothing || pair % 2 == 1 || text.back() != pairs[pair + 1]) return std::nullopt;
    int depth = 1;
    for (const char byte : inner) {
        if (byte == '(' || byte == '{' || byte == '[') ++depth;
        if (byte == ')' || byte == '}' || byte == ']') --depth;
        if (depth == 0) return std::nullopt;  // closed before the end
    }
    return trimmed(inner);
}

std::string_view without_quotes(std::string_view text) {
    if (!text.empty() && std::string_view("\"'`").find(text.front()) != nothing) {
        if (const auto inner = enclosed(text)) return *inner;
    }
    return text;
}

/// Strips list marks, declarations and separators at the end, as programs write them around a line.
std::string_view bare(std::string_view line) {
    line = trimmed(line);
    while (line.ends_with(',') || line.ends_with(';') || is_blank(line.empty() ? 'x' : line.back())) {
        line.remove_suffix(1);
    }
    line.remove_prefix(item_number_length(line));
    for (const std::string_view word :
         {"- ", "* ", "\u2022 ", "let ", "var ", "const ", "String ", "string ", "this.", "self."}) {
        if (line.starts_with(word)) line = trimmed(line.substr(word.size()));
    }
    return line;
}

/// Replaces HTML entities such as `&gt;`.
std::string without_entities(std::string_view line) {
    constexpr std::array<std::pair<std::string_view, char>, 4> entities = {
        {{"&gt;", '>'}, {"&lt;", '<'}, {"&minus;", '-'}, {"&amp;", '&'}}};
    std::string text(line);
    for (const auto& [entity, sign] : entities) {
        for (std::size_t at = text.find(entity); at != std::string::npos; at = text.find(entity, at)) {
            text.replace(at, entity.size(), 1, sign);
            ++at;
        }
    }
    return text;
}

/// True for one code point, possibly with parameters and contexts.
bool is_predecessor(std::string_view text) {
    text = trimmed(text);
    if (text.empty() || text.size() > 200) return false;
    for (std::size_t at = 0; at < text.size();) {
        if (is_blank(text[at]) || text[at] == '<' || text[at] == '>') return text.find_first_of("<>") != nothing;
        at += std::max<std::size_t>(utf8_length(text.substr(at)), 1);
        if (at < text.size() && text[at] == '(') at = std::min(text.find(')', at), text.size() - 1) + 1;
        if (at >= text.size()) return true;
        return text.find_first_of("<>", at) != nothing;
    }
    return false;
}

/// A word without quotes, in ASCII; `*` if it is empty.
std::string word(std::string_view text) {
    const std::string result(trimmed(without_quotes(trimmed(plain(text)))));
    return result.empty() ? "*" : result;
}

/// A value of a key: degrees without their sign.
std::string value_for(std::string_view key, std::string_view text) {
    std::string value = word(text);
    if (key != "angle increment" && key != "heading") return value;
    for (const std::string_view unit : {"\u00B0", "\u00BA", "degrees", "degree", "deg"}) {
        if (value.size() > unit.size() && value.ends_with(unit)) value.resize(value.size() - unit.size());
    }
    for (const std::string_view call : {"radians(", "math.radians(", "degrees("}) {
        if (value.starts_with(call) && value.ends_with(')')) {
            value = value.substr(call.size(), value.size() - call.size() - 1);
        }
    }
    return std::string(trimmed(value));
}

bool is_number(std::string_view text) {
    double value = 0;
    return read_number(trimmed(text), value);
}

/// The first error of a line in a pattern that consists of little else; empty if it is accepted. Names in conditions
/// and parameters that the rest of the pattern has to define are defined.
std::string error_of(const std::string& line) {
    constexpr std::string_view undefined = "' is not defined";
    constexpr int most_names = 8;
    const bool is_axiom = line.starts_with("axiom:");
    const std::size_t arrow = line.find("-->");
    const bool is_word = is_axiom || arrow != nothing;
    std::string_view weight;
    if (arrow != nothing) {
        weight = std::string_view(line).substr(arrow);
        weight.remove_prefix(std::min(find_top(weight, ":"), weight.size()));
    }
    std::string text = is_axiom ? line + '\n' : "axiom: F\n" + line + '\n';
    for (int names = 0;; ++names) {
        Diagnostics diagnostics;
        const Pattern pattern = parse_pattern("", text, diagnostics);
        // Only productions and axioms are compiled, because interpreters check the values of other keys.
        if (is_word && !diagnostics.has_errors()) compile_grammar(pattern, diagnostics);
        const auto& list = diagnostics.list();
        const auto error = std::find_if(list.begin(), list.end(), [](const Diagnostic& one) { return !one.warning; });
        if (error == list.end()) return {};
        const std::string& message = error->message;
        if (names == most_names || !message.starts_with('\'') || !message.ends_with(undefined)) return message;
        const std::string name = message.substr(1, message.size() - 1 - undefined.size());
        if (weight.find(name) != nothing) return message;  // more likely not a weight at all
        text += fmt::format("define {} = 1\n", name);
    }
}

template <class List>
bool contains(const List& list, std::string_view name) {
    return std::find(list.begin(), list.end(), name) != list.end();
}

class Adviser {
public:
    explicit Adviser(bool has_axiom) : has_axiom_(has_axiom) {}

    LineAdvice read(std::string_view line) {
        if (line.size() > most_advised_bytes) return {};
        text_ = without_entities(line);
        if (line_is_read(text_, 0)) return accepted();
        advice_ = {};
        if (!quoted_pairs_are_read(text_)) advice_ = {};
        return accepted();
    }

private:
    /// Returns the advice without lines that a pattern would not accept, or their error if the line was certainly
    /// meant as a production.
    LineAdvice accepted() {
        std::string problem;
        const std::size_t before = advice_.lines.size();
        std::erase_if(advice_.lines, [&](const std::string& line) {
            const std::string error = error_of(line);
            if (!error.empty() && problem.empty()) problem = error;
            if (!error.empty() && line == "axiom: " + advice_.axiom) advice_.axiom = "*";
            return !error.empty();
        });
        const bool is_certain = !foreign_arrow(text_).empty() || !advice_.lines.empty() || has_symbol_;
        if (advice_.lines.size() < before && is_certain) advice_.problem = problem;
        if (!advice_.is_understood()) return {};
        return std::move(advice_);
    }

    bool line_is_read(std::string_view line, int level) {
        line = bare(line);
        if (line.empty() || level > most_levels) return false;
        if (const auto inner = enclosed(line); inner && line.front() != '"') return list_is_read(*inner, level + 1);
        if (const std::size_t sign = find_top(line, "=:,;");
            sign != nothing && (line[sign] == '=' || line[sign] == ':')) {
            if (is_needless(folded_name(without_quotes(trimmed(line.substr(0, sign)))))) return true;
        }
        if (const auto parts = split_top(line, ",;"); parts.size() > 1) return list_is_read(line, level + 1);
        if (const std::size_t arrow = line.find("-->"); arrow != nothing && foreign_arrow(line).empty()) {
            return production_is_read(line.substr(0, arrow), line.substr(arrow + 3));
        }
        if (const std::string_view arrow = foreign_arrow(line); !arrow.empty()) {
            const auto at = static_cast<std::size_t>(arrow.data() - line.data());
            return production_is_read(line.substr(0, at), line.substr(at + arrow.size()));
        }
        // rule0=G>GG
        const std::size_t symbol = std::max<std::size_t>(utf8_length(line), 1);
        if (level > 0 && line.size() > symbol + 1 && line[symbol] == '>' &&
            line.find_first_of("<>", symbol + 1) == nothing) {
            return production_is_read(line.substr(0, symbol), line.substr(symbol + 1));
        }
        if (const std::size_t sign = find_top(line, "=:"); sign != nothing) {
            return setting_is_read(trimmed(line.substr(0, sign)), trimmed(line.substr(sign + 1)), level);
        }
        return call_is_read(line);
    }

    /// rules.Add('F', "FF"), new Rule("F", "FF"), [["F", "FF"]]
    bool quoted_pairs_are_read(std::string_view line) {
        std::vector<std::string_view> quoted;
        for (std::size_t at = line.find_first_of("\"'"); at != nothing; at = line.find_first_of("\"'", at)) {
            const std::size_t end = line.find(line[at], at + 1);
            if (end == nothing) return false;
            quoted.push_back(line.substr(at + 1, end - at - 1));
            at = end + 1;
        }
        if (quoted.empty() || quoted.size() % 2 == 1) return false;
        for (std::size_t i = 0; i < quoted.size(); i += 2) {
            if (!is_predecessor(quoted[i]) || !production_is_read(quoted[i], quoted[i + 1])) return false;
        }
        return true;
    }

    bool list_is_read(std::string_view list, int level) {
        const auto parts = split_top(list, ",;");
        // ("F", "F+F") and rule('F', 'F+F')
        if (parts.size() == 2 && parts[0] != without_quotes(parts[0]) && parts[1] != without_quotes(parts[1])) {
            return is_predecessor(without_quotes(parts[0])) && production_is_read(parts[0], parts[1]);
        }
        if (parts.size() == 2 && named_pair_is_read(parts[0], parts[1])) return true;
        const auto is_empty = [](std::string_view part) { return part.empty(); };
        return !std::all_of(parts.begin(), parts.end(), is_empty) &&
               std::all_of(parts.begin(), parts.end(),
                           [&](std::string_view part) { return part.empty() || line_is_read(part, level); });
    }

    /// {a: "F", b: "FF"}
    bool named_pair_is_read(std::string_view first, std::string_view second) {
        const std::size_t first_colon = find_top(first, ":=");
        const std::size_t second_colon = find_top(second, ":=");
        if (first_colon == nothing || second_colon == nothing) return false;
        const std::string_view symbol = trimmed(first.substr(first_colon + 1));
        if (!contains(predecessor_names, folded_name(without_quotes(trimmed(first.substr(0, first_colon))))))
            return false;
        if (symbol == without_quotes(symbol) || !is_predecessor(without_quotes(symbol))) return false;
        return production_is_read(symbol, second.substr(second_colon + 1));
    }

    bool production_is_read(std::string_view left, std::string_view right) {
        left = trimmed(left);
        right = trimmed(right);
        if (const std::size_t colon = left.find(':'); colon != nothing) {
            const std::string_view name = left.substr(0, colon), rest = trimmed(left.substr(colon + 1));
            if (is_label(trimmed(name), rest) || contains(rule_names, folded_name(name))) left = rest;
        }
        left = without_quotes(left);
        left.remove_prefix(item_number_length(left));
        left = without_star(left);
        // A label before '=', as in `rule1 = F -> FF`.
        if (const std::size_t equals = find_top(left, "="); equals != nothing)
            left = trimmed(left.substr(equals + 1));
        while (left.starts_with('(')) left = trimmed(left.substr(1));
        if (right.ends_with(')') &&
            std::count(right.begin(), right.end(), ')') > std::count(right.begin(), right.end(), '(')) {
            right.remove_suffix(1);
        }
        if (left.empty()) return false;
        const std::string name = folded_name(left);
        if (left.size() != 1 && (name == "axiom" || key_of_other_name(name) == "axiom")) return axiom_is_read(right);
        has_symbol_ = has_symbol_ || utf8_length(left) == left.size();
        advice_.lines.push_back(fmt::format("{} --> {}", trimmed(plain(left)), word(right)));
        return true;
    }

    bool axiom_is_read(std::string_view value) {
        if (trimmed(value).empty()) return false;
        has_symbol_ = true;
        advice_.axiom = word(value);
        advice_.lines.push_back("axiom: " + advice_.axiom);
        return true;
    }

    bool is_needless(const std::string& name) {
        if (contains(length_factors, name)) {
            advice_.reason = "a step takes its length as a parameter: F(x) --> F(1.36*x)";
        } else if (!contains(needless_names, name)) {
            return false;
        }
        return advice_.is_needless = true;
    }

    bool setting_is_read(std::string_view left, std::string_view right, int level) {
        if (right.starts_with(':') || right.starts_with('=')) right = trimmed(right.substr(1));  // F :: F+F
        const std::string name = folded_name(without_quotes(left));
        if (name.empty()) return false;
        if (is_needless(name)) return true;
        // rules[0], rules["F"], rule1, p_1
        const std::size_t bracket = name.find('[');
        const std::string_view stem = std::string_view(name).substr(0, std::min(bracket, name.size()));
        if (bracket != nothing && name.ends_with(']') && contains(rule_names, stem)) {
            const std::string_view key = trimmed(left).substr(bracket + 1, left.size() - bracket - 2);
            if (key != without_quotes(key)) return production_is_read(key, right);
            return line_is_read(right, level + 1);
        }
        if (contains(rule_names, name) && name != "p") {
            if (right.empty() || right == "{" || right == "[" || right == "[]" || right == "{}") {
                return advice_.is_needless = true;
            }
            return line_is_read(right, level + 1);
        }
        if (name == "axiom") return axiom_is_read(right);
        // ruleF = "FF"
        if (name.size() == 5 && name.starts_with("rule") && is_letter(name[4]) && right != without_quotes(right)) {
            return production_is_read(left.substr(left.size() - 1), right);
        }
        const std::string_view other = key_of_other_name(name);
        const bool is_symbol = is_predecessor(without_quotes(left));
        if (other == "axiom") return axiom_is_read(right);
        if (name == "w" && !has_axiom_ && !is_number(right)) return axiom_is_read(right);
        if (is_symbol && !is_number(value_for("angle increment", right))) return production_is_read(left, right);
        const KeyInfo* known = find_language_key(name);
        const std::string_view key = known ? std::string_view(name) : other;
        if (!key.empty()) {
            const std::string value = value_for(key, right);
            if (right.empty() || ((key == "angle increment" || key == "heading") && !read_angle(value))) return false;
            if (key == "derivation length" && !std::all_of(value.begin(), value.end(), is_digit)) return false;
            advice_.lines.push_back(fmt::format("{}: {}", key, value));
            return true;
        }
        return is_label(left, right) && line_is_read(right, level + 1);
    }

    /// setAxiom("F"), setProduction('F', 'F+F')
    bool call_is_read(std::string_view line) {
        const std::size_t open = line.find('(');
        if (open == nothing || !line.ends_with(')') || open == 0) return false;
        const std::string name = lower_case(line.substr(0, open));
        const std::string_view inner = line.substr(open + 1, line.size() - open - 2);
        if (name.find("axiom") != nothing) return axiom_is_read(inner);
        if (name.find("rule") == nothing && name.find("production") == nothing) return false;
        const auto parts = split_top(inner, ",");
        if (parts.size() != 2 || !is_predecessor(without_quotes(parts[0]))) return false;
        return production_is_read(parts[0], parts[1]);
    }

    bool has_axiom_;
    bool has_symbol_ = false;  // alone, to the left of an arrow or sign, or the name of the axiom
    std::string text_;
    LineAdvice advice_;
};

}  // namespace

std::string_view without_star(std::string_view left) {
    left = trimmed(left);
    const std::size_t colon = left.rfind(':');
    return colon != nothing && trimmed(left.substr(colon + 1)) == "*" ? trimmed(left.substr(0, colon)) : left;
}

std::string LineAdvice::text() const {
    if (lines.empty() && !problem.empty()) return problem;
    if (lines.empty()) return fmt::format("leave this line out{}{}", reason.empty() ? "" : "; ", reason);
    const std::string other = problem.empty() ? "" : "; in another: " + problem;
    if (lines.size() == 1) return fmt::format("write '{}'{}", printable(lines.front(), 120), other);
    std::string list;
    constexpr std::size_t most_shown = 8;
    for (std::size_t i = 0; i < std::min(lines.size(), most_shown); ++i) {
        list += fmt::format("{}'{}'", i > 0 ? ", " : "", printable(lines[i], 80));
    }
    if (lines.size() > most_shown) list += " …";
    return "write each in its own line: " + list + other;
}

LineAdvice advice_for_line(std::string_view line, bool has_axiom) {
    // The parser and the compiler, which check the advice, would request advice themselves.
    thread_local bool is_trial = false;
    if (is_trial) return {};
    struct Trial {
        Trial() { is_trial = true; }
        ~Trial() { is_trial = false; }
        Trial(const Trial&) = delete;
        Trial& operator=(const Trial&) = delete;
    };
    const Trial trial;
    return Adviser(has_axiom).read(line);
}

std::string_view foreign_arrow(std::string_view line) {
    int depth = 0;
    for (std::size_t at = 0; at < line.size(); ++at) {
        if (line[at] == '(') ++depth;
        if (line[at] == ')' && depth > 0) --depth;
        if (depth > 0) continue;
        if (line.compare(at, 3, "-->") == 0) return {};
        for (const std::string_view arrow : arrows) {
            if (line.compare(at, arrow.size(), arrow) == 0) return line.substr(at, arrow.size());
        }
    }
    return {};
}

std::string_view key_of_other_name(std::string_view name) {
    static const auto keys = [] {
        std::unordered_map<std::string_view, std::string_view> by_name;
        for (const auto& [key, names] : other_names) {
            for (const std::string_view other : split_words(names, ",")) by_name.emplace(other, key);
        }
        return by_name;
    }();
    const auto found = keys.find(name);
    return found == keys.end() ? std::string_view() : found->second;
}

std::string_view nearest_key(std::string_view name) {
    if (const std::string_view key = key_of_other_name(name); !key.empty()) return key;
    std::vector<std::string_view> known = {"interpret", "table", "variant", "define", "patch"};
    for (const KeyInfo& key : language_keys()) known.push_back(key.name);
    if (const std::string_view near = nearest(name, known); !near.empty()) return near;
    std::vector<std::string_view> others;
    for (const auto& [key, names] : other_names) {
        for (const std::string_view other : split_words(names, ",")) {
            if (other.size() > 3) others.push_back(other);
        }
    }
    return key_of_other_name(nearest(name, others));
}

const char* ascii_of(std::string_view point) {
    for (const auto& [ascii, signs] : other_signs) {
        if (point.size() > 1 && signs.find(point) != nothing) return ascii;
    }
    return nullptr;
}

bool is_label(std::string_view name, std::string_view after_colon) {
    std::size_t letters = 0;
    while (letters < name.size() && (is_letter(name[letters]) || name[letters] == '_')) ++letters;
    if (letters == name.size()) return false;
    const std::string_view number = trimmed(name.substr(letters));
    if (number.empty() || !std::all_of(number.begin(), number.end(), is_digit)) return false;
    // A predecessor follows: with a condition of its own, or single symbols with contexts.
    after_colon = trimmed(after_colon);
    if (find_top(after_colon, ":") != nothing) return true;
    const bool has_number = std::any_of(after_colon.begin(), after_colon.end(), is_digit);
    return !after_colon.empty() && !has_number && is_predecessor(after_colon);
}

std::size_t remark_length(std::string_view text) {
    return text.starts_with("--") || text.starts_with("//") ? 2 : 1;
}

std::size_t find_late_remark(std::string_view line, const std::function<bool(std::string_view)>& is_name) {
    for (std::size_t at = 1; at + 2 < line.size(); ++at) {
        if (!is_blank(line[at - 1])) continue;
        const std::size_t length = remark_length(line.substr(at));
        if (length == 1 && std::string_view("#;%").find(line[at]) == nothing) continue;
        const std::size_t next = at + length;
        if (next >= line.size()) continue;
        const bool is_apart = is_blank(line[next]);
        // `//` between blanks has a warning of its own, which needs no word.
        if (is_apart ? line[at] == '/' : !is_prose(line.substr(next))) continue;
        // Symbols between blanks may follow, too; a word has a small letter that is not a move.
        for (std::size_t i = next; i < line.size();) {
            std::size_t end = i;
            bool is_word = false;
            while (end < line.size() && is_word_byte(line[end])) {
                if (line[end] >= 'a' && line[end] <= 'z' && line[end] != 'f') is_word = true;
                ++end;
            }
            const bool is_long = end - i > (is_apart ? 1U : 2U);
            const bool has_parameter = end < line.size() && line[end] == '(';
            if (is_word && is_long && !has_parameter && !is_name(line.substr(i, end - i))) return at;
            i = std::max(end, i + 1);
        }
        return nothing;  // marks after the first belong to its remark
    }
    return nothing;
}

std::optional<MisplacedWeight> misplaced_weight(std::string_view right) {
    const auto weight = [](std::string_view text) -> std::optional<std::string_view> {
        const bool is_percent = text.ends_with('%');
        if (is_percent) text.remove_suffix(1);
        const bool is_plain = text.find_first_not_of("0123456789.") == nothing;
        if (!is_plain || !is_number(text) || !(is_percent || text.find('.') != nothing)) return std::nullopt;
        return text;
    };
    const auto answer = [&](std::string_view number, std::string_view value, std::string_view word) {
        while (word.ends_with(',') || word.ends_with(';')) word = trimmed(word.substr(0, word.size() - 1));
        return MisplacedWeight{static_cast<std::size_t>(number.data() - right.data()), number.size(),
                               fmt::format("{} : {}", word, value)};
    };
    right = trimmed(right);
    const std::size_t colon = right.find(':');
    if (colon != nothing) {
        const std::string_view number = trimmed(right.substr(0, colon));
        const std::string_view word = trimmed(right.substr(colon + 1));
        const auto value = weight(number);
        if (value && !word.empty() && !is_number(word)) return answer(number, *value, word);
        return std::nullopt;
    }
    const std::size_t first = right.find_first_of(" \t");
    if (first == nothing) return std::nullopt;
    const std::string_view before = right.substr(0, first);
    if (const auto value = weight(before)) return answer(before, *value, trimmed(right.substr(first)));
    const std::size_t last = right.find_last_of(" \t");
    const std::string_view after = right.substr(last + 1);
    if (const auto value = weight(after)) return answer(after, *value, trimmed(right.substr(0, last)));
    return std::nullopt;
}

std::size_t item_number_length(std::string_view line) {
    const bool is_enclosed = line.starts_with('(');
    const std::size_t begin = is_enclosed ? 1 : 0;
    std::size_t at = begin;
    while (at < line.size() && is_digit(line[at])) ++at;
    if (at == begin || at - begin > 4 || at + 1 >= line.size()) return 0;
    if (line[at] != ')' && (is_enclosed || line[at] != '.')) return 0;
    if (!is_blank(line[++at])) return 0;
    while (at < line.size() && is_blank(line[at])) ++at;
    return at;
}

}  // namespace sikku
