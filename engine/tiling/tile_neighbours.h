// engine/tiling/tile_neighbours.h: which tiles share a piece of an edge.
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace sikku {

struct TilePieces;

/// The neighbours of each tile, ascending.
class TileNeighbours {
public:
    explicit TileNeighbours(const TilePieces& pieces);
    /// @param pairs  ascending, each once
    TileNeighbours(std::uint32_t tiles, std::span<const std::pair<std::uint32_t, std::uint32_t>> pairs);

    std::uint32_t tiles() const { return static_cast<std::uint32_t>(begin_.size() - 1); }
    std::span<const std::uint32_t> of(std::uint32_t tile) const {
        return std::span(others_).subspan(begin_[tile], begin_[tile + 1] - begin_[tile]);
    }

private:
    std::vector<std::uint32_t> begin_;
    std::vector<std::uint32_t> others_;
};

}  // namespace sikku
