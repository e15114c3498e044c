// engine/language/command_table.h: what a turtle does on which letter.
#pragma once

#include "engine/language/grammar.h"

#include <set>
#include <string>

namespace sikku {

/// What a pattern says about the meaning of its letters.
struct CommandSettings {
    std::set<std::string> forward;  ///< letters that draw
    std::set<std::string> move;     ///< letters that move
    Angle increment;                ///< of turns without a parameter
    bool plus_turns_left = false;
};

/// The command of a symbol; Action::pass for a letter without one.
Command command_of(const SymbolInfo& symbol, const CommandSettings& settings);

}  // namespace sikku
