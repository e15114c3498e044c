#include "engine/language/command_table.h"

#include <algorithm>
#include <array>

namespace sikku {
namespace {

/// The effect of a module's first parameter.
enum class Parameter : std::uint8_t {
    none,
    value,    ///< sets the value of the command
    degrees,  ///< sets the angle, times `number`; without it the angle is the increment, times `number`
};

struct Row {
    std::string_view letter;
    Action action;  ///< command without a parameter
    double number;  ///< value without a parameter; 1 or -1 for turns
    Parameter parameter;
    Action action_with;  ///< command with a parameter
};

constexpr auto rows = [] {
    using enum Action;
    using enum Parameter;
    return std::array<Row, 19>{{
        {"+", turn, 1.0, degrees, turn},  // the direction depends on `turn:`
        {"-", turn, -1.0, degrees, turn},
        {"&", pitch, 1.0, degrees, pitch},
        {"^", pitch, -1.0, degrees, pitch},
        {"\\", roll, 1.0, degrees, roll},
        {"/", roll, -1.0, degrees, roll},
        {"$", level, 0.0, none, level},
        {"[", push, 0.0, none, push},
        {"]", pop, 0.0, none, pop},
        {"{", polygon_begin, 0.0, value, polygon_begin},
        {"}", polygon_end, 0.0, none, polygon_end},
        {".", polygon_vertex, 0.0, none, polygon_vertex},
        {"#", width_factor, 1.25, value, width_set},
        {"!", width_factor, 0.8, value, width_set},
        {"'", colour_step, 1.0, value, colour_set},
        {";", colour_step, 1.0, value, colour_set},
        {",", colour_step, -1.0, value, colour_set},
        {"@O", disc, 1.0, value, disc},
        {"@.", disc, 0.0, none, disc},
    }};
}();

/// A parameter of a draw or a move is the length of the step; the default is 1.
constexpr Row draw_row{"", Action::draw, 1.0, Parameter::value, Action::draw};
constexpr Row move_row{"", Action::move, 1.0, Parameter::value, Action::move};

constexpr Row edge_begin_row{"", Action::edge_begin, 0.0, Parameter::none, Action::edge_begin};
constexpr Row edge_end_row{"", Action::edge_end, 0.0, Parameter::none, Action::edge_end};

bool is_frame_step(const std::string& letter, const CommandSettings& settings) {
    return settings.frames_polygons && (letter == "G" || letter == "g") && !settings.forward.contains(letter) &&
           !settings.move.contains(letter);
}

const Row* row_of(const std::string& letter, const CommandSettings& settings) {
    if (letter == settings.edge_begin) return &edge_begin_row;
    if (letter == settings.edge_end) return &edge_end_row;
    if (settings.forward.contains(letter)) return &draw_row;
    if (settings.move.contains(letter)) return &move_row;
    if (is_frame_step(letter, settings)) return letter == "G" ? &draw_row : &move_row;
    const auto found = std::find_if(rows.begin(), rows.end(), [&](const Row& row) { return row.letter == letter; });
    if (found == rows.end() || (found->action == Action::polygon_vertex && !settings.frames_polygons)) return nullptr;
    return &*found;
}

constexpr std::array<SymbolHelp, 18> help_rows = {{
    {"F", "move one step and draw; F(2.5) moves 2.5 steps"},
    {"f", "move one step without drawing"},
    {"+ -", "turn by the angle increment; +(60) by 60 degrees"},
    {"|", "turn around"},
    {"& ^", "pitch down, up by the angle increment; &(30) by 30 degrees"},
    {"\\ /", "roll left, right by the angle increment; /(30) by 30 degrees"},
    {"$", "roll until the turtle's left is level"},
    {"[ ]", "save the turtle's state, restore it"},
    {"{ }", "begin and end a filled polygon"},
    {".", "with polygons: framework, a vertex of the polygon"},
    {"G g", "with polygons: framework, move one step with and without drawing, without adding a vertex"},
    {"? #", "with edges: ? #, begin and end an inserted edge, which closes a polygon"},
    {"# !", "widen the pen by 1.25, narrow it by 0.8; with a parameter, set its width in the unit of stroke"},
    {"' ;", "next colour; with a parameter, that colour: ;(3)"},
    {",", "previous colour; with a parameter, that colour"},
    {"~NAME", "a predefined surface; ~NAME(s) scaled by s, ~NAME(sx,sy,sz) along its own axes"},
    {"@O", "a disc of radius 1 step; @O(r) of r steps; in space a sphere"},
    {"@.", "a dot, twice as wide as the line"},
}};

/// Returns the command of a row, with its value and angle.
Command command_of_row(const Row& row, const SymbolInfo& symbol, const CommandSettings& settings) {
    const bool takes_argument = symbol.arity > 0;
    const bool has_value = takes_argument || !symbol.arguments.empty();
    if (row.parameter == Parameter::degrees) {
        const bool positive = (row.number > 0) == (row.action != Action::turn || settings.plus_turns_left);
        if (takes_argument) return {row.action, positive ? 1.0 : -1.0, {}, true};
        const Angle angle = has_value ? angle_of_degrees(symbol.arguments.front()) : settings.increment;
        return {row.action, 0.0, positive ? angle : negated(angle), false};
    }
    if (row.parameter == Parameter::none || !has_value) return {row.action, row.number, {}, false};
    return {row.action_with, takes_argument ? 1.0 : symbol.arguments.front(), {}, takes_argument};
}

}  // namespace

std::span<const SymbolHelp> turtle_symbols() {
    return help_rows;
}

Command command_of(const SymbolInfo& symbol, const CommandSettings& settings) {
    if (const auto label = std::find(settings.labels.begin(), settings.labels.end(), symbol.letter);
        label != settings.labels.end()) {
        Command command{.action = Action::label, .value = 0.0, .angle = {}};
        command.label = static_cast<std::uint32_t>(label - settings.labels.begin());
        return command;
    }
    if (symbol.is_name && symbol.letter.front() == '~') {
        const auto found = std::find(settings.surfaces.begin(), settings.surfaces.end(), symbol.letter.substr(1));
        Command command{.action = Action::surface, .value = 1.0, .angle = {}, .takes_argument = symbol.arity > 0};
        command.surface = static_cast<std::uint32_t>(found - settings.surfaces.begin());
        return command;
    }
    const Row* const row = row_of(symbol.letter, settings);
    if (!row) {
        if (symbol.letter == "|") return {Action::turn, 0.0, Angle{180.0, TurnFraction{1, 2}}, false};
        return {};
    }
    Command command = command_of_row(*row, symbol, settings);
    command.is_vertex =
        row->action == Action::polygon_begin ? !settings.frames_polygons : !is_frame_step(symbol.letter, settings);
    return command;
}

}  // namespace sikku
