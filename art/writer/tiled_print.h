// art/writer/tiled_print.h: prints cut into sheets.
#pragma once

#include "art/drawing/drawing.h"
#include "art/writer/draw_options.h"
#include "engine/base/output.h"

#include <filesystem>

namespace sikku {

/// Places the drawing on the page of the whole print. With a fixed step, the page becomes as large as the drawing,
/// its border and its margins; the width of the border depends on the page.
DrawReport place_whole(Drawing& drawing, Print& print);

/// Cuts a print into the sheets of `options.tiles`: the page of `print` is that of the whole print or, with a fixed
/// step, as large as the drawing and its margins. A PDF has an overview and then a page for each sheet, and reads the
/// drawing once; in other formats each sheet is a file (tile_file()) and reads the drawing again.
/// @throws as draw()
DrawReport draw_tiles(Drawing& drawing, Print print, const DrawOptions& options, const std::filesystem::path& file,
                      Destination& destination);

}  // namespace sikku
