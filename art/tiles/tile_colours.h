// art/tiles/tile_colours.h: numbers for tiles by their neighbours, as colours.
#pragma once

#include "art/tiles/united_lines.h"

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace sikku {

/// colours_of_neighbours() of the engine. @param neighbours  as in UnitedLines::Result
std::vector<std::uint32_t> colours_of_neighbours(std::uint32_t tiles, std::span<const UnitedLines::Pair> neighbours);

/// colours_of_neighbours() for tiles that repeat: tiles that two vectors translate onto each other get the same
/// number. Returns nullopt if a tile is its own neighbour. @param middles  middles of the tiles
std::optional<std::vector<std::uint32_t>> colours_of_repeated(std::span<const glm::dvec2> middles,
                                                              std::span<const UnitedLines::Pair> neighbours,
                                                              const std::array<glm::dvec2, 2>& vectors);

/// The number of tiles to cross from the border, from 0; tiles that are not connected with it have 0.
std::vector<std::uint32_t> distances_from_border(std::uint32_t tiles, std::span<const UnitedLines::Pair> neighbours,
                                                 std::span<const std::uint32_t> border);

}  // namespace sikku
