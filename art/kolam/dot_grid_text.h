// art/kolam/dot_grid_text.h: words written in dots.
#pragma once

#include "art/kolam/dot_grid.h"

#include <cstdint>
#include <string_view>

namespace sikku {

/// Rows of dots that a capital letter may have, and usually has.
inline constexpr std::uint32_t fewest_letter_rows = 5, most_letter_rows = 200, usual_letter_rows = 12;

/// Writes text in the letters of engine/geometry/lettering.h as dots of the square lattice. The bars of letters are
/// moved to the lattice, so that they have the same number of dots everywhere (about a sixth of the rows, at least 1)
/// and the counters of letters stay open. Line feeds and `/` end lines, which are centred.
/// @param rows  rows of dots of a capital letter
/// Cost: about 1 ms for each different letter of 12 rows, 100 bytes for each dot.
/// @throws std::runtime_error for characters that the font lacks, texts without letters, over DotGrid::most_dots, and
///     letters so far apart that the grid would have more than 16 times as many places
DotGrid text_grid(std::string_view utf8, std::uint32_t rows = usual_letter_rows);

}  // namespace sikku
