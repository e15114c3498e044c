#include "studio/editor/highlighting.h"

#include "art/style/colour.h"
#include "engine/base/keys.h"
#include "engine/base/text.h"
#include "engine/language/command_table.h"
#include "engine/language/function_names.h"
#include "music/scale/scale.h"
#include "studio/editor/help.h"
#include "studio/editor/request_members.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <functional>
#include <set>
#include <string_view>
#include <utility>
#include <vector>

namespace sikku {
namespace {

using Names = std::vector<std::string>;

/// The kind of a symbol, as the studio colours it.
enum class SymbolClass : std::uint8_t { draw, turn, branch, pen, other };

SymbolClass class_of(std::string_view symbol) {
    if (symbol == "%") return SymbolClass::branch;
    CommandSettings settings;
    settings.forward = {"F"};
    settings.move = {"f"};
    SymbolInfo info;
    info.letter = symbol;
    switch (command_of(info, settings).action) {
        case Action::draw:
        case Action::move:
        case Action::disc:
            return SymbolClass::draw;
        case Action::turn:
        case Action::pitch:
        case Action::roll:
        case Action::level:
            return SymbolClass::turn;
        case Action::push:
        case Action::pop:
        case Action::polygon_begin:
        case Action::polygon_end:
            return SymbolClass::branch;
        case Action::width_factor:
        case Action::colour_step:
            return SymbolClass::pen;
        default:
            return SymbolClass::other;
    }
}

/// Sorts alternatives of a regular expression so that the longest comes first, and removes repeated ones.
Names longest_first(Names names) {
    const std::set<std::string> unique(names.begin(), names.end());
    names.assign(unique.begin(), unique.end());
    std::stable_sort(names.begin(), names.end(),
                     [](const std::string& a, const std::string& b) { return a.size() > b.size(); });
    return names;
}

Names symbols_of(SymbolClass wanted) {
    Names names;
    if (wanted == SymbolClass::branch) names.emplace_back("%");
    for (const SymbolHelp& row : single_turtle_symbols()) {
        if (class_of(row.symbols) == wanted) names.emplace_back(row.symbols);
    }
    return longest_first(names);
}

Names keys_that(const std::function<bool(const KeyInfo&)>& wanted) {
    Names names;
    for (const KeyInfo& key : language_keys()) {
        if (!wanted(key)) continue;
        names.emplace_back(key.is_for_symbols() ? trimmed(key.before_symbol()) : key.name);
    }
    return longest_first(names);
}

bool is_free_text(const KeyInfo& key) {
    return key.values == "text";
}
Names text_keys() {
    return keys_that(is_free_text);
}
Names word_keys() {
    return keys_that([](const KeyInfo& key) { return has_symbols(key) && !key.is_for_symbols(); });
}
Names word_keys_for_symbols() {
    return keys_that([](const KeyInfo& key) { return has_symbols(key) && key.is_for_symbols(); });
}
Names keys_for_symbols() {
    return keys_that([](const KeyInfo& key) { return !has_symbols(key) && key.is_for_symbols(); });
}
Names other_keys() {
    return keys_that([](const KeyInfo& key) {
        return !is_free_text(key) && !has_symbols(key) && !key.is_for_symbols() && key.name != "schedule" &&
               key.name != "surface";
    });
}

/// Values that are words, of all keys together, and other names of scales.
Names all_choices() {
    Names names;
    for (const Scale& scale : known_scales()) names.insert(names.end(), scale.names.begin(), scale.names.end());
    for (const KeyInfo& key : language_keys()) {
        for (std::string& choice : choices_of(key)) {
            if (choice.find_first_of("0123456789#/") == std::string::npos) names.push_back(std::move(choice));
        }
    }
    return longest_first(names);
}

Names colours() {
    Names names;
    for (const std::string_view name : colour_names()) names.emplace_back(name);
    return longest_first(names);
}

Names functions() {
    Names names;
    for (const std::string_view name : function_names()) names.emplace_back(name);
    return longest_first(names);
}

/// Escapes `special` characters with a backslash, and replaces a blank by a pattern for blanks.
std::string escaped(std::string_view text, std::string_view special, std::string_view blanks) {
    std::string result;
    for (const char byte : text) {
        if (byte == ' ') {
            result += blanks;
        } else {
            if (special.find(byte) != std::string_view::npos) result += '\\';
            result += byte;
        }
    }
    return result;
}

// --- TextMate ---------------------------------------------------------------------------------------------------

std::string alternation(const Names& names) {
    Names all;
    for (const std::string& name : names) all.push_back(escaped(name, R"(\^$.|?*+()[]{}/-#)", "[ \\t]+"));
    return fmt::format("(?:{})", fmt::join(all, "|"));
}

std::string scope(std::string_view name) {
    return std::string(name) + ".sikku";
}

Json match(std::string_view name, const std::string& pattern) {
    return {{"name", scope(name)}, {"match", pattern}};
}

Json included(std::initializer_list<const char*> names) {
    Json list = Json::array();
    for (const char* name : names) list.push_back({{"include", std::string("#") + name}});
    return list;
}

/// Scopes of the groups of a regular expression, from 1; empty: none.
Json captures(std::initializer_list<std::string_view> names) {
    Json groups = Json::object();
    int number = 0;
    for (const std::string_view name : names) {
        ++number;
        if (!name.empty()) groups[std::to_string(number)] = {{"name", scope(name)}};
    }
    return groups;
}

/// The end of a line that is not continued. Lines are matched with their line feed, and `$` after it as well.
constexpr const char* line_end = "(?<![ \\t]\\\\|\\n)$";
/// The beginning of a line, or what follows a comment there.
const std::string line_begin = "(?:^|(?<=\\*/))[ \\t]*";
constexpr const char* key_scope = "keyword.other.key";
constexpr const char* colon_scope = "punctuation.separator.key-value";
constexpr const char* symbol_scope = "variable.other.symbol";

/// A line that begins with `begin`, and what its rest contains.
Json line_rule(const std::string& begin, const Json& groups, const Json& patterns, std::string_view content = {}) {
    Json rule = {{"begin", begin}, {"beginCaptures", groups}, {"end", line_end}, {"patterns", patterns}};
    if (!content.empty()) rule["contentName"] = scope(content);
    return rule;
}

Json key_rule(const Names& keys, const Json& patterns, std::string_view content = {}) {
    return line_rule(fmt::format("{}((?i){})[ \\t]*(:)", line_begin, alternation(keys)),
                     captures({key_scope, colon_scope}), patterns, content);
}

Json symbol_key_rule(const Names& keys, const Json& patterns) {
    return line_rule(fmt::format("{}((?i){})[ \\t]+(\\S+?)[ \\t]*(:)", line_begin, alternation(keys)),
                     captures({key_scope, symbol_scope, colon_scope}), patterns);
}

Json word_rules() {
    Json rules = included({"comment", "continuation", "parameters"});
    rules.push_back(
        match("support.function.draw", "~[A-Za-z][A-Za-z0-9]*|" + alternation(symbols_of(SymbolClass::draw))));
    rules.push_back(match("punctuation.section.branch", alternation(symbols_of(SymbolClass::branch))));
    rules.push_back(match("keyword.operator.turn", alternation(symbols_of(SymbolClass::turn))));
    rules.push_back(match("support.constant.pen", alternation(symbols_of(SymbolClass::pen))));
    rules.push_back(match(symbol_scope, "@?[^\\s()<>:*]"));
    return rules;
}

Json expression_rules() {
    Json rules = included({"comment", "continuation", "parameters"});
    rules.push_back(match("support.function.math", fmt::format("\\b{}(?=[ \\t]*\\()", alternation(functions()))));
    rules.push_back(match("constant.numeric", "(?:\\d+\\.?\\d*|\\.\\d+)(?:[eE][+-]?\\d+)?"));
    rules.push_back(match("variable.parameter", "[\\p{L}_][\\p{L}\\p{N}_]*"));
    rules.push_back(match("keyword.operator.expression", "<=|>=|==|!=|&&|\\|\\||[-+*/^<>!=]"));
    rules.push_back(match("punctuation.separator.arguments", ","));
    return rules;
}

Json value_rules() {
    Json rules = included({"comment", "continuation"});
    rules.push_back(
        match("constant.other.colour", fmt::format("#(?:[0-9A-Fa-f]{{8}}|[0-9A-Fa-f]{{6}}|[0-9A-Fa-f]{{3,4}})\\b|"
                                                   "(?<![\\w-])(?i:{})(?![\\w-])",
                                                   alternation(colours()))));
    rules.push_back(
        match("constant.language", fmt::format("(?<![\\w-])(?i:{})(?![\\w-])", alternation(all_choices()))));
    rules.push_back({{"match",
                      "(?<![\\w#])([-+]?(?:\\d+\\.?\\d*|\\.\\d+)(?:[eE][+-]?\\d+)?(?:/\\d+)?)(mm|cm|in|pt|px)?"
                      "(?![\\w.])"},
                     {"captures", captures({"constant.numeric", "keyword.other.unit"})}});
    rules.push_back(match("punctuation.separator.list", "[,;]"));
    rules.push_back(match("string.unquoted.value", "(?:(?!/\\*)[^\\s,;])+"));
    return rules;
}

/// Lines in the order in which the parser of the language tries them.
Json line_rules() {
    // Two levels of parentheses around an arrow are enough in practice.
    const std::string outside = "(?:[^()\\n]|\\((?:[^()\\n]|\\([^()\\n]*\\))*\\))*?";
    Json rules = Json::array();
    rules.push_back(match("comment.line.double-slash", "^[ \\t]*//.*$"));
    rules.push_back(key_rule(text_keys(), included({"comment"}), "string.unquoted"));
    rules.push_back({{"name", scope("meta.production")},
                     {"begin", "(?:^|(?<=\\*/))(?=" + outside + "-->)"},
                     {"end", line_end},
                     {"patterns", included({"production"})}});
    rules.push_back(
        line_rule(line_begin + "(#?define)[ \\t]+([^\\s=]+)(?:[ \\t]*(=))?",
                  captures({"keyword.control.define", "variable.other.constant", "keyword.operator.assignment"}),
                  included({"expression"})));
    rules.push_back(line_rule(line_begin + "((?i)interpret)[ \\t]*(:)",
                              captures({"keyword.control.section", colon_scope}), included({"comment"})));
    rules.push_back(line_rule(line_begin + "((?i)table|patch)[ \\t]+([^:\\n]+?)[ \\t]*(:)",
                              captures({"keyword.control.section", "entity.name.section", colon_scope}),
                              included({"comment"})));
    rules.push_back(line_rule(line_begin + "((?i)variant)[ \\t]+([^:\\n]+?)[ \\t]*(:)",
                              captures({"keyword.control.section", "entity.name.section", colon_scope}),
                              included({"settings"})));
    rules.push_back(key_rule(word_keys(), included({"word"})));
    rules.push_back(symbol_key_rule(word_keys_for_symbols(), included({"word"})));
    rules.push_back(symbol_key_rule(keys_for_symbols(), included({"value"})));
    rules.push_back(key_rule({"schedule"}, included({"schedule"})));
    rules.push_back(key_rule({"surface"}, included({"surfaces"})));
    rules.push_back(key_rule(other_keys(), included({"value"})));
    rules.push_back({{"match", "^[ \\t]*[-+.\\d][-+.\\deE \\t]*$"}, {"name", scope("constant.numeric")}});
    rules.push_back({{"include", "#comment"}});
    return rules;
}

Json repository() {
    Json production = Json::array();
    production.push_back(match("keyword.operator.arrow", "-->"));
    production.push_back({{"begin", ":"},
                          {"beginCaptures", {{"0", {{"name", scope(colon_scope)}}}}},
                          {"end", std::string("(?=-->)|") + line_end},
                          {"patterns", included({"expression"})}});
    production.push_back(match("keyword.operator.context", "[<>]"));
    production.push_back(match("constant.language.empty", "\\*|ε"));
    production.push_back({{"include", "#word"}});

    Json schedule = included({"comment", "continuation", "parameters"});
    schedule.push_back({{"match", "(\\*)[ \\t]*([\\p{L}_][\\p{L}\\p{N}_]*)"},
                        {"captures", captures({"keyword.operator.expression", "variable.parameter"})}});
    schedule.push_back(match("keyword.operator.expression", "\\*"));
    schedule.push_back(match("constant.numeric", "(?<=\\*)\\d+"));
    schedule.push_back(match("entity.name.section", "[^\\s*(),]+"));
    schedule.push_back(match("punctuation.separator.list", ","));

    Json settings = included({"comment", "continuation"});
    const std::string key = alternation(keys_that([](const KeyInfo& row) { return !row.is_for_symbols(); }));
    settings.push_back({{"match", fmt::format("(?<=[:,])[ \\t]*((?i){})[ \\t]*(=)", key)},
                        {"captures", captures({key_scope, "keyword.operator.assignment"})}});
    settings.push_back({{"match", "([\\p{L}_][\\p{L}\\p{N}_]*)[ \\t]*(=)"},
                        {"captures", captures({"variable.other.constant", "keyword.operator.assignment"})}});
    settings.push_back({{"include", "#value"}});

    Json surfaces = included({"comment", "continuation"});
    surfaces.push_back({{"match", "([A-Za-z][A-Za-z0-9]*)[ \\t]*(=)"},
                        {"captures", captures({"entity.name.section", "keyword.operator.assignment"})}});
    surfaces.push_back({{"include", "#value"}});

    return {{"comment", {{"patterns", {{{"name", scope("comment.block")}, {"begin", "/\\*"}, {"end", "\\*/"}}}}}},
            {"continuation", {{"patterns", {match("punctuation.separator.continuation", "(?<=[ \\t])\\\\$")}}}},
            {"parameters",
             {{"patterns",
               {{{"name", scope("meta.parameters")},
                 {"begin", "\\("},
                 {"beginCaptures", {{"0", {{"name", scope("punctuation.section.parens")}}}}},
                 {"end", std::string("\\)|") + line_end},
                 {"endCaptures", {{"0", {{"name", scope("punctuation.section.parens")}}}}},
                 {"patterns", included({"expression"})}}}}}},
            {"production", {{"patterns", production}}},
            {"word", {{"patterns", word_rules()}}},
            {"expression", {{"patterns", expression_rules()}}},
            {"value", {{"patterns", value_rules()}}},
            {"schedule", {{"patterns", schedule}}},
            {"settings", {{"patterns", settings}}},
            {"surfaces", {{"patterns", surfaces}}}};
}

// --- Vim --------------------------------------------------------------------------------------------------------

std::string vim_alternation(const Names& names) {
    Names all;
    for (const std::string& name : names) all.push_back(escaped(name, R"(\^$.*[]~/)", "\\s\\+"));
    return fmt::format(R"(\%({}\))", fmt::join(all, R"(\|)"));
}

/// Syntax groups, and the standard groups that they link to.
constexpr std::pair<const char*, const char*> vim_groups[] = {
    {"Comment", "Comment"},     {"Key", "Identifier"},       {"Colon", "Delimiter"},    {"Section", "Statement"},
    {"SectionName", "Title"},   {"Table", "Title"},          {"Variant", "Title"},      {"Setting", "Identifier"},
    {"Define", "Define"},       {"Constant", "Constant"},    {"Arrow", "Operator"},     {"Context", "Operator"},
    {"Empty", "Constant"},      {"Continuation", "Special"}, {"Text", "String"},        {"Value", "String"},
    {"Settings", "String"},     {"Surfaces", "String"},      {"SymbolValue", "String"}, {"SymbolValueOf", "Type"},
    {"SymbolWordOf", "Type"},   {"Symbol", "Type"},          {"Draw", "Function"},      {"Turn", "Operator"},
    {"Branch", "Delimiter"},    {"Pen", "Special"},          {"Name", "Identifier"},    {"Function", "Function"},
    {"Number", "Number"},       {"Row", "Number"},           {"Factor", "Operator"},    {"Parameters", "Delimiter"},
    {"Expression", "Operator"}, {"Defined", "Operator"},     {"Choice", "Constant"},    {"Colour", "Constant"},
    {"Schedule", "Delimiter"},
};

}  // namespace

std::string textmate_grammar() {
    const Json grammar = {{"name", "Sikku pattern"},
                          {"scopeName", "source.sikku"},
                          {"fileTypes", {"lsys"}},
                          {"patterns", line_rules()},
                          {"repository", repository()}};
    return grammar.dump(2) + "\n";
}

std::string vim_syntax() {
    const std::string outside = R"(\%([^()]\|(\%([^()]\|([^()]*)\)*)\)\{-})";
    const std::string end = R"(skip=/\s\\$/ end=/$/)";
    std::string text = R"(" Vim syntax file. Language: Sikku patterns (*.lsys). Made by `sikku lsp --grammar vim`.
if exists("b:current_syntax")
  finish
endif
syn case match
syn sync minlines=200

)";
    const auto add = [&](const std::string& line) { text += line + "\n"; };
    const auto symbols = [&](const char* group, SymbolClass wanted) {
        add(fmt::format("syn match {} /{}/ contained", group, vim_alternation(symbols_of(wanted))));
    };
    add("\" Words");
    add(R"(syn match sikkuSymbol /@\=[^ \t()<>:*]/ contained)");
    symbols("sikkuPen", SymbolClass::pen);
    symbols("sikkuTurn", SymbolClass::turn);
    symbols("sikkuBranch", SymbolClass::branch);
    symbols("sikkuDraw", SymbolClass::draw);
    add(R"(syn match sikkuDraw /\~\a\w*/ contained)");
    add(R"(syn match sikkuContext /[<>]/ contained)");
    add(R"(syn match sikkuEmpty /\*\|ε/ contained)");
    add(R"(syn match sikkuArrow /-->/ contained)");
    add(R"(syn match sikkuContinuation /\s\zs\\$/ contained)");
    add("\" Expressions");
    const std::string expression =
        " contains=sikkuParameters,sikkuName,sikkuFunction,sikkuNumber,sikkuComment,sikkuContinuation";
    add(R"(syn match sikkuName /\%(\a\|_\|[^\x00-\x7f]\)\%(\w\|[^\x00-\x7f]\)*/ contained)");
    add(fmt::format("syn match sikkuFunction /\\<{}\\ze\\s*(/ contained", vim_alternation(functions())));
    add(R"(syn match sikkuNumber /\%(\d\+\.\=\d*\|\.\d\+\)\%([eE][+-]\=\d\+\)\=/ contained)");
    add("syn region sikkuParameters start=/(/ end=/)/ contained oneline" + expression);
    add(R"(syn region sikkuExpression start=/:/ end=/\ze-->/ )" + end + " contained" + expression);
    add("\" Values");
    add(fmt::format(R"(syn match sikkuChoice /\c\<{}\%(\w\|-\)\@!/ contained)", vim_alternation(all_choices())));
    add(fmt::format("syn match sikkuColour /\\c\\<{}\\>/ contained", vim_alternation(colours())));
    add(R"(syn match sikkuColour /#\%(\x\{8}\|\x\{6}\|\x\{3,4}\)\>/ contained)");
    add(R"(syn match sikkuSectionName /[^ \t*(),=:]\+\ze\s*\%(=\|[*(]\|\s\|$\)/ contained)");
    add(R"(syn match sikkuFactor /\*\s*\%(\d\+\|\a\w*\)\=/ contained contains=sikkuNumber,sikkuName)");
    add("syn cluster sikkuWords contains=sikkuSymbol,sikkuPen,sikkuTurn,sikkuBranch,sikkuDraw,sikkuParameters,"
        "sikkuComment,sikkuContinuation");
    const std::string values = "sikkuChoice,sikkuColour,sikkuNumber,sikkuComment,sikkuContinuation";
    add("\" Lines");
    const auto key_line = [&](const char* value, const Names& keys, const std::string& contained) {
        add(fmt::format("syn match sikkuKey /^\\s*\\c{}\\ze\\s*:/ nextgroup={} skipwhite", vim_alternation(keys),
                        value));
        add(fmt::format("syn region {} matchgroup=sikkuColon start=/:/ {} contained contains={}", value, end,
                        contained));
    };
    const auto symbol_key_line = [&](const std::string& value, const Names& keys, const std::string& contained) {
        add(fmt::format("syn match sikkuKey /^\\s*\\c{}\\ze\\s\\+\\S\\+\\s*:/ nextgroup={}Of skipwhite",
                        vim_alternation(keys), value));
        add(fmt::format("syn match {}Of /\\S\\{{-1,}}\\ze\\s*:/ contained nextgroup={} skipwhite", value, value));
        add(fmt::format("syn region {} matchgroup=sikkuColon start=/:/ {} contained contains={}", value, end,
                        contained));
    };
    key_line("sikkuValue", other_keys(), values);
    key_line("sikkuSchedule", {"schedule"},
             "sikkuParameters,sikkuSectionName,sikkuFactor,sikkuComment,sikkuContinuation");
    key_line("sikkuSurfaces", {"surface"}, "sikkuSectionName,sikkuComment,sikkuContinuation");
    key_line("sikkuWord", word_keys(), "@sikkuWords");
    symbol_key_line("sikkuSymbolValue", keys_for_symbols(), values);
    symbol_key_line("sikkuSymbolWord", word_keys_for_symbols(), "@sikkuWords");
    add(R"(syn match sikkuSection /^\s*\cinterpret\ze\s*:/ nextgroup=sikkuColon skipwhite)");
    add(R"(syn match sikkuColon /:/ contained)");
    add(R"(syn match sikkuSection /^\s*\c\%(table\|patch\)\ze\s[^:]*:/ nextgroup=sikkuTable skipwhite)");
    add(R"(syn match sikkuTable /[^:]*[^: \t]/ contained nextgroup=sikkuColon skipwhite)");
    add(R"(syn match sikkuSection /^\s*\cvariant\ze\s[^:]*:/ nextgroup=sikkuVariant skipwhite)");
    add(R"(syn match sikkuVariant /[^:]*[^: \t]/ contained nextgroup=sikkuSettings skipwhite)");
    add("syn region sikkuSettings matchgroup=sikkuColon start=/:/ " + end + " contained contains=sikkuSetting," +
        values);
    add(R"(syn match sikkuSetting /\%([:,]\s*\)\@<=[^ \t=,:][^=,:]\{-}\ze\s*=/ contained)");
    add(R"(syn match sikkuDefine /^\s*#\=define\ze\s/ nextgroup=sikkuConstant skipwhite)");
    add(R"(syn match sikkuConstant /[^ \t=]\+/ contained nextgroup=sikkuDefined skipwhite)");
    add("syn region sikkuDefined start=/\\S/ " + end + " contained" + expression);
    add(R"(syn match sikkuRow /^\s*[-+.0-9][-+.0-9eE \t]*$/)");
    add("syn region sikkuProduction start=/^\\ze" + outside + "-->/ " + end +
        " contains=@sikkuWords,sikkuArrow,sikkuContext,sikkuEmpty,sikkuExpression");
    key_line("sikkuText", text_keys(), "sikkuComment,sikkuContinuation");
    add(R"(syn match sikkuComment /^\s*\/\/.*/)");
    add(R"(syn region sikkuComment start=/\/\*/ end=/\*\//)");
    text += "\n";
    for (const auto& [group, link] : vim_groups) add(fmt::format("hi def link sikku{} {}", group, link));
    text += "\nlet b:current_syntax = \"sikku\"\n";
    return text;
}

}  // namespace sikku
