// engine/language/command_table.h: maps letters to commands of the turtle.
#pragma once

#include "engine/language/grammar.h"

#include <set>
#include <string>

namespace sikku {

/// Settings of a pattern that change the meaning of letters.
struct CommandSettings {
    std::set<std::string> forward;  ///< symbols that draw
    std::set<std::string> move;     ///< symbols that move without drawing
    Angle increment;                ///< angle of turns without a parameter
    bool plus_turns_left = false;
};

/// The command of a symbol; Action::pass for a letter without one.
Command command_of(const SymbolInfo& symbol, const CommandSettings& settings);

}  // namespace sikku
