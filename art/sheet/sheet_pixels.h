// art/sheet/sheet_pixels.h: combines the pixels of cells.
#pragma once

#include "art/print/print.h"
#include "art/raster/raster.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace sikku {

/// A cell as pixels of the sheet.
struct CellPicture {
    std::size_t cell = 0;
    Print print;  ///< a print whose page is the cell
    int left = 0, right = 0;
    int top = 0, bottom = 0;
};

/// Rows of the sheet with whole cells.
struct Strip {
    int top = 0, bottom = 0;
    std::vector<CellPicture> cells;
};

/// Rows of the sheet that are made at once.
struct SheetBand {
    int top = 0, bottom = 0;
    std::vector<std::uint8_t> pixels;
};

/// The colour that shows where `upper` lies over `lower`.
Colour over(Colour upper, Colour lower);

/// Copies the rows of a raster that lie in the band to their place.
/// @param left, top, height  place of the raster on the sheet, in pixels
void render_part(const Rendering& raster, int left, int top, int height, int channels, std::size_t stride,
                 SheetBand& band);

/// Keeps one channel of grey pixels.
void keep_first_channel(std::vector<std::uint8_t>& pixels, int channels);

}  // namespace sikku
