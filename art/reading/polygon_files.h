// art/reading/polygon_files.h: reads polygons that other programs wrote, to examine them as tiles.
#pragma once

#include "engine/base/monitor.h"
#include "engine/tiling/polygon_list.h"

#include <cstddef>
#include <string>
#include <string_view>

namespace sikku {

/// Maximum size of a file: 512 MB.
constexpr std::size_t most_polygon_bytes = std::size_t{512} << 20U;
constexpr std::size_t most_polygon_corners = 50'000'000;
constexpr double most_polygon_coordinate = 1e9;

/// Returns `line 3, column 7` for a byte of a text. Cost: linear.
std::string line_and_column(std::string_view text, std::size_t at);

/// Reads JSON: a list of polygons, or an object with such a list as `list`, as `sikku tiling --json` writes it. A
/// polygon is a list of corners `[x, y]`, or an object with that list as `corners`, and optionally a `colour`. Other
/// members are skipped. Only the polygons are held in memory; cost: linear.
/// @throws std::runtime_error with line and column of invalid JSON, or with the polygon and the corner; Stopped
PolygonList read_polygons_json(std::string_view text, const Monitor& monitor = {});

/// Reads the closed polygons of an SVG: paths of lines, `polygon` and `rect`, moved by all transforms around them,
/// with the y axis turned up. If any of them is filled, those without a fill are lines, not tiles, and are left out,
/// as are the contents of a layer named `ground`. Notes count the omissions. Colours are numbered in the order of
/// appearance.
/// @throws std::runtime_error with the line of damaged XML or of an element that cannot be a tile: a curve, a copy
/// (`use`); Stopped
PolygonList read_polygons_svg(std::string_view text, const Monitor& monitor = {});

}  // namespace sikku
