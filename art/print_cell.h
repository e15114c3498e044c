// art/print_cell.h: a print as a cell of a sheet.
#pragma once

#include "art/draw_settings.h"
#include "art/sheet/sheet.h"
#include "engine/language/document.h"

namespace sikku {

/// The cell in which a document is drawn as its own print would be, without a caption. What belongs to the file of
/// the print (bleed, marks, inks, resolution, the order of a plot) has no effect, nor has a distance of dots: a
/// drawing fills its cell. @throws SettingError, PatternError
SheetCell print_cell(const Document& document, const DrawSettings& settings);

}  // namespace sikku
