#include "engine/language/module_types.h"

#include "engine/language/defines.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

namespace sikku {
namespace {

std::string type_key(std::string_view letter, std::size_t parameters) {
    return fmt::format("{}({}", letter, parameters);
}

}  // namespace

ModuleTypes::ModuleTypes(const Pattern& pattern, const SymbolNames& names) {
    std::unordered_set<std::string_view> formals;  // parameters of the current production
    const auto mentions = [&](const Span& text) { return text.view().find('(') != std::string_view::npos; };
    const auto is_computed = [&](const Span& part) {
        const auto mentioned = names_in(part.view());
        return std::any_of(mentioned.begin(), mentioned.end(),
                           [&](std::string_view name) { return name == "random" || formals.contains(name); });
    };
    const auto computed = [&](std::string_view letter, const std::vector<Span>& parts, const Span&) {
        if (std::any_of(parts.begin(), parts.end(), is_computed)) types_.insert(type_key(letter, parts.size()));
    };
    const auto named = [&](std::string_view letter, const std::vector<Span>& parts, const Span&) {
        if (parts.empty()) return;
        types_.insert(type_key(letter, parts.size()));
        for (const Span& part : parts) formals.insert(part.view());
    };
    const auto look_at = [&](const std::vector<ProductionText>& productions) {
        for (const ProductionText& text : productions) {
            formals.clear();
            for (const auto& span : {text.left, std::optional(text.predecessor), text.right}) {
                if (span && mentions(*span)) for_each_symbol(names, *span, named);
            }
            if (mentions(text.successor)) for_each_symbol(names, text.successor, computed);
        }
    };
    look_at(pattern.common);
    for (const TableText& table : pattern.tables) look_at(table.productions);
    look_at(pattern.interpret);
    const Key* axiom = pattern.find("axiom");
    if (axiom && axiom->value.view().find("random") != std::string_view::npos) {
        for_each_symbol(names, axiom->value, computed);
    }
}

bool ModuleTypes::contains(std::string_view letter, std::size_t parameters) const {
    return !types_.empty() && types_.contains(type_key(letter, parameters));
}

}  // namespace sikku
