// engine/language/command_table.h: maps letters to commands of the turtle.
#pragma once

#include "engine/language/grammar.h"

#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace sikku {

/// Settings of a pattern that change the meaning of letters.
struct CommandSettings {
    std::set<std::string> forward;  ///< symbols that draw
    std::set<std::string> move;     ///< symbols that move without drawing
    Angle increment;                ///< angle of turns without a parameter
    bool plus_turns_left = false;
    bool frames_polygons = false;  ///< `polygons: framework`
    std::string edge_begin;        ///< symbols of `edges:`, or empty
    std::string edge_end;
    std::vector<std::string> surfaces;  ///< names, in the order of Grammar::surfaces()
    std::vector<std::string> labels;    ///< symbols that write, in the order of Grammar::labels()
};

/// Help for commands of the turtle.
struct SymbolHelp {
    std::string_view symbols;  ///< separated by spaces: `[ ]`
    std::string_view help;
};
/// In the order of the manual.
std::span<const SymbolHelp> turtle_symbols();

/// The command of a symbol; Action::pass for a letter without one.
Command command_of(const SymbolInfo& symbol, const CommandSettings& settings);

}  // namespace sikku
