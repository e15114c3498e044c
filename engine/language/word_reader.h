// engine/language/word_reader.h: turns words of a pattern into symbols, which it numbers.
#pragma once

#include "engine/language/defines.h"
#include "engine/language/grammar.h"
#include "engine/language/module_types.h"
#include "engine/language/word_scanner.h"

#include <array>
#include <limits>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

namespace sikku {

/// Where a word stands, which decides what may be in it.
enum class WordPlace { axiom_or_successor, predecessor, context, list };

/// Reads the words and expressions of one pattern. Symbols are numbered in the order in which they are met. The names
/// of the formal parameters that predecessors and contexts introduce hold until the next begin_production().
class WordReader {
public:
    WordReader(const Pattern& pattern, const SymbolNames& names, const Defines& defines, Diagnostics& diagnostics)
        : names_(names), defines_(defines), types_(pattern, names), diagnostics_(diagnostics) {}

    /// Forgets formal parameters.
    void begin_production() { formals_.clear(); }
    /// Reads a word; nullopt after the first error in it. The parameters of modules that state them for themselves go
    /// to `arguments`.
    std::optional<Word> word(const Span& span, WordPlace place, std::vector<Expression>* arguments = nullptr);
    /// Reads a list of symbols, written as a word; a comma in it is most likely an error.
    std::optional<Word> symbol_list(const Key& key);
    /// Compiles an expression of formal parameters and defines; nullopt after an error in it.
    std::optional<Expression> expression(const Span& text);

    /// The symbols met so far.
    std::vector<SymbolInfo>& symbols() { return symbols_; }
    std::vector<std::string>& letters() { return letters_; }
    /// Are there modules that state their parameters for themselves?
    bool is_parametric() const { return !types_.empty(); }
    /// Is a parameter in one of the words a matter of chance?
    bool uses_chance() const { return uses_chance_; }
    /// The symbol `%`, if an axiom or a successor holds it.
    std::optional<Symbol> cut() const { return cut_; }

private:
    struct Parameters;
    template <class Take>
    bool read_word(const Span& span, WordPlace place, Take take);
    bool read_parameters(WordScanner& scanner, const Span& span, std::string_view letter, WordPlace place,
                         Parameters& read);
    bool read_formals(const std::vector<Span>& parts);
    bool read_expressions(const std::vector<Span>& parts, std::vector<Expression>& own);
    Symbol intern(std::string letter, bool is_name, std::vector<double> arguments, std::uint32_t arity);

    const SymbolNames& names_;
    const Defines& defines_;
    ModuleTypes types_;
    Diagnostics& diagnostics_;
    std::vector<SymbolInfo> symbols_;
    std::vector<std::string> letters_;
    std::optional<Symbol> cut_;
    bool uses_chance_ = false;
    std::unordered_map<std::string_view, std::uint32_t> formals_;  // slots, of the production being read
    std::uint32_t draws_ = 1;                                      // draw 0 chooses among weights
    static constexpr Symbol no_symbol = std::numeric_limits<Symbol>::max();
    std::array<Symbol, 256> plain_symbols_ = [] {
        std::array<Symbol, 256> symbols{};
        symbols.fill(no_symbol);
        return symbols;
    }();  // of single letters without parameters
    std::unordered_map<std::string, Symbol> symbol_index_;
    std::unordered_map<std::string, std::uint32_t> letter_index_;
};

}  // namespace sikku
