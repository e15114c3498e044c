#include "engine/language/pattern.h"

#include "engine/base/characters.h"
#include "engine/base/keys.h"
#include "engine/base/text.h"
#include "engine/language/foreign_line.h"
#include "engine/language/foreign_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <set>
#include <unordered_map>

namespace sikku {
namespace {

constexpr const char* open_comment_message = "this comment has no end: expected '*/'";

constexpr std::size_t most_key_bytes = 100;    // of `symbols`, with blanks
constexpr std::size_t most_strange_lines = 3;  // for each line that may belong to a pattern

constexpr std::size_t most_advised = 1000;  // lines in another notation; then the text has errors enough

constexpr std::size_t most_nesting = std::size_t{1} << 20;
// Limits of a pattern file, checked while it is read, so that a small file cannot take much memory.
constexpr std::size_t most_keys = 1024;  // together with those that settings add
constexpr std::size_t most_defines = std::size_t{1} << 18;
constexpr std::size_t most_productions = std::size_t{1} << 20;  // of all tables together
constexpr std::size_t most_tables = std::size_t{1} << 16;
constexpr std::size_t most_pattern_patches = 4096;
constexpr std::size_t most_variants = std::size_t{1} << 16;
constexpr std::size_t most_settings = std::size_t{1} << 16;  // of all variants together

std::string folded(std::string_view name) {
    std::string result;
    for (std::string_view rest = name, word = take_word(rest); !word.empty(); word = take_word(rest)) {
        if (!result.empty()) result += ' ';
        result += lower_case(word);
    }
    return result;
}

/// The name of a key: folded, but for the symbol of a key such as `note SYMBOL`.
std::string folded_key(std::string_view name) {
    std::string result = folded(name);
    const KeyInfo* row = find_language_key(result);
    if (!row || !row->is_for_symbols()) return result;
    const std::string_view whole = trimmed(name);
    return std::string(row->before_symbol()) + std::string(trimmed(whole.substr(row->before_symbol().size() - 1)));
}

/// The first byte that is NUL or not valid UTF-8, or npos.
std::size_t first_bad_byte(std::string_view text) {
    for (std::size_t i = 0; i < text.size();) {
        const std::size_t length = text[i] == 0 ? 0 : utf8_length(text.substr(i));
        if (length == 0) return i;
        i += length;
    }
    return std::string_view::npos;
}

/// Finds `wanted` outside parentheses at or after `from`, or npos.
std::size_t find_outside(std::string_view text, std::string_view wanted, std::size_t from = 0) {
    int depth = 0;
    for (std::size_t i = from; i < text.size(); ++i) {
        if (text[i] == '(') ++depth;
        if (text[i] == ')' && depth > 0) --depth;
        if (depth == 0 && text.compare(i, wanted.size(), wanted) == 0) return i;
    }
    return std::string_view::npos;
}

std::size_t rfind_outside(std::string_view text, std::string_view wanted) {
    std::size_t last = std::string_view::npos;
    for (std::size_t at = find_outside(text, wanted); at != std::string_view::npos;
         at = find_outside(text, wanted, at + 1)) {
        last = at;
    }
    return last;
}

class Parser {
public:
    Parser(Pattern& pattern, Diagnostics& diagnostics)
        : pattern_(pattern), diagnostics_(diagnostics), before_(diagnostics), section_(&pattern.common) {}

    void run() {
        const std::string_view text = pattern_.source->cleaned();
        const ForeignKind kind = foreign_kind(pattern_.source->text());
        if (kind != ForeignKind::none) {
            const bool can_import = kind == ForeignKind::fractint || kind == ForeignKind::cpfg;
            return diagnostics_.unreadable({pattern_.source, 0, 0},
                                           fmt::format("this is {}, not a pattern{}", foreign_kind_name(kind),
                                                       can_import ? "; import it first" : ""));
        }
        for (std::size_t at = 0; at < text.size() && !diagnostics_.is_unreadable();) {
            std::size_t end = text.find('\n', at);
            if (end == std::string_view::npos) end = text.size();
            line(Span{pattern_.source, at, end - at}.trimmed());
            at = end + 1;
        }
        if (!diagnostics_.is_unreadable()) finish();
    }

private:
    /// Reports the lines that are neither in the pattern language nor in another notation; in one message if the
    /// text contains nothing else.
    void finish() {
        find_axiom();
        std::size_t strange = unknown_.size() + repeated_;  // lines
        std::size_t known = productions_ + pattern_.tables.size() + pattern_.defines.size() +
                            pattern_.patches.size() + (advised_ > 0 ? 1 : 0);
        for (const Key& key : pattern_.keys) {
            const bool is_key = find_language_key(key.name) || !nearest_key(key.name).empty();
            ++(is_key ? known : strange);
        }
        const bool has_axiom = pattern_.find("axiom") || !axiom_.empty();
        if (strange > most_strange_lines * std::max<std::size_t>(known, 1) || (known == 0 && strange > 1) ||
            (!has_axiom && strange > known + advised_)) {
            diagnostics_ = before_;  // advice on single lines of prose is of no use
            return diagnostics_.unreadable(
                unknown_.empty() ? pattern_.keys.front().name_at : unknown_.front(),
                "this text is not a pattern: expected lines such as 'axiom: F' and 'F --> F+F'");
        }
        for (const Span& whole : unknown_) {
            // Brackets and headings of a program around lines that were reported.
            const std::string_view text = whole.view();
            const bool is_heading = text.ends_with('{') || (text.front() == '[' && text.back() == ']');
            if (advised_ > 0 && (is_heading || text.find_first_not_of("{}[]();, \t") == std::string_view::npos))
                continue;
            diagnostics_.error(whole, whole.view().starts_with('#')
                                          ? "a comment begins with '//'"
                                          : "expected 'key: value', 'define NAME = VALUE', 'table NAME:' or a "
                                            "production with '-->'");
        }
    }

    /// Without an axiom, `start: X` is meant to state it. If another notation states it, that was reported, and a
    /// missing axiom is not an additional error.
    void find_axiom() {
        if (pattern_.find("axiom")) return;
        for (Key& key : pattern_.keys) {
            double bars = 0;
            if (key.name != "start" || key.value.empty() || read_number(key.value.view(), bars)) continue;
            const LineAdvice advice = advice_for_line(fmt::format("axiom = {}", key.value.view()), true);
            diagnostics_.error(key.name_at, fmt::format("'start:' delays a part of a score; {}", advice.text()));
            key.name = "axiom";
            return;
        }
        if (axiom_.empty()) return;
        const auto source = std::make_shared<const Source>("axiom", axiom_, true);
        pattern_.overrides.push_back(source);
        pattern_.keys.push_back({"axiom", {source, 0, 0}, {source, 0, axiom_.size()}});
    }

    /// Reports a line in another notation. False if it is not understood.
    bool advise(const Span& whole, std::size_t colon) {
        const std::string_view text = whole.view();
        if (advised_ > most_advised) {
            ++advised_;
            diagnostics_.error(whole, "expected 'key: value' or a production with '-->'");
            return true;
        }
        const LineAdvice advice = advice_for_line(text, pattern_.find("axiom") || !axiom_.empty());
        if (!advice.is_understood()) return false;
        ++advised_;
        if (!advice.axiom.empty() && axiom_.empty()) axiom_ = advice.axiom;
        const std::string_view arrow = foreign_arrow(text);
        Span where = whole;
        std::string what = "expected 'key: value' or a production with '-->'";
        if (!arrow.empty()) {
            where = whole.part(static_cast<std::size_t>(arrow.data() - text.data()), arrow.size());
            what = fmt::format("'{}' is not the arrow of a production", arrow);
        } else if (colon != std::string_view::npos &&
                   (advice.is_needless || text.find("-->") == std::string_view::npos)) {
            what = fmt::format("unknown key '{}'{}", whole.part(0, colon).trimmed().view(),
                               advice.is_needless ? ": patterns do without it" : "");
        }
        diagnostics_.error(where, fmt::format("{}; {}", what, advice.text()));
        return true;
    }

    void line(const Span& whole) {
        if (whole.empty()) return;
        const std::string_view text = whole.view();
        const std::size_t colon = text.find(':');
        const std::string key = colon == std::string_view::npos ? "" : folded_key(text.substr(0, colon));
        if (key == "title" || key == "source" || key == "description") return add_key(whole, key, colon);
        if (!nesting_is_sane(whole)) return;
        warn_of_late_comment(whole);
        if (const std::size_t arrow = find_outside(text, "-->"); arrow != std::string_view::npos) {
            return production(whole, arrow);
        }
        if (starts_with_word(text, "define") || starts_with_word(text, "#define")) return define(whole);
        if (colon == std::string_view::npos && is_row(text)) return patch_row(whole);
        is_in_patch_ = false;
        if (text.starts_with('#')) return unknown_.push_back(whole);
        const bool is_known = key == "interpret" || find_language_key(key) || starts_with_word(key, "table") ||
                              starts_with_word(key, "patch") || starts_with_word(key, "variant");
        if (!is_known && advise(whole, colon)) return;
        if (colon == std::string_view::npos) {
            unknown_.push_back(whole);
            return;
        }
        if (key == "interpret") return interpret(whole, colon);
        if (starts_with_word(key, "table")) return table(whole, colon);
        if (starts_with_word(key, "patch")) return patch(whole, colon);
        if (starts_with_word(key, "variant")) return variant(whole, colon);
        if (key.empty()) return diagnostics_.error(whole, "expected the name of a key before ':'");
        add_key(whole, key, colon);
    }

    static bool starts_with_word(std::string_view text, std::string_view word) {
        if (text.size() <= word.size()) return text == word;
        return folded(text.substr(0, word.size())) == word && is_blank(text[word.size()]);
    }

    /// True if there is room for one more entry; otherwise the rest of the file is not read.
    bool has_room(const Span& where, std::size_t count, std::size_t most, std::string_view what) {
        if (count < most) return true;
        diagnostics_.unreadable(where, fmt::format("too many {}: a pattern has at most {}", what, most));
        return false;
    }

    bool nesting_is_sane(const Span& whole) {
        std::size_t depth = 0;
        const std::string_view text = whole.view();
        for (std::size_t i = 0; i < text.size(); ++i) {
            if (text[i] == '(' && ++depth > most_nesting) {
                diagnostics_.unreadable(whole.part(i), "parentheses nest deeper than 1,048,576");
                return false;
            }
            if (text[i] == ')' && depth > 0) --depth;
        }
        return true;
    }

    /// Warns of ` // ` before letters in a word, which is two rolls but may be meant as a comment.
    void warn_of_late_comment(const Span& whole) {
        const std::string_view text = whole.view();
        for (std::size_t i = text.find(" // "); i != std::string_view::npos; i = text.find(" // ", i + 1)) {
            const std::size_t next = text.find_first_not_of(" \t", i + 4);
            if (next == std::string_view::npos) continue;
            if (!is_letter(text[next])) continue;
            return diagnostics_.warning(whole.part(i + 1),
                                        "'//' is a comment only at the beginning of a line; here it means two rolls");
        }
    }

    /// Warns of ` # ` before a word in a word, which is a symbol but may be meant as a comment, and of the comment
    /// marks of other languages.
    void warn_of_remark(const Span& whole) {
        const std::size_t at =
            find_late_remark(whole.view(), [this](std::string_view word) { return is_of_symbols(word); });
        if (at == std::string_view::npos) return;
        const std::string_view mark = whole.view().substr(at, remark_length(whole.view().substr(at)));
        diagnostics_.warning(whole.part(at),
                             fmt::format("'{}' does not begin a comment: the rest of this line is read as symbols; "
                                         "comments stand in lines of their own, after '//'",
                                         mark));
    }

    /// Warns of quotation marks around a word, which are symbols.
    void warn_of_quotes(const Span& word) {
        std::string_view text = word.view();
        if (text.ends_with("\",") || text.ends_with("\";")) text.remove_suffix(1);
        if (text.size() < 3 || (text.front() != '"' && text.front() != '\'') || text.back() != text.front()) return;
        if (text.find(text.front(), 1) != text.size() - 1) return;
        diagnostics_.warning(word, fmt::format("a word has no quotation marks: here {} is a symbol", text.front()));
    }

    /// Reports `p1 : F --> FF` and `A ---> B`, which would be productions of other predecessors.
    bool is_misread(const Span& whole, const Span& left_side, std::size_t arrow) {
        const auto report = [&](const Span& where, const std::string& message) {
            diagnostics_.error(where, message);
            return true;
        };
        const auto advice = [&] { return advice_for_line(whole.view(), true).text(); };
        const std::string_view left = left_side.view();
        const std::size_t colon = left.find(':');
        if (colon != std::string_view::npos) {
            const std::string_view name = trimmed(left.substr(0, colon));
            const std::string_view rest = trimmed(left.substr(colon + 1));
            if (is_label(name, rest) && !define_names_.contains(rest) && !listed_symbols().contains(name)) {
                return report(
                    left_side.part(0, name.size()),
                    fmt::format("'{}:' is not a predecessor: productions have no names; {}", name, advice()));
            }
        }
        if (const std::size_t number = item_number_length(left); number > 0 && number < left.size()) {
            return report(left_side.part(0, number).trimmed(),
                          fmt::format("'{}' is not a predecessor: productions have no numbers; {}",
                                      trimmed(left.substr(0, number)), advice()));
        }
        if (without_star(left).size() < trimmed(left).size()) {
            return report(
                left_side.part(left.rfind('*'), 1),
                fmt::format("'*' is not a condition: without one, a production always applies; {}", advice()));
        }
        // A weight beside the word: `F --> 0.33 FF`.
        const Span right_side = whole.part(arrow + 3).trimmed();
        if (const auto weight = misplaced_weight(right_side.view())) {
            const Span number = right_side.part(weight->at, weight->length);
            if (number.view().find_first_of(predecessors()) == std::string_view::npos) {
                return report(number, fmt::format("a weight follows the successor; write '{}'",
                                                  printable(fmt::format("{} --> {}", left, weight->right), 120)));
            }
        }
        // A weight in front of the arrow: `F 0.33 --> FF`.
        const std::size_t blank = left.find_last_of(" \t");
        double weight = 0;
        if (blank != std::string_view::npos && colon == std::string_view::npos &&
            left.find('.', blank) != std::string_view::npos && read_number(left.substr(blank + 1), weight)) {
            const std::string_view rest = whole.view().substr(arrow);
            return report(left_side.part(blank + 1),
                          fmt::format("a weight follows the successor; write '{}'",
                                      printable(fmt::format("{} {} : {}", trimmed(left.substr(0, blank)), rest,
                                                            left.substr(blank + 1)),
                                                120)));
        }
        const bool is_long = left.size() > 2 && arrow > 0 && whole.view()[arrow - 1] == '-';
        if (is_long && is_blank(left[left.size() - 2])) {
            return report(left_side.part(left.size() - 1), "'--->' is not the arrow of a production; expected '-->'");
        }
        return false;
    }

    /// True for the name of a symbol, and for words all of whose letters are symbols with productions.
    bool is_of_symbols(std::string_view word) {
        return listed_symbols().contains(word) || word.find_first_not_of(predecessors()) == std::string_view::npos;
    }

    /// The letters and digits to the left of arrows, wherever these stand, and up to parameters and conditions.
    const std::string& predecessors() {
        if (predecessors_) return *predecessors_;
        predecessors_.emplace();
        for (std::string_view text = pattern_.source->cleaned(); !text.empty();) {
            const std::string_view line = take_line(text);
            const std::size_t arrow = line.find("-->");
            if (arrow == std::string_view::npos) continue;
            const std::string_view left = line.substr(0, arrow);
            int depth = 0;
            for (const char byte : left.substr(0, find_outside(left, ":"))) {
                if (byte == '(') ++depth;
                if (byte == ')') --depth;
                const bool is_known = predecessors_->find(byte) != std::string::npos;
                if (depth == 0 && is_letter_or_digit(byte) && !is_known) *predecessors_ += byte;
            }
        }
        return *predecessors_;
    }

    /// The names that the key `symbols:` lists, wherever it stands.
    const std::set<std::string, std::less<>>& listed_symbols() {
        if (listed_symbols_) return *listed_symbols_;
        listed_symbols_.emplace();
        for (std::string_view text = pattern_.source->cleaned(); !text.empty();) {
            const std::string_view line = trimmed(take_line(text));
            const std::size_t colon = line.find(':');
            if (colon > most_key_bytes || folded(line.substr(0, colon)) != "symbols") continue;
            for (const std::string_view name : split_words(line.substr(colon + 1))) listed_symbols_->emplace(name);
            break;
        }
        return *listed_symbols_;
    }

    void add_key(const Span& whole, const std::string& name, std::size_t colon) {
        const Key key{name, whole.part(0, colon).trimmed(), whole.part(colon + 1).trimmed()};
        if (!has_room(key.name_at, pattern_.keys.size(), most_keys, "keys")) return;
        if (name == "axiom") {
            warn_of_remark(whole);
            warn_of_quotes(key.value);
        }
        if (!key_names_.insert(name).second) {
            // One that is unknown was reported already.
            if (!find_language_key(name)) {
                ++repeated_;
                return;
            }
            return diagnostics_.error(key.name_at, fmt::format("'{}:' is given twice", name));
        }
        pattern_.keys.push_back(key);
    }

    void define(const Span& whole) {
        const bool hashed = whole.view().starts_with('#');
        const Span rest = whole.part(hashed ? 7 : 6).trimmed();
        const std::string_view text = rest.view();
        std::size_t end = 0;
        while (end < text.size() && !is_blank(text[end]) && text[end] != '=') ++end;
        const Span name = rest.part(0, end);
        Span value = rest.part(end).trimmed();
        if (!value.view().starts_with('=')) {
            if (!hashed) return diagnostics_.error(value.empty() ? rest : value, "expected '=' after the name");
        } else {
            value = value.part(1).trimmed();
        }
        if (name.empty()) return diagnostics_.error(whole, "expected a name after 'define'");
        if (value.empty()) {
            return diagnostics_.error(name, fmt::format("'{}' is defined without a value", name.view()));
        }
        if (!has_room(name, pattern_.defines.size(), most_defines, "defines")) return;
        if (!define_names_.insert(std::string(name.view())).second) {
            return diagnostics_.error(name, fmt::format("'{}' is defined twice", name.view()));
        }
        pattern_.defines.push_back({name, value});
    }

    void table(const Span& whole, std::size_t colon) {
        const Span name = whole.part(5, colon - 5).trimmed();
        if (name.empty()) return diagnostics_.error(whole, "expected the table's name: 'table NAME:'");
        if (!has_room(name, pattern_.tables.size(), most_tables, "tables")) return;
        const Span rest = whole.part(colon + 1).trimmed();
        if (!rest.empty()) diagnostics_.error(rest, "a table's productions stand on the lines after its name");
        if (!table_names_.insert(std::string(name.view())).second) {
            diagnostics_.error(name, fmt::format("the table '{}' is defined twice", name.view()));
        }
        section_ = &pattern_.tables.emplace_back(TableText{name, {}}).productions;
    }

    void interpret(const Span& whole, std::size_t colon) {
        if (interpret_seen_) return diagnostics_.error(whole, "'interpret:' is given twice");
        interpret_seen_ = true;
        section_ = &pattern_.interpret;
        const Span rest = whole.part(colon + 1).trimmed();
        if (!rest.empty()) diagnostics_.error(rest, "the productions of 'interpret:' stand on the lines after it");
    }

    /// True for a row of a patch; rows directly follow its name.
    bool is_row(std::string_view text) const {
        if (!is_in_patch_) return false;
        const std::string begin = lower_case(text.substr(0, 3));
        return std::string_view("+-.0123456789").find(text.front()) != std::string_view::npos || begin == "nan" ||
               begin == "inf";
    }

    void patch(const Span& whole, std::size_t colon) {
        const Span name = whole.part(5, colon - 5).trimmed();
        if (name.empty()) return diagnostics_.error(whole, "expected the surface's name: 'patch NAME:'");
        if (!has_room(name, pattern_.patches.size(), most_pattern_patches, "patches")) return;
        const Span rest = whole.part(colon + 1).trimmed();
        if (!rest.empty()) diagnostics_.error(rest, "the points of a patch stand on the lines after its name");
        pattern_.patches.push_back({name, {}});
        is_in_patch_ = true;
    }

    void patch_row(const Span& whole) {
        std::vector<Span>& rows = pattern_.patches.back().rows;
        if (rows.size() == 16) return diagnostics_.error(whole, "a patch has at most 16 lines of points");
        rows.push_back(whole);
    }

    void variant(const Span& whole, std::size_t colon) {
        const Span name = whole.part(7, colon - 7).trimmed();
        if (name.empty()) return diagnostics_.error(whole, "expected the variant's name: 'variant NAME:'");
        if (!has_room(name, pattern_.variants.size(), most_variants, "variants")) return;
        if (!variant_names_.insert(std::string(name.view())).second) {
            return diagnostics_.error(name, fmt::format("the variant '{}' is defined twice", name.view()));
        }
        Variant result{name, {}};
        const Span list = whole.part(colon + 1).trimmed();
        if (list.empty()) return diagnostics_.error(name, "expected 'key = value' after the variant's name");
        for (const Span& item : split_settings(list)) {
            const std::size_t equals = item.view().find('=');
            if (equals == std::string_view::npos || item.part(0, equals).trimmed().empty()) {
                diagnostics_.error(item.empty() ? name : item, "expected 'key = value'");
                continue;
            }
            const Span key = item.part(0, equals).trimmed();
            if (!has_room(key, settings_++, most_settings, "settings of variants")) return;
            result.settings.push_back({std::string(key.view()), key, item.part(equals + 1).trimmed()});
        }
        pattern_.variants.push_back(std::move(result));
    }

    /// Splits a list at commas outside parentheses that `name =` follows: a comma may also be a symbol of a word.
    static std::vector<Span> split_settings(const Span& list) {
        std::vector<Span> items;
        const std::string_view text = list.view();
        std::size_t begin = 0;
        for (std::size_t comma = find_outside(text, ","); comma != std::string_view::npos;
             comma = find_outside(text, ",", comma + 1)) {
            if (items.size() > most_settings) return items;
            const std::size_t next = text.find_first_of(",=", comma + 1);
            if (next != std::string_view::npos && text[next] == ',') continue;
            items.push_back(list.part(begin, comma - begin).trimmed());
            begin = comma + 1;
        }
        items.push_back(list.part(begin).trimmed());
        return items;
    }

    void production(const Span& whole, std::size_t arrow) {
        const Span left_side = whole.part(0, arrow).trimmed();
        const Span right_side = whole.part(arrow + 3).trimmed();
        const std::string_view left = left_side.view();
        warn_of_remark(whole);
        warn_of_quotes(right_side);
        if (is_misread(whole, left_side, arrow)) return;
        ProductionText result;
        result.whole = whole;
        if (const std::size_t second = find_outside(right_side.view(), "-->"); second != std::string_view::npos) {
            return diagnostics_.error(right_side.part(second),
                                      "a second '-->' in this line; expected one production per line");
        }
        std::size_t end = left.size();
        if (const std::size_t colon = find_outside(left, ":"); colon != std::string_view::npos) {
            result.condition = left_side.part(colon + 1).trimmed();
            end = colon;
        }
        std::size_t begin = 0;
        const std::string_view before_condition = left.substr(0, end);
        if (const std::size_t less = find_outside(before_condition, "<"); less != std::string_view::npos) {
            result.left = left_side.part(0, less).trimmed();
            begin = less + 1;
        }
        if (const std::size_t greater = find_outside(before_condition, ">", begin);
            greater != std::string_view::npos) {
            result.right = left_side.part(greater + 1, end - greater - 1).trimmed();
            end = greater;
        }
        result.predecessor = left_side.part(begin, end - begin).trimmed();
        result.successor = right_side;
        if (const std::size_t colon = rfind_outside(right_side.view(), ":"); colon != std::string_view::npos) {
            result.weight = right_side.part(colon + 1).trimmed();
            result.successor = right_side.part(0, colon).trimmed();
        }
        if (result.predecessor.empty()) return diagnostics_.error(whole, "expected a predecessor before '-->'");
        if (!has_room(whole, productions_++, most_productions, "productions")) return;
        section_->push_back(result);
    }

    Pattern& pattern_;
    Diagnostics& diagnostics_;
    const Diagnostics before_;              // diagnostics before this text
    std::vector<ProductionText>* section_;  // that the next production belongs to
    bool interpret_seen_ = false;
    bool is_in_patch_ = false;
    std::size_t productions_ = 0;
    std::size_t settings_ = 0;
    std::vector<Span> unknown_;  // lines that are not understood
    std::size_t repeated_ = 0;   // keys that are unknown and were stated before
    std::size_t advised_ = 0;    // lines in another notation
    std::string axiom_;          // as another notation states it
    std::optional<std::set<std::string, std::less<>>> listed_symbols_;
    std::optional<std::string> predecessors_;
    std::set<std::string, std::less<>> key_names_;
    std::set<std::string, std::less<>> define_names_;
    std::set<std::string, std::less<>> table_names_;
    std::set<std::string, std::less<>> variant_names_;
};

/// Overrides values of a pattern.
class Overrides {
public:
    Overrides(Pattern& pattern, Diagnostics& diagnostics) : pattern_(pattern), diagnostics_(diagnostics) {
        for (std::size_t i = 0; i < pattern.defines.size(); ++i) defines_.emplace(pattern.defines[i].name.view(), i);
    }

    void set(std::string_view name, const Span& name_at, const Span& value) {
        if (const auto define = defines_.find(name); define != defines_.end()) {
            pattern_.defines[define->second].value = value;
            return;
        }
        const std::string key = folded_key(name);
        // If two keys exclude each other, the one set later wins.
        constexpr std::array<std::pair<std::string_view, std::string_view>, 2> exclusive = {
            std::pair{"angle factor", "angle increment"}, std::pair{"ignore", "consider"}};
        for (const auto& [one, other] : exclusive) {
            if (key != one && key != other) continue;
            std::erase_if(pattern_.keys, [excluded = key == one ? other : one](const Key& present) {
                return present.name == excluded;
            });
        }
        for (Key& present : pattern_.keys) {
            if (present.name == key) {
                present.name_at = name_at;
                present.value = value;
                return;
            }
        }
        if (pattern_.keys.size() >= most_keys) {
            if (!diagnostics_.is_unreadable()) {
                diagnostics_.unreadable(name_at, fmt::format("too many keys: a pattern has at most {}", most_keys));
            }
            return;
        }
        pattern_.keys.push_back({key, name_at, value});
    }

private:
    Pattern& pattern_;
    Diagnostics& diagnostics_;
    std::unordered_map<std::string_view, std::size_t> defines_;
};

void check_scope(const Key& key, const KeyInfo& known, bool is_map, Diagnostics& diagnostics) {
    if (is_map && known.scope == KeyScope::words) {
        diagnostics.error(key.name_at, fmt::format("'{}:' does not apply to a map, which has no turtle", key.name));
    } else if (!is_map && known.scope == KeyScope::maps) {
        diagnostics.error(
            key.name_at,
            fmt::format("'{}:' applies only to maps: expected the key 'map: clockwise' beside it", key.name));
    }
}

}  // namespace

const Key* Pattern::find(std::string_view name) const {
    const auto found = std::find_if(keys.begin(), keys.end(), [&](const Key& key) { return key.name == name; });
    return found == keys.end() ? nullptr : &*found;
}

std::string Pattern::text(std::string_view name) const {
    const Key* key = find(name);
    return key ? std::string(key->value.view()) : std::string();
}

SourcePointer read_source(std::string name, std::string text, Diagnostics& diagnostics) {
    if (text.size() > most_pattern_bytes) {
        text.resize(most_pattern_bytes);
        while (!text.empty() && is_continuation(text.back())) text.pop_back();
        auto source = std::make_shared<const Source>(std::move(name), std::move(text));
        diagnostics.unreadable({source, source->text().size(), 0}, "a pattern file is at most 64 MB");
        return source;
    }
    const std::size_t bad = first_bad_byte(text);
    auto source = std::make_shared<const Source>(std::move(name), std::move(text));
    if (bad != std::string::npos) {
        diagnostics.unreadable({source, bad, 1}, source->text()[bad] == 0
                                                     ? "a NUL byte; a pattern file is UTF-8 text"
                                                     : "invalid UTF-8; a pattern file is UTF-8 text");
    } else if (source->open_comment() != std::string::npos) {
        diagnostics.unreadable({source, source->open_comment(), 2}, open_comment_message);
    }
    return source;
}

Pattern parse_pattern(std::string name, std::string text, Diagnostics& diagnostics) {
    Pattern pattern;
    pattern.source = read_source(std::move(name), std::move(text), diagnostics);
    if (!diagnostics.is_unreadable()) Parser(pattern, diagnostics).run();
    return pattern;
}

void apply_overrides(Pattern& pattern, std::string_view variant, const std::vector<Setting>& settings,
                     Diagnostics& diagnostics) {
    if (variant.empty() && settings.empty()) return;
    Overrides overrides(pattern, diagnostics);
    if (!variant.empty()) {
        const auto chosen = std::find_if(pattern.variants.begin(), pattern.variants.end(),
                                         [&](const Variant& other) { return other.name.view() == variant; });
        if (chosen == pattern.variants.end()) {
            std::vector<std::string_view> known;
            for (const Variant& other : pattern.variants) known.push_back(other.name.view());
            const auto source = std::make_shared<const Source>(
                "variant " + std::string(variant), std::string(variant), true, "variant", std::string(variant));
            pattern.overrides.push_back(source);
            diagnostics.error({source, 0, variant.size()},
                              known.empty()
                                  ? "this pattern has no variants"
                                  : fmt::format("unknown variant; the pattern has {}", fmt::join(known, ", ")));
        } else {
            for (const Key& setting : chosen->settings) overrides.set(setting.name, setting.name_at, setting.value);
        }
    }
    for (const Setting& setting : settings) {
        const bool is_value = !setting.is_assignment;
        const bool is_shown = is_value && !setting.value.empty();
        const auto source = std::make_shared<const Source>(
            is_shown ? setting.origin + " " + setting.value : setting.origin, setting.key + "=" + setting.value,
            is_value, setting.origin, setting.value);
        pattern.overrides.push_back(source);
        const Span whole{source, 0, source->text().size()};
        if (first_bad_byte(source->text()) != std::string_view::npos ||
            source->text().find('\n') != std::string::npos) {
            diagnostics.error(whole, "expected one line of valid UTF-8");
            continue;
        }
        if (source->open_comment() != std::string::npos) {
            diagnostics.error(whole.part(source->open_comment()), open_comment_message);
            continue;
        }
        const Span name = whole.part(0, setting.key.size()).trimmed();
        if (name.empty()) {
            diagnostics.error(whole, "expected key=value");
            continue;
        }
        overrides.set(name.view(), name, whole.part(setting.key.size() + 1).trimmed());
    }
}

void check_keys(const Pattern& pattern, Diagnostics& diagnostics) {
    const bool is_map = pattern.find("map") != nullptr;
    for (const Key& key : pattern.keys) {
        if (const KeyInfo* known_key = find_language_key(key.name)) {
            check_scope(key, *known_key, is_map, diagnostics);
            continue;
        }
        diagnostics.error(key.name_at,
                          fmt::format("unknown key '{}'{}", key.name_at.view(), did_you_mean(nearest_key(key.name))));
    }
}

bool states_axiom(std::string_view text) {
    while (!text.empty()) {
        const std::string_view line = take_line(text);
        const std::size_t colon = line.find(':');
        if (colon < 100 && lower_case(trimmed(line.substr(0, colon))) == "axiom") return true;
    }
    return false;
}

}  // namespace sikku
