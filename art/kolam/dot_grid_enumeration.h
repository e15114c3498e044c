// art/kolam/dot_grid_enumeration.h: enumerates all single-line kolams on a small grid of dots.
#pragma once

#include "art/kolam/dot_grid_symmetry.h"

#include <cstdint>
#include <string>
#include <vector>

namespace sikku {

struct EnumerationOptions {
    GridSymmetry symmetry = GridSymmetry::none;  ///< only kolams with this symmetry
    bool joined = false;                         ///< gaps may be joined, too: three states instead of two
    std::size_t keep = 0;                        ///< maximum number of kolams listed
    int threads = 0;                             ///< 0: all cores
    Monitor monitor = {};                        ///< polled on any thread
};

/// The kolams of a grid.
struct Enumeration {
    int choices = 0;                ///< gaps, or orbits of gaps, that are decided
    std::uint64_t states = 0;       ///< 2^choices, or 3^choices with joined gaps
    std::uint64_t single_line = 0;  ///< kolams of a single line
    std::uint64_t distinct = 0;     ///< single lines up to the symmetries of the grid
    /// The first `keep` distinct kolams, each the least of its class when written as digits, in that order.
    std::vector<GapStates> kolams;
};

/// Maximum numbers of choices: 2^36 states, or 3^22, take minutes.
constexpr int most_choices = 36;
constexpr int most_choices_of_three = 22;

/// Decides gap by gap, and backtracks as soon as a line closes while gaps are left. The result does not depend
/// on the number of threads.
/// @throws std::runtime_error if the grid does not have the symmetry, or for too many choices
Enumeration enumerate_single_lines(const DotGrid& grid, const EnumerationOptions& options = {});

/// Formats the counts in one line, then each kolam that was kept as the digits of its gaps.
std::string enumeration_text(const DotGrid& grid, GridSymmetry symmetry, const Enumeration& found);
/// Formats the result as one line of JSON.
std::string enumeration_json(const DotGrid& grid, GridSymmetry symmetry, const Enumeration& found);

}  // namespace sikku
