// python/arrays.h: vectors as arrays of numpy, without copies.
#pragma once

#include "art/analysis.h"
#include "music/scores.h"

#include <pybind11/numpy.h>

namespace sikku {

/// Points, float64 of shape (points, 2 or 3), and the index of the first point of each stroke, then their number,
/// int64 of shape (strokes + 1,).
pybind11::tuple to_arrays(DrawnLines lines);

/// Onset, duration (int64, ticks), key (float64), velocity (uint8), voice (int16), one of each for every note, and
/// the pieces of the curve, float64 of shape (notes, 2, 2).
pybind11::tuple to_arrays(const std::vector<Note>& notes);

}  // namespace sikku
