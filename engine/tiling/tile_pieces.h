// engine/tiling/tile_pieces.h: the edges of tiles, cut at every corner that lies on them, and how they meet.
#pragma once

#include "engine/tiling/tile_set.h"

#include <cstdint>
#include <set>
#include <unordered_map>
#include <utility>
#include <vector>

namespace sikku {

/// A list of numbers with one byte each, or, if one of them is larger, four.
class SmallNumbers {
public:
    void reserve(std::size_t count) { bytes_.reserve(count); }
    void push_back(std::uint32_t number) {
        if (words_.empty() && number <= 255) return bytes_.push_back(static_cast<std::uint8_t>(number));
        if (words_.empty()) {
            words_.reserve(bytes_.capacity());
            words_.assign(bytes_.begin(), bytes_.end());
            std::vector<std::uint8_t>().swap(bytes_);  // frees the memory
        }
        words_.push_back(number);
    }
    std::uint32_t operator[](std::size_t i) const { return words_.empty() ? bytes_[i] : words_[i]; }

private:
    std::vector<std::uint8_t> bytes_;
    std::vector<std::uint32_t> words_;
};

/// The parts of edges between corners, each as one side of its tile, which lies on the left. Sides of a tile follow
/// each other anticlockwise. Memory: 13 to 16 bytes a side, 8 more if the plane is not exact.
struct TilePieces {
    /// Index of each tile's first side, and the number of sides at the end.
    std::vector<std::uint32_t> begin = {0};
    /// For each side:
    std::vector<std::uint32_t> from;  ///< the point where it begins
    std::vector<double> heading;      ///< radians, -π to π, if the plane is not exact
    std::vector<std::uint32_t> twin;  ///< the same piece in the opposite direction, or no_number
    /// Sides that begin at a point, anticlockwise: those of point p are in `out` from out_begin[p] on.
    std::vector<std::uint32_t> out_begin;
    std::vector<std::uint32_t> out;

    std::uint64_t edges_cut = 0;  ///< edges of tiles with a corner inside

    void reserve(std::size_t tiles, std::size_t sides);
    /// The number of a direction of TilePlane::directions(), 0 if the plane is not exact, and an angle of
    /// TileSet::angles.
    std::uint32_t form(std::uint32_t direction, std::uint32_t angle);
    /// Adds a side to a tile that is not finished yet. @param form  its direction, and the angle where it begins
    void add(std::uint32_t point, std::uint32_t form) {
        if (from.size() % share == 0) tile_of_share_.push_back(static_cast<std::uint32_t>(begin.size() - 1));
        from.push_back(point);
        form_.push_back(form);
    }
    void finish_tile() { begin.push_back(sides()); }

    std::uint32_t sides() const { return static_cast<std::uint32_t>(from.size()); }
    std::uint32_t direction(std::uint32_t side) const { return forms_[form_[side]].direction; }
    std::uint32_t angle(std::uint32_t side) const { return forms_[form_[side]].angle; }
    std::uint32_t tile(std::uint32_t side) const {
        std::uint32_t tile = tile_of_share_[side / share];
        while (begin[tile + 1] <= side) ++tile;
        return tile;
    }
    std::uint32_t next(std::uint32_t side) const {
        const std::uint32_t owner = tile(side);
        return side + 1 < begin[owner + 1] ? side + 1 : begin[owner];
    }
    std::uint32_t previous(std::uint32_t side) const {
        const std::uint32_t owner = tile(side);
        return side > begin[owner] ? side - 1 : begin[owner + 1] - 1;
    }
    std::uint32_t to(std::uint32_t side) const { return from[next(side)]; }
    std::span<const std::uint32_t> out_of(std::uint32_t point) const {
        return std::span(out).subspan(out_begin[point], out_begin[point + 1] - out_begin[point]);
    }

private:
    struct Form {
        std::uint32_t direction, angle;
    };
    static constexpr std::uint32_t share = 16;
    SmallNumbers form_;        // of sides
    std::vector<Form> forms_;  // few occur
    std::unordered_map<std::uint64_t, std::uint32_t> form_numbers_;
    std::vector<std::uint32_t> tile_of_share_;  // the tile of every 16th side
};

/// The edges in which corners of other tiles are looked for.
enum class CutSearch : std::uint8_t {
    /// Those that are not an edge of two tiles in opposite directions, and only corners where such edges meet. That
    /// finds all corners inside edges, unless tiles overlap: elsewhere, tiles lie on all sides. Only for exact
    /// planes.
    unpaired,
    all
};

/// Cuts the edges of tiles and finds the sides of each piece. Sorts the directions of an exact plane. Cost: linear
/// for tiles of similar sizes; on the threads of the caller's arena. @throws BudgetError if the sizes of the tiles
/// differ so much that it would take minutes
TilePieces cut_into_pieces(TilePlane& plane, const TileSet& tiles, CutSearch search, const Monitor& monitor);

/// Overlaps of pairs of tiles, each pair once as far as the first 100,000.
class TileOverlaps {
public:
    explicit TileOverlaps(const TileSet& tiles) : tiles_(tiles) {}
    void add(std::uint32_t a, std::uint32_t b, glm::dvec2 at) {
        const auto [first, second] = std::minmax(a, b);
        const bool is_new =
            pairs_.size() >= 100'000 ? !pairs_.contains({first, second}) : pairs_.emplace(first, second).second;
        if (is_new) found.add({TileFault::overlap, tiles_.number[second], tiles_.number[first], at});
    }
    TileViolations found;

private:
    const TileSet& tiles_;
    std::set<std::pair<std::uint32_t, std::uint32_t>> pairs_;
};

/// Facts about the points where pieces meet, and places where tiles overlap.
struct TileVertices {
    TileViolations overlaps;  ///< pairs of tiles that overlap around a point
    std::uint64_t points = 0;
    std::uint64_t inner = 0;  ///< points with tiles all around
};

/// Checks that no piece is used twice in one direction, and that the sectors of tiles around each vertex do not
/// overlap.
TileVertices check_vertices(const TilePlane& plane, const TileSet& tiles, const TilePieces& pieces,
                            const Monitor& monitor);

}  // namespace sikku
