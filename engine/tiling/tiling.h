// engine/tiling/tiling.h: examines whether the polygons of a pattern tile a region, and how.
#pragma once

#include "engine/language/grammar.h"
#include "engine/tiling/colour_search.h"
#include "engine/tiling/polygon_list.h"
#include "engine/tiling/tile_border.h"
#include "engine/tiling/tile_symmetry.h"

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace sikku {

/// Tiles that are congruent, mirror images included.
struct TileShape {
    std::uint64_t tiles = 0;
    std::uint64_t reflected = 0;  ///< those of the other hand than the first
    bool is_chiral = false;       ///< tiles of both hands occur
    std::uint64_t orientations = 0;
    std::vector<double> angles;  ///< degrees, anticlockwise, of the first tile of the shape
    std::vector<double> sides;   ///< steps; the first one follows the first angle
    double area = 0;             ///< steps squared
    /// On a lattice, coordinates of 4 i times the area in units squared: a number of the field; else empty.
    std::vector<std::int64_t> area_4i;
    double tolerance = 0;  ///< possible error of sides, in steps; 0: they were computed
};

/// Vertices with tiles all around that have the same angles of the same shapes, up to rotation and reflection.
struct VertexFigure {
    std::vector<double> angles;         ///< degrees
    std::vector<std::uint32_t> shapes;  ///< of these angles, as index into TilingExamination::shapes
    std::uint64_t count = 0;
};

/// Counts the figures of vertices with tiles all around, and numbers them by points in `figure_of`. Cost: linear.
std::vector<VertexFigure> find_figures(const TilePlane& plane, const TileSet& tiles, const TilePieces& pieces,
                                       std::vector<std::uint32_t>& figure_of, const Monitor& monitor);

/// Data of an examination, for exports.
struct TilingPatch {
    TilePlane plane;
    TileSet tiles;
    TilePieces pieces;
    TileBorder border;
    TileNeighbours neighbours{0, {}};
    std::vector<std::uint32_t> colours;    ///< of tiles, so that neighbours differ
    std::vector<std::uint32_t> figure_of;  ///< of points: index of their figure, or no_number
};

struct TilingExamination {
    bool is_exact = false;
    double tolerance = 0;  ///< steps within which points are one, if it is not exact
    std::string inexact;   ///< why it is not exact, if known
    std::uint64_t polygons = 0;
    std::uint64_t tiles = 0;
    TileViolations violations;
    /// False if tiles overlap: then all members from `regions` to `loops` are unknown.
    bool has_border = false;
    std::uint64_t regions = 0;     ///< groups of tiles that are joined by pieces
    std::uint64_t components = 0;  ///< groups of tiles that are joined by pieces or at corners
    std::vector<TileGap> gaps;     ///< bounded faces of the complement
    std::uint64_t loops = 0;
    std::vector<TileShape> shapes;
    std::uint64_t edges = 0;  ///< pieces between corners
    std::uint64_t inner_edges = 0;
    std::uint64_t border_edges = 0;
    std::uint64_t edges_cut = 0;  ///< edges of tiles with a corner inside; 0: edge-to-edge
    std::uint64_t vertices = 0;
    std::uint64_t inner_vertices = 0;
    std::vector<VertexFigure> figures;  ///< the most frequent first
    bool euler_agrees = false;          ///< V - E + F = components - gaps
    bool areas_agree = false;           ///< sum of tiles = within the outer loops - gaps
    double area = 0;                    ///< of all tiles, steps squared
    std::uint64_t neighbours = 0;       ///< pairs of tiles that share a piece
    /// Number of neighbours of a tile and number of such tiles, the largest number first.
    std::vector<std::pair<std::uint64_t, std::uint64_t>> neighbour_counts;
    int least_colours = 0;  ///< needed so that neighbours differ; absent tiles need none
    int most_colours = 0;   ///< that suffice; more than least_colours if the search did not decide. Four suffice for
                            ///< tiles that do not overlap, also where TilingPatch::colours has more
    TileSymmetry symmetry;

    bool is_tiling() const {
        return tiles > 0 && violations.count == 0 && has_border && gaps.empty() && euler_agrees && areas_agree;
    }
};

struct TilingOptions {
    TileLimits limits;
    ColourBudget colours;
    bool exact = true;  ///< use whole coordinates where angles and lengths fit a lattice
    Monitor monitor{};
};

struct TilingResult {
    TilingExamination examination;
    TilingPatch patch;
};

/// Derives a word and examines its polygons on all cores. Several threads use the monitor. Cost: about 2 s and
/// 500 MB for a million tiles.
/// @throws BudgetError, WordError, Stopped; std::runtime_error if the drawing lies in space
TilingResult examine_tiling(const Grammar& grammar, const TilingOptions& options);

/// A tolerance for polygons whose corners were rounded: a 500th of the median length of their edges, or a 1000th of
/// their size if that is less. Cost: linear. @throws std::runtime_error if no edge has a length
double usual_tolerance(const PolygonList& polygons);

/// Examines polygons of any origin; none is exact. Corners within `tolerance` of each other are one, and a corner
/// that near an edge lies on it. Cost: as above. @param tolerance  greater than 0, in the units of the polygons
/// @throws BudgetError, Stopped; std::runtime_error if the tolerance is not between 1e-12 and a thousandth of the
/// size of all polygons
TilingResult examine_polygons(const PolygonList& polygons, double tolerance, const TilingOptions& options);

}  // namespace sikku
