// art/reading/dot_finder.h: finds the dots of a kolam among the spots of a picture.
#pragma once

#include "art/reading/kolam_lines.h"
#include "art/reading/lattice_map.h"
#include "art/reading/spots.h"

#include <cstddef>
#include <optional>
#include <vector>

namespace sikku {

/// Maximum number of dots in a photograph: more would be a few pixels apart.
inline constexpr std::size_t most_seen_dots = 10'000;

/// A lattice in a picture, and the appearance of its dots.
struct FoundGrid {
    PlacedGrid placed;
    LatticeMap map;  ///< maps the plane of the grid to pixels
    double spacing = 0;
    double dot_radius = 0;  ///< in spacings
    double strength = 0;    ///< strength of most dots
    double angle = 90;      ///< degrees between its shortest steps
    double score = 0;

    const DotGrid& grid() const { return placed.grid; }
    /// The position of a place of the grid in the picture.
    glm::dvec2 at(GridDot place) const { return map(lattice_point(placed.grid.lattice(), place)); }
    /// The same lattice with other dots, given by places of this grid.
    FoundGrid with(std::vector<GridDot> places) const;
};

/// Finds the best lattice through the stronger spots, grown from dot to dot: rows may be bent, a few dots may be
/// weak, and a place without a dot may be skipped, but spots apart from the lattice are ignored.
/// @param spots    the strongest first
/// @param spacing  distance of neighbouring dots, if known
std::optional<FoundGrid> find_grid(const SpotFinder& finder, const std::vector<InkSpot>& spots,
                                   std::optional<DotLattice> lattice, const Monitor& monitor,
                                   std::optional<double> spacing = std::nullopt);

}  // namespace sikku
