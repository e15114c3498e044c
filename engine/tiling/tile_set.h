// engine/tiling/tile_set.h: the polygons of a word as tiles.
#pragma once

#include "engine/base/monitor.h"
#include "engine/language/grammar.h"
#include "engine/tiling/tile_anchors.h"
#include "engine/tiling/tile_plane.h"

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace sikku {

/// Error of a polygon, or of two.
enum class TileFault : std::uint8_t {
    open,       ///< the outline does not end where it began
    empty,      ///< fewer than three corners, or no area
    too_fine,   ///< at this tolerance, corners of a curved outline count as points on straight lines
    crossing,   ///< the outline crosses or touches itself
    duplicate,  ///< the same corners as an earlier tile
    overlap,
};
/// The symbol of a pattern that drew a polygon.
struct TileOrigin {
    int line = 0, column = 0;  ///< of the `}` in the text, from 1
    std::string path;          ///< `A 1, B 3`: the symbols from the axiom to it, if there are any
};
/// A fault with its polygons, numbered from 1 in drawing order.
struct TileViolation {
    TileFault fault = TileFault::open;
    std::uint32_t tile = 0;
    std::uint32_t other = 0;  ///< the earlier tile of two; else 0
    glm::dvec2 at{0.0};
    std::vector<TileOrigin> origins{};  ///< of `other` and `tile`, if known: see find_origins()
};
/// The first violations in their order, and the number of all.
struct TileViolations {
    static constexpr std::size_t most = 100;
    /// Number of overlaps after which the search for more ends.
    static constexpr std::uint64_t most_counted = 100'000;
    std::vector<TileViolation> list;
    std::uint64_t count = 0;  ///< a lower bound from most_counted on
    void add(TileViolation violation) {
        if (list.size() < most) list.push_back(std::move(violation));
        ++count;
    }
    void add(const TileViolations& others) {
        for (const TileViolation& violation : others.list) add(violation);
        count += others.count - others.list.size();
    }
};

/// Tiles that are the same up to translation.
struct TileClass {
    std::vector<std::uint32_t> vectors;  ///< edges, anticlockwise; the least of all their rotations
    std::vector<std::uint32_t> angles;   ///< at the beginning of each edge, as index into TileSet::angles
    std::uint32_t shape = 0;             ///< the same up to motions and reflections
    std::uint32_t hand = 0;              ///< the same up to motions
    bool is_reflected = false;           ///< not of the hand of the first tile of its shape
    double area = 0;                     ///< in steps squared
    Cyclotomic::Number area_4i{};        ///< 4 i times the area in units squared, if the plane is exact
    std::uint32_t first = 0;             ///< its first tile
};

/// Valid tiles on an exact plane that recur at other places, relative to a place of its lattice.
struct TilePart {
    std::vector<std::int32_t> points;    ///< coordinates of their corners, in the order in which these occur first
    std::vector<std::uint32_t> corner;   ///< of all tiles, as indices of points
    std::vector<std::uint32_t> partner;  ///< of edges: the only one in the opposite direction, or no_number
    std::vector<std::uint32_t> in_class;
    std::vector<std::int32_t> colour;
};

/// Valid tiles in drawing order, without duplicates.
struct TileSet {
    /// For each tile; `begin` has one more entry at its end.
    std::vector<std::uint32_t> begin;     ///< index of its first corner
    std::vector<std::uint32_t> in_class;  ///< index into `classes`
    std::vector<std::int32_t> colour;
    std::vector<std::uint32_t> number;  ///< of the polygon in drawing order, from 1
    std::vector<std::uint32_t> corner;  ///< points, anticlockwise, those on straight stretches left out
    TileAnchors anchors;

    /// Parts that recur, and where their tiles are: the index of the first corner.
    struct PlacedPart {
        std::uint32_t begin = 0, part = 0;
    };
    std::vector<TilePart> parts;
    std::vector<PlacedPart> placed;

    std::vector<TileClass> classes;  ///< in the order of their first tiles
    std::vector<double> angles;      ///< angles between edges, in degrees
    std::uint32_t shapes = 0;
    std::uint32_t polygons = 0;  ///< all that were drawn
    TileViolations violations;

    std::uint32_t tiles() const { return static_cast<std::uint32_t>(in_class.size()); }
    std::span<const std::uint32_t> corners(std::uint32_t tile) const {
        return std::span(corner).subspan(begin[tile], begin[tile + 1] - begin[tile]);
    }
    const TileClass& class_of(std::uint32_t tile) const { return classes[in_class[tile]]; }
};

/// The index at which the least rotation of a cyclic sequence begins. Cost: linear.
std::size_t least_rotation(std::span<const std::uint32_t> sequence);
std::uint64_t hash_of(std::span<const std::uint32_t> sequence);

/// Limits of an examination, checked before memory and time are spent.
struct TileLimits {
    double nodes = 200e6;  ///< of the derivation
    double tiles = 10e6;
    double bytes = 0;  ///< of memory; 0: half of what is available
};

/// The state of a set of tiles to which more are added.
struct TileMark {
    std::uint32_t tiles = 0, polygons = 0;
};

/// Adds polygons one by one to a set of tiles.
class TileCollector {
public:
    TileCollector(TilePlane& plane, TileSet& tiles, double most_corners, const Monitor& monitor);
    ~TileCollector();
    /// Reserves memory for about that many polygons.
    void expect(double polygons);
    /// Adds a polygon; faults go to TileSet::violations. @throws BudgetError
    void add(std::span<const std::uint32_t> points, std::int32_t colour, bool is_closed);
    /// The same on an exact plane, in coordinates of its lattice, and faster.
    void add(std::span<const std::int64_t> coordinates, std::span<const glm::dvec2> places, std::int32_t colour,
             bool is_closed);

    TileMark mark() const;
    /// Keeps the tiles that were added since `mark` as a part, relative to a place. Returns its number; nullopt if
    /// there were faults. Only on an exact plane.
    std::optional<std::uint32_t> keep_part(const TileMark& mark, const Cyclotomic::Number& origin);
    /// Adds the tiles of a part at another place, as if they were drawn there. @throws BudgetError
    void add_part(std::uint32_t part, const Cyclotomic::Number& origin);

private:
    class Implementation;
    std::unique_ptr<Implementation> implementation_;
};

/// Number of corners that fit into the memory of the limits.
double most_corners(const TileLimits& limits);

/// Maximum number of corners of an outline that is searched for crossings.
constexpr std::size_t most_corners_of_tile = 20'000;

/// The sizes of polygons whose corners are doubles.
struct TileScale {
    /// Error of positions as a share of the farthest one: about a thousand roundings.
    static constexpr double rounding = 0x1p-42;

    double farthest = 0;                                        ///< the largest coordinate
    double shortest = std::numeric_limits<double>::infinity();  ///< the shortest edge

    void add(std::span<const glm::dvec2> corners);
    /// The distance within which points can count as one: TilePlane::least_tolerance, unless positions have larger
    /// errors or edges are shorter than a hundred times that. @throws BudgetError if both is the case
    double tolerance() const;
};

/// Derives the word of a grammar and collects its polygons.
/// @param scale  receives their sizes, if the plane is not exact
/// @throws BudgetError, WordError, Stopped; TilePlane::OutOfRange
TileSet collect_tiles(const Grammar& grammar, TilePlane& plane, const TileLimits& limits, TileScale& scale,
                      const Monitor& monitor);

}  // namespace sikku
