// art/writer/print_cost.h: the costs of prints, and of their stages.
#pragma once

#include "art/drawing/drawing_cost.h"
#include "art/print/print.h"
#include "art/writer/draw_options.h"
#include "engine/base/cost.h"

namespace sikku {

/// The cost of a print of a drawing, in a program that makes nothing else.
/// @throws BudgetError if the word is too long to be read
Cost print_cost(const Grammar& grammar, const Print& print, const DrawOptions& options);

/// The cost of a model in space, or of a relief if the options have one. @param format  format of the file
Cost solid_cost(const Grammar& grammar, const Print& print, const DrawOptions& options, PrintFormat format);

/// Adds the pixels of a scene in space and their light.
void add_scene(const Print& print, const DrawingCost& drawing, Cost& cost);

/// The cost that arises once per program: starting it, and loading OpenImageIO if it is used.
Cost base_cost(bool has_module);

}  // namespace sikku
