// engine/tiling/exactness.cpp: explains why positions of a turtle are rounded.
#include "engine/base/decimal.h"
#include "engine/tiling/tiling.h"

#include <fmt/format.h>

namespace sikku {
std::string inexact_reason(const Grammar& grammar, const Lattice& lattice) {
    if (lattice.rank > 0) return {};
    const std::vector<char> reached = grammar.reachable();
    const auto first = [&](auto&& is_meant) -> const SymbolInfo* {
        for (std::size_t i = 0; i < reached.size(); ++i) {
            if (reached[i] && is_meant(grammar.symbols()[i])) return &grammar.symbols()[i];
        }
        return nullptr;
    };
    const auto name = [](const SymbolInfo& symbol) { return printable(symbol_text(symbol)); };
    if (const SymbolInfo* computed = first([](const SymbolInfo& symbol) {
            const Command& command = symbol.command;
            return command.takes_argument && (command.is_step() || command.action == Action::turn);
        })) {
        return fmt::format("the parameters of '{}' are computed", name(*computed));
    }
    if (lattice.headings == 0) {
        const SymbolInfo* turn = first([](const SymbolInfo& symbol) {
            return symbol.command.action == Action::turn && !symbol.command.angle.exact;
        });
        return turn ? fmt::format("'{}' does not turn by a simple fraction of 360 degrees", name(*turn))
                    : "the turns have no common fraction of 360 degrees";
    }
    if (lattice_rank(lattice.headings) == 0) {
        return fmt::format("turns by 360/{} degrees lead to places with more than 8 coordinates", lattice.headings);
    }
    const SymbolInfo* step = first([](const SymbolInfo& symbol) {
        return symbol.command.is_step() && symbol.command.edge == 0 && decimal_denominator(symbol.command.value) == 0;
    });
    return step ? fmt::format("the length of '{}' is not a short decimal; 'edge SYMBOL:' states lengths exactly",
                              name(*step))
                : "the lengths have no common unit";
}

}  // namespace sikku
