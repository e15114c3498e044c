// engine/language/edge_reader.h: reads the keys `edge SYMBOL: WORD` of a pattern.
#pragma once

#include "engine/language/command_table.h"
#include "engine/language/edge.h"
#include "engine/language/word_reader.h"

#include <vector>

namespace sikku {

/// Reads the edges of one pattern: first their words, then, when all symbols are known, their lengths.
class EdgeReader {
public:
    /// Reads the symbols and words; errors go to `diagnostics`.
    EdgeReader(const Pattern& pattern, WordReader& reader, Diagnostics& diagnostics);

    /// Makes the symbols of edges draw a step, unless `move:` lists them. Symbols that turn, branch or have another
    /// effect are reported.
    void add_to(CommandSettings& settings) const;

    /// Measures the edges, and sets the lengths of their symbols, whose commands are known.
    /// Words that do not end straight ahead at the heading of their start, and those without length, are reported.
    /// Cost: linear in the words.
    std::vector<EdgeLength> measure(std::vector<SymbolInfo>& symbols) const;

private:
    struct Line {
        Symbol symbol;
        Span name;
        Span value;
        Word word;
    };
    bool check(const Line& line, const std::vector<SymbolInfo>& symbols) const;
    std::optional<EdgeLength> measure(const Line& line, const std::vector<SymbolInfo>& symbols) const;

    std::vector<Line> lines_;
    WordReader& reader_;
    Diagnostics& diagnostics_;
};

}  // namespace sikku
