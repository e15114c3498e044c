#include "engine/check.h"

#include "engine/derivation/derivation.h"
#include "engine/measure/fold.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <tuple>
#include <utility>

namespace sikku {
namespace {

constexpr std::size_t most_variant_bytes = std::size_t{256} << 20;  // of all variants together
constexpr std::size_t most_pattern_errors = 50;
constexpr double most_compositions = 100'000;  // symbols times steps, which take a few milliseconds

/// True if each bracket and each brace in the text has its counterpart.
bool is_balanced(std::string_view text) {
    for (const auto& [opening, closing] : {std::pair('[', ']'), std::pair('{', '}')}) {
        std::int64_t depth = 0;
        for (const char byte : text) {
            depth += byte == opening ? 1 : byte == closing ? -1 : 0;
            if (depth < 0) return false;
        }
        if (depth != 0) return false;
    }
    return true;
}

/// The axiom or the first successor whose brackets or braces do not balance; else the axiom.
Span unbalanced_span(const Pattern& pattern) {
    std::vector<const std::vector<ProductionText>*> lists = {&pattern.common};
    for (const TableText& table : pattern.tables) lists.push_back(&table.productions);
    lists.push_back(&pattern.interpret);
    const Key* axiom = pattern.find("axiom");
    if (axiom && !is_balanced(axiom->value.view())) return axiom->value;
    for (const std::vector<ProductionText>* productions : lists) {
        for (const ProductionText& production : *productions) {
            if (!is_balanced(production.successor.view())) return production.successor;
        }
    }
    return axiom ? axiom->value : Span();
}

class Checker {
public:
    Checker(std::span<const Interpreter* const> interpreters, const Monitor& monitor)
        : interpreters_(interpreters), monitor_(monitor) {}

    std::vector<Diagnostic> run(std::string name, std::string text) {
        Diagnostics diagnostics;
        const Pattern pattern = parse_pattern(std::move(name), std::move(text), diagnostics);
        if (!diagnostics.is_unreadable()) check(pattern, diagnostics);
        collect(diagnostics);
        if (!diagnostics.is_unreadable()) check_variants(pattern);
        std::stable_sort(found_.begin(), found_.end(), [](const Diagnostic& a, const Diagnostic& b) {
            return std::tie(a.where.line, a.where.column) < std::tie(b.where.line, b.where.column);
        });
        return std::move(found_);
    }

private:
    void collect(const Diagnostics& diagnostics) {
        for (const Diagnostic& one : diagnostics.sorted()) {
            if (!known_.insert(one.text()).second) continue;
            found_.push_back(one);
            if (!one.warning) ++errors_;
        }
    }

    void check(const Pattern& pattern, Diagnostics& diagnostics) const {
        monitor_.check();
        check_keys(pattern, diagnostics);
        const Grammar grammar = compile_grammar(pattern, diagnostics);
        for (const Interpreter* interpreter : interpreters_) interpreter->check_keys(pattern, diagnostics);
        if (diagnostics.has_errors()) return;
        check_brackets(pattern, grammar, diagnostics);
        for (const Interpreter* interpreter : interpreters_) {
            interpreter->check_grammar(pattern, grammar, diagnostics);
        }
    }

    /// Compiles and checks each variant; rejects too many variants of a large pattern, which would take minutes.
    void check_variants(const Pattern& pattern) {
        const std::size_t size = pattern.source->text().size();
        if (pattern.variants.size() > 1 && size > most_variant_bytes / pattern.variants.size()) {
            Diagnostics diagnostics;
            diagnostics.error(
                pattern.variants.front().name,
                fmt::format("too many variants to check: {1} of {0} bytes each; at most 256 MB in total", size,
                            pattern.variants.size()));
            return collect(diagnostics);
        }
        for (const Variant& variant : pattern.variants) {
            if (errors_ >= most_pattern_errors) return;
            Diagnostics diagnostics;
            Pattern varied = pattern;
            apply_overrides(varied, variant.name.view(), {}, diagnostics);
            check(varied, diagnostics);
            collect(diagnostics);
        }
    }

    std::span<const Interpreter* const> interpreters_;
    const Monitor& monitor_;
    std::vector<Diagnostic> found_;
    std::set<std::string> known_;
    std::size_t errors_ = 0;
};

}  // namespace

void check_brackets(const Pattern& pattern, const Grammar& grammar, Diagnostics& diagnostics) {
    const double steps = static_cast<double>(grammar.steps()) + 1;
    // A map has no word, and its brackets are checked with its productions.
    if (grammar.map() || grammar.is_spatial()) return;
    if (static_cast<double>(1 + grammar.symbols().size()) * steps > most_compositions) return;
    try {
        fold(grammar, true);
    } catch (const WordError& error) {
        diagnostics.error(unbalanced_span(pattern), error.what());
    }
}

std::vector<Diagnostic> check_pattern(std::string name, std::string text,
                                      std::span<const Interpreter* const> interpreters, const Monitor& monitor) {
    return Checker(interpreters, monitor).run(std::move(name), std::move(text));
}

}  // namespace sikku
