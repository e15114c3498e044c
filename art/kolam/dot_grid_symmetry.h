// art/kolam/dot_grid_symmetry.h: symmetries of grids of dots, and of kolams on them.
#pragma once

#include "art/kolam/dot_grid_lines.h"

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace sikku {

/// Groups of rotations and mirrors about the centroid of the dots. mirror_x exchanges left and right (D1), mirror_y
/// top and bottom (D1), diagonal the two sides of the rising diagonal; mirrors are mirror_x and mirror_y (D2),
/// diagonals both diagonals (D2); d3 contains mirror_x, d3_y mirror_y.
enum class GridSymmetry : std::uint8_t {
    none,
    c2,
    c3,
    c4,
    c6,
    mirror_x,
    mirror_y,
    diagonal,
    mirrors,
    diagonals,
    d3,
    d3_y,
    d4,
    d6
};

/// Parses `none`, `C2`, `C3`, `C4`, `C6`, `mirror-x` (D1), `mirror-y`, `diagonal`, `mirrors` (D2), `diagonals`, `D3`,
/// `D3-y`, `D4`, `D6`, in any case. @throws std::runtime_error
GridSymmetry parse_grid_symmetry(std::string_view text);
std::string_view grid_symmetry_name(GridSymmetry symmetry);
/// Number of rotations and mirrors of the group, the identity included.
int grid_symmetry_order(GridSymmetry symmetry);
bool has_half_turn(GridSymmetry symmetry);
/// All symmetries, `none` first.
std::span<const GridSymmetry> grid_symmetry_list();

bool has_symmetry(const DotGrid& grid, GridSymmetry symmetry);
/// @throws std::runtime_error if the grid does not have the symmetry
void require_symmetry(const DotGrid& grid, GridSymmetry symmetry);

/// Permutations of the gaps by the grid's own symmetries, the identity first: at most 12.
std::vector<std::vector<std::uint32_t>> grid_symmetries(const DotGrid& grid);

/// Permutations of the arcs by the same symmetries, in the same order. Arcs are numbered as in ArcEnd.
std::vector<std::vector<std::uint32_t>> arc_symmetries(const DotGrid& grid);

/// The orbit of each gap under the symmetry; orbits are numbered from 0 in the order of their first gaps.
/// @param period  columns after which the gaps of a row repeat: these share an orbit; 0: they do not repeat
/// @throws std::runtime_error if the grid does not have the symmetry
std::vector<std::uint32_t> gap_orbits(const DotGrid& grid, GridSymmetry symmetry, std::uint32_t period = 0);

/// The orbit of each dot, likewise.
/// @throws std::runtime_error if the grid does not have the symmetry
std::vector<std::uint32_t> dot_orbits(const DotGrid& grid, GridSymmetry symmetry);

/// Images of a place of the lattice, with or without a dot: at most 12 places, the place itself first.
/// @throws std::runtime_error if the grid does not have the symmetry
std::vector<GridDot> place_images(const DotGrid& grid, GridDot place, GridSymmetry symmetry);

bool is_symmetric(const DotGrid& grid, const GapStates& states, GridSymmetry symmetry);

/// The first of the images of a kolam under the grid's own symmetries, when written as digits: the same for kolams
/// that are images of each other.
GapStates canonical_states(const DotGrid& grid, const GapStates& states);

/// The class of each line, in the order of line_starts(): lines that the kolam's own symmetries map onto each other
/// share a number. Classes are numbered from 0 in the order of their first lines.
std::vector<std::uint32_t> line_orbits(const DotGrid& grid, const GapStates& states, const Monitor& monitor = {});

/// A name for a kolam and all its images: 8 letters and digits (base 32) of a hash (FNV-1a, 64 bits) of the grid and
/// its canonical states.
std::string kolam_code(const DotGrid& grid, const GapStates& states);

/// Returns the reason why no single line on this grid can have the symmetry, or nullopt if none of the known reasons
/// applies. The dots have to be connected. A rotation of even order carries the line along itself, so that it winds
/// around the centre an odd number of times: a dot has to be there (or, for a half turn, a gap). The axis of a mirror
/// meets the line twice if the mirror reverses the line, and never otherwise; but it meets a line in every arc that
/// it cuts around a dot, and at every end of a row of dots on it.
/// @param joined  gaps may be joined, too: then an axis may meet the line there
std::optional<std::string> single_line_obstacle(const DotGrid& grid, GridSymmetry symmetry, bool joined = false);

/// single_line_obstacle() of a grid whose dots are connected.
std::optional<std::string> symmetry_obstacle(const DotGrid& grid, GridSymmetry symmetry, bool joined = false);

}  // namespace sikku
