#include "art/drawing/tile_colours.h"

#include "art/drawing/torus_places.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <optional>

namespace sikku {
namespace {

using Tile = std::uint32_t;
constexpr Tile none = std::numeric_limits<Tile>::max();

/// Neighbours of each tile, ascending.
class Neighbours {
public:
    Neighbours(Tile tiles, std::span<const UnitedLines::Pair> pairs) : begins_(tiles + std::size_t{1}) {
        for (const auto& [a, b] : pairs) {
            if (a == b) continue;
            ++begins_[a + std::size_t{1}];
            ++begins_[b + std::size_t{1}];
        }
        for (std::size_t i = 0; i < tiles; ++i) begins_[i + 1] += begins_[i];
        others_.resize(begins_.back());
        std::vector<std::size_t> next = begins_;
        for (const auto& [a, b] : pairs) {
            if (a == b) continue;
            others_[next[a]++] = b;
            others_[next[b]++] = a;
        }
    }

    Tile tiles() const { return static_cast<Tile>(begins_.size() - 1); }
    std::span<const Tile> of(Tile tile) const {
        return std::span(others_).subspan(begins_[tile], begins_[tile + std::size_t{1}] - begins_[tile]);
    }

private:
    std::vector<std::size_t> begins_;
    std::vector<Tile> others_;
};

/// Distances from the given tiles; `none` where no path leads.
std::vector<Tile> distances(const Neighbours& neighbours, std::vector<Tile> reached) {
    std::vector<Tile> result(neighbours.tiles(), none);
    for (const Tile tile : reached) result[tile] = 0;
    for (std::size_t i = 0; i < reached.size(); ++i) {
        for (const Tile other : neighbours.of(reached[i])) {
            if (result[other] != none) continue;
            result[other] = result[reached[i]] + 1;
            reached.push_back(other);
        }
    }
    return result;
}

/// The parity of distances, if neighbours always differ in it.
std::optional<std::vector<Tile>> two_colours(const Neighbours& neighbours) {
    std::vector<Tile> colours(neighbours.tiles(), none);
    std::vector<Tile> reached;
    for (Tile start = 0; start < neighbours.tiles(); ++start) {
        if (colours[start] != none) continue;
        colours[start] = 0;
        reached.assign(1, start);
        for (std::size_t i = 0; i < reached.size(); ++i) {
            for (const Tile other : neighbours.of(reached[i])) {
                if (colours[other] == colours[reached[i]]) return std::nullopt;
                if (colours[other] != none) continue;
                colours[other] = 1 - colours[reached[i]];
                reached.push_back(other);
            }
        }
    }
    return colours;
}

/// Removes a tile with the fewest remaining neighbours again and again; returns the tiles in reverse order, in which
/// each has few neighbours before it (Matula & Beck 1983, smallest-last order).
std::vector<Tile> smallest_last(const Neighbours& neighbours) {
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
    explicit Colouring(const Neighbours& neighbours)
        : neighbours_(neighbours), colours_(neighbours.tiles(), none), seen_(neighbours.tiles(), none) {}

    /// False if a tile was left over after exchanges.
    bool colour(const std::vector<Tile>& order, Tile count) {
        for (const Tile tile : order) {
            if (!take_free(tile, count) && !exchange(tile, count)) return false;
        }
        return true;
    }
    /// The first free colour for each remaining tile.
    void finish(const std::vector<Tile>& order) {
        for (const Tile tile : order) {
            if (colours_[tile] == none) take_free(tile, none - 1);
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

    const Neighbours& neighbours_;
    std::vector<Tile> colours_;
    std::vector<Tile> seen_;
    std::vector<Tile> chain_;
    std::vector<bool> used_;
    Tile round_ = 0;
};

}  // namespace

std::vector<std::uint32_t> colours_of_neighbours(std::uint32_t tiles, std::span<const UnitedLines::Pair> pairs) {
    const Neighbours neighbours(tiles, pairs);
    if (auto colours = two_colours(neighbours)) return *colours;
    const std::vector<Tile> order = smallest_last(neighbours);
    for (const Tile count : {3U, 4U}) {
        Colouring colouring(neighbours);
        if (colouring.colour(order, count)) return colouring.colours();
    }
    Colouring colouring(neighbours);
    colouring.finish(order);
    return colouring.colours();
}

std::optional<std::vector<std::uint32_t>> colours_of_repeated(std::span<const glm::dvec2> middles,
                                                              std::span<const UnitedLines::Pair> neighbours,
                                                              const std::array<glm::dvec2, 2>& vectors) {
    TorusPlaces places(vectors);
    std::vector<Tile> numbers;
    numbers.reserve(middles.size());
    for (const glm::dvec2 middle : middles) numbers.push_back(places.number(middle));
    std::vector<UnitedLines::Pair> pairs;
    for (const auto& [a, b] : neighbours) {
        if (numbers[a] == numbers[b]) return std::nullopt;
        pairs.push_back(std::minmax(numbers[a], numbers[b]));
    }
    std::sort(pairs.begin(), pairs.end());
    pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
    const std::vector<Tile> colours = colours_of_neighbours(places.count(), pairs);
    for (Tile& number : numbers) number = colours[number];
    return numbers;
}

std::vector<std::uint32_t> distances_from_border(std::uint32_t tiles, std::span<const UnitedLines::Pair> pairs,
                                                 std::span<const std::uint32_t> border) {
    std::vector<Tile> result = distances(Neighbours(tiles, pairs), std::vector<Tile>(border.begin(), border.end()));
    std::replace(result.begin(), result.end(), none, Tile{0});
    return result;
}

}  // namespace sikku
