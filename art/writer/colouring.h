// art/writer/colouring.h: checks that the regions of a colouring page are large enough to be coloured.
#pragma once

#include "art/print/print.h"
#include "art/writer/draw_options.h"
#include "engine/language/grammar.h"

#include <vector>

namespace sikku {

/// The closed regions of a colouring page: those to colour, and holes that are not larger than a square of the line's
/// width, between lines that nearly meet in a point.
struct ColouringCheck {
    RegionReport regions;
    std::vector<Speck> specks;
};

/// Measures the closed regions between the lines of a colouring page, without lines of text, in a picture of up to
/// 300 dpi and 12 million pixels.
/// @param style    of the drawing before it was made, from prepare_colouring()
/// @param options  with the least area in `colouring`
/// @param placed   print of the drawing; its page is that of the drawing or its place on a sheet
/// @param sheet    the whole sheet, for the message
/// @throws SettingError for the option `colouring`, with the page, the derivation length and the number of dots that
/// make all regions large enough, if one is smaller or none is closed
ColouringCheck check_regions(const Grammar& grammar, const Style& style, const DrawOptions& options,
                             const Print& placed, const Page& sheet);

}  // namespace sikku
