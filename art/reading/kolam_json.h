// art/reading/kolam_json.h: reads and writes `.kolam.json`, a design on a square grid.
#pragma once

#include "art/reading/read_kolam.h"

#include <string>

namespace sikku {

/// Reads `{"format": "kolam", "version": 1, "design": {"rows": R, "cols": C, "mask": […], "h": […], "v": […]}}`.
/// `mask` has a text for each row, `1` where there is a dot; `h` has the states of the gaps within each row and `v`
/// those of the gaps to the next row: `x` crossed, `p` turned, `j` joined, `.` no gap. Other keys are skipped. Safe
/// for untrusted texts. A list of such objects is read, too. @param number  number of the kolam in the list, from 1
ReadKolam read_kolam_json(const std::string& text, std::size_t number = 1);

/// Writes the same bytes for the same kolam. @throws std::runtime_error for interlaced grids, which the format lacks
std::string kolam_json_file(const DotGrid& grid, const GapStates& states);

}  // namespace sikku
