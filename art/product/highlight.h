// art/product/highlight.h: colours the parts of a drawing that the productions of one step made.
#pragma once

#include "art/product/draw_settings.h"
#include "engine/base/monitor.h"

#include <string>

namespace sikku {

/// A drawing of a word that was derived whole, in which colours show where symbols come from.
struct LitDrawing {
    Grammar grammar;
    Style style;
    std::string fact;  ///< a remark: how many symbols the step replaced
};

/// Colours the parts of a finished drawing that come from each symbol that a step replaced, in six colours in turn,
/// or those of one symbol in the first colour; everything else is pale. Edges of polygons keep their colour. Works
/// with every system of words: tables, contexts, parameters, random choices, cuts, `interpret:`. Memory: two
/// successive words, and 4 bytes for the origin of each symbol.
/// @throws SettingError if the step or the symbol does not exist; BudgetError if the words exceed the budget;
/// WordError
LitDrawing lit_drawing(const Grammar& grammar, const Style& style, const Highlight& highlight, double budget,
                       const Monitor& monitor);

/// The colours of parts on a ground. @param ground  absent: white paper
std::vector<Colour> lit_colours(const std::optional<Colour>& ground);
/// An opaque tint: `share` of an ink on a ground. @param ground  absent: white paper
Colour tint(Colour ink, const std::optional<Colour>& ground, double share);

}  // namespace sikku
