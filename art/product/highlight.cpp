#include "art/product/highlight.h"

#include "art/style/contrast.h"
#include "art/style/white_paper.h"
#include "engine/base/text.h"
#include "engine/derivation/lineage.h"
#include "engine/derivation/neighbourhood.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace sikku {
namespace {

[[noreturn]] void refuse_highlight(const Highlight& highlight, const std::string& why) {
    refuse_option(
        "highlight",
        highlight.symbol ? fmt::format("{}:{}", highlight.step, *highlight.symbol) : std::to_string(highlight.step),
        why);
}

/// A word. `parts` has for each symbol the number of the replaced symbol that it comes from, from 1; 0: none.
struct TracedWord {
    ModuleWord word;
    std::vector<std::uint32_t> parts;
    std::uint32_t count = 0;  ///< symbols that the step replaced
    std::string chosen;       ///< text of the symbol that is highlighted, if one was chosen
};

/// Derives a word step by step.
class HighlightTracer {
public:
    HighlightTracer(const Grammar& grammar, const Highlight& highlight, double budget, const Monitor& monitor)
        : grammar_(grammar),
          highlight_(highlight),
          budget_(budget),
          monitor_(monitor),
          options_(DerivationOptions::within(budget, [this](std::uint64_t symbols) { monitor_.advance(symbols); })),
          work_(options_) {
        traced_.word = grammar.axiom_modules();
        count(0);
    }

    TracedWord trace() {
        std::int64_t done = 0;
        for (const ScheduleRun& run : grammar_.schedule()) {
            for (std::int64_t i = 0; i < run.steps; ++i) step(grammar_.tables()[run.table], ++done);
        }
        if (grammar_.interpretation()) step(*grammar_.interpretation(), done + 1);
        return std::move(traced_);
    }

private:
    void step(const Table& table, std::int64_t number) {
        monitor_.check();
        StepOrigins origins;
        ModuleWord next = rewrite(grammar_, table, traced_.word, number, options_, work_, origins);
        std::vector<std::uint32_t> before;
        if (number == highlight_.step && number <= grammar_.steps()) {
            before = number_replaced(table, origins.applied);
        } else if (!traced_.parts.empty()) {
            before = std::move(traced_.parts);
        }
        traced_.parts.clear();
        if (!before.empty()) {
            for (const std::uint32_t parent : origins.parents) traced_.parts.push_back(before[parent]);
        }
        traced_.word = std::move(next);
        count(number);
    }

    void count(std::int64_t number) {
        visited_ += static_cast<double>(traced_.word.symbols.size()) + 1;
        if (visited_ > budget_) {
            throw BudgetError(
                fmt::format("those up to step {} have more than {:.0f} symbols in all", number, budget_));
        }
    }

    /// Numbers the symbols that productions replace. Symbols that one production replaces together count as one.
    std::vector<std::uint32_t> number_replaced(const Table& table, const std::vector<std::uint32_t>& applied) {
        std::vector<std::uint32_t> numbers(applied.size(), 0);
        for (std::size_t i = 0; i < applied.size();) {
            if (applied[i] == StepOrigins::stays || applied[i] == StepOrigins::is_cut) {
                ++i;
                continue;
            }
            const std::size_t length = table.production(applied[i]).predecessor.size();
            const std::size_t end = std::min(i + std::max<std::size_t>(length, 1), applied.size());
            ++traced_.count;
            if (highlight_.symbol == traced_.count) traced_.chosen = text_of(i, end);
            for (; i < end; ++i) numbers[i] = traced_.count;
        }
        return numbers;
    }

    std::string text_of(std::size_t begin, std::size_t end) const {
        const double* next = traced_.word.arguments.data();
        std::string text;
        for (std::size_t i = 0; i < end; ++i) {
            const SymbolInfo& info = grammar_.symbols()[traced_.word.symbols[i]];
            if (i >= begin) append_symbol(info, {next, info.arity}, text);
            next += info.arity;
        }
        return text;
    }

    const Grammar& grammar_;
    Highlight highlight_;
    double budget_;
    double visited_ = 0;  ///< symbols of all words
    const Monitor& monitor_;
    DerivationOptions options_;
    MatchingWork work_;
    TracedWord traced_;
};

/// Inserts colours into a written word.
class ColouredWord {
public:
    /// @param colours  number of colours of parts, which follow that of everything else @param chosen  the part that
    /// is lit; absent: all @param moves_draw  moves are points of splines
    ColouredWord(const Grammar& grammar, int colours, std::optional<std::uint64_t> chosen, bool moves_draw)
        : colours_(colours), chosen_(chosen), moves_draw_(moves_draw) {
        parts_.symbols = grammar.symbols();
        first_ = static_cast<Symbol>(parts_.symbols.size());
        for (int i = 0; i <= colours + 1; ++i) {
            SymbolInfo info;
            info.command.action = Action::colour_set;
            info.command.value = i;
            parts_.symbols.push_back(info);
        }
    }

    Grammar coloured(const Grammar& grammar, const std::vector<std::uint32_t>& parts) {
        const Word& word = grammar.axiom();
        for (std::size_t i = 0; i < word.size(); ++i) {
            const Action action = parts_.symbols[word[i]].command.action;
            if (action == Action::colour_set || action == Action::colour_step) continue;
            if (action == Action::polygon_begin) ++open_;
            if (needs_colour(action)) set(action == Action::draw && open_ > 0 ? colours_ + 1 : colour_of(parts, i));
            if (action == Action::polygon_end && open_ > 0) --open_;
            if (action == Action::pop) current_ = -1;
            parts_.axiom.push_back(word[i]);
        }
        return grammar.with_parts(std::move(parts_));
    }

private:
    bool needs_colour(Action action) const {
        return (action == Action::move && moves_draw_) || action == Action::draw || action == Action::polygon_end ||
               action == Action::edge_end || action == Action::disc || action == Action::surface ||
               action == Action::label || action == Action::polygon_begin || action == Action::edge_begin;
    }
    int colour_of(const std::vector<std::uint32_t>& parts, std::size_t at) const {
        const std::uint32_t part = parts.empty() ? 0 : parts[at];
        if (part == 0) return 0;
        if (chosen_) return part == *chosen_ ? 1 : 0;
        return 1 + static_cast<int>((part - 1) % static_cast<std::uint32_t>(colours_));
    }
    void set(int colour) {
        if (colour == current_) return;
        parts_.axiom.push_back(first_ + static_cast<Symbol>(colour));
        current_ = colour;
    }

    Grammar::PlainParts parts_;
    Symbol first_ = 0;
    int colours_;
    std::optional<std::uint64_t> chosen_;
    bool moves_draw_;   ///< points of splines
    int current_ = -1;  ///< of the turtle; -1: unknown
    int open_ = 0;      ///< polygons
};

Style lit_style(const Style& given, bool has_choice) {
    constexpr double pale_line = 0.28, pale_fill = 0.1, pale_edge = 0.5;
    const std::vector<Colour> colours = lit_colours(given.ground);
    Colour ink = given.line_colour({});
    ink.alpha = 255;
    Style style = given;
    style.palette = {tint(ink, given.ground, pale_line)};
    style.palette.insert(style.palette.end(), colours.begin(), colours.end());
    style.palette.push_back(has_choice ? tint(ink, given.ground, pale_edge) : ink);
    style.stroke_colour.reset();
    style.fill = tint(ink, given.ground, pale_fill);
    style.fields.reset();
    style.tile_colours.reset();
    style.decoration = {};
    style.cut_layers.clear();
    return style;
}

}  // namespace

std::vector<Colour> lit_colours(const std::optional<Colour>& ground) {
    if (ground && ground->alpha > 0 && lightness(*ground) < 0.55) {
        return {{0xff, 0xc8, 0x57, 255}, {0x8f, 0xd3, 0xe8, 255}, {0xff, 0x9b, 0x85, 255},
                {0xb8, 0xe0, 0x7a, 255}, {0xd9, 0xb3, 0xff, 255}, {0xff, 0xff, 0xff, 255}};
    }
    return {{0xb3, 0x45, 0x2c, 255}, {0x1f, 0x6f, 0x8b, 255}, {0xd9, 0x8e, 0x04, 255},
            {0x5b, 0x7f, 0x2b, 255}, {0x7b, 0x4b, 0x94, 255}, {0xc2, 0x67, 0x8f, 255}};
}

Colour tint(Colour ink, const std::optional<Colour>& ground, double share) {
    Colour result = mixed(ground_or_white(ground), ink, share);
    result.alpha = 255;
    return result;
}

LitDrawing lit_drawing(const Grammar& grammar, const Style& style, const Highlight& highlight, double budget,
                       const Monitor& monitor) {
    if (grammar.steps() == 0) refuse_highlight(highlight, "the derivation length is 0, so no step replaces anything");
    if (highlight.step > grammar.steps()) {
        refuse_highlight(highlight,
                         fmt::format("expected a step from 1 to the derivation length, {}", grammar.steps()));
    }
    TracedWord traced;
    try {
        traced = HighlightTracer(grammar, highlight, budget, monitor).trace();
    } catch (const BudgetError& error) {
        throw BudgetError(fmt::format("'highlight' keeps whole words in memory: {}", error.what()));
    }
    if (traced.count == 0) {
        refuse_highlight(highlight, fmt::format("no production is applied in step {}", highlight.step));
    }
    if (highlight.symbol && *highlight.symbol > traced.count) {
        refuse_highlight(highlight,
                         fmt::format("step {} replaces only {}", highlight.step, counted(traced.count, "symbol")));
    }
    const auto written = grammar.written_out(traced.word);
    if (!written)
        throw BudgetError(
            "'highlight' keeps whole words in memory: the word has more than 524,288 different modules");
    const int colours = static_cast<int>(lit_colours(style.ground).size());
    ColouredWord coloured(*written, colours, highlight.symbol, style.moves_draw());
    std::string fact = fmt::format("step {} replaces {}", highlight.step, counted(traced.count, "symbol"));
    if (highlight.symbol) fact += fmt::format("; number {} is {}", *highlight.symbol, traced.chosen);
    return {coloured.coloured(*written, traced.parts), lit_style(style, highlight.symbol.has_value()),
            std::move(fact)};
}

}  // namespace sikku
