// art/words/word_svg.h: words and derivation trees as SVG, with letters as text.
#pragma once

#include "engine/derivation/word_table.h"
#include "engine/language/pattern.h"

#include <cstddef>
#include <string>

namespace sikku {

/// Texts above a figure of words, and those stored in the file.
struct WordFigure {
    std::string title;
    std::vector<std::string> lines;  ///< axiom and productions
    std::string pattern;             ///< text of the pattern
    std::string made;                ///< recipe
};

/// The title of a pattern, and its axiom and productions as the file writes them, up to a dozen, each up to 100
/// characters.
WordFigure word_figure(const Pattern& pattern);

/// Words one below the other: symbols that the next step replaces are red, and joined to those that replace them.
std::string words_svg(const WordTable& table, const WordFigure& figure);

/// The derivation tree: a node for each symbol of each word, one level for each step. Subtrees are as close as their
/// outlines allow, a parent is centred above its children, and equal subtrees are drawn alike.
/// Source: Buchheim, Jünger & Leipert, Improving Walker's algorithm to run in linear time, GD 2002; after Reingold &
/// Tilford, Tidier drawings of trees, IEEE TSE 7 (1981), and Walker 1990.
std::string tree_svg(const WordTable& table, const WordFigure& figure);

}  // namespace sikku
