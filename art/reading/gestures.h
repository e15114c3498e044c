// art/reading/gestures.h: reads and writes kolams as gestures of the hand.
#pragma once

#include "art/reading/read_kolam.h"

#include <string>
#include <string_view>

namespace sikku {

/// Reads the gestures of square loop kolams. Source: T. Waring, Sequential encoding of Tamil kolam patterns, Forma
/// 27, 2012, 83-92. `O1` to `O4` lead from one gap around 1 to 4 quarters of a dot to the next gap, where lines
/// cross; `C1` is a ring around a dot. Horns (`H3L`, `H3R`) and points (`OP`) are read without their decoration.
///
/// The text is either a transcription as the study of Tran, Waring, Atmaca & Beheim (2021) shares them, with
/// `matrix_size`, `sequence` and `history` (YAML), or one loop in each row, as gestures separated by blanks; a row
/// may begin with the place, in dots, and the heading that the loop starts with: `0,0.5,45: O1 O3 O4 O1`. Headings
/// are in degrees clockwise from the top. Without them the first loop starts at 0,0.5,45.
/// @throws std::runtime_error with the loop and the gesture for anything else, for the gestures of diagonal kolams
/// (D, T), which cross between four dots, and for loops that do not close
ReadKolam read_gestures(std::string_view text);

/// A transcription (YAML) that read_gestures() reads.
/// @throws std::runtime_error for interlaced grids, and for joined gaps, naming the first one
std::string gestures_file(const DotGrid& grid, const GapStates& states);

}  // namespace sikku
