#include "engine/language/map_system.h"

#include "engine/language/word_scanner.h"

#include <fmt/format.h>

#include <algorithm>
#include <initializer_list>
#include <optional>
#include <unordered_map>
#include <utility>

namespace sikku {
namespace {

// Limit for all tables together: each has an entry for every label.
constexpr std::size_t most_entries = std::size_t{1} << 22;

enum class TokenKind : std::uint8_t { label, left, right, reversal, open, close, end, error };

struct Token {
    TokenKind kind = TokenKind::end;
    Span where;
};

/// Divides the text of an axiom or a successor into labels and signs.
class MapScanner {
public:
    MapScanner(const SymbolNames& names, const Span& text, Diagnostics& diagnostics)
        : scanner_(names, text, &diagnostics), text_(text), diagnostics_(diagnostics) {}

    Token next() {
        const bool blank_before = scanner_.skip_blanks();
        const std::size_t begin = scanner_.at();
        if (scanner_.at_end()) return {TokenKind::end, text_.part(begin, 0)};
        const std::string_view letter = scanner_.letter(blank_before);
        if (letter.empty()) return {TokenKind::error, {}};
        const Token token{kind_of(letter), text_.part(begin, letter.size())};
        if (scanner_.at_parameters()) return wrong(text_.part(scanner_.at()), "labels of a map have no parameters");
        for (const std::string_view tilde : {"\xE2\x88\xBC", "\xCB\x9C"}) {
            if (letter == tilde) return wrong(token.where, fmt::format("'{}' is not a label: write '~'", tilde));
        }
        if (letter == "%") return wrong(token.where, "a map has no branches to cut: '%' is not a label");
        return token;
    }

private:
    static TokenKind kind_of(std::string_view letter) {
        if (letter == "+") return TokenKind::left;
        if (letter == "-") return TokenKind::right;
        if (letter == "~") return TokenKind::reversal;
        if (letter == "[") return TokenKind::open;
        if (letter == "]") return TokenKind::close;
        return TokenKind::label;
    }

    Token wrong(const Span& where, const std::string& message) {
        diagnostics_.error(where, message);
        return {TokenKind::error, where};
    }

    WordScanner scanner_;
    Span text_;
    Diagnostics& diagnostics_;
};

bool is_empty_word(std::string_view text) {
    return text.empty() || text == "*" || text == "\xCE\xB5";
}

class MapCompiler {
public:
    MapCompiler(const Pattern& pattern, const SymbolNames& names, Diagnostics& diagnostics)
        : pattern_(pattern), names_(names), diagnostics_(diagnostics) {}

    MapSystem run() {
        system_.is_clockwise = choice<bool>("map", {{"clockwise", true}, {"anticlockwise", false}}, true);
        system_.divides_all = choice<bool>("divide", {{"once", false}, {"all", true}}, false);
        system_.placing = choice<Placing>(
            "place",
            {{"straight", Placing::straight}, {"gravity", Placing::gravity}, {"pressure", Placing::pressure}},
            Placing::straight);
        system_.outline = choice<MapOutline>(
            "outline", {{"polygon", MapOutline::polygon}, {"circle", MapOutline::circle}}, MapOutline::polygon);
        system_.growth = number("growth", 1.0, "a number from 0 to 1", [](double x) { return x >= 0 && x <= 1; });
        system_.stretch = number("stretch", 1.0, "a number above 0, from 0.001 to 1000",
                                 [](double x) { return x >= 0.001 && x <= 1000; });
        read_axiom();
        if (!pattern_.interpret.empty()) {
            diagnostics_.error(pattern_.interpret.front().whole, "a map has no word that 'interpret:' could change");
        }
        read_tables();
        return std::move(system_);
    }

private:
    /// The production of one label, not yet in a table.
    struct Rule {
        Label label = 0;
        std::uint32_t production = 0;
        Span predecessor;
    };

    template <class Value>
    Value choice(std::string_view name, std::initializer_list<std::pair<std::string_view, Value>> values,
                 Value if_absent) {
        const Key* key = pattern_.find(name);
        if (!key) return if_absent;
        std::string known;
        for (const auto& [text, value] : values) {
            if (key->value.view() == text) return value;
            known += fmt::format("{}'{}'", known.empty() ? "" : " or ", text);
        }
        diagnostics_.error(key->value.empty() ? key->name_at : key->value, "expected " + known);
        return if_absent;
    }

    template <class Accepts>
    double number(std::string_view name, double if_absent, std::string_view expected, Accepts accepts) {
        const Key* key = pattern_.find(name);
        if (!key) return if_absent;
        double value = 0;
        if (read_number(key->value.view(), value) && accepts(value)) return value;
        diagnostics_.error(key->value.empty() ? key->name_at : key->value, fmt::format("expected {}", expected));
        return if_absent;
    }

    std::optional<Label> label_of(const Span& where) {
        const auto [found, is_new] =
            labels_.try_emplace(std::string(where.view()), static_cast<Label>(system_.labels.size()));
        if (!is_new) return found->second;
        if (system_.labels.size() >= most_symbols) {
            return diagnostics_.refuse(where, "there are more than 524,288 different labels");
        }
        system_.labels.emplace_back(where.view());
        return found->second;
    }

    bool wrong(const Span& where, const std::string& message) { return diagnostics_.refuse(where, message); }

    /// Reads a label, or `~` and a label. @param token  the first of them
    /// @param expected  the error if it is neither
    bool read_part(MapScanner& scanner, Token token, const char* expected, MapPart& part) {
        part.is_reversed = token.kind == TokenKind::reversal;
        if (part.is_reversed) token = scanner.next();
        if (token.kind == TokenKind::error) return false;
        if (token.kind != TokenKind::label) {
            return wrong(token.where, part.is_reversed ? "expected a label after '~'" : expected);
        }
        const auto label = label_of(token.where);
        if (label) part.label = *label;
        return label.has_value();
    }

    void read_axiom() {
        const Key* key = pattern_.find("axiom");
        if (!key) return diagnostics_.error({pattern_.source, 0, 0}, "there is no 'axiom:'");
        if (is_empty_word(key->value.view())) {
            return diagnostics_.error(key->name_at, "the axiom is empty: expected the labels of a cell's wall");
        }
        MapScanner scanner(names_, key->value, diagnostics_);
        for (Token token = scanner.next(); token.kind != TokenKind::end; token = scanner.next()) {
            MapPart part;
            if (!read_part(scanner, token,
                           "the axiom of a map consists of labels, with '~' before those directed against the walk",
                           part)) {
                return;
            }
            system_.axiom.push_back(part);
        }
    }

    /// Reads a branch after its `[`.
    bool read_branch(MapScanner& scanner, const Span& open, MapProduction& production) {
        Token token = scanner.next();
        if (token.kind == TokenKind::error) return false;
        if (token.kind == TokenKind::end) return wrong(open, "this '[' is not closed");
        if (token.kind == TokenKind::close) return wrong(open, "this branch is empty: expected a sign and a label");
        if (token.kind != TokenKind::left && token.kind != TokenKind::right) {
            return wrong(token.where, "a branch begins with '+' (left of the edge) or '-' (right of it)");
        }
        auto& side = token.kind == TokenKind::left ? production.left : production.right;
        MapPart part;
        if (!read_part(scanner, scanner.next(), "expected the label of the branch", part)) return false;
        token = scanner.next();
        if (token.kind == TokenKind::error) return false;
        if (token.kind == TokenKind::open) return wrong(token.where, "branches of a map do not nest");
        if (token.kind == TokenKind::end) return wrong(open, "this '[' is not closed");
        if (token.kind != TokenKind::close) return wrong(token.where, "a branch has one label: expected ']'");
        side.push_back({static_cast<std::uint32_t>(production.parts.size()), part.label, part.is_reversed});
        return true;
    }

    bool read_successor(const Span& text, MapProduction& production) {
        MapScanner scanner(names_, text, diagnostics_);
        for (Token token = scanner.next(); token.kind != TokenKind::end; token = scanner.next()) {
            if (token.kind == TokenKind::close) return wrong(token.where, "']' without '['");
            if (token.kind == TokenKind::open) {
                if (!read_branch(scanner, token.where, production)) return false;
                continue;
            }
            MapPart part;
            if (!read_part(scanner, token, "'+' and '-' stand only at the beginning of a branch: '[+a]'", part)) {
                return false;
            }
            production.parts.push_back(part);
        }
        std::reverse(production.left.begin(), production.left.end());
        return true;
    }

    std::optional<Label> read_predecessor(const ProductionText& text) {
        const auto refuse = [&](const Span& where, const char* what) {
            return diagnostics_.refuse(where, fmt::format("productions of a map have no {}", what));
        };
        if (text.left) return refuse(*text.left, "contexts");
        if (text.right) return refuse(*text.right, "contexts");
        if (text.condition) return refuse(*text.condition, "conditions");
        if (text.weight) return refuse(*text.weight, "weights");
        MapScanner scanner(names_, text.predecessor, diagnostics_);
        const Token token = scanner.next();
        if (token.kind == TokenKind::error) return std::nullopt;
        if (token.kind != TokenKind::label) {
            return diagnostics_.refuse(text.predecessor, "the predecessor is not a label: expected one label");
        }
        const Token after = scanner.next();
        if (after.kind == TokenKind::error) return std::nullopt;
        if (after.kind != TokenKind::end) {
            return diagnostics_.refuse(after.where, "a production of a map replaces one label");
        }
        return label_of(token.where);
    }

    std::vector<Rule> read_productions(const std::vector<ProductionText>& texts) {
        std::vector<Rule> rules;
        for (const ProductionText& text : texts) {
            const auto label = read_predecessor(text);
            if (!label) continue;
            MapProduction production;
            if (!is_empty_word(text.successor.view()) && !read_successor(text.successor, production)) continue;
            if (production.parts.empty()) {
                diagnostics_.error(text.successor.empty() ? text.predecessor : text.successor,
                                   "edges never vanish: expected a label outside of brackets");
                continue;
            }
            rules.push_back({*label, static_cast<std::uint32_t>(system_.productions.size()), text.predecessor});
            system_.productions.push_back(std::move(production));
        }
        return rules;
    }

    void enter(const std::vector<Rule>& rules, std::vector<std::uint32_t>& table) {
        const std::size_t kept = system_.productions.size() - system_.labels.size();
        for (const Rule& rule : rules) {
            if (table[rule.label] < kept) {
                diagnostics_.error(rule.predecessor,
                                   fmt::format("'{}' has a production already; expected one for each label",
                                               system_.labels[rule.label]));
            }
            table[rule.label] = rule.production;
        }
    }

    void read_tables() {
        const std::vector<Rule> common = read_productions(pattern_.common);
        std::vector<std::vector<Rule>> own;
        for (const TableText& table : pattern_.tables) own.push_back(read_productions(table.productions));
        const std::size_t labels = system_.labels.size();
        if (own.size() > 1 && own.size() * labels > most_entries) {
            return diagnostics_.error(
                pattern_.tables.front().name,
                fmt::format("{} tables of {} labels are too many: expected at most {} entries in total", own.size(),
                            labels, most_entries));
        }
        // Productions that keep their labels.
        std::vector<std::uint32_t> table;
        for (Label label = 0; label < labels; ++label) {
            table.push_back(static_cast<std::uint32_t>(system_.productions.size()));
            system_.productions.push_back({{{label, false}}, {}, {}});
        }
        enter(common, table);
        if (own.empty()) system_.tables.push_back(table);
        for (const std::vector<Rule>& rules : own) {
            system_.tables.push_back(table);
            enter(rules, system_.tables.back());
        }
    }

    const Pattern& pattern_;
    const SymbolNames& names_;
    Diagnostics& diagnostics_;
    MapSystem system_;
    std::unordered_map<std::string, Label> labels_;
};

}  // namespace

MapSystem compile_map_system(const Pattern& pattern, const SymbolNames& names, Diagnostics& diagnostics) {
    return MapCompiler(pattern, names, diagnostics).run();
}

}  // namespace sikku
