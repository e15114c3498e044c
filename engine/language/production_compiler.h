// engine/language/production_compiler.h: reads and checks the productions of a pattern.
#pragma once

#include "engine/language/word_reader.h"

#include <map>
#include <optional>
#include <vector>

namespace sikku {

/// The productions of a pattern, in the order of the file.
struct CompiledProductions {
    /// One list for each table; one in all if the pattern has no tables.
    std::vector<std::vector<Production>> tables;
    std::optional<std::vector<Production>> interpretation;
    /// A condition or a choice among successors is a matter of chance.
    bool uses_chance = false;
    /// In parametric systems, the symbols of predecessors and contexts and the first production that has each.
    std::map<Symbol, Span> looked_at;
};

CompiledProductions compile_productions(const Pattern& pattern, WordReader& reader, Diagnostics& diagnostics);

}  // namespace sikku
