// art/tiles/border_cuts.h: moves the border of a tiling outwards by half the width of a cut.
#pragma once

#include "art/tiles/united_lines.h"

#include <vector>

namespace sikku {

/// Moves the pieces of the border outwards, into gaps between tiles, too; corners are mitred. Other lines, and pieces
/// that do not form loops, stay. @param lines  of UnitedLines::Kept::cuts  @param distance  in their unit
/// @throws std::runtime_error if a notch of the border is too narrow
std::vector<UnitedLines::Line> with_wider_border(const std::vector<UnitedLines::Line>& lines, double distance);

}  // namespace sikku
