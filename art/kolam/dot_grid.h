// art/kolam/dot_grid.h: grids of dots, the gaps between them, and their notations.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace sikku {

/// Arrangement of the rows of dots: above each other (*ner pulli*), or each in the gaps of its neighbours (*idukku
/// pulli*, *sandhu pulli*), so that a dot has up to six neighbours, all one spacing away.
enum class DotLattice : std::uint8_t { square, triangular };

/// A place relative to the middle of the grid's box: x in half spacings to the right, y in half distances of rows
/// upwards. A distance of rows is one spacing in the square lattice and sqrt(3)/2 of it in the triangular one.
struct GridDot {
    std::int32_t x = 0;
    std::int32_t y = 0;
    bool operator==(const GridDot&) const = default;
    /// Rows from the bottom, each from the left.
    bool operator<(GridDot other) const { return y != other.y ? y < other.y : x < other.x; }
    GridDot operator+(GridDot other) const { return {x + other.x, y + other.y}; }
    GridDot operator-(GridDot other) const { return {x - other.x, y - other.y}; }
};
/// True if `a` precedes `b` in rows from the top, each from the left.
inline bool is_before(GridDot a, GridDot b) {
    return a.y != b.y ? a.y > b.y : a.x < b.x;
}

/// The gap between two neighbouring dots. The sides of a dot count anticlockwise from the right: 0 right, 1 up, 2
/// left, 3 down, or in the triangular lattice six sides 60 degrees apart.
struct GridGap {
    std::uint32_t from = 0;  ///< the left or the upper dot
    std::uint32_t to = 0;
    std::uint32_t side = 0;  ///< side of `from`
};

/// Dots of a lattice, one spacing apart, in rows from the top.
class DotGrid {
public:
    static constexpr std::uint64_t most_dots = 4'000'000;  ///< about 100 bytes each, derived data included

    /// Makes centred rows without holes: square if all numbers are odd or all even, triangular if odd and even ones
    /// alternate.
    /// @param rows  dots in each row, from the top
    /// @throws std::runtime_error for no rows, an empty row, other numbers, and over most_dots
    explicit DotGrid(std::vector<std::uint32_t> rows);

    /// Makes a grid from any set of dots.
    /// @param columns  x of the dots of each row from the top, ascending, in half spacings from any origin. In the
    ///     square lattice all are odd or all even, in the triangular lattice odd and even rows alternate.
    /// @throws std::runtime_error for no dots, places off the lattice, and over most_dots
    DotGrid(DotLattice lattice, const std::vector<std::vector<std::int32_t>>& columns);

    DotLattice lattice() const { return lattice_; }
    /// Number of neighbours of an inner dot: 4 or 6.
    std::uint32_t sides() const { return lattice_ == DotLattice::square ? 4 : 6; }
    /// Number of dots in each row, from the top.
    std::vector<std::uint32_t> rows() const;
    /// All dots, from the top, each row from the left.
    const std::vector<GridDot>& dots() const { return dots_; }
    /// All gaps: for each row from the top, those within the row, then those to the next row, each from the left.
    const std::vector<GridGap>& gaps() const { return gaps_; }
    /// Index of the gap on that side of a dot, or -1 at the border.
    std::int32_t gap(std::uint32_t dot, std::uint32_t side) const { return gap_at_[sides() * dot + side]; }
    std::optional<std::uint32_t> dot_at(GridDot place) const;
    /// Offset from a dot to its neighbour on that side.
    GridDot step(std::uint32_t side) const;
    /// Number of connected groups of dots.
    std::size_t groups() const;
    /// True for centred rows without holes, which the numbers of dots determine.
    bool is_solid() const;
    /// Canonical notation, which parse_dot_grid() reads: `7x7`, `1-3-5-3-1`, `15-8 idukku`, `.o./ooo/.o.`.
    std::string text() const;
    /// The notation if it is short, for messages; `a grid of 60 dots` otherwise.
    std::string name() const;

private:
    void place(DotLattice lattice, const std::vector<std::vector<std::int32_t>>& columns);
    void connect();

    DotLattice lattice_ = DotLattice::square;
    std::vector<std::uint32_t> row_begin_;  // index of each row's first dot, and the number of dots
    std::vector<GridDot> dots_;
    std::vector<GridGap> gaps_;
    std::vector<std::int32_t> gap_at_;  // by dot and side
};

/// The unit vector towards a side of a dot.
glm::dvec2 lattice_ray(DotLattice lattice, std::uint32_t side);

/// A place of a GridDot in the plane of the lattice: neighbours are 1 apart, y points up.
glm::dvec2 lattice_point(DotLattice lattice, GridDot place);
/// The place of a dot, in spacings from the middle of the grid's box.
glm::dvec2 dot_place(const DotGrid& grid, std::uint32_t dot);
/// The centroid of the dots, about which the grid is symmetric.
glm::dvec2 centre_of(const DotGrid& grid);

/// Reads the notations of practitioners, in any case, with `×` for `x`, any dash, and words such as `pulli` and
/// `dots`:
/// - `7x7`: rows x columns;
/// - `1-3-5-3-1` or `7,1`: dots of each row from the top; numbers that are odd and even in turn make interlaced rows;
/// - `7 to 1`, `7-1 ner pulli`: the longest row, and each row above and below it two dots shorter, to the last one;
/// - `15-8`, `15-8 idukku pulli`, `15x8 interlaced`: the same in the interlaced (triangular) lattice, one dot shorter
///   each. Two numbers without such a word are interlaced if their difference is odd or makes a hexagon (5-3, 9-5);
/// - `7x7 idukku`: rows of 7 and 6 dots in turn (with no more rows than dots in a row, `15x8` is 15 to 8);
/// - `7x3 to 3`: three rows of 7, then shorter ones above and below;
/// - `15x9-9x3`: a block of 15 dots x 9 rows, then 9 dots x 3 rows above and below it;
/// - a shape drawn in text, rows separated by line feeds or `/`: `o` (or O * # •) is a dot, `.` or `_` none. With
///   blanks between the dots, each row may be shifted by half a spacing against its neighbours: interlaced;
/// - `text:MEERA`, `text 18:MEERA`: letters of 12 or 18 rows of dots; see text_grid().
/// @throws std::runtime_error for anything else, and as DotGrid and text_grid() do
DotGrid parse_dot_grid(std::string_view text);

/// Returns a note about notations such as `1-15-1` and `15 dots`, which users write for a diamond but which mean a
/// few rows here; empty for others.
std::string dot_grid_note(std::string_view text);

/// The letters of `text:MEERA`, as a title in one line; empty for other notations.
std::string dot_grid_title(std::string_view text);

}  // namespace sikku
