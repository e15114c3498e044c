// art/product/border_files.h: loads the patterns of borders.
#pragma once

#include "art/product/draw_settings.h"
#include "engine/base/input_file.h"
#include "engine/language/document.h"

#include <filesystem>

namespace sikku {

/// Loads the patterns that the border of `style` names into `options`. Files that an option names are in `folder`,
/// files that the pattern names are beside it; other names are bundled patterns.
/// @throws SettingError if one is not found or is not a pattern; Stopped
void load_border(const Style& style, const Document& document, const DrawSettings& settings,
                 const std::filesystem::path& folder, DrawingOptions& options, const FileWitness& witness = {});

}  // namespace sikku
