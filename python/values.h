// python/values.h: converts options and settings between Python and the libraries, and lines and notes to NumPy
// arrays.
#pragma once

#include "art/analysis.h"
#include "art/prints.h"
#include "engine/interpreter.h"
#include "music/scores.h"

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <span>
#include <string>
#include <utility>
#include <vector>

namespace sikku {

/// Pairs of names and values, as passed by the package.
using TextPairs = std::vector<std::pair<std::string, std::string>>;

OptionValues to_values(const TextPairs& pairs);
std::vector<Setting> to_settings(const TextPairs& pairs);

/// Returns prints() or scores(). @throws pybind11::value_error for other names
const Interpreter& interpreter_of(const std::string& name);

/// Returns a list of (is a warning, text).
pybind11::list to_list(const std::vector<Remark>& remarks);

/// The outputs by name: str or, if the format is not a text, bytes. @param format  may be null
pybind11::dict to_dict(const MemoryDestination& outputs, const FormatName* format);

/// Returns (name, may be repeated, kind, placeholder of the value, help) for each option; kinds are text, number,
/// whole and flag.
pybind11::list list_options(std::span<const OptionInfo* const> options);
/// Returns (extension, alias, is text) for each format of an interpreter.
pybind11::list list_formats(const Interpreter& interpreter);
/// The names of all keys of the language.
pybind11::list list_keys();

/// Points: float64 of shape (points, 2 or 3). Index of the first point of each stroke, then the number of points:
/// int64 of shape (strokes + 1,). The arrays take over the vectors, without copies.
pybind11::tuple to_arrays(DrawnLines lines);

/// uint8 of shape (height, width, 4); takes over the bytes, without a copy.
pybind11::array to_array(DrawnPixels pixels);

/// Returns (arrays of the notes, end, tempo, beats of a bar, their unit).
pybind11::tuple to_tuple(const NoteList& list);
/// For each note: onset and duration (int64, ticks), key (float64), velocity (uint8), voice (int16), and piece of the
/// curve (float64, 2 x 2).
pybind11::tuple to_arrays(const std::vector<Note>& notes);

}  // namespace sikku
