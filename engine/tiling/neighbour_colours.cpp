#include "engine/tiling/colour_search.h"

#include "engine/tiling/tile_pieces.h"

#include <algorithm>
#include <cstddef>
#include <limits>

namespace sikku {
namespace {

using Tile = std::uint32_t;
constexpr Tile uncoloured = std::numeric_limits<Tile>::max();

/// Removes a tile with the fewest remaining neighbours again and again; returns the tiles in reverse order, in which
/// each has few neighbours before it (Matula & Beck 1983, smallest-last order).
std::vector<Tile> smallest_last(const TileNeighbours& neighbours) {
    const Tile count = neighbours.tiles();
    std::vector<std::size_t> degree(count);
    std::vector<std::vector<Tile>> with_degree;
    for (Tile tile = 0; tile < count; ++tile) {
        degree[tile] = neighbours.of(tile).size();
        if (with_degree.size() <= degree[tile]) with_degree.resize(degree[tile] + 1);
        with_degree[degree[tile]].push_back(tile);
    }
    std::vector<bool> is_removed(count);
    std::vector<Tile> order;
    for (std::size_t least = 0; least < with_degree.size();) {
        if (with_degree[least].empty()) {
            ++least;
            continue;
        }
        const Tile tile = with_degree[least].back();
        with_degree[least].pop_back();
        if (is_removed[tile] || degree[tile] != least) continue;  // it has moved to another list
        is_removed[tile] = true;
        order.push_back(tile);
        for (const Tile other : neighbours.of(tile)) {
            if (is_removed[other]) continue;
            with_degree[--degree[other]].push_back(other);
        }
        if (least > 0) --least;
    }
    std::reverse(order.begin(), order.end());
    return order;
}

/// Colours tiles in an order with a number of colours.
class Colouring {
public:
    Colouring(const TileNeighbours& neighbours, const Monitor& monitor)
        : neighbours_(neighbours),
          pulse_(monitor),
          colours_(neighbours.tiles(), uncoloured),
          seen_(neighbours.tiles(), uncoloured) {}

    /// Colours the tiles; false if one is left over after exchanges.
    bool colour(const std::vector<Tile>& order, Tile count) {
        for (const Tile tile : order) {
            if (!take_free(tile, count) && !exchange(tile, count)) return false;
        }
        return true;
    }
    /// Gives each remaining tile its first free colour.
    void finish(const std::vector<Tile>& order) {
        for (const Tile tile : order) {
            if (colours_[tile] == uncoloured) take_free(tile, uncoloured - 1);
        }
    }
    const std::vector<Tile>& colours() const { return colours_; }

private:
    static constexpr std::size_t longest_chain = 100'000;

    bool take_free(Tile tile, Tile count) {
        used_.assign(std::min<std::size_t>(count, neighbours_.of(tile).size() + 1), false);
        for (const Tile other : neighbours_.of(tile)) {
            if (colours_[other] < used_.size()) used_[colours_[other]] = true;
        }
        const auto free = std::find(used_.begin(), used_.end(), false);
        if (free == used_.end()) return false;
        colours_[tile] = static_cast<Tile>(free - used_.begin());
        return true;
    }

    /// Frees a colour by exchanging two colours in the chains of tiles that begin at neighbours.
    bool exchange(Tile tile, Tile count) {
        for (Tile a = 0; a < count; ++a) {
            for (Tile b = 0; b < count; ++b) {
                if (a != b && free_of(tile, a, b)) {
                    colours_[tile] = a;
                    return true;
                }
            }
        }
        return false;
    }

    /// Exchanges a and b in all chains that begin at neighbours of colour a, unless one contains a neighbour of
    /// colour b.
    bool free_of(Tile tile, Tile a, Tile b) {
        chain_.clear();
        ++round_;
        for (const Tile other : neighbours_.of(tile)) {
            if (colours_[other] == a) reach(other);
        }
        for (std::size_t next = 0; next < chain_.size();) {
            pulse_();
            if (chain_.size() > longest_chain) return false;
            for (const Tile other : neighbours_.of(chain_[next++])) {
                if (colours_[other] == a || colours_[other] == b) reach(other);
            }
        }
        for (const Tile other : neighbours_.of(tile)) {
            if (colours_[other] == b && seen_[other] == round_) return false;
        }
        for (const Tile each : chain_) colours_[each] = colours_[each] == a ? b : a;
        return true;
    }
    void reach(Tile tile) {
        if (seen_[tile] == round_) return;
        seen_[tile] = round_;
        chain_.push_back(tile);
    }

    const TileNeighbours& neighbours_;
    Pulse pulse_;
    std::vector<Tile> colours_;
    std::vector<Tile> seen_;
    std::vector<Tile> chain_;
    std::vector<bool> used_;
    Tile round_ = 0;
};

}  // namespace

TileNeighbours::TileNeighbours(const TilePieces& pieces) {
    std::vector<std::uint32_t> near;
    begin_.reserve(pieces.begin.size());
    begin_.push_back(0);
    for (std::uint32_t tile = 0; tile + 1 < pieces.begin.size(); ++tile) {
        near.clear();
        for (std::uint32_t side = pieces.begin[tile]; side < pieces.begin[tile + 1]; ++side) {
            if (pieces.twin[side] == no_number) continue;
            const Tile other = pieces.tile(pieces.twin[side]);
            if (near.empty() || near.back() != other) near.push_back(other);
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

std::vector<std::uint32_t> colours_of_neighbours(const TileNeighbours& neighbours, const Monitor& monitor) {
    if (auto colours = two_colours(neighbours)) return *colours;
    const std::vector<Tile> order = smallest_last(neighbours);
    for (const Tile count : {3U, 4U}) {
        Colouring colouring(neighbours, monitor);
        if (colouring.colour(order, count)) return colouring.colours();
    }
    Colouring colouring(neighbours, monitor);
    colouring.finish(order);
    return colouring.colours();
}

}  // namespace sikku
