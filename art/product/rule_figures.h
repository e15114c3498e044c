// art/product/rule_figures.h: productions as drawings of what they replace and of what replaces it.
#pragma once

#include "art/style/style.h"
#include "engine/base/monitor.h"
#include "engine/language/document.h"

#include <memory>
#include <string>
#include <vector>

namespace sikku {

/// One production. Both drawings are in one system of coordinates: an edge ends where the path that replaces it ends.
struct RuleFigure {
    std::string before, after;  ///< as the file writes them
    std::shared_ptr<const Grammar> predecessor, successor;
};

struct RuleFigures {
    std::vector<RuleFigure> figures;
    std::vector<std::string> sentences;  ///< about productions that are not drawn: three, and numbers of others
    Style style;                         ///< of the drawings, plain, with colours for letters and tiles
};

/// Makes the drawings of the productions of a pattern that derives words, in the order of the file; those under
/// `interpret:` are applied, and not drawn themselves. Productions with parameters are drawn with the values of their
/// first application. Letters that draw nothing are dots with their names; as predecessors they are tiles, which the
/// drawing of their successor fills, with dots where it begins and ends.
/// @param nodes  budget of the derivation that finds values of parameters; it visits at most 20 million symbols
RuleFigures rule_figures(const Document& document, const Style& style, double nodes, const Monitor& monitor);

}  // namespace sikku
