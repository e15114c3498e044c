#include "studio/editor/occurrences.h"

#include "engine/base/keys.h"
#include "engine/base/text.h"
#include "engine/language/defines.h"
#include "engine/language/word_scanner.h"

#include <algorithm>
#include <iterator>
#include <set>
#include <string>
#include <string_view>

namespace sikku {
namespace {

class Collector {
public:
    explicit Collector(const Pattern& pattern) : pattern_(pattern), names_(pattern, ignored_) {
        for (const Define& define : pattern.defines) defines_.insert(define.name.view());
        for (const TableText& table : pattern.tables) tables_.insert(table.name.view());
    }

    std::vector<Occurrence> run() {
        for (const Key& key : pattern_.keys) add_key(key);
        for (const Define& define : pattern_.defines) {
            add(define.name, NameKind::define, true);
            add_expression(define.value);
        }
        for (const ProductionText& production : pattern_.common) add_production(production);
        for (const TableText& table : pattern_.tables) {
            add(table.name, NameKind::table, true);
            for (const ProductionText& production : table.productions) add_production(production);
        }
        for (const ProductionText& production : pattern_.interpret) add_production(production);
        for (const PatchText& patch : pattern_.patches) add(patch.name, NameKind::surface, true);
        for (const Variant& variant : pattern_.variants) add_variant(variant);
        std::stable_sort(found_.begin(), found_.end(),
                         [](const Occurrence& a, const Occurrence& b) { return a.where.at < b.where.at; });
        return std::move(found_);
    }

private:
    void add(const Span& where, NameKind kind, bool is_definition = false) {
        if (where.source != pattern_.source.get() || where.empty()) return;
        found_.push_back({where, kind, is_definition, kind == NameKind::formal ? production_ : 0});
    }

    void add_key(const Key& key) {
        const KeyInfo* row = find_language_key(key.name);
        if (!row || key.name_at.source != pattern_.source.get()) return;
        if (row->is_for_symbols()) {
            const std::size_t symbol = key.name.size() - row->before_symbol().size();
            const std::size_t name = key.name_at.length - std::min<std::size_t>(symbol, key.name_at.length);
            add(key.name_at.part(0, name).trimmed(), NameKind::key);
            add_word(key.name_at.part(name), WordRole::used);
        } else {
            add(key.name_at, NameKind::key);
        }
        add_value(*row, key.value);
    }

    void add_value(const KeyInfo& row, const Span& value) {
        if (has_symbols(row)) {
            add_word(value, row.name == "symbols" ? WordRole::listed : WordRole::used);
        } else if (row.name == "schedule") {
            add_schedule(value);
        } else if (row.name == "surface") {
            add_surfaces(value);
        }
    }

    /// Names of tables, and of defines in their counts; there, `n` is the derivation length.
    void add_schedule(const Span& value) {
        const std::string_view text = value.view();
        std::size_t depth = 0;
        for (std::size_t at = 0; at < text.size();) {
            if (text[at] == '(') ++depth;
            if (text[at] == ')' && depth > 0) --depth;
            std::size_t end = at;
            while (end < text.size() && std::string_view(" \t*,()").find(text[end]) == std::string_view::npos) ++end;
            const std::string_view name = text.substr(at, end - at);
            const std::size_t before = text.find_last_not_of(" \t", at == 0 ? std::string_view::npos : at - 1);
            const bool is_count = at > 0 && before < at && text[before] == '*';
            if (depth == 0 && !is_count && tables_.contains(name)) {
                add(value.part(at, end - at), NameKind::table);
            } else if (end > at) {
                add_expression(value.part(at, end - at), "n");
            }
            at = std::max(end, at + 1);
        }
    }

    /// `leaf = leaf.s, petal = petal.s`
    void add_surfaces(const Span& value) {
        std::string_view rest = value.view();
        while (!rest.empty()) {
            const std::size_t begin = value.length - rest.size();
            const std::size_t comma = std::min(rest.find(','), rest.size());
            const std::size_t equals = rest.find('=');
            if (equals < comma) add(value.part(begin, equals).trimmed(), NameKind::surface, true);
            rest.remove_prefix(std::min(comma + 1, rest.size()));
        }
    }

    void add_variant(const Variant& variant) {
        add(variant.name, NameKind::variant, true);
        for (const Key& setting : variant.settings) {
            const std::string name = lower_case(setting.name);
            if (defines_.contains(setting.name)) {
                add(setting.name_at, NameKind::define);
                add_expression(setting.value);
            } else if (const KeyInfo* row = find_language_key(name); row && !row->is_for_symbols()) {
                add(setting.name_at, NameKind::key);
                add_value(*row, setting.value);
            }
        }
    }

    void add_production(const ProductionText& production) {
        production_ = production.whole.at;
        formals_.clear();
        for (const auto& context : {production.left, production.right}) {
            if (context) add_word(*context, WordRole::context);
        }
        add_word(production.predecessor, WordRole::predecessor);
        if (production.condition) add_expression(*production.condition);
        std::size_t left = production.predecessor.at + production.predecessor.length;
        for (const auto& part : {production.right, production.condition}) {
            if (part) left = part->at + part->length;
        }
        const std::size_t arrow = production.whole.view().find("-->", left - production.whole.at);
        if (arrow != std::string_view::npos) add(production.whole.part(arrow, 3), NameKind::arrow);
        add_word(production.successor, WordRole::used);
        if (production.weight) add_expression(*production.weight);
        formals_.clear();
    }

    enum class WordRole : std::uint8_t { used, context, predecessor, listed };

    void add_word(const Span& word, WordRole role) {
        bool is_first = true;
        for_each_symbol(
            names_, word, [&](std::string_view letter, const std::vector<Span>& parameters, const Span& where) {
                const Span name = where.part(0, letter.size());
                const bool is_surface = letter.size() > 1 && letter.front() == '~';
                const bool defines = (role == WordRole::predecessor && is_first) || role == WordRole::listed;
                if (is_surface) {
                    add(name.part(1), NameKind::surface);
                } else {
                    add(name, NameKind::symbol, defines);
                }
                is_first = false;
                for (const Span& parameter : parameters) add_parameter(parameter, role);
            });
    }

    void add_parameter(const Span& parameter, WordRole role) {
        if (role != WordRole::context && role != WordRole::predecessor) return add_expression(parameter);
        if (!is_expression_name(parameter.view())) return;
        formals_.insert(parameter.view());
        add(parameter, NameKind::formal, true);
    }

    /// @param reserved  a name with another meaning in this expression
    void add_expression(const Span& text, std::string_view reserved = {}) {
        for (const std::string_view name : names_in(text.view())) {
            if (name == reserved) continue;
            const auto begin = static_cast<std::size_t>(name.data() - text.view().data());
            if (formals_.contains(name)) {
                add(text.part(begin, name.size()), NameKind::formal);
            } else if (defines_.contains(name)) {
                add(text.part(begin, name.size()), NameKind::define);
            }
        }
    }

    const Pattern& pattern_;
    Diagnostics ignored_;  // before names_, which reports to it
    SymbolNames names_;
    std::set<std::string_view> defines_, tables_, formals_;
    std::size_t production_ = 0;  // offset of the current production
    std::vector<Occurrence> found_;
};

}  // namespace

bool has_symbols(const KeyInfo& key) {
    constexpr std::string_view names[] = {"axiom", "forward",  "move",   "edge SYMBOL", "mirror",
                                          "edges", "consider", "ignore", "symbols"};
    return std::find(std::begin(names), std::end(names), key.name) != std::end(names);
}

bool Occurrence::is_same(const Occurrence& other) const {
    return kind == other.kind && production == other.production && where.view() == other.where.view();
}

std::vector<Occurrence> occurrences(const Pattern& pattern) {
    return Collector(pattern).run();
}

const Occurrence* find_occurrence(const std::vector<Occurrence>& all, std::size_t offset) {
    const Occurrence* ending = nullptr;
    for (const Occurrence& each : all) {
        if (each.where.at > offset) break;
        const std::size_t end = std::size_t{each.where.at} + each.where.length;
        if (offset < end) return &each;
        if (offset == end) ending = &each;
    }
    return ending;
}

}  // namespace sikku
