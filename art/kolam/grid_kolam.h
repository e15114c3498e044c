// art/kolam/grid_kolam.h: makes a kolam on a grid of dots, by chance or from given gaps, and describes it.
#pragma once

#include "art/kolam/dot_grid_making.h"
#include "art/kolam/dot_grid_pattern.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

namespace sikku {

struct GridKolamOptions {
    std::uint64_t seed = 0;
    std::optional<GridSymmetry> symmetry = {};  ///< absent: the seed chooses one of those that the grid and a single
                                                ///< line permit, the largest for every other kolam
    std::optional<double> density = {};  ///< share of crossed gaps; absent: composed, with a density of 0.6 to 0.8
    double joined = 0.0;                 ///< share of joined gaps among the others
    std::optional<GapStates> gaps = {};  ///< instead of chance
    std::uint32_t period = 0;            ///< columns after which the gaps of a row repeat; 0: they do not
    bool single_line = false;
    int attempts = 1000;  ///< to find a single line with a symmetry or a period
};

/// A kolam, and how it was found.
struct GridKolam {
    GapStates states;
    GridSymmetry symmetry = GridSymmetry::none;
    std::optional<std::uint64_t> same_seed{};  ///< an earlier seed that gives this kolam, if no other was found
    std::size_t different = 0;                 ///< kolams that the seeds up to this one give, if same_seed
    std::size_t changed = 0;                   ///< gaps changed to join the lines
    int attempt = 1;                           ///< number of the attempt that succeeded
    std::size_t lines = 0;                     ///< counted by following them
    std::optional<std::size_t> nullity{};  ///< counted by the Laplacian of the dots; absent if that would take long
};

/// Makes a kolam; the same on every machine. Seeds from 0 to 100 of grids with up to 150 gaps give different kolams,
/// not counting images under symmetries of the grid, as long as some are found. Cost: at most seconds.
/// @throws std::runtime_error if the grid does not have the symmetry, no single line can have it, or none was found,
/// or the grid does not have more columns than the period; Stopped
GridKolam make_grid_kolam(const DotGrid& grid, const GridKolamOptions& options, const Monitor& monitor);

/// Title and description for kolam_pattern(): dots, gaps, lines, and how to make it again.
KolamPatternOptions describe_grid_kolam(const DotGrid& grid, const GridKolamOptions& options, const GridKolam& kolam);

/// One line of JSON with grid, counts, symmetry, code and gaps.
std::string grid_kolam_json(const DotGrid& grid, const GridKolam& kolam);

}  // namespace sikku
