#include "art/tiles/tile_colours.h"

#include "art/tiles/torus_places.h"
#include "engine/tiling/colour_search.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <optional>

namespace sikku {
namespace {

using TileNumber = std::uint32_t;
constexpr TileNumber none = std::numeric_limits<TileNumber>::max();

/// Distances from the given tiles; `none` where no path leads.
std::vector<TileNumber> distances(const TileNeighbours& neighbours, std::vector<TileNumber> reached) {
    std::vector<TileNumber> result(neighbours.tiles(), none);
    for (const TileNumber tile : reached) result[tile] = 0;
    for (std::size_t i = 0; i < reached.size(); ++i) {
        for (const TileNumber other : neighbours.of(reached[i])) {
            if (result[other] != none) continue;
            result[other] = result[reached[i]] + 1;
            reached.push_back(other);
        }
    }
    return result;
}

}  // namespace

std::vector<std::uint32_t> colours_of_neighbours(std::uint32_t tiles, std::span<const UnitedLines::Pair> pairs) {
    return colours_of_neighbours(TileNeighbours(tiles, pairs), {});
}

std::optional<std::vector<std::uint32_t>> colours_of_repeated(std::span<const glm::dvec2> middles,
                                                              std::span<const UnitedLines::Pair> neighbours,
                                                              const std::array<glm::dvec2, 2>& vectors) {
    TorusPlaces places(vectors);
    std::vector<TileNumber> numbers;
    numbers.reserve(middles.size());
    for (const glm::dvec2 middle : middles) numbers.push_back(places.number(middle));
    std::vector<UnitedLines::Pair> pairs;
    for (const auto& [a, b] : neighbours) {
        if (numbers[a] == numbers[b]) return std::nullopt;
        pairs.push_back(std::minmax(numbers[a], numbers[b]));
    }
    std::sort(pairs.begin(), pairs.end());
    pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
    const std::vector<TileNumber> colours = colours_of_neighbours(places.count(), pairs);
    for (TileNumber& number : numbers) number = colours[number];
    return numbers;
}

std::vector<std::uint32_t> distances_from_border(std::uint32_t tiles, std::span<const UnitedLines::Pair> pairs,
                                                 std::span<const std::uint32_t> border) {
    std::vector<TileNumber> result =
        distances(TileNeighbours(tiles, pairs), std::vector<TileNumber>(border.begin(), border.end()));
    std::replace(result.begin(), result.end(), none, TileNumber{0});
    return result;
}

}  // namespace sikku
