// art/kolam/dot_grid_making.h: makes kolams on grids of dots, by chance and as single lines.
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
    /// Crosses further gaps, with their images, until lines around neighbouring dots connect all dots of a group: no
    /// ring around a dot alone, and no piece apart.
    bool connects = false;
};

/// Each gap, or each orbit of gaps, on its own. The same on every machine.
/// @throws std::runtime_error if the grid does not have the symmetry, or a share is not between 0 and 1
GapStates random_states(const DotGrid& grid, const RandomKolam& kolam);

/// The symmetries that people would choose for a kolam on this grid, the largest first, `none` last; for a single
/// line those that nothing known speaks against.
std::vector<GridSymmetry> usual_symmetries(const DotGrid& grid, bool single_line);

/// Turns c lines into one by changing c - 1 gaps, the fewest that can do it; returns how many. Any two lines that
/// pass a gap become one if it changes: the first ones in random order. Turned and joined gaps become crossings,
/// crossings turn back. On a grid of several groups of dots each group keeps a line.
std::size_t make_single_line(const DotGrid& grid, GapStates& states, std::uint64_t seed, const Monitor& monitor = {});

struct SingleLine {
    GapStates states;
    std::size_t changed = 0;  ///< gaps that differ from random_states() of the seed that led to it
    int attempt = 1;
};

/// Without a symmetry random_states(), then make_single_line(). With one, whole orbits are changed as long as that
/// leaves fewer lines; where that ends with several, the next attempt starts from another seed, made from the first.
/// Nothing if `attempts` attempts, or 3 * 10^9 steps along lines, did not lead to one, or the dots are not connected.
/// @param steps_left  instead of 3 * 10^9 steps, those that several calls share
/// @throws as random_states()
std::optional<SingleLine> find_single_line(const DotGrid& grid, const RandomKolam& kolam, int attempts = 1000,
                                           const Monitor& monitor = {}, std::uint64_t* steps_left = nullptr);

}  // namespace sikku
