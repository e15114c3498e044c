// art/reading/grid_fit.h: lays the grid that a picture should show onto the dots that were found in it.
#pragma once

#include "art/kolam/dot_grid.h"

#include <cstddef>
#include <vector>

namespace sikku {

/// A grid laid onto other dots of the same lattice.
struct GridFit {
    std::vector<GridDot> places;  ///< of its dots, as places of the grid that was found; ascending
    std::size_t agreed = 0;       ///< those with a dot
    std::size_t surplus = 0;      ///< dots that were found elsewhere

    std::size_t lost() const { return places.size() - agreed; }
    /// True if at least half of its dots were found, and hardly any others.
    bool is_plausible() const;
};

/// Lays a grid, in each rotation of the lattice, where most dots agree. @return the best fits, the first one with the
/// fewest lost and surplus dots; none if the lattices differ, or
/// the numbers of dots do so much that none would be plausible
/// Cost: about 64 steps for each of its dots and rotation.
std::vector<GridFit> fit_grid(const DotGrid& wanted, const DotGrid& found);

}  // namespace sikku
