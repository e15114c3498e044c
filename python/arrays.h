// python/arrays.h: vectors as NumPy arrays, without copies.
#pragma once

#include "art/analysis.h"
#include "music/scores.h"

#include <pybind11/numpy.h>

namespace sikku {

/// Points: float64 of shape (points, 2 or 3). Index of the first point of each stroke, then the number of points:
/// int64 of shape (strokes + 1,).
pybind11::tuple to_arrays(DrawnLines lines);

/// For each note: onset and duration (int64, ticks), key (float64), velocity (uint8), voice (int16), and piece of the
/// curve (float64, 2 x 2).
pybind11::tuple to_arrays(const std::vector<Note>& notes);

}  // namespace sikku
