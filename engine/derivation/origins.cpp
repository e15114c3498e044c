#include "engine/derivation/origins.h"

#include "engine/derivation/levels.h"
#include "engine/language/word_scanner.h"

#include <algorithm>
#include <limits>
#include <map>
#include <stdexcept>

namespace sikku {
namespace {

constexpr std::int64_t most_levels = 10'000;
constexpr std::size_t most_lengths = std::size_t{1} << 22;

std::uint64_t sum(std::uint64_t a, std::uint64_t b) {
    return a > std::numeric_limits<std::uint64_t>::max() - b ? std::numeric_limits<std::uint64_t>::max() : a + b;
}

/// Spans of the symbols of a word, in the text of the pattern.
std::vector<Span> symbol_spans(const SymbolNames& names, const Span& word) {
    std::vector<Span> spans;
    for_each_symbol(names, word,
                    [&](std::string_view, const std::vector<Span>&, const Span& where) { spans.push_back(where); });
    return spans;
}

}  // namespace

class OriginTracer::Implementation {
public:
    explicit Implementation(const Document& document)
        : pattern_(document.pattern()),
          grammar_(document.grammar()),
          levels_(grammar_, true),
          names_(pattern_, diagnostics_),
          symbols_(grammar_.symbols().size()) {
        const auto& tables = grammar_.tables();
        const bool is_traced =
            grammar_.is_plain() && !grammar_.cut() &&
            std::all_of(tables.begin(), tables.end(), [](const Table& table) { return table.context_free(); });
        if (!is_traced) {
            throw std::runtime_error(
                "origins of symbols need productions without contexts, parameters and random choices");
        }
        if (levels_.count() > most_levels ||
            static_cast<std::size_t>(levels_.count() + 1) * symbols_ > most_lengths) {
            throw std::runtime_error("origins of symbols are available up to 10,000 steps");
        }
        for (std::size_t i = 0; i < tables.size(); ++i) {
            const bool has_own = !pattern_.tables.empty();
            add_table(tables[i], pattern_.common, has_own ? std::span(pattern_.tables[i].productions) : Texts());
        }
        if (grammar_.interpretation()) add_table(*grammar_.interpretation(), {}, pattern_.interpret);
        const Key* axiom = pattern_.find("axiom");
        if (axiom) axiom_ = symbol_spans(names_, axiom->value);
        lengths_.assign(symbols_, 1);
        for (std::int64_t level = 1; level <= levels_.count(); ++level) {
            const std::size_t below = lengths_.size() - symbols_;
            for (Symbol symbol = 0; symbol < symbols_; ++symbol) {
                const Word* successor = levels_.table(level).successor(symbol);
                std::uint64_t length = successor ? 0 : lengths_[below + symbol];
                if (successor) {
                    for (const Symbol child : *successor) length = sum(length, lengths_[below + child]);
                }
                lengths_.push_back(length);
            }
        }
    }

    /// Descends to the symbol of the word at `position`, and reports each symbol on the way: its origin, and its
    /// place in the word that contains it. False if there is no such symbol.
    template <class Report>
    bool descend(std::uint64_t position, Pulse& pulse, const Report& report) const {
        if (position == 0) return false;
        std::uint64_t before = position - 1;  // symbols of the part that precede it
        std::int64_t level = levels_.count();
        const Word* word = &grammar_.axiom();
        const std::vector<Span>* spans = &axiom_;
        Span production;
        while (true) {
            std::size_t item = 0;
            while (item < word->size() && before >= length((*word)[item], level)) {
                before -= length((*word)[item], level);
                ++item;
                pulse();
            }
            if (item == word->size() || item >= spans->size()) return false;
            const Symbol symbol = (*word)[item];
            report(Origin{(*spans)[item], production}, PathStep{symbol, item + 1});
            const Word* successor = nullptr;
            while (level > 0 && !(successor = levels_.table(level).successor(symbol))) --level;
            if (!successor) return true;
            const Made& made = made_.at(&levels_.table(level))[symbol];
            word = successor;
            spans = &made.spans;
            production = made.production;
            --level;
        }
    }

private:
    /// The successor of a symbol under a table, in the text.
    struct Made {
        Span production;
        std::vector<Span> spans;
    };

    using Texts = std::span<const ProductionText>;

    /// @param shared, own  texts of the table's productions
    void add_table(const Table& table, Texts shared, Texts own) {
        std::vector<Made>& made = made_[&table];
        made.resize(symbols_);
        // The first production of a symbol applies.
        for (std::size_t i = table.productions().size(); i > 0; --i) {
            const Production& production = table.productions()[i - 1];
            if (production.text >= shared.size() + own.size() || production.predecessor.size() != 1) continue;
            const std::size_t number = production.text;
            const ProductionText& text = number < shared.size() ? shared[number] : own[number - shared.size()];
            made[production.predecessor.front()] = {text.whole, symbol_spans(names_, text.successor)};
        }
    }
    std::uint64_t length(Symbol symbol, std::int64_t level) const {
        return lengths_[static_cast<std::size_t>(level) * symbols_ + symbol];
    }

    const Pattern& pattern_;
    const Grammar& grammar_;
    Levels levels_;
    Diagnostics diagnostics_;
    SymbolNames names_;
    std::size_t symbols_;
    std::vector<Span> axiom_;
    std::map<const Table*, std::vector<Made>> made_;
    std::vector<std::uint64_t> lengths_;  // lengths of the expansions of each symbol at each level
};

OriginTracer::OriginTracer(const Document& document)
    : implementation_(std::make_unique<const Implementation>(document)) {}

OriginTracer::~OriginTracer() = default;

Origin OriginTracer::origin(std::uint64_t position, const Monitor& monitor) const {
    Origin found;
    Pulse pulse(monitor);
    const auto note = [&](const Origin& origin, const PathStep&) { found = origin; };
    return implementation_->descend(position, pulse, note) ? found : Origin();
}

std::vector<PathStep> OriginTracer::path(std::uint64_t position) const {
    std::vector<PathStep> steps;
    const Monitor monitor;
    Pulse pulse(monitor);
    const auto note = [&](const Origin&, const PathStep& step) { steps.push_back(step); };
    if (!implementation_->descend(position, pulse, note)) return {};
    steps.pop_back();  // the symbol itself
    return steps;
}

std::vector<Origin> origins(const Document& document, std::span<const std::uint64_t> positions,
                            const Monitor& monitor) {
    const OriginTracer tracer(document);
    std::vector<Origin> all;
    all.reserve(positions.size());
    for (const std::uint64_t position : positions) {
        monitor.check();
        all.push_back(tracer.origin(position, monitor));
    }
    return all;
}

}  // namespace sikku
