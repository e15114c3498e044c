// art/product/print_cell.h: converts the settings of a print into a cell of a sheet.
#pragma once

#include "art/product/draw_settings.h"
#include "art/sheet/sheet.h"
#include "engine/base/monitor.h"
#include "engine/language/document.h"

#include <filesystem>
#include <memory>

namespace sikku {

/// Returns a cell that draws a document like its own print, without a caption. Settings of the print's file (bleed,
/// marks, inks, resolution, the order of a plot) have no effect, and neither has the dot spacing: a drawing fills its
/// cell. @throws SettingError, PatternError
/// @param folder  folder of files that the settings name
/// @param font    the font of the settings, which cells may share; null: it is opened
/// @param monitor  of the derivation that lights a step
SheetCell print_cell(const Document& document, const DrawSettings& settings, const std::filesystem::path& folder = {},
                     std::shared_ptr<const Font> font = nullptr, const Monitor& monitor = {});

}  // namespace sikku
