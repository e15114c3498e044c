// python/tiles.h: the tiles of a drawing as NumPy arrays, with the certificate of the tiling.
#pragma once

#include "engine/language/document.h"

#include <pybind11/pybind11.h>

namespace sikku {

/// Examines the polygons of a document. Returns (certificate as JSON, arrays): corners (float64, corners x 2), index
/// of the first corner of each tile and the number of corners (int64), number of the polygon in drawing order
/// (int64), shape, orientation and colour (int32), whether the tile is reflected (bool), letters (list of str),
/// neighbours (int32, pairs x 2, indices of tiles) and colours in which neighbours differ (int32).
/// @param budget  maximum number of derivation nodes visited
/// @throws as examine_tiling(); PatternError for maps
pybind11::tuple tiles_of(const Document& document, double budget);

/// The numbers of tiles and their growth as JSON, without deriving them. @throws PatternError for maps
pybind11::str count_tiles(const Document& document);

}  // namespace sikku
