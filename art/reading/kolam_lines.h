// art/reading/kolam_lines.h: reads a kolam from its lines, as closed polylines.
#pragma once

#include "art/reading/lattice.h"
#include "art/reading/read_kolam.h"

#include <algorithm>
#include <cstdint>
#include <glm/vec2.hpp>
#include <optional>
#include <vector>

namespace sikku {

/// A closed line: from the last point back to the first, which is not repeated.
using ClosedLine = std::vector<glm::dvec2>;

/// A grid of dots at places of a lattice, and the origin of these places.
struct PlacedGrid {
    DotGrid grid;
    GridDot origin;  ///< the place (0, 0) of the grid
};
/// The least and the greatest x and y of some places.
struct PlaceBox {
    GridDot low{INT32_MAX, INT32_MAX}, high{INT32_MIN, INT32_MIN};
    void add(GridDot place) {
        low = {std::min(low.x, place.x), std::min(low.y, place.y)};
        high = {std::max(high.x, place.x), std::max(high.y, place.y)};
    }
};
/// @throws std::runtime_error for no places, and over DotGrid::most_dots
PlacedGrid place_grid(DotLattice lattice, std::vector<GridDot> places);

/// Reads the state of each gap from the lines that pass it. Around each gap lies a rhombus, of the two dots and the
/// middles of the faces at its sides; the states differ in how they connect the four strands that enter it. Gaps that
/// are not passed by two strands, and dots that are not encircled, are doubtful and noted.
/// @param to_lattice  maps the plane of the lines to that of the grid, where dots lie at lattice_point()
ReadKolam read_gaps(const DotGrid& grid, const Homography& to_lattice, const std::vector<ClosedLine>& lines,
                    const Monitor& monitor = {});

/// The same for lines at places of a square lattice, in units of GridDot.
ReadKolam read_gaps(const PlacedGrid& placed, const std::vector<ClosedLine>& lines, const Monitor& monitor = {});

/// Fits a grid to the dots and reads the gaps from the lines. Without dots, they are placed as tradition does: one
/// in each face that the lines run around an odd number of times.
/// @param y_down  y points down
/// @throws std::runtime_error if there are no lines, no lattice of dots fits, or most gaps cannot be read
ReadKolam kolam_of_lines(const std::vector<ClosedLine>& lines, std::vector<glm::dvec2> dots, bool y_down,
                         std::optional<DotLattice> lattice = std::nullopt, const Monitor& monitor = {});

/// The lines of a kolam through the middles of sides of dots, moved apart where they do not cross: at a turned gap
/// each turns back `apart` of the way from the gap to its dot, and at a joined one it runs as far beside the gap. In
/// units of GridDot. Cost: linear.
std::vector<ClosedLine> lines_of_kolam(const DotGrid& grid, const GapStates& states, double apart,
                                       const Monitor& monitor = {});

}  // namespace sikku
