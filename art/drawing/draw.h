// art/drawing/draw.h: from a grammar and its style to a finished print in a file.
#pragma once

#include "art/drawing/draw_options.h"
#include "art/space/model.h"
#include "engine/base/output.h"
#include "engine/language/grammar.h"

#include <filesystem>

namespace sikku {

/// Draws into `file`, which appears whole or not at all. `print` comes with page, style, dpi and texts; its placement
/// is worked out here: from the fold where only straight lines are drawn and all are seen, else from one pass over
/// the word. What leaves nothing on paper (`stroke: none`, transparent colours) does not count. Drawings in space
/// (Grammar::is_spatial()) are seen as the style's camera sees them.
/// @throws BudgetError, WordError; std::runtime_error if nothing is drawn or the file cannot be written
DrawReport draw(const Grammar& grammar, Print print, const DrawOptions& options, const std::filesystem::path& file,
                Destination& destination = file_system());

/// A model of what is drawn: see write_model(). Widths in millimetres are those that a print would have; of `options`
/// placement, budget, begin and watch count.
/// @throws as draw()
ModelReport draw_model(const Grammar& grammar, Print print, const DrawOptions& options, PrintFormat format,
                       const std::filesystem::path& file, Destination& destination = file_system());

}  // namespace sikku
