// engine/language/grammar.h: a compiled L-system: symbols as numbers, productions in tables, a schedule.
#pragma once

#include "engine/language/angle.h"
#include "engine/language/edge.h"
#include "engine/language/expression.h"
#include "engine/language/label.h"
#include "engine/language/pattern.h"

#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace sikku {

struct MapSystem;

/// A symbol of one grammar, counted from 0: a letter together with its constant parameters, so that `F`, `F(1)` and
/// `F(2.5)` are three symbols; or, where a production names or computes the parameters, the type of a module: a
/// letter with their number. Their values are stored beside the symbols of a word.
using Symbol = std::uint32_t;
using Word = std::vector<Symbol>;

/// A word with the parameters of its modules.
struct ModuleWord {
    Word symbols;
    std::vector<double> arguments;      ///< SymbolInfo::arity values for each symbol, in order
    std::vector<std::uint64_t> places;  ///< in stochastic systems one for each symbol; empty for an axiom
};

/// The effect of a symbol on a turtle.
enum class Action : std::uint8_t {
    pass,   ///< nothing
    draw,   ///< one step of length `value`, drawing
    move,   ///< one step of length `value`
    turn,   ///< by `angle`, to the left where that is positive
    pitch,  ///< by `angle`, down
    roll,   ///< by `angle`, to the left
    level,  ///< roll until the turtle's left is level
    push,
    pop,
    polygon_begin,
    polygon_end,
    polygon_vertex,
    edge_begin,
    edge_end,
    width_factor,  ///< multiply the line's width by `value`
    width_set,     ///< set it to `value`
    colour_step,   ///< next or previous colour: add `value`
    colour_set,
    disc,     ///< radius `value`; 0 is a dot
    mark,     ///< nothing, but ends a part: see Grammar::with_marks()
    surface,  ///< the surface of that number, `value` times its size
    label,    ///< the text of that number, with the module's parameters
};
struct Command {
    Action action = Action::pass;
    double value = 0.0;
    Angle angle;
    /// True if the value is `value` times the module's first argument; for a turn, pitch or roll, in degrees.
    bool takes_argument = false;
    /// For a step, true if its end is a vertex of the open polygon; for polygon_begin, true if the polygon begins
    /// with one.
    bool is_vertex = true;
    std::uint32_t surface = 0;  ///< index into Grammar::surfaces()
    std::uint32_t label = 0;    ///< index into Grammar::labels()
    std::uint32_t edge = 0;     ///< for a step, index into Grammar::edges() plus 1; 0: its value is its exact length

    bool is_step() const { return action == Action::draw || action == Action::move; }
    /// True if it turns the turtle by an angle, in the plane or in space.
    bool is_turn() const { return action == Action::turn || action == Action::pitch || action == Action::roll; }
};

/// A symbol as the file writes it.
struct SymbolInfo {
    std::string letter;              ///< without parameters: one code point, `@` and one, or a listed name
    std::vector<double> arguments;   ///< constant parameters
    bool is_name = false;            ///< listed under `symbols:`
    std::uint32_t letter_index = 0;  ///< index into Grammar::letters(); the same for `F` and `F(2)`
    Command command;
    std::uint32_t arity = 0;  ///< number of variable parameters of each module
};

/// left < predecessor > right : condition --> successor : weight
/// Expressions take the arguments of left, predecessor and right, in this order, as formal parameters.
struct Production {
    Word left;
    Word predecessor;
    Word right;  ///< with brackets that balance, if it looks into branches
    Word successor;
    std::optional<Expression> condition{};  ///< none: always
    std::optional<Expression> weight{};     ///< none: no random choice
    std::vector<Expression> arguments{};    ///< arguments of the successor's symbols with arity, in order
    std::uint32_t group = 0;                ///< the same in a table for equal predecessor and contexts
    std::uint32_t text = 0;                 ///< index of its text among those of its table, shared ones first
    bool has_context() const { return !left.empty() || !right.empty(); }
};

/// The productions that one derivation step chooses from.
class Table {
public:
    Table() = default;
    /// @param productions  in the order of the file
    /// @param symbols      number of symbols of the grammar
    /// @param is_plain  result of Grammar::is_plain()
    Table(std::vector<Production> productions, std::size_t symbols, bool is_plain);

    /// True if every production replaces one symbol without contexts.
    bool context_free() const { return context_free_; }
    /// Context-free tables of plain grammars: the successor of a symbol, or null if it is unchanged.
    const Word* successor(Symbol symbol) const {
        const std::int32_t index = symbol < first_.size() ? first_[symbol] : -1;
        return index < 0 ? nullptr : &productions_[static_cast<std::size_t>(index)].successor;
    }
    /// Other tables: the productions whose predecessor begins with `symbol`, in the order in which they are tried.
    std::span<const std::uint32_t> candidates(Symbol symbol) const {
        if (std::size_t{symbol} + 1 >= candidate_begin_.size()) return {};
        return std::span(candidate_list_)
            .subspan(candidate_begin_[symbol], candidate_begin_[symbol + 1] - candidate_begin_[symbol]);
    }
    const Production& production(std::uint32_t index) const { return productions_[index]; }
    const std::vector<Production>& productions() const { return productions_; }
    /// True if conditions are random, so that a module that is unchanged in one step may change in the next.
    bool has_random_conditions() const { return has_random_conditions_; }

private:
    std::vector<Production> productions_;
    bool context_free_ = true;
    bool has_random_conditions_ = false;
    std::vector<std::int32_t> first_;            // by symbol, index of the production or -1
    std::vector<std::uint32_t> candidate_list_;  // grouped by first symbol
    std::vector<std::uint32_t> candidate_begin_;
};

struct ScheduleItem;
struct Surface;

/// A stretch of equal steps of the schedule.
struct ScheduleRun {
    std::uint32_t table = 0;
    std::int64_t steps = 0;
};

/// Bends branches: after each segment that is drawn the turtle turns about heading x force, by `elasticity` times
/// the size of segment x force, radians.
/// Source: Prusinkiewicz & Hanan 1989, section 3.1.
struct Tropism {
    glm::dvec3 force{0.0};
    double elasticity = 0.0;
};

/// Immutable once compiled. Everything an interpreter needs besides its own keys.
class Grammar {
public:
    const std::vector<SymbolInfo>& symbols() const { return symbols_; }
    const std::vector<std::string>& letters() const { return letters_; }
    const Word& axiom() const { return axiom_->symbols; }
    const ModuleWord& axiom_modules() const { return *axiom_; }
    const std::vector<Table>& tables() const { return tables_; }
    /// The homomorphism, or null.
    const Table* interpretation() const { return interpretation_ ? &*interpretation_ : nullptr; }
    /// Derivation length n, as the file, the variant or the caller set it.
    std::int64_t steps() const { return steps_; }
    /// The table of each step, from the first to the last; steps sum to steps(), unless after() has removed the first
    /// of them.
    const std::vector<ScheduleRun>& schedule() const { return schedule_; }
    /// Number of steps that after() has removed.
    std::int64_t steps_done() const;

    /// True if some modules have variable parameters.
    bool is_parametric() const { return is_parametric_; }
    /// True if some successors, conditions or parameters are random.
    bool is_stochastic() const { return is_stochastic_; }
    /// True if it is neither parametric nor stochastic: a successor depends only on the table, and on neighbours in
    /// tables that are not context-free. Only such systems are forecast and folded.
    bool is_plain() const { return !is_parametric_ && !is_stochastic_; }
    /// The seed of random choices.
    std::uint64_t seed() const { return seed_; }
    /// The place in the derivation tree of a symbol of a word in a stochastic system.
    std::uint64_t place_of(const ModuleWord& word, std::size_t at) const {
        return word.places.empty() ? axiom_place(seed_, at) : word.places[at];
    }
    /// The symbol `%`, if words contain it: a step first removes it and the symbols after it in its branch.
    std::optional<Symbol> cut() const { return cut_; }

    /// The map system, or null if the pattern derives words. With a map, the grammar states only the derivation
    /// length, the schedule and the scale; it has no symbols, and its word is empty.
    const MapSystem* map() const { return map_.get(); }

    const Angle& heading() const { return heading_; }
    const std::optional<Tropism>& tropism() const { return tropism_; }
    /// The predefined surfaces; see surface.h.
    const std::vector<std::shared_ptr<const Surface>>& surfaces() const { return surfaces_; }
    /// The steps whose lengths are those of words, stated by `edge`.
    const std::vector<EdgeLength>& edges() const { return *edges_; }
    /// The texts that symbols write, and the height of their capital letters in steps.
    const std::vector<LabelText>& labels() const { return *labels_; }
    double letter_height() const { return letter_height_; }
    /// True if the axiom can lead to a symbol that writes a label, `interpret:` included.
    bool has_labels() const;
    /// True if the turtle needs the third dimension: to pitch, to roll or to be bent.
    bool is_spatial() const { return is_spatial_; }
    double scale_percent() const { return scale_percent_; }
    /// True if context matching ignores the symbol.
    bool ignored(Symbol symbol) const { return ignored_[symbol] != 0; }
    /// Names of several characters, sorted.
    const std::vector<std::string>& names() const { return names_; }
    bool is_push(Symbol symbol) const { return symbols_[symbol].command.action == Action::push; }
    bool is_pop(Symbol symbol) const { return symbols_[symbol].command.action == Action::pop; }

    /// For each symbol, 1 if the axiom can lead to it, `interpret:` included, else 0.
    std::vector<char> reachable() const;

    /// True if the axiom can lead to a symbol whose action has a property, `interpret:` included.
    template <class Holds>
    bool leads_to(Holds holds) const {
        const std::vector<char> reached = reachable();
        for (std::size_t i = 0; i < reached.size(); ++i) {
            if (reached[i] && holds(symbols_[i].command.action)) return true;
        }
        return false;
    }

    /// The same system with another derivation length; nullopt if its schedule is too short for it.
    std::optional<Grammar> with_steps(std::int64_t steps) const;

    /// The rest of the derivation after `word` has been derived by the first `steps` steps. It keeps steps(), and has
    /// no with_steps().
    Grammar after(std::int64_t steps, std::shared_ptr<const ModuleWord> word) &&;
    bool is_begun() const { return begun_; }
    /// True if the file has a schedule of tables; otherwise one table applies in every step.
    bool has_schedule() const { return schedule_items_ != nullptr; }

    /// The same system with a mark, a symbol without meaning, after each part that draws and is derived in the last
    /// `order` steps from one symbol that they rewrite: the sub-curves of that order. Without marks if the derivation
    /// is not longer; nullopt for systems that are not plain or look at neighbours.
    /// @param sounding  1 for symbols that count as drawing, by symbol; may be empty
    std::optional<Grammar> with_marks(std::int64_t order, const std::vector<char>& sounding = {}) const;
    /// The mark of with_marks().
    std::optional<Symbol> mark() const { return mark_; }

    /// A system that replaces each symbol by map[symbol], or by nothing if that is not a valid symbol, in one step.
    Grammar with_map(const std::vector<Symbol>& map) const;

    /// A plain system without further steps or homomorphism, whose word is `word`: modules with variable parameters
    /// become symbols of their own. Nullopt if there are more than 524,288 of them.
    std::optional<Grammar> written_out(const ModuleWord& word) const;

    /// A plain system with the same settings and schedule, and with these symbols and productions instead. It has no
    /// with_steps().
    struct PlainParts {
        std::vector<SymbolInfo> symbols;  ///< symbols of arity 0
        Word axiom;
        std::vector<std::vector<Production>> tables;
        std::optional<std::vector<Production>> interpretation;
    };
    Grammar with_parts(PlainParts parts) const;

    /// The number of steps from the beginning up to and including the last that needs whole words (contexts,
    /// predecessors of several symbols, cuts); 0 if the system is context-free throughout.
    std::int64_t whole_word_steps() const;

private:
    friend class GrammarCompiler;
    bool make_schedule(std::string* problem);

    std::vector<SymbolInfo> symbols_;
    std::vector<std::string> letters_;
    // Shared by copies: it may be large.
    std::shared_ptr<const ModuleWord> axiom_ = std::make_shared<const ModuleWord>();
    std::vector<Table> tables_;
    std::optional<Table> interpretation_;
    std::shared_ptr<const MapSystem> map_;
    std::int64_t steps_ = 0;
    bool begun_ = false;
    bool has_fixed_steps_ = false;
    bool is_parametric_ = false;
    bool is_stochastic_ = false;
    std::uint64_t seed_ = 0;
    std::optional<Symbol> cut_;
    std::optional<Symbol> mark_;
    std::vector<ScheduleRun> schedule_;
    std::shared_ptr<const std::vector<ScheduleItem>> schedule_items_;  // null: one table in every step
    Angle heading_;
    std::optional<Tropism> tropism_;
    std::vector<std::shared_ptr<const Surface>> surfaces_;
    std::shared_ptr<const std::vector<EdgeLength>> edges_ = std::make_shared<const std::vector<EdgeLength>>();
    std::shared_ptr<const std::vector<LabelText>> labels_ = std::make_shared<const std::vector<LabelText>>();
    double letter_height_ = usual_letter_height;
    bool is_spatial_ = false;
    double scale_percent_ = 100.0;
    std::vector<char> ignored_;
    std::vector<std::string> names_;
};

/// A module as a plain symbol: its values become constant parameters of its command.
SymbolInfo with_values(const SymbolInfo& symbol, std::span<const double> values);

/// Compiles and checks a pattern. All errors go to `diagnostics`; the grammar is usable only if there were none.
/// Cost: linear in the file.
Grammar compile_grammar(const Pattern& pattern, Diagnostics& diagnostics);

/// The symbols of `word` as `sikku derive` prints them.
std::string to_text(const Grammar& grammar, std::span<const Symbol> word);
std::string to_text(const Grammar& grammar, const ModuleWord& word);

/// True if a blank is needed between two symbols, so that the text reads back as the same two.
bool needs_blank(const Grammar& grammar, Symbol before, Symbol after);

/// One symbol as it is printed, parameters in the shortest digits that read back the same.
/// @param arguments  those of the module, if its symbol has none of its own
std::string symbol_text(const SymbolInfo& symbol, std::span<const double> arguments = {});
/// Appends the same to `text`.
void append_symbol(const SymbolInfo& symbol, std::span<const double> arguments, std::string& text);

}  // namespace sikku
