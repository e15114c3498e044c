// art/sheet/sheet_captions.cpp: makes the captions of cells, and the cells of rows of generations.
#include "art/sheet/sheet.h"
#include "engine/derivation/derivation.h"
#include "engine/derivation/forecast.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <stdexcept>
#include <string_view>
#include <utility>

namespace sikku {
namespace {

/// The angle of `+`, from the first symbol of that letter.
std::string angle_of(const Grammar& grammar) {
    for (const SymbolInfo& symbol : grammar.symbols()) {
        if (symbol.letter != "+" || !symbol.arguments.empty() || symbol.arity > 0) continue;
        if (symbol.command.action != Action::turn) continue;
        return fmt::format("{:.6g}°", std::fabs(symbol.command.angle.degrees));
    }
    return "";
}

/// A word with a true minus sign, cut at the maximum length of a caption.
std::string word_text(const Grammar& grammar, const Word& word) {
    constexpr std::size_t most = 400;
    std::string text = to_text(grammar, std::span<const Symbol>(word).first(std::min(word.size(), most)));
    std::string result;
    for (const char byte : text) result += byte == '-' ? std::string("−") : std::string(1, byte);
    return word.size() > most ? result + "…" : result;
}

/// Productions as the file states them, where words alone are incomplete: with parameters, conditions and weights.
std::string productions_as_written(const Pattern& pattern, std::size_t most) {
    std::string text;
    const auto add = [&](const std::vector<ProductionText>& productions) {
        for (const ProductionText& production : productions) {
            if (text.size() > most) return;
            if (!text.empty()) text += "  ";
            bool was_blank = true;
            const std::string_view whole = production.whole.view();
            for (std::size_t i = 0; i < whole.size(); ++i) {
                if (text.size() > most && (static_cast<unsigned char>(whole[i]) & 0xC0) != 0x80) {
                    text += "…";
                    return;
                }
                if (whole.substr(i, 3) == "-->") {
                    text += "→";
                    i += 2;
                } else if (whole[i] == '-') {
                    text += "−";
                } else if (whole[i] != ' ' && whole[i] != '\t') {
                    text += whole[i];
                } else if (!was_blank) {
                    text += "\u00A0";
                }
                was_blank = whole[i] == ' ' || whole[i] == '\t';
            }
        }
    };
    add(pattern.common);
    for (const TableText& table : pattern.tables) add(table.productions);
    return text;
}

}  // namespace

std::vector<std::string> caption_of(const Grammar& grammar, const std::string& title, const Pattern& pattern) {
    std::vector<std::string> caption = {title};
    const std::string angle = angle_of(grammar);
    caption.push_back(fmt::format("n = {}{}{}", grammar.steps(), angle.empty() ? "" : " · ", angle));
    // Lines break between productions.
    constexpr std::size_t most = 2000;
    std::string productions = grammar.is_plain() ? "" : productions_as_written(pattern, most);
    for (const Table& table : grammar.tables()) {
        if (!grammar.is_plain()) break;
        for (const Production& production : table.productions()) {
            if (production.predecessor == production.successor || productions.size() > most) continue;
            if (!productions.empty()) productions += "  ";
            if (!production.left.empty()) productions += word_text(grammar, production.left) + "\u00A0<\u00A0";
            productions += word_text(grammar, production.predecessor);
            if (!production.right.empty()) productions += "\u00A0>\u00A0" + word_text(grammar, production.right);
            productions += "\u00A0→\u00A0";
            productions += production.successor.empty() ? "*" : word_text(grammar, production.successor);
        }
    }
    if (!productions.empty()) caption.push_back(productions);
    return caption;
}

std::vector<SheetCell> generations(const SheetCell& cell, std::int64_t first, std::int64_t last) {
    std::vector<SheetCell> row;
    if (last > most_steps) {
        throw std::runtime_error(fmt::format("'{}': expected derivation lengths up to {}", cell.title, most_steps));
    }
    for (std::int64_t n = first; n <= last; ++n) {
        auto grammar = cell.grammar->with_steps(n);
        if (!grammar) {
            throw std::runtime_error(
                fmt::format("'{}': its schedule does not reach derivation length {}", cell.title, n));
        }
        row.push_back(cell);
        row.back().grammar = std::make_shared<const Grammar>(std::move(*grammar));
        row.back().title = fmt::format("{}, n = {}", cell.title, n);
        row.back().caption = {fmt::format("n = {}", n)};
        if (n > first) row.back().heading.clear();
    }
    return row;
}

}  // namespace sikku
