#include "studio/editor/help.h"

#include "engine/base/characters.h"
#include "engine/base/text.h"
#include "music/melody/melody.h"
#include "music/scale/scale.h"
#include "studio/editor/measures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <set>
#include <utility>

namespace sikku {
namespace {

constexpr std::size_t most_productions_shown = 8;
constexpr std::int64_t most_lengths_shown = 10;

/// A text between backquotes, which Markdown shows unchanged.
std::string code(std::string_view text) {
    const std::string plain = printable(text, 120);
    if (plain.find('`') == std::string::npos) return fmt::format("`{}`", plain);
    return fmt::format("`` {} ``", plain);
}

std::string key_help(const KeyInfo& key) {
    std::string text = fmt::format("**{}**\n\n{}", key.name, key.help);
    if (!key.values.empty()) text += fmt::format("\n\nValues: {}", key.values);
    if (!key.if_absent.empty()) text += fmt::format("\n\nIf absent: {}", key.if_absent);
    return text;
}

std::string capital(std::string_view text) {
    std::string result(text);
    if (!result.empty()) result[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(result[0])));
    return result;
}

/// Words that describe values and are not values.
bool is_prose(std::string_view text) {
    static const std::set<std::string_view> words = {
        "a",   "an",      "the",    "such",    "or",      "as",         "of",       "to",
        "and", "several", "number", "numbers", "symbols", "names",      "text",     "degrees",
        "k",   "colours", "from",   "tables",  "pairs",   "optionally", "semitones"};
    const auto all = split_words(text);
    return std::any_of(all.begin(), all.end(), [](std::string_view word) { return words.contains(word); });
}

bool is_choice(std::string_view text) {
    if (text.empty() || (text != "symbols" && is_prose(text))) return false;
    return std::all_of(text.begin(), text.end(), [](char byte) {
        return is_letter_or_digit(byte) || byte == ' ' || byte == '-' || byte == '/' || byte == '#';
    });
}

std::string symbol_help(std::string_view symbol, const Pattern& pattern) {
    std::string text = fmt::format("**{}**", code(symbol));
    for (const SymbolHelp& row : single_turtle_symbols()) {
        const bool is_meant = row.symbols == symbol || (row.symbols == "~NAME" && symbol == "~");
        if (is_meant && !pattern.find("map")) text += "\n\n" + capital(row.help);
    }
    for (const char* list : {"forward", "move", "ignore", "consider"}) {
        const Key* key = pattern.find(list);
        const auto names = key ? split_words(key->value.view()) : std::vector<std::string_view>();
        if (std::find(names.begin(), names.end(), symbol) != names.end()) {
            text += fmt::format("\n\n{}", find_language_key(list)->help);
        }
    }
    return text;
}

/// Productions whose predecessor begins with the symbol.
std::string productions_of(const Occurrence& symbol, const Pattern& pattern, const std::vector<Occurrence>& all) {
    std::vector<const std::vector<ProductionText>*> lists = {&pattern.common};
    for (const TableText& table : pattern.tables) lists.push_back(&table.productions);
    lists.push_back(&pattern.interpret);
    std::set<std::uint32_t> places;
    for (const Occurrence& each : all) {
        if (each.is_definition && each.is_same(symbol)) places.insert(each.where.at);
    }
    std::string text;
    std::size_t shown = 0;
    for (const auto* productions : lists) {
        for (const ProductionText& production : *productions) {
            if (!places.contains(production.predecessor.at) || ++shown > most_productions_shown) continue;
            text += fmt::format("\n\n{} (line {})", code(production.whole.view()),
                                pattern.source->place(production.whole.at).line);
        }
    }
    if (shown > most_productions_shown) {
        text += fmt::format("\n\n… and {} more", counted(shown - most_productions_shown, "production"));
    }
    return text;
}

Completion key_completion(const KeyInfo& key) {
    Completion item{std::string(key.name), std::string(key.name) + ": ", {}, key_help(key), true};
    if (key.is_for_symbols()) item.insert = std::string(key.before_symbol());
    constexpr std::size_t longest_detail = 40;
    if (key.values.size() <= longest_detail) item.detail = key.values;
    return item;
}

/// The beginnings of lines without keys, and their help.
constexpr std::pair<std::string_view, std::string_view> sections[] = {
    {"define ", "A constant: `define NAME = EXPRESSION`"},
    {"table ", "Productions that the schedule applies: `table NAME:`, and productions on the lines after it"},
    {"interpret:", "Productions that are applied once to the finished word, on the lines after it"},
    {"variant ", "Values that differ: `variant NAME: a = 1, derivation length = 12`"},
    {"patch ", "A surface of Bezier patches: `patch NAME:`, and points on the lines after it"},
};

}  // namespace

std::vector<SymbolHelp> single_turtle_symbols() {
    std::vector<SymbolHelp> rows;
    for (const SymbolHelp& row : turtle_symbols()) {
        for (const std::string_view symbol : split_words(row.symbols)) rows.push_back({symbol, row.help});
    }
    return rows;
}

std::vector<std::string> choices_of(const KeyInfo& key) {
    std::vector<std::string> choices;
    if (has_symbols(key) || key.name == "schedule") return choices;
    for (const std::string_view part : split_words(key.values, ",;")) {
        if (is_choice(trimmed(part))) choices.emplace_back(trimmed(part));
    }
    if (key.name == "scale") {
        for (const Scale& scale : known_scales()) choices.push_back(scale.id);
    }
    if (key.name == "instrument") {
        for (const std::string_view name : instrument_names()) choices.emplace_back(name);
    }
    return choices;
}

std::string help_for(const Occurrence& name, const Pattern& pattern, const std::vector<Occurrence>& all) {
    const std::string_view text = name.where.view();
    switch (name.kind) {
        case NameKind::key: {
            std::string folded;
            for (const std::string_view word : split_words(text)) {
                folded += (folded.empty() ? "" : " ") + lower_case(word);
            }
            const KeyInfo* key = find_language_key(folded);
            if (!key) key = find_language_key(folded + " A");  // of a key for symbols
            return key ? key_help(*key) : "";
        }
        case NameKind::symbol:
            return symbol_help(text, pattern) + productions_of(name, pattern, all);
        case NameKind::surface:
            return fmt::format("**{}**\n\nA surface", code("~" + std::string(text)));
        case NameKind::define:
            for (const Define& define : pattern.defines) {
                if (define.name.view() != text) continue;
                return fmt::format("**{}**\n\nDefined on line {}",
                                   code(fmt::format("{} = {}", text, define.value.view())),
                                   pattern.source->place(define.name.at).line);
            }
            return {};
        case NameKind::table:
            for (const TableText& table : pattern.tables) {
                if (table.name.view() != text) continue;
                return fmt::format("**table {}**\n\n{}, on line {}", code(text),
                                   counted(table.productions.size(), "production"),
                                   pattern.source->place(table.name.at).line);
            }
            return {};
        case NameKind::formal:
            return fmt::format("**{}**\n\nA parameter of this production", code(text));
        case NameKind::variant:
            return fmt::format("**variant {}**\n\nChoose it with `sikku draw --variant` or in the studio",
                               code(text));
        case NameKind::arrow:
            return {};
    }
    return {};
}

std::string growth_table(const Document& document, const Monitor& monitor) {
    const auto steps = static_cast<std::int64_t>(document.grammar().steps());
    std::string rows;
    constexpr std::int64_t most = 1'000'000'000;
    if (steps >= most) return {};
    for (std::int64_t n = std::max<std::int64_t>(0, steps + 2 - most_lengths_shown); n <= steps + 1; ++n) {
        std::string text;
        try {
            text = measures_text(document.with({{"derivation length", fmt::format("{}", n)}}), monitor);
        } catch (const PatternError&) {  // the schedule can be shorter
        }
        if (!text.empty()) rows += fmt::format("\n| {}{} | {} |", n, n == steps ? " (set)" : "", text);
    }
    return rows.empty() ? rows : "| n | word and drawing |\n|---|---|" + rows;
}

Completions complete(const Pattern& pattern, std::size_t offset) {
    const std::string_view text = pattern.source->text();
    offset = std::min(offset, text.size());
    const std::size_t feed = offset == 0 ? std::string_view::npos : text.rfind('\n', offset - 1);
    const std::size_t line = feed == std::string_view::npos ? 0 : feed + 1;
    const std::string_view before = text.substr(line, offset - line);
    Completions result;
    const auto begin_at = [&](std::size_t at) {
        while (at < before.size() && is_blank(before[at])) ++at;
        result.begin = line + at;
    };
    const std::size_t colon = before.find(':');
    if (colon == std::string_view::npos) {
        begin_at(0);
        const bool is_name =
            std::all_of(before.begin(), before.end(), [](char byte) { return is_letter(byte) || is_blank(byte); });
        if (!is_name) return result;
        for (const KeyInfo& key : language_keys()) {
            if (!pattern.find(key.name)) result.items.push_back(key_completion(key));
        }
        for (const auto& [start, help] : sections) {
            result.items.push_back({std::string(trimmed(start)), std::string(start), {}, std::string(help), true});
        }
        return result;
    }
    std::string folded;
    for (const std::string_view word : split_words(before.substr(0, colon))) {
        folded += (folded.empty() ? "" : " ") + lower_case(word);
    }
    const KeyInfo* key = find_language_key(folded);
    if (!key) return result;
    begin_at(colon + 1);
    if (key->name == "schedule") {
        const std::size_t blank = before.find_last_of(" \t:");
        begin_at(blank + 1);
        for (const TableText& table : pattern.tables) {
            const std::string name(table.name.view());
            result.items.push_back({name, name, counted(table.productions.size(), "production"), {}, false});
        }
        return result;
    }
    for (std::string& choice : choices_of(*key)) result.items.push_back({choice, std::move(choice), {}, {}, false});
    return result;
}

}  // namespace sikku
