#include "engine/tiling/tile_neighbours.h"

#include "engine/tiling/tile_pieces.h"

#include <algorithm>

namespace sikku {

TileNeighbours::TileNeighbours(const TilePieces& pieces) {
    std::vector<std::uint32_t> near;
    begin_.reserve(pieces.begin.size());
    begin_.push_back(0);
    for (std::uint32_t tile = 0; tile + 1 < pieces.begin.size(); ++tile) {
        near.clear();
        for (std::uint32_t side = pieces.begin[tile]; side < pieces.begin[tile + 1]; ++side) {
            if (pieces.twin[side] != no_number) near.push_back(pieces.tile[pieces.twin[side]]);
        }
        std::sort(near.begin(), near.end());
        near.erase(std::unique(near.begin(), near.end()), near.end());
        others_.insert(others_.end(), near.begin(), near.end());
        begin_.push_back(static_cast<std::uint32_t>(others_.size()));
    }
}

TileNeighbours::TileNeighbours(std::uint32_t tiles, std::span<const std::pair<std::uint32_t, std::uint32_t>> pairs)
    : begin_(tiles + std::size_t{1}) {
    for (const auto& [a, b] : pairs) {
        if (a == b) continue;
        ++begin_[a + std::size_t{1}];
        ++begin_[b + std::size_t{1}];
    }
    for (std::size_t i = 0; i < tiles; ++i) begin_[i + 1] += begin_[i];
    others_.resize(begin_.back());
    std::vector<std::uint32_t> next = begin_;
    for (const auto& [a, b] : pairs) {
        if (a == b) continue;
        others_[next[a]++] = b;
        others_[next[b]++] = a;
    }
}

}  // namespace sikku
