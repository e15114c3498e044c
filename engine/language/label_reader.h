// engine/language/label_reader.h: reads the keys `label SYMBOL: TEXT` and `lettering:` of a pattern.
#pragma once

#include "engine/language/command_table.h"
#include "engine/language/label.h"
#include "engine/language/word_reader.h"

#include <vector>

namespace sikku {

/// Reads the labels of one pattern: first their texts; when all symbols are known, checks that these have the
/// parameters that the texts show.
class LabelReader {
public:
    /// Errors go to `diagnostics`.
    LabelReader(const Pattern& pattern, WordReader& reader, Diagnostics& diagnostics);

    /// Makes the symbols write their labels. Symbols that draw, turn, branch or have another effect are reported.
    void add_to(CommandSettings& settings) const;

    /// Reports symbols that the axiom leads to and that lack a parameter which their label shows.
    void check(const Grammar& grammar) const;

    std::vector<LabelText> labels() const;
    /// Height of capital letters in steps.
    double height() const { return height_; }

private:
    struct Line {
        Symbol symbol;
        Span name;
        Span value;
        LabelText label;
    };
    bool read_text(const Span& value, LabelText& label);
    void read_height(const Pattern& pattern);

    std::vector<Line> lines_;
    double height_ = usual_letter_height;
    WordReader& reader_;
    Diagnostics& diagnostics_;
};

}  // namespace sikku
