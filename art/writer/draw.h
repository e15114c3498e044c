// art/writer/draw.h: draws a grammar in a style as a print or a model in a file.
#pragma once

#include "art/space/model.h"
#include "art/writer/draw_options.h"
#include "engine/base/output.h"
#include "engine/language/grammar.h"

#include <filesystem>

namespace sikku {

/// Draws into `file`, which appears whole or not at all. `print` contains page, style, dpi and texts; its placement
/// is computed here: from the fold if only straight lines are drawn and all are visible, else in one pass over the
/// word. Invisible ink (`stroke: none`, transparent colours) does not count. The style's camera views drawings in
/// space (Grammar::is_spatial()).
/// @throws BudgetError, WordError; std::runtime_error if nothing is drawn or the file cannot be written
DrawReport draw(const Grammar& grammar, Print print, const DrawOptions& options, const std::filesystem::path& file,
                Destination& destination = file_system());

class Drawing;
/// Writes a drawing that is placed on `print`: as a plot if the options or the format request it, else as a page.
/// Fills in the findings of the report. @param file  name of the output, whose extension selects the picture format
void draw_placed(const Drawing& drawing, const Print& print, const DrawOptions& options, Output& output,
                 const std::filesystem::path& file, DrawReport& report);
/// Writes a drawing that is placed on `print` as a plot. Fills in the plot of the report.
void draw_plot(const Drawing& drawing, Print print, const DrawOptions& options, Output& output, DrawReport& report);

/// Writes the drawing as a model: see write_model(). Widths in millimetres are those of the print; only placement,
/// budget, begin and watch of `options` are used.
/// @throws as draw()
ModelReport draw_model(const Grammar& grammar, Print print, const DrawOptions& options, PrintFormat format,
                       const std::filesystem::path& file, Destination& destination = file_system());

}  // namespace sikku
