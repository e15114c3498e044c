// engine/language/grammar_compiler.cpp: compiles a pattern into a grammar.
#include "engine/base/text.h"
#include "engine/language/command_table.h"
#include "engine/language/edge_reader.h"
#include "engine/language/foreign_line.h"
#include "engine/language/label_reader.h"
#include "engine/language/map_system.h"
#include "engine/language/production_compiler.h"
#include "engine/language/schedule.h"
#include "engine/language/surface.h"
#include "engine/language/undrawn.h"
#include "engine/language/word_reader.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <optional>
#include <set>

namespace sikku {
namespace {

// Limit for all tables together: each has an entry for every symbol of the grammar.
constexpr std::size_t most_places = std::size_t{1} << 22;

}  // namespace

class GrammarCompiler {
public:
    GrammarCompiler(const Pattern& pattern, Diagnostics& diagnostics)
        : pattern_(pattern),
          diagnostics_(diagnostics),
          names_(pattern, diagnostics),
          defines_(pattern, diagnostics),
          reader_(pattern, names_, defines_, diagnostics) {}

    Grammar run() {
        grammar_.names_ = names_.sorted();
        if (const Key* key = pattern_.find("derivation length")) {
            if (const auto steps = whole_number(key->value)) grammar_.steps_ = *steps;
        }
        if (const Key* key = pattern_.find("seed")) {
            if (const auto seed = whole_number(key->value)) grammar_.seed_ = static_cast<std::uint64_t>(*seed);
        }
        read_scale();
        if (pattern_.find("map")) return map_grammar();
        const CommandSettings angles = read_angles();
        read_axiom();
        CompiledProductions productions = compile_productions(pattern_, reader_, diagnostics_);
        const ContextList context = read_contexts();
        read_tropism();
        grammar_.surfaces_ = read_surfaces(pattern_, diagnostics_);
        const LabelReader labels(pattern_, reader_, diagnostics_);
        read_commands(angles, context, labels);
        grammar_.symbols_ = std::move(reader_.symbols());
        grammar_.letters_ = std::move(reader_.letters());
        grammar_.cut_ = reader_.cut();
        grammar_.is_parametric_ = reader_.is_parametric();
        grammar_.is_stochastic_ = reader_.uses_chance() || productions.uses_chance;
        read_schedule();
        const std::map<Symbol, Span> looked_at = std::move(productions.looked_at);
        make_tables(std::move(productions));
        grammar_.is_spatial_ = grammar_.tropism_ || reaches_into_space();
        labels.check(grammar_);
        warn_of_types(looked_at);
        if (!diagnostics_.has_errors()) warn_of_undrawn(pattern_, grammar_, diagnostics_);
        return std::move(grammar_);
    }

private:
    /// Reads the symbols that `ignore:` or `consider:` lists.
    struct ContextList {
        std::set<std::string> letters;
        bool is_considered = false;
        bool is_stated = false;
    };

    std::optional<std::int64_t> whole_number(const Span& value) {
        std::int64_t number = 0;
        const std::string_view text = value.view();
        const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
        if (error != std::errc() || end != text.data() + text.size() || text.empty() || number < 0) {
            return diagnostics_.refuse(value, "expected a whole number, 0 or more, below 2^63");
        }
        return number;
    }

    Angle angle(const Key& key, const Angle& otherwise) {
        if (const auto angle = read_angle(key.value.view())) return *angle;
        // 25°, 25 degrees
        const LineAdvice advice = advice_for_line(fmt::format("{} = {}", key.name, key.value.view()), true);
        diagnostics_.error(key.value, advice.lines.empty()
                                          ? "expected degrees: a number such as 25.7 or a fraction such as 360/7"
                                          : "degrees are a plain number; " + advice.text());
        return otherwise;
    }

    /// Sets the heading and returns the settings of commands.
    CommandSettings read_angles() {
        CommandSettings settings;
        const Key* factor = pattern_.find("angle factor");
        const Key* increment = pattern_.find("angle increment");
        settings.increment = Angle{90.0, TurnFraction{1, 4}};
        if (factor && increment) {
            const Key* later = factor->name_at.at > increment->name_at.at ? factor : increment;
            diagnostics_.error(later->name_at, "'angle factor:' and 'angle increment:' exclude each other");
        }
        if (factor) {
            const auto k = whole_number(factor->value);
            if (k && (*k < 1 || *k > most_angle_parts)) {
                diagnostics_.error(factor->value, "expected a whole number k, 1 or more: the angle is 360/k degrees");
            } else if (k) {
                settings.increment = angle_of_parts(*k);
            }
        } else if (increment) {
            settings.increment = angle(*increment, settings.increment);
        }
        grammar_.heading_ = Angle{90.0, TurnFraction{1, 4}};
        if (const Key* key = pattern_.find("heading")) grammar_.heading_ = angle(*key, grammar_.heading_);
        settings.plus_turns_left = has_choice("turn", "left", "right", "expected 'left' or 'right'");
        settings.frames_polygons =
            has_choice("polygons", "framework", "outline", "expected 'outline' or 'framework'");
        return settings;
    }

    /// True if a key has the value `chosen`; values other than this and `usual` are reported.
    bool has_choice(std::string_view name, std::string_view chosen, std::string_view usual, const char* problem) {
        const Key* key = pattern_.find(name);
        if (!key || key->value.view() == usual) return false;
        return key->value.view() == chosen || diagnostics_.refuse(key->value, problem);
    }

    void read_scale() {
        const Key* key = pattern_.find("scale factor");
        if (!key) return;
        double percent = 0;
        if (!read_number(key->value.view(), percent) || percent <= 0 || percent > 100) {
            diagnostics_.error(key->value, "'scale factor:' is a percentage, above 0 and at most 100");
        } else {
            grammar_.scale_percent_ = percent;
        }
    }

    Grammar map_grammar() {
        grammar_.map_ = std::make_shared<const MapSystem>(compile_map_system(pattern_, names_, diagnostics_));
        grammar_.tables_.resize(std::max<std::size_t>(pattern_.tables.size(), 1));
        read_schedule();
        return std::move(grammar_);
    }

    void read_tropism() {
        const Key* force = pattern_.find("tropism");
        const Key* elasticity = pattern_.find("elasticity");
        if (!force && !elasticity) return;
        if (!force || !elasticity) {
            diagnostics_.error((force ? force : elasticity)->name_at,
                               "'tropism:' and 'elasticity:' need each other: the direction in which branches "
                               "bend, and how much");
            return;
        }
        Tropism tropism;
        int numbers = 0;
        bool good = true;
        for (const std::string_view word : split_words(force->value.view(), " \t,")) {
            double number = 0;
            good = good && numbers < 3 && read_number(word, number) && std::fabs(number) <= 1e100;
            if (good) tropism.force[numbers] = number;
            ++numbers;
        }
        if (!good || (numbers != 2 && numbers != 3)) {
            diagnostics_.error(force->value, "expected two or three numbers x, y and z, such as 0, -1, 0");
        }
        if (!read_number(elasticity->value.view(), tropism.elasticity) || std::fabs(tropism.elasticity) > 1e100) {
            diagnostics_.error(elasticity->value, "expected a number such as 0.22");
        }
        grammar_.tropism_ = tropism;
    }

    bool reaches_into_space() const {
        return grammar_.leads_to([](Action action) {
            return action == Action::pitch || action == Action::roll || action == Action::level ||
                   action == Action::surface;
        });
    }

    void read_axiom() {
        const Key* key = pattern_.find("axiom");
        if (!key) return diagnostics_.error({pattern_.source, 0, 0}, "'axiom:' is missing");
        if (key->value.empty()) return diagnostics_.error(key->name_at, "the axiom is empty: expected a word");
        std::vector<Expression> arguments;
        auto axiom = reader_.word(key->value, WordPlace::axiom_or_successor, &arguments);
        if (!axiom) return;
        ModuleWord modules{std::move(*axiom), {}, {}};
        modules.arguments.reserve(arguments.size());
        for (std::size_t i = 0, next = 0; next < arguments.size(); ++i) {
            const Chance chance{axiom_place(grammar_.seed_, i), 0};
            for (std::uint32_t k = 0; k < reader_.symbols()[modules.symbols[i]].arity; ++k) {
                modules.arguments.push_back(arguments[next++].evaluate({}, chance));
            }
        }
        grammar_.axiom_ = std::make_shared<const ModuleWord>(std::move(modules));
    }

    /// Adds the letters of a list of symbols; false after an error in it.
    bool add_letters(const Key& key, std::set<std::string>& letters) {
        const auto symbols = reader_.symbol_list(key);
        for (const Symbol symbol : symbols.value_or(Word())) letters.insert(reader_.symbols()[symbol].letter);
        return symbols.has_value();
    }

    ContextList read_contexts() {
        ContextList list;
        const Key* ignore = pattern_.find("ignore");
        const Key* consider = pattern_.find("consider");
        if (ignore && consider) {
            diagnostics_.error(consider->name_at, "'ignore:' and 'consider:' exclude each other");
            return list;
        }
        const Key* key = ignore ? ignore : consider;
        if (key) {
            list.is_considered = consider != nullptr;
            list.is_stated = add_letters(*key, list.letters);
        }
        return list;
    }

    void read_commands(CommandSettings settings, const ContextList& context, const LabelReader& labels) {
        std::set<std::string>& forward = settings.forward = {"F"};
        std::set<std::string>& move = settings.move = {"f"};
        const auto replace = [&](std::string_view name, std::set<std::string>& letters) {
            const Key* listed = pattern_.find(name);
            if (!listed) return;
            letters.clear();
            add_letters(*listed, letters);
        };
        replace("forward", forward);
        replace("move", move);
        // A letter that is listed is taken from the other list's default.
        const Key* key = pattern_.find("move");
        if (!key) std::erase_if(move, [&](const std::string& letter) { return forward.contains(letter); });
        if (!pattern_.find("forward")) {
            std::erase_if(forward, [&](const std::string& letter) { return move.contains(letter); });
        }
        for (const std::string& letter : move) {
            if (!forward.contains(letter)) continue;
            diagnostics_.error(key->value, fmt::format("'{}' is listed under both 'forward:' and 'move:'", letter));
        }
        read_inserted_edges(settings);
        const EdgeReader edges(pattern_, reader_, diagnostics_);
        edges.add_to(settings);
        for (const auto& surface : grammar_.surfaces_) settings.surfaces.push_back(surface->name);
        labels.add_to(settings);
        grammar_.labels_ = std::make_shared<const std::vector<LabelText>>(labels.labels());
        grammar_.letter_height_ = labels.height();
        grammar_.ignored_.assign(reader_.symbols().size(), 0);
        for (std::size_t i = 0; i < reader_.symbols().size(); ++i) {
            SymbolInfo& symbol = reader_.symbols()[i];
            symbol.command = command_of(symbol, settings);
            const bool bracket = symbol.letter == "[" || symbol.letter == "]";
            const bool listed = context.letters.contains(symbol.letter);
            grammar_.ignored_[i] =
                context.is_stated && (context.is_considered ? !listed && !bracket : listed) ? 1 : 0;
        }
        grammar_.edges_ = std::make_shared<const std::vector<EdgeLength>>(edges.measure(reader_.symbols()));
    }

    void read_inserted_edges(CommandSettings& settings) {
        const Key* key = pattern_.find("edges");
        const auto list = key ? reader_.symbol_list(*key) : std::nullopt;
        if (!list) return;
        if (list->size() != 2 || list->front() == list->back()) {
            diagnostics_.error(key->value, "expected two symbols, such as ? #");
            return;
        }
        settings.edge_begin = reader_.symbols()[list->front()].letter;
        settings.edge_end = reader_.symbols()[list->back()].letter;
    }

    void read_schedule() {
        const Key* key = pattern_.find("schedule");
        if (!key) {
            if (pattern_.tables.size() > 1) {
                diagnostics_.error(pattern_.tables[1].name, "several tables need a 'schedule:'");
            }
        } else if (auto items = sikku::read_schedule(*key, pattern_, defines_, diagnostics_)) {
            grammar_.schedule_items_ = std::make_shared<const std::vector<ScheduleItem>>(std::move(*items));
        } else {
            return;
        }
        std::string problem;
        if (!grammar_.make_schedule(&problem)) diagnostics_.error(key ? key->value : Span{}, problem);
    }

    void make_tables(CompiledProductions productions) {
        const std::size_t symbols = grammar_.symbols_.size();
        const std::size_t tables = productions.tables.size();
        if (tables > 1 && tables * symbols > most_places) {
            diagnostics_.error(
                pattern_.tables.front().name,
                fmt::format("{} tables of {} symbols are too many: expected at most {} entries in total", tables,
                            symbols, most_places));
            return;
        }
        for (std::vector<Production>& table : productions.tables) {
            grammar_.tables_.emplace_back(std::move(table), symbols, grammar_.is_plain());
        }
        if (productions.interpretation) {
            grammar_.interpretation_.emplace(std::move(*productions.interpretation), symbols, grammar_.is_plain());
        }
    }

    /// Warns of productions for a number of parameters that no word states, which can never apply.
    void warn_of_types(const std::map<Symbol, Span>& looked_at) {
        if (looked_at.empty() || diagnostics_.has_errors()) return;
        std::vector<char> stated(grammar_.symbols_.size(), 0);
        const auto state = [&](const Word& word) {
            for (const Symbol symbol : word) stated[symbol] = 1;
        };
        state(grammar_.axiom());
        for (const Table& table : grammar_.tables_) {
            for (const Production& production : table.productions()) state(production.successor);
        }
        if (grammar_.interpretation_) {
            for (const Production& production : grammar_.interpretation_->productions()) state(production.successor);
        }
        std::vector<std::optional<std::size_t>> other(grammar_.letters_.size());  // stated number of parameters
        for (std::size_t i = 0; i < stated.size(); ++i) {
            const SymbolInfo& symbol = grammar_.symbols_[i];
            if (stated[i]) other[symbol.letter_index] = std::max<std::size_t>(symbol.arity, symbol.arguments.size());
        }
        for (const auto& [symbol, where] : looked_at) {
            const SymbolInfo& info = grammar_.symbols_[symbol];
            if (stated[symbol] || !other[info.letter_index]) continue;
            diagnostics_.warning(where, fmt::format("words contain '{0}' with {2} parameters, never with {1}: this "
                                                    "production can never apply",
                                                    info.letter, info.arity, *other[info.letter_index]));
        }
    }

    const Pattern& pattern_;
    Diagnostics& diagnostics_;
    SymbolNames names_;
    Defines defines_;
    WordReader reader_;
    Grammar grammar_;
};

Grammar compile_grammar(const Pattern& pattern, Diagnostics& diagnostics) {
    return GrammarCompiler(pattern, diagnostics).run();
}

}  // namespace sikku
