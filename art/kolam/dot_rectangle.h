// art/kolam/dot_rectangle.h: rectangular grids of dots by their numbers of rows and columns.
#pragma once

#include "art/kolam/dot_grid.h"

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace sikku {

/// A rectangle of dots. In the triangular lattice every second row has one dot less.
struct DotRectangle {
    DotLattice lattice = DotLattice::square;
    std::uint32_t rows = 0;
    std::uint32_t columns = 0;  ///< dots of the first row
    bool operator==(const DotRectangle&) const = default;
};

/// True if the rectangle has dots in every row, and not more than a grid can have.
bool is_possible(const DotRectangle& rectangle);
/// @throws as DotGrid
DotGrid dot_grid(const DotRectangle& rectangle);
/// `7x22`, `7x22 idukku`; in words for interlaced grids with more rows than columns, which have no such notation.
std::string name_of(const DotRectangle& rectangle);
/// The rectangle that a grid is, or nullopt for other shapes.
std::optional<DotRectangle> rectangle_of(const DotGrid& grid);

/// Returns the nearest rectangles that `is_good`, at most two: with more or fewer columns, or else of other sizes
/// with the same difference between rows and columns. Examines 16 grids at most.
std::vector<DotRectangle> nearest_rectangles(const DotRectangle& rectangle,
                                             const std::function<bool(const DotGrid&)>& is_good);

/// Reads `7xfill`, `fillx22` and `fill`, with the words of parse_dot_grid() for lattices: sides that a page
/// determines are 0. Returns nullopt for notations without `fill`. @throws std::runtime_error
std::optional<DotRectangle> parse_fill(std::string_view text);

}  // namespace sikku
