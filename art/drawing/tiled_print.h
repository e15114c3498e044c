// art/drawing/tiled_print.h: prints over many sheets.
#pragma once

#include "art/drawing/drawing.h"
#include "engine/base/output.h"

#include <filesystem>

namespace sikku {

/// Cuts a print into the sheets of `options.tiles`: the page of `print` is that of the whole or, with a fixed step,
/// as large as the drawing within its margins. A PDF has a page for each sheet after an overview, for which the
/// drawing is read once; in other formats each sheet is a file (tile_file()), for which it is read again.
/// @throws as draw()
DrawReport draw_tiles(Drawing& drawing, Print print, const DrawOptions& options, const std::filesystem::path& file,
                      Destination& destination);

}  // namespace sikku
