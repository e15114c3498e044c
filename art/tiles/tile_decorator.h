// art/tiles/tile_decorator.h: draws the decoration of tiles: curves on each, joined into long strokes.
#pragma once

#include "art/style/style.h"
#include "art/tiles/tile_outlines.h"
#include "engine/base/monitor.h"
#include "engine/geometry/path.h"

#include <glm/vec2.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace sikku {

/// Collects tiles and draws their decoration. An arc leaves the sides at right angles, so that arcs which meet in a
/// side pass it smoothly; between two sides, with both ends equally far from their common corner, it is a circular
/// arc around the corner, to about 0.03 % of its radius. The strands of a kolam pass the middles of inner sides at 45
/// degrees.
/// The sides of `kolam` and `truchet` are those between the corners of all tiles: where a corner of one tile lies in
/// a side of another, it divides the side.
class TileDecorator {
public:
    /// @param seed  seed of `truchet`  @param most  maximum number of sides
    TileDecorator(const Style& style, std::uint64_t seed, double most) : style_(style), seed_(seed), most_(most) {}

    /// Adds a tile with its vertices in drawing order. @throws BudgetError; std::runtime_error if a place lies beyond
    /// its last side
    void add(std::span<const glm::dvec2> vertices, const Pen& pen);
    /// Draws all curves: those of a colour joined smoothly into as few strokes as possible. Cost: n log n for n
    /// sides. @returns true if it drew worms @throws BudgetError, Stopped
    bool draw(PathSink& sink, const Monitor& monitor) const;

private:
    class Curves;
    /// A side of a tile, which lies on its left.
    struct Side {
        glm::dvec2 from, to;
        bool is_inner = false;  ///< another tile lies on its right
    };

    std::vector<std::vector<Side>> cut_sides(const Monitor& monitor) const;
    void draw_own(Curves& curves) const;

    const Style& style_;
    std::uint64_t seed_;
    double most_;
    TileOutlines tiles_;
    std::vector<int> colours_;  ///< colours of tiles, as indices into the palette
};

}  // namespace sikku
