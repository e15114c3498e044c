#include "studio/editor/answers.h"

#include "art/prints.h"
#include "art/style/colour.h"
#include "engine/base/characters.h"
#include "engine/base/keys.h"
#include "engine/base/text.h"
#include "engine/check.h"
#include "engine/language/defines.h"
#include "music/scores.h"
#include "studio/editor/format.h"
#include "studio/editor/help.h"
#include "studio/editor/measures.h"
#include "studio/editor/rename.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>

namespace sikku {
namespace {

std::span<const Interpreter* const> all_interpreters() {
    static const std::array<const Interpreter*, 2> both = {&prints(), &scores()};
    return both;
}

Json json_of(const EditorPosition& position) {
    return {{"line", position.line}, {"character", position.character}};
}

Json range_of(const TextPositions& positions, std::size_t begin, std::size_t end) {
    return {{"start", json_of(positions.position(begin))}, {"end", json_of(positions.position(end))}};
}

Json range_of(const TextPositions& positions, const Span& span) {
    return range_of(positions, span.at, std::size_t{span.at} + span.length);
}

Json edits_of(const TextPositions& positions, const std::vector<TextEdit>& list) {
    Json result = Json::array();
    for (const TextEdit& edit : list) {
        result.push_back({{"range", range_of(positions, edit.begin, edit.end)}, {"newText", edit.text}});
    }
    return result;
}

/// The end of the word or character at a byte; at a line end, the byte itself.
std::size_t end_of_word(std::string_view text, std::size_t begin) {
    std::size_t end = begin;
    if (end >= text.size() || text[end] == '\n' || text[end] == '\r') return end;
    if (begins_name(text[end])) {
        while (end < text.size() && continues_name(text[end])) ++end;
        return end;
    }
    return end + 1;  // other bytes are ASCII
}

Json diagnostic(const Json& range, Severity severity, const std::string& message) {
    return {{"range", range}, {"severity", severity}, {"source", "sikku"}, {"message", message}};
}

Json markdown(const std::string& text) {
    return {{"kind", "markdown"}, {"value", text}};
}

/// Parts of a value that are separated by blanks or commas.
template <class Take>
void for_each_word(const Span& value, Take take) {
    std::string_view rest = value.view();
    for (std::string_view word = take_word(rest, " \t,"); !word.empty(); word = take_word(rest, " \t,")) {
        take(word, value.part(value.length - rest.size() - word.size(), word.size()));
    }
}

bool has_colours(const std::string& name) {
    const KeyInfo* key = find_language_key(lower_case(name));
    return key && key->owner == KeyOwner::art && key->values.find("colour") != std::string_view::npos;
}

constexpr std::array token_type_names = {"property", "class", "variable", "parameter", "operator", "function"};
/// An index into token_type_names. The grammar colours symbols of one character.
std::optional<std::size_t> token_type(const Occurrence& name) {
    switch (name.kind) {
        case NameKind::key:
            return 0;
        case NameKind::table:
        case NameKind::variant:
        case NameKind::surface:
            return 1;
        case NameKind::define:
            return 2;
        case NameKind::formal:
            return 3;
        case NameKind::arrow:
            return 4;
        case NameKind::symbol:
            if (name.where.length > utf8_length(name.where.view())) return 5;
            break;
    }
    return std::nullopt;
}

/// The pattern with a variant; nullopt if it has errors.
std::optional<Document> compiled(const ReadPattern& read, const std::string& variant) {
    Diagnostics diagnostics;
    const Source& source = *read.pattern.source;
    Document result = Document::compile(source.name(), source.text(), {variant, {}}, diagnostics);
    return diagnostics.has_errors() ? std::nullopt : std::optional(std::move(result));
}

std::string address_of(const Json& parameters) {
    return text_of(member(parameters, "textDocument"), "uri");
}

// --- requests ---------------------------------------------------------------------------------------------------

Json hover(const ReadPattern& read, const Json& parameters, const Monitor& monitor) {
    const Occurrence* name = read.name_at(parameters);
    std::string help = name ? help_for(*name, read.pattern, read.names) : "";
    if (help.empty()) return nullptr;
    if (name->kind == NameKind::key && lower_case(name->where.view()) == "derivation length") {
        try {
            if (const auto plain = compiled(read, "")) help += "\n\n" + growth_table(*plain, monitor);
        } catch (const Stopped&) {  // without the table
        }
    }
    return {{"contents", markdown(help)}, {"range", range_of(read.positions, name->where)}};
}

Json completion(const ReadPattern& read, const Json& parameters, const Monitor& /*monitor*/) {
    enum ItemKind : int { property = 10, value = 12 };
    const std::size_t cursor = read.positions.offset(place_of(member(parameters, "position")));
    const Completions found = complete(read.pattern, cursor);
    const Json range = range_of(read.positions, found.begin, cursor);
    Json items = Json::array();
    for (const Completion& each : found.items) {
        Json item = {{"label", each.label},
                     {"kind", each.is_key ? property : value},
                     {"textEdit", {{"range", range}, {"newText", each.insert}}}};
        if (!each.detail.empty()) item["detail"] = each.detail;
        if (!each.help.empty()) item["documentation"] = markdown(each.help);
        items.push_back(std::move(item));
    }
    return {{"isIncomplete", false}, {"items", std::move(items)}};
}

Json definition(const ReadPattern& read, const Json& parameters, const Monitor& /*monitor*/) {
    const Occurrence* name = read.name_at(parameters);
    if (!name) return nullptr;
    Json places = Json::array();
    for (const Occurrence& each : read.names) {
        if (!each.is_definition || !each.is_same(*name)) continue;
        places.push_back({{"uri", address_of(parameters)}, {"range", range_of(read.positions, each.where)}});
    }
    return places;
}

Json prepare_rename(const ReadPattern& read, const Json& parameters, const Monitor& /*monitor*/) {
    const Occurrence* name = read.name_at(parameters);
    require_renamable(name);
    return {{"range", range_of(read.positions, name->where)}, {"placeholder", name->where.view()}};
}

Json rename(const ReadPattern& read, const Json& parameters, const Monitor& /*monitor*/) {
    const Occurrence* name = read.name_at(parameters);
    require_renamable(name);
    const std::vector<TextEdit> edits = renaming(read.pattern, read.names, *name, text_of(parameters, "newName"));
    Json changes = Json::object();
    changes[address_of(parameters)] = edits_of(read.positions, edits);
    return {{"changes", std::move(changes)}};
}

Json format(const ReadPattern& read, const Json& /*parameters*/, const Monitor& /*monitor*/) {
    if (read.diagnostics.is_unreadable()) return Json::array();
    return edits_of(read.positions, formatting(read.pattern));
}

Json colours(const ReadPattern& read, const Json& /*parameters*/, const Monitor& /*monitor*/) {
    Json list = Json::array();
    const auto look = [&](const Key& key) {
        if (!has_colours(key.name)) return;
        for_each_word(key.value, [&](std::string_view word, const Span& where) {
            const auto colour = parse_colour(word);
            if (!colour) return;
            const auto share = [](std::uint8_t channel) { return channel / 255.0; };
            list.push_back({{"range", range_of(read.positions, where)},
                            {"color",
                             {{"red", share(colour->red)},
                              {"green", share(colour->green)},
                              {"blue", share(colour->blue)},
                              {"alpha", share(colour->alpha)}}}});
        });
    };
    for (const Key& key : read.pattern.keys) {
        if (key.value.source == read.pattern.source.get()) look(key);
    }
    for (const Variant& variant : read.pattern.variants) {
        for (const Key& setting : variant.settings) look(setting);
    }
    return list;
}

Json lenses(const ReadPattern& read, const Json& /*parameters*/, const Monitor& monitor) {
    Json list = Json::array();
    const auto add = [&](const Document& drawn, const Span& where) {
        const std::string text = measures_text(drawn, monitor);
        if (text.empty()) return;
        list.push_back(
            {{"range", range_of(read.positions, where)},
             {"command", {{"title", fmt::format("n = {}: {}", drawn.grammar().steps(), text)}, {"command", ""}}}});
    };
    try {
        const auto plain = compiled(read, "");
        const Key* length = read.pattern.find("derivation length");
        if (plain && length) {
            add(*plain, length->name_at);
            try {
                const auto next = static_cast<std::int64_t>(plain->grammar().steps()) + 1;
                add(plain->with({{"derivation length", fmt::format("{}", next)}}), length->name_at);
            } catch (const PatternError&) {  // the schedule ends there
            }
        }
        for (const Variant& variant : read.pattern.variants) {
            monitor.check();
            if (const auto varied = compiled(read, std::string(variant.name.view()))) add(*varied, variant.name);
        }
    } catch (const Stopped&) {  // those found so far are shown
    }
    return list;
}

Json tokens(const ReadPattern& read, const Json& /*parameters*/, const Monitor& /*monitor*/) {
    Json data = Json::array();
    EditorPosition last;
    for (const Occurrence& each : read.names) {
        const auto type = token_type(each);
        if (!type) continue;
        const EditorPosition begin = read.positions.position(each.where.at);
        const EditorPosition end = read.positions.position(std::size_t{each.where.at} + each.where.length);
        if (end.line != begin.line) continue;  // a continued line
        data.push_back(begin.line - last.line);
        data.push_back(begin.line == last.line ? begin.character - last.character : begin.character);
        data.push_back(end.character - begin.character);
        data.push_back(*type);
        data.push_back(0);
        last = begin;
    }
    return {{"data", std::move(data)}};
}

}  // namespace

ReadPattern::ReadPattern(const std::string& name, const std::string& text)
    : pattern(parse_pattern(name, text, diagnostics)), positions(pattern.source->text()) {
    if (!diagnostics.is_unreadable()) names = occurrences(pattern);
}

const Occurrence* ReadPattern::name_at(const Json& parameters) const {
    return find_occurrence(names, positions.offset(place_of(member(parameters, "position"))));
}

EditorAnswer find_editor_answer(std::string_view method) {
    struct Row {
        std::string_view method;
        EditorAnswer answer;
    };
    static constexpr std::array rows = {
        Row{"textDocument/hover", hover},
        Row{"textDocument/completion", completion},
        Row{"textDocument/definition", definition},
        Row{"textDocument/prepareRename", prepare_rename},
        Row{"textDocument/rename", rename},
        Row{"textDocument/formatting", format},
        Row{"textDocument/documentColor", colours},
        Row{"textDocument/codeLens", lenses},
        Row{"textDocument/semanticTokens/full", tokens},
    };
    const auto* found = std::find_if(rows.begin(), rows.end(), [&](const Row& row) { return row.method == method; });
    return found == rows.end() ? nullptr : found->answer;
}

Json colour_texts(const Json& parameters) {
    const Json& colour = member(parameters, "color");
    const auto channel = [&](const char* name, double otherwise) {
        return static_cast<unsigned>(std::lround(255 * std::clamp(number_of(colour, name, otherwise), 0.0, 1.0)));
    };
    std::string text = fmt::format("#{:02x}{:02x}{:02x}", channel("red", 0), channel("green", 0), channel("blue", 0));
    const unsigned alpha = channel("alpha", 1);
    Json list = Json::array();
    if (alpha < 255) {
        list.push_back({{"label", fmt::format("{}{:02x}", text, alpha)}});
        return list;
    }
    const std::string name = colour_name(*parse_colour(text));
    list.push_back({{"label", text}});
    if (name != text) list.push_back({{"label", name}});
    return list;
}

Json editor_diagnostics(const std::string& name, const std::string& text, const Monitor& monitor) {
    const TextPositions positions(text);
    Json list = Json::array();
    for (const Diagnostic& one : check_pattern(name, text, all_interpreters(), monitor)) {
        const bool is_in_text = one.where.line > 0;
        const std::size_t begin = is_in_text ? positions.offset(one.where) : 0;
        const std::size_t end = is_in_text ? end_of_word(text, begin) : 0;
        list.push_back(diagnostic(range_of(positions, begin, end), one.warning ? Severity::warning : Severity::error,
                                  is_in_text ? one.message : one.file + ": " + one.message));
    }
    return list;
}

Json whole_document_diagnostics(Severity severity, const std::string& message) {
    const Json beginning = json_of(EditorPosition{});
    return Json::array({diagnostic({{"start", beginning}, {"end", beginning}}, severity, message)});
}

Json token_types() {
    return token_type_names;
}

}  // namespace sikku
