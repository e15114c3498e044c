// engine/language/word_reader.h: reads the words of a pattern and numbers their symbols.
#pragma once

#include "engine/language/defines.h"
#include "engine/language/grammar.h"
#include "engine/language/word_scanner.h"

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <unordered_set>
#include <utility>
#include <vector>

namespace sikku {

/// Types of modules (a letter with a number of parameters) with variable parameters: a predecessor or a context names
/// them, or a word computes them. Parameters of other modules are part of their symbol.
class ModuleTypes {
public:
    ModuleTypes(const Pattern& pattern, const SymbolNames& names);

    bool empty() const { return types_.empty(); }
    bool contains(std::string_view letter, std::size_t parameters) const;

private:
    std::unordered_set<std::string> types_;
};

/// The position of a word, which determines its syntax.
enum class WordPlace { axiom_or_successor, predecessor, context, list };

/// Reads the words and expressions of one pattern. Symbols are numbered in the order of their first occurrence. The
/// names of the formal parameters that predecessors and contexts introduce hold until the next begin_production().
class WordReader {
public:
    WordReader(const Pattern& pattern, const SymbolNames& names, const Defines& defines, Diagnostics& diagnostics)
        : names_(names), defines_(defines), types_(pattern, names), diagnostics_(diagnostics) {}

    /// Forgets formal parameters.
    void begin_production() { formals_.clear(); }
    /// Reads a word; nullopt after the first error in it. Variable parameters of modules go to `arguments`.
    std::optional<Word> word(const Span& span, WordPlace place, std::vector<Expression>* arguments = nullptr);
    /// Reads a list of symbols, separated by blanks; reports commas as errors.
    std::optional<Word> symbol_list(const Key& key);
    /// The symbol of a key such as `edge SYMBOL`, and its place. Nullopt if the key does not begin with `before`, and
    /// after an error.
    std::optional<std::pair<Symbol, Span>> symbol_of(const Key& key, std::string_view before);
    /// Compiles an expression with formal parameters and defines; nullopt after an error in it.
    std::optional<Expression> expression(const Span& text);

    /// The number of a symbol with the same parameters and another letter.
    Symbol renamed(Symbol symbol, const std::string& letter, bool is_name);

    /// The symbols read so far.
    std::vector<SymbolInfo>& symbols() { return symbols_; }
    std::vector<std::string>& letters() { return letters_; }
    /// True if there are modules with variable parameters.
    bool is_parametric() const { return !types_.empty(); }
    /// True if a parameter in one of the words is random.
    bool uses_chance() const { return uses_chance_; }
    /// The symbol `%`, if an axiom or a successor contains it.
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
    std::array<std::optional<Symbol>, 256> plain_symbols_{};       // of single letters without parameters
    std::unordered_map<std::string, Symbol> symbol_index_;
    std::unordered_map<std::string, std::uint32_t> letter_index_;
};

}  // namespace sikku
