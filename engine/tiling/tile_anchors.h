// engine/tiling/tile_anchors.h: finds tiles by their class and their first corner.
#pragma once

#include "engine/tiling/tile_plane.h"

#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <vector>

namespace sikku {

/// Lists for each point the tiles with that first corner. Neighbours have similar numbers, so the lists of successive
/// tiles are close in memory, unlike entries of a hash table. Memory: 4 bytes a point, 8 a tile.
class TileAnchors {
public:
    /// The tile of that class and first corner, or no_number.
    std::uint32_t find(std::uint32_t in_class, std::uint32_t corner) const {
        if (corner >= first_.size()) return no_number;
        std::size_t length = 0;
        for (std::uint32_t tile = first_[corner]; tile != no_number; tile = tiles_[tile].next) {
            if (tiles_[tile].in_class == in_class) return tile;
            ++length;
        }
        if (length < longest) return no_number;
        const auto found = others_.find(key(in_class, corner));
        return found == others_.end() ? no_number : found->second;
    }
    /// Adds the next tile, unless there is one of that class and first corner. Returns that one, or no_number.
    std::uint32_t add(std::uint32_t in_class, std::uint32_t corner) {
        const std::uint32_t earlier = find(in_class, corner);
        if (earlier != no_number) return earlier;
        if (corner >= first_.size()) first_.resize(corner + std::size_t{1}, no_number);
        const auto tile = static_cast<std::uint32_t>(tiles_.size());
        tiles_.push_back({in_class, no_number});
        std::size_t length = 0;
        std::uint32_t* end = &first_[corner];
        for (; *end != no_number; end = &tiles_[*end].next) ++length;
        if (length < longest) {
            *end = tile;
        } else {
            others_.emplace(key(in_class, corner), tile);
        }
        return no_number;
    }

private:
    static constexpr std::size_t longest = 32;
    struct Tile {
        std::uint32_t in_class;
        std::uint32_t next;  ///< next tile with the same first corner
    };
    static std::uint64_t key(std::uint32_t in_class, std::uint32_t corner) {
        return std::uint64_t{in_class} << 32U | corner;
    }

    std::vector<std::uint32_t> first_;  // first tile of each point
    std::vector<Tile> tiles_;
    std::unordered_map<std::uint64_t, std::uint32_t> others_;  ///< beyond the longest list
};

}  // namespace sikku
