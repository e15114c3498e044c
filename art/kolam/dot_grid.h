// art/kolam/dot_grid.h: kolams on a grid of dots: crossings in the gaps between dots, and the lines they form.
#pragma once

#include "engine/base/monitor.h"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace sikku {

/// Around a dot, anticlockwise. A dot's arc number s lies between its sides s and s + 1: the quarter of a line that
/// passes it there.
enum GridSide : std::uint32_t { right_side, upper_side, left_side, lower_side };

/// Twice the distance from the middle of the grid, in spacings of dots; x to the right, y up.
struct GridDot {
    std::int32_t x = 0;
    std::int32_t y = 0;
    bool operator==(const GridDot&) const = default;
};

/// The gap between two neighbouring dots.
struct GridGap {
    std::uint32_t from = 0;  ///< the left or the upper dot
    std::uint32_t to = 0;
    GridSide side = right_side;  ///< of `from`: right_side or lower_side
};

/// Dots in rows, each row centred, one spacing apart in both directions (*ner pulli*).
class DotGrid {
public:
    static constexpr std::uint64_t most_dots = 4'000'000;  ///< about 100 bytes each with all that is made of them

    /// @param rows  dots in each row, from the top: all odd or all even
    /// @throws std::runtime_error for no row, an empty one, odd and even ones together, and over most_dots
    explicit DotGrid(std::vector<std::uint32_t> rows);

    const std::vector<std::uint32_t>& rows() const { return rows_; }
    /// From the top, each row from the left.
    const std::vector<GridDot>& dots() const { return dots_; }
    /// For each row from the top: those within the row, then those to the next row, each from the left.
    const std::vector<GridGap>& gaps() const { return gaps_; }
    /// Index of the gap on that side of a dot, or -1 at the border.
    std::int32_t gap(std::uint32_t dot, std::uint32_t side) const { return gap_at_[dot][side]; }
    std::optional<std::uint32_t> dot_at(GridDot place) const;
    /// `7x7`, or `1-3-5-3-1`.
    std::string text() const;

private:
    std::vector<std::uint32_t> rows_;
    std::vector<std::uint32_t> row_begin_;  // index of each row's first dot
    std::vector<GridDot> dots_;
    std::vector<GridGap> gaps_;
    std::vector<std::array<std::int32_t, 4>> gap_at_;
};

/// `ROWSxCOLUMNS`, or the rows from the top, `1-3-5-7-5-3-1`.
/// @throws std::runtime_error for anything else, and as DotGrid does
DotGrid parse_dot_grid(std::string_view text);

/// For each gap 1 if two lines cross in it, 0 if they turn back on either side of it.
using Crossings = std::vector<char>;

/// `all`, `none`, or a 0 or 1 for each gap in the order of DotGrid::gaps(); blanks, commas and slashes between them
/// mean nothing. @throws std::runtime_error
Crossings parse_crossings(const DotGrid& grid, std::string_view text);
/// The digits, each row of gaps a word.
std::string crossings_text(const DotGrid& grid, const Crossings& crossings);

// --- lines --------------------------------------------------------------------------------------------------------

/// The number of closed lines, by following them. Cost: linear.
std::size_t count_lines(const DotGrid& grid, const Crossings& crossings, const Monitor& monitor = {});

/// The same number by another way: the nullity over GF(2) of the Laplacian of the graph whose vertices are the dots
/// and whose edges are the crossings. Time: O(dots * width^2 / 64), memory O(width^2), width the smaller of the
/// grid's two. Source: Godsil & Royle, Algebraic Graph Theory, 2001, section 17.5 (straight-ahead walks of the medial
/// graph).
std::size_t laplacian_nullity(const DotGrid& grid, const Crossings& crossings, const Monitor& monitor = {});

/// A step along a line, from the middle of one side of a dot to the middle of the next: along its arc.
struct ArcStep {
    std::uint32_t dot = 0;
    std::uint32_t arc = 0;      ///< between its sides `arc` and `arc + 1`
    bool anticlockwise = true;  ///< around the dot

    /// Side of the dot it starts from, and that it leads to.
    std::uint32_t entry() const { return anticlockwise ? arc : (arc + 1) % 4; }
    std::uint32_t exit() const { return anticlockwise ? (arc + 1) % 4 : arc; }
    /// Quarter turns anticlockwise from the direction up right.
    std::uint32_t heading() const { return (arc + (anticlockwise ? 1 : 3)) % 4; }
    bool operator==(const ArcStep&) const = default;
};
ArcStep next_step(const DotGrid& grid, const Crossings& crossings, const ArcStep& step);

/// The first step of each line, in the order of the arcs they start with: by dot, then by number.
std::vector<ArcStep> line_starts(const DotGrid& grid, const Crossings& crossings, const Monitor& monitor = {});

// --- symmetry -----------------------------------------------------------------------------------------------------

/// What leaves a drawing as it is. mirror_x exchanges left and right, mirror_y top and bottom; `mirrors` is both.
enum class GridSymmetry { none, c2, c4, mirror_x, mirror_y, mirrors, d4 };

/// `none`, `C2` (a half turn), `C4` (a quarter turn), `mirror-x`, `mirror-y`, `mirrors`, `D4`, in any case.
/// @throws std::runtime_error
GridSymmetry parse_grid_symmetry(std::string_view text);
std::string_view grid_symmetry_name(GridSymmetry symmetry);

bool has_symmetry(const DotGrid& grid, GridSymmetry symmetry);
/// @throws std::runtime_error if it does not
void require_symmetry(const DotGrid& grid, GridSymmetry symmetry);

/// Where each gap goes under each of the grid's own symmetries, the identity first: at most 8 permutations.
std::vector<std::vector<std::uint32_t>> grid_symmetries(const DotGrid& grid);

/// Gaps that the symmetry takes to each other have the same number; numbers from 0 in the order of their first gaps.
/// @throws std::runtime_error if the grid does not have the symmetry
std::vector<std::uint32_t> gap_orbits(const DotGrid& grid, GridSymmetry symmetry);

bool is_symmetric(const DotGrid& grid, const Crossings& crossings, GridSymmetry symmetry);

/// Why no single line on this grid has that symmetry, or nothing if none of the reasons known speaks against it.
/// A turn carries the line along itself, so that it winds around the middle an odd number of times: there has to be a
/// dot (or, for a half turn, a crossing). Under D4 each diagonal may cross the line only twice, and every dot on it
/// makes it do so.
std::optional<std::string> single_line_obstacle(const DotGrid& grid, GridSymmetry symmetry);

// --- making them --------------------------------------------------------------------------------------------------

struct RandomKolam {
    std::uint64_t seed = 0;
    double density = 0.7;  ///< of the gaps that are crossings, 0 to 1
    GridSymmetry symmetry = GridSymmetry::none;
};

/// Each gap, or each orbit of gaps, on its own. The same on every machine.
/// @throws std::runtime_error if the grid does not have the symmetry, or the density is not between 0 and 1
Crossings random_crossings(const DotGrid& grid, const RandomKolam& kolam);

/// Turns c lines into one by changing c - 1 gaps, the fewest that can do it; returns how many. Any two lines that
/// meet in a gap become one when it changes. Which gaps is a matter of the seed. Cost: linear, but for union-find.
std::size_t make_single_line(const DotGrid& grid, Crossings& crossings, std::uint64_t seed,
                             const Monitor& monitor = {});

/// A single line as it was found.
struct SingleLine {
    Crossings crossings;
    std::size_t changed = 0;  ///< gaps that differ from random_crossings of the seed that led to it
    int attempt = 1;
};

/// Without a symmetry random_crossings(), then make_single_line(). With one, whole orbits are changed as long as that
/// leaves fewer lines; where that ends with several, the next attempt starts from another seed, made from the first.
/// Nothing if `attempts` attempts, or 3 * 10^9 steps along lines, did not lead to one (that none exists is for
/// single_line_obstacle() to say, or for an enumeration). The monitor is asked throughout.
/// @throws as random_crossings(); Stopped
std::optional<SingleLine> find_single_line(const DotGrid& grid, const RandomKolam& kolam, int attempts = 1000,
                                           const Monitor& monitor = {});

}  // namespace sikku
