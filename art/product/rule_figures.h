// art/product/rule_figures.h: drawings of productions: the predecessor and the successor of each.
#pragma once

#include "art/style/style.h"
#include "engine/base/monitor.h"
#include "engine/language/document.h"

#include <memory>
#include <string>
#include <vector>

namespace sikku {

/// One production. Both drawings have the same coordinates: an edge ends where the path that replaces it ends.
struct RuleFigure {
    std::string before, after;  ///< as the file writes them
    std::shared_ptr<const Grammar> predecessor, successor;
    bool is_cell = false;  ///< drawn to the same scale as other cells
};

struct RuleFigures {
    std::vector<RuleFigure> figures;
    std::vector<std::string> sentences;  ///< about productions that are not drawn: three, and numbers of others
    Style style;                         ///< of the drawings, plain, with colours for letters and tiles
};

/// Draws the productions of a pattern that derives words, in the order of the file. Productions under `interpret:`
/// are applied, but not drawn. Productions with parameters use the values of their first application. A letter that
/// draws nothing is a dot with its name; as a predecessor it is a tile of the size of its successor, with a dot where
/// the successor begins and a ring where it ends.
/// @param nodes  budget of the derivation that finds the values of parameters; it visits at most 20 million symbols
RuleFigures rule_figures(const Document& document, const Style& style, double nodes, const Monitor& monitor);

}  // namespace sikku
