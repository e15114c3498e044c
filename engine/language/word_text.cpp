// engine/language/word_text.cpp: prints words, as grammar.h declares it.
#include "engine/language/grammar.h"

#include <fmt/compile.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace sikku {

void append_symbol(const SymbolInfo& symbol, std::span<const double> arguments, std::string& text) {
    text += symbol.letter;
    if (symbol.arity == 0) arguments = symbol.arguments;
    for (std::size_t i = 0; i < arguments.size(); ++i) {
        const double value = arguments[i];
        text += i == 0 ? '(' : ',';
        // Values that are not finite are written as expressions that give them.
        if (std::isfinite(value)) {
            std::array<char, 32> digits;
            const char* const end = fmt::format_to(digits.data(), FMT_COMPILE("{}"), value);
            text.append(digits.data(), static_cast<std::size_t>(end - digits.data()));
        } else {
            text += std::isnan(value) ? "0/0" : value > 0 ? "1/0" : "-1/0";
        }
    }
    if (!arguments.empty()) text += ')';
}

std::string symbol_text(const SymbolInfo& symbol, std::span<const double> arguments) {
    std::string text;
    append_symbol(symbol, arguments, text);
    return text;
}

bool needs_blank(const Grammar& grammar, Symbol before, Symbol after) {
    const SymbolInfo& one = grammar.symbols()[before];
    const SymbolInfo& other = grammar.symbols()[after];
    if (one.is_name || other.is_name) return true;
    if (grammar.names().empty() || one.arity > 0 || !one.arguments.empty()) return false;
    // Two letters that begin a name could be read as it, together with what follows.
    const std::string both = one.letter + other.letter;
    const auto found = std::lower_bound(grammar.names().begin(), grammar.names().end(), both);
    return found != grammar.names().end() && found->starts_with(both);
}

std::string to_text(const Grammar& grammar, std::span<const Symbol> word) {
    std::string text;
    for (std::size_t i = 0; i < word.size(); ++i) {
        if (i > 0 && needs_blank(grammar, word[i - 1], word[i])) text += ' ';
        text += symbol_text(grammar.symbols()[word[i]]);
    }
    return text;
}

std::string to_text(const Grammar& grammar, const ModuleWord& word) {
    std::string text;
    const double* next = word.arguments.data();
    for (std::size_t i = 0; i < word.symbols.size(); ++i) {
        const SymbolInfo& symbol = grammar.symbols()[word.symbols[i]];
        if (i > 0 && needs_blank(grammar, word.symbols[i - 1], word.symbols[i])) text += ' ';
        text += symbol_text(symbol, {next, symbol.arity});
        next += symbol.arity;
    }
    return text;
}

}  // namespace sikku
