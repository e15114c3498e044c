// studio/editor/help.h: help for the text of a pattern: on keys, symbols, defines and tables, and completions.
#pragma once

#include "engine/base/keys.h"
#include "engine/base/monitor.h"
#include "engine/language/command_table.h"
#include "engine/language/document.h"
#include "studio/editor/occurrences.h"

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace sikku {

/// The commands of the turtle, one symbol a row.
std::vector<SymbolHelp> single_turtle_symbols();

/// Words that are valid values of a key, such as `right` and `left`: those that its help lists, the names of scales
/// and instruments. Empty for keys with other values, and for texts.
std::vector<std::string> choices_of(const KeyInfo& key);

/// Help for a name, in Markdown. @param all  occurrences(pattern)
std::string help_for(const Occurrence& name, const Pattern& pattern, const std::vector<Occurrence>& all);

/// Length and extent for each derivation length up to the next one, the last ten, as a table in Markdown. Empty if
/// they are unknown. @throws Stopped
std::string growth_table(const Document& document, const Monitor& monitor);

/// A text that can be completed at the cursor.
struct Completion {
    std::string label;   ///< shown
    std::string insert;  ///< written
    std::string detail;  ///< shown beside the label; may be empty
    std::string help;    ///< Markdown; may be empty
    bool is_key = false;
};

/// The completions of a line at the cursor.
struct Completions {
    std::size_t begin = 0;  ///< byte offset into the text, from where to the cursor the completion replaces
    std::vector<Completion> items;
};

/// Completes keys that are not set at the beginning of a line, values after a key, and tables in a schedule.
/// @param offset  of the cursor, a byte in the text of the pattern
Completions complete(const Pattern& pattern, std::size_t offset);

}  // namespace sikku
