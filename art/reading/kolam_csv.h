// art/reading/kolam_csv.h: reads and writes the CSV files of one-stroke pulli kolams.
#pragma once

#include "art/reading/read_kolam.h"

#include <cstddef>
#include <string_view>

namespace sikku {

/// Reads one kolam of a table with columns `x-kolam 1`, `y-kolam 1`, `x-kolam 2`, …: the points of a closed line in
/// each pair, on a grid of halves. Dots have whole coordinates 2 apart; a line crosses another midway between two
/// dots, and turns back half a unit from its dot. Lines with other points are read as those of a drawing. Cost:
/// linear.
/// @param number  number of the kolam in the table, from 1
/// @throws std::runtime_error with the place of the error
ReadKolam read_kolam_csv(std::string_view text, std::size_t number, const Monitor& monitor = {});

/// True if a text begins with the heading of such a table.
bool is_kolam_csv(std::string_view text);

/// Writes the kolam as number 1. Joined strands, which the format does not define, run half a unit beside the gap.
/// @throws std::runtime_error for several lines and for interlaced grids: a column has one line on a grid of halves
std::string kolam_csv_file(const DotGrid& grid, const GapStates& states, const Monitor& monitor = {});

}  // namespace sikku
