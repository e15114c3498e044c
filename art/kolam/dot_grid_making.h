// art/kolam/dot_grid_making.h: makes kolams on grids of dots, at random and as single lines.
#pragma once

#include "art/kolam/dot_grid_symmetry.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace sikku {

struct RandomKolam {
    std::uint64_t seed = 0;
    double density = 0.7;  ///< share of crossed gaps, 0 to 1
    double joined = 0.0;   ///< share of joined gaps among the others, 0 to 1
    GridSymmetry symmetry = GridSymmetry::none;
    std::uint32_t period = 0;  ///< columns after which the gaps of a row repeat; 0: they do not
    /// In the square lattice, crosses further gaps, with their images, until lines around neighbouring dots connect
    /// all dots of a group, without rings around single dots or separate pieces. In the triangular lattice, crosses
    /// those of interlaced_states() instead, whatever the density; single lines with a symmetry only in the first 20
    /// attempts.
    bool composed = false;
};

/// Chooses the state of each gap, or each orbit of gaps, independently unless `composed`; the same on every machine.
/// @throws std::runtime_error if the grid does not have the symmetry, or a share is not between 0 and 1
GapStates random_states(const DotGrid& grid, const RandomKolam& kolam);

/// Usual symmetries of a kolam on this grid, the largest first, `none` last; for a single line, only those without a
/// known obstacle.
std::vector<GridSymmetry> usual_symmetries(const DotGrid& grid, bool single_line);

/// Turns c lines into one by changing c - 1 gaps, the minimum; returns their number. Changing a gap that two lines
/// pass joins them; gaps are tried in random order. Turned and joined gaps become crossings, crossings turn back. On
/// a grid of several groups of dots, each group keeps a line.
std::size_t make_single_line(const DotGrid& grid, GapStates& states, std::uint64_t seed, const Monitor& monitor = {});

struct SingleLine {
    GapStates states;
    std::size_t changed = 0;  ///< gaps that differ from random_states() of the seed that led to it
    int attempt = 1;
};

/// Finds a single-line kolam. Without a symmetry: random_states(), then make_single_line(). With one, whole orbits
/// are changed as long as that reduces the number of lines; if several remain, in framed kolams (interlaced_states())
/// after up to 20 random changes more, the next attempt starts from another seed, derived from the first. With a
/// period, orbits of the repeated gaps are changed until every line reaches an end of a row; then only gaps at dots
/// that end rows, which need not repeat, are changed to join the lines. Without a symmetry that always succeeds: the
/// gaps around an end connect all lines that reach it. Returns nullopt if `attempts` attempts or 3 * 10^9 steps along
/// lines do not suffice, or the dots are not connected.
/// @param steps_left  steps that several calls share, instead of 3 * 10^9
/// @throws as random_states()
std::optional<SingleLine> find_single_line(const DotGrid& grid, const RandomKolam& kolam, int attempts = 1000,
                                           const Monitor& monitor = {}, std::uint64_t* steps_left = nullptr);

}  // namespace sikku
