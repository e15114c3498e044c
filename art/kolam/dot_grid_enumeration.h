// art/kolam/dot_grid_enumeration.h: enumerates all single-line kolams on a small grid of dots.
#pragma once

#include "art/kolam/dot_grid_symmetry.h"

#include <cstdint>
#include <string>
#include <vector>

namespace sikku {

struct EnumerationOptions {
    GridSymmetry symmetry = GridSymmetry::none;  ///< only those that have it
    bool joined = false;                         ///< gaps may be joined, too: three states instead of two
    std::size_t keep = 0;                        ///< maximum number of kolams listed
    int threads = 0;                             ///< 0: all cores
    Monitor monitor = {};                        ///< asked on any thread
};

/// The kolams of a grid.
struct Enumeration {
    int choices = 0;                ///< gaps, or orbits of gaps, that are decided
    std::uint64_t states = 0;       ///< 2^choices, or 3^choices with joined gaps
    std::uint64_t single_line = 0;  ///< kolams of a single line
    std::uint64_t distinct = 0;     ///< single lines up to the symmetries of the grid
    /// The first `keep` of the distinct ones: of each class the least when written as digits, in that order.
    std::vector<GapStates> kolams;
};

/// More choices are refused: 2^36 states, or 3^22, take minutes.
constexpr int most_choices = 36;
constexpr int most_choices_of_three = 22;

/// Decides gap by gap and gives up as soon as a line closes with gaps left. The same whatever the number of threads.
/// @throws std::runtime_error if the grid does not have the symmetry, or for too many choices
Enumeration enumerate_single_lines(const DotGrid& grid, const EnumerationOptions& options = {});

/// The counts in one line, then each kolam that was kept as the digits of its gaps.
std::string enumeration_text(const DotGrid& grid, GridSymmetry symmetry, const Enumeration& found);
/// The same as one line of JSON.
std::string enumeration_json(const DotGrid& grid, GridSymmetry symmetry, const Enumeration& found);

}  // namespace sikku
