// art/reading/polygon_files.h: reads polygons that other programs wrote, to examine them as tiles.
#pragma once

#include "engine/base/monitor.h"
#include "engine/tiling/polygon_list.h"

#include <cstddef>
#include <string_view>

namespace sikku {

/// Larger files are refused: 512 MB.
constexpr std::size_t most_polygon_bytes = std::size_t{512} << 20U;

/// Reads JSON: a list of polygons, or an object with such a list as `list`, as `sikku tiling --json` writes it. A
/// polygon is a list of corners `[x, y]`, or an object with that list as `corners`, and perhaps a `colour`. Other
/// members are skipped. Nothing but the polygons is held in memory; cost: linear.
/// @throws std::runtime_error with line and column of invalid JSON, or with the polygon and the corner; Stopped
PolygonList read_polygons_json(std::string_view text, const Monitor& monitor = {});

/// Reads the closed polygons of an SVG: paths of lines, `polygon` and `rect`, moved by all transforms around them,
/// with the y axis turned up. If any of them is filled, those without a fill are lines, not tiles, and are left out;
/// so is what a layer named `ground` contains. Notes count what was left out. Colours are numbered as they come.
/// @throws std::runtime_error with the line of damaged XML or of an element that cannot be a tile: a curve, a copy
/// (`use`); Stopped
PolygonList read_polygons_svg(std::string_view text, const Monitor& monitor = {});

}  // namespace sikku
