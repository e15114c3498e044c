// art/product/cell_rows.h: sheets of several drawings of one document.
#pragma once

#include "art/print/print.h"
#include "art/sheet/sheet.h"
#include "art/writer/draw_options.h"
#include "engine/interpreter.h"

#include <filesystem>
#include <vector>

namespace sikku {

/// The sheet for drawings of a print, with its title.
SheetOptions row_options(const Print& print, const DrawOptions& drawing);

/// Draws the cells of a sheet, and warns of missing letters and of faint inks.
/// @param has_faint_inks  the drawings use faint inks on purpose: no warning
SheetLayout make_row(const std::vector<SheetCell>& cells, SheetOptions sheet, const DrawOptions& options,
                     Destination& destination, const std::filesystem::path& name, Made& made,
                     bool has_faint_inks = false);

}  // namespace sikku
