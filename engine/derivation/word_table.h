// engine/derivation/word_table.h: words of successive steps one below the other, each symbol above those that replace
// it; as plain text, Markdown and LaTeX.
#pragma once

#include "engine/derivation/lineage.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace sikku {

/// A symbol of a word, with its place. Columns are counted from 0.
struct TableSymbol {
    std::string text;
    std::size_t width = 1;   ///< of the text in columns
    std::size_t column = 0;  ///< first column of the text
    std::size_t begin = 0;   ///< columns of the symbol and of its descendants
    std::size_t end = 0;
    std::size_t parent = 0;       ///< index in the row above
    std::size_t first_child = 0;  ///< index in the row below
    std::size_t children = 0;
    std::size_t leaf = 0;      ///< number of symbols without children to the left, in all rows
    std::size_t leaves = 1;    ///< its descendants without children, or the symbol itself
    bool is_replaced = false;  ///< a production replaces it in the next step
    std::size_t replaced = 1;  ///< symbols that the production replaces, from this one on; 0: not the first
    bool is_joined = false;    ///< replaced together with the symbol before it, without a blank between
    bool is_cut = false;       ///< the next step removes it
};

struct TableRow {
    std::string label;  ///< the number of steps, or `interpret`
    std::vector<TableSymbol> symbols;
};

struct WordTable {
    std::vector<TableRow> rows;
    std::size_t columns = 0;
    std::size_t leaves = 0;
    std::size_t symbols = 0;
};

/// Lays out the words of word_lineage(): each symbol is above the middle of the symbols that replace it, and blanks
/// separate symbols that replace different ones. Parameters have four digits. Cost: linear in the symbols.
WordTable lay_out_words(const Grammar& grammar, const std::vector<LineageWord>& words);

/// Width of a text in columns: its code points without combining marks.
std::size_t text_columns(std::string_view utf8);

/// The rows as lines. @param wrap  most columns of a line with its label; longer lines continue in further blocks of
/// lines; 0: no limit
std::string words_as_text(const WordTable& table, std::size_t wrap);
/// The lines of words_as_text() as a block of code, below the title if there is one.
std::string words_as_markdown(const WordTable& table, std::size_t wrap, const std::string& title);
/// A table of LaTeX that needs no package: a column for each symbol without children; symbols that the next step
/// replaces are underlined.
std::string words_as_latex(const WordTable& table, const std::string& title);

}  // namespace sikku
