// engine/language/production_compiler.h: reads and checks the productions of a pattern.
#pragma once

#include "engine/language/word_reader.h"

#include <map>
#include <optional>
#include <vector>

namespace sikku {

/// The productions of a pattern, in the order of the file.
struct CompiledProductions {
    /// One list for each table; a single list if the pattern has no tables.
    std::vector<std::vector<Production>> tables;
    std::optional<std::vector<Production>> interpretation;
    /// True if conditions or choices of successors are random.
    bool uses_chance = false;
    /// In parametric systems, the symbols of predecessors and contexts, each with its first production.
    std::map<Symbol, Span> looked_at;
};

CompiledProductions compile_productions(const Pattern& pattern, WordReader& reader, Diagnostics& diagnostics);

}  // namespace sikku
