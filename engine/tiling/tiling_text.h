// engine/tiling/tiling_text.h: formats the examination of a tiling as text and as JSON.
#pragma once

#include "engine/tiling/tile_growth.h"
#include "engine/tiling/tiling.h"

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

namespace sikku {

/// Text with one line for each fact. @param title  title of the pattern or the file of polygons
/// @param n  derivation length; of polygons from a file: none
std::string tiling_text(const std::string& title, std::optional<std::int64_t> n, const TilingExamination& examination,
                        const TileGrowth& growth);
/// One line of JSON with the facts, without the border and the list of tiles.
std::string tiling_json(const std::string& title, std::optional<std::int64_t> n, const TilingResult& result,
                        const TileGrowth& growth);
/// Writes one line of JSON in parts: the facts, then all tiles with their corners in steps and, on a lattice, in
/// whole coordinates. @param path  returns the path of a tile from the axiom by its number; may be empty
void write_tiling_json(const std::string& title, std::optional<std::int64_t> n, const TilingResult& result,
                       const TileGrowth& growth, const std::function<std::string(std::uint32_t)>& path,
                       const std::function<void(std::string_view)>& write);

/// Numbers of tiles that were not derived, and their growth.
std::string tile_counts_text(const std::string& title, std::int64_t n, const TileGrowth& growth);
std::string tile_counts_json(const std::string& title, std::int64_t n, const TileGrowth& growth);

/// The usual name of a shape, such as `rhomb` or `13-gon`.
std::string shape_name(const TileShape& shape);

}  // namespace sikku
