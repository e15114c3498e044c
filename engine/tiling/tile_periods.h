// engine/tiling/tile_periods.h: translations that map a tiling onto itself, and rectangles that they repeat.
#pragma once

#include "engine/tiling/tiling.h"

#include <array>
#include <cstdint>
#include <optional>
#include <span>

namespace sikku {

/// Translations by which a patch of tiles repeats: as far as it reaches, they map tiles onto tiles of the same kind.
struct TilePeriods {
    int count = 0;  ///< 0, 1 if all are parallel, or 2
    /// The shortest, and the shortest of another direction, in steps: all are sums of multiples of these two.
    std::array<glm::dvec2, 2> vectors{};
    std::array<Cyclotomic::Number, 2> exact{};  ///< the same in coordinates of the lattice, if the plane is exact
    std::uint64_t compared = 0;  ///< minimum number of tiles compared with their images under the vectors
    double reach = 0;            ///< length in steps up to which translations were tried
    std::uint32_t middle = 0;    ///< the tile farthest from the border
    double radius = 0;           ///< distance from the border to its first corner
};

/// Tries the translations from the tile farthest from the border to others of its kind, up to a third of its distance
/// from the border. A translation fails if it maps a neighbour of a tile onto no tile although the image of that tile
/// is surrounded by others. Exact on an exact plane.
/// @param kinds  of the tiles; tiles of the same kind have to be congruent and parallel besides
/// Cost: the tiles, times the translations that do not fail at once. @throws Stopped
TilePeriods find_periods(const TilingPatch& patch, std::span<const std::uint32_t> kinds, const Monitor& monitor);

/// Two perpendicular vectors of a lattice.
struct LatticeRectangle {
    glm::dvec2 across{0.0}, up{0.0};
    double area() const { return across.x * up.y - across.y * up.x; }
};

/// The smallest rectangle with sides along the axes whose sides are sums of multiples of two vectors, up to multiples
/// of 1000; across to the right and up. Nullopt if there is none.
std::optional<LatticeRectangle> upright_rectangle(glm::dvec2 a, glm::dvec2 b);

/// The smallest such rectangle of any direction, among sides of up to 24 vectors. It is returned in the orientation
/// with `across` within 45 degrees of the x axis.
std::optional<LatticeRectangle> least_rectangle(glm::dvec2 a, glm::dvec2 b);

}  // namespace sikku
