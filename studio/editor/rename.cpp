#include "studio/editor/rename.h"

#include "engine/base/text.h"
#include "engine/language/document.h"
#include "engine/language/map_system.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

namespace sikku {
namespace {

/// Compiles a text. @throws RenameError with the first error
Document compiled(const Pattern& pattern, std::string text, std::string_view consequence) {
    Diagnostics diagnostics;
    Document document = Document::compile(pattern.source->name(), std::move(text), {}, diagnostics);
    for (const Diagnostic& one : diagnostics.sorted()) {
        if (!one.warning) {
            throw RenameError(fmt::format("{}: line {}: {}", consequence, one.where.line, one.message));
        }
    }
    return document;
}

/// Symbols are numbered in the order of the text, so the symbols of both grammars correspond.
bool has_same_effect(const Grammar& one, const Grammar& other) {
    const auto& a = one.symbols();
    const auto& b = other.symbols();
    const bool is_same =
        std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const SymbolInfo& x, const SymbolInfo& y) {
            return x.command.action == y.command.action && x.arity == y.arity && x.arguments == y.arguments &&
                   (x.letter == "%") == (y.letter == "%");
        });
    if (!is_same || !one.map() || !other.map()) return is_same && !one.map() == !other.map();
    return one.map()->labels.size() == other.map()->labels.size();
}

bool sounds_names(const Pattern& pattern) {
    const Key* key = pattern.find("named notes");
    return key && lower_case(key->value.view()) == "yes";
}

}  // namespace

void require_renamable(const Occurrence* name) {
    if (!name || name->kind == NameKind::arrow) throw RenameError("no name at this place");
    if (name->kind == NameKind::key) throw RenameError("a key cannot be renamed");
}

std::vector<TextEdit> renaming(const Pattern& pattern, const std::vector<Occurrence>& all, const Occurrence& name,
                               const std::string& new_name) {
    require_renamable(&name);
    const std::string old_name(name.where.view());
    if (new_name == old_name) return {};
    const std::string shown = printable(new_name, 80);
    if (name.kind == NameKind::symbol && sounds_names(pattern)) {
        throw RenameError("under 'named notes: yes' the name of a symbol is its note; it cannot be renamed");
    }
    const Document before = compiled(pattern, pattern.source->text(), "the pattern has errors");
    std::vector<TextEdit> edits;
    for (const Occurrence& each : all) {
        if (each.kind == name.kind && each.production == name.production && each.where.view() == new_name) {
            throw RenameError(fmt::format("'{}' is already in use", shown));
        }
        if (each.is_same(name))
            edits.push_back({each.where.at, std::size_t{each.where.at} + each.where.length, new_name});
    }
    const Document after =
        compiled(pattern, with_edits(pattern.source->text(), edits), fmt::format("'{}' is not a valid name", shown));
    const std::vector<Occurrence> renamed = occurrences(after.pattern());
    const bool is_same = std::equal(
        all.begin(), all.end(), renamed.begin(), renamed.end(), [&](const Occurrence& a, const Occurrence& b) {
            return a.kind == b.kind && a.is_definition == b.is_definition &&
                   b.where.view() == (a.is_same(name) ? std::string_view(new_name) : a.where.view());
        });
    if (!is_same)
        throw RenameError(fmt::format("'{}' is not a valid name here, or already has another meaning", shown));
    if (!has_same_effect(before.grammar(), after.grammar())) {
        throw RenameError(
            fmt::format("renaming '{}' to '{}' would change the meaning of the pattern", old_name, shown));
    }
    return edits;
}

}  // namespace sikku
