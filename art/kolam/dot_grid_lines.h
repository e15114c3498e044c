// art/kolam/dot_grid_lines.h: the states of gaps on a grid of dots, and the lines that they form.
#pragma once

#include "art/kolam/dot_grid.h"
#include "engine/base/monitor.h"

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace sikku {

/// Course of the two strands in a gap. Source for the third state: Jablan, Radović, Sazdanović & Zeković,
/// Mirror-curves and knot mosaics, 2012 (mirrors across a gap or along it).
enum class GapState : std::uint8_t {
    turned,   ///< they turn back, each around its dot
    crossed,  ///< they cross
    joined,   ///< each runs past both dots, on its side of the gap
};
/// One state for each gap, in the order of DotGrid::gaps().
using GapStates = std::vector<GapState>;

/// Parses `all` or `none` (crossed), or a digit for each gap: 0 turned, 1 crossed, 2 joined; skips blanks, commas and
/// slashes between them. @throws std::runtime_error
GapStates parse_gap_states(const DotGrid& grid, std::string_view text);
/// Formats the states as digits, with each row of gaps as a word.
std::string gap_states_text(const DotGrid& grid, const GapStates& states);
/// Counts the gaps: `60 of 84 gaps crossed and 4 joined`.
std::string summary_of(const GapStates& states);

/// The end of an arc at a side of a dot. Arc s of a dot is the part of a line that passes it between its sides s and
/// s + 1. Arcs are numbered over all dots: sides() * dot + s.
struct ArcEnd {
    std::uint32_t arc = 0;
    std::uint32_t end = 0;  ///< 0 at side s, 1 at side s + 1
    bool operator==(const ArcEnd&) const = default;
};
/// Two ends that meet.
struct ArcJoint {
    ArcEnd first;
    ArcEnd second;
};
/// The two joints in a gap.
std::array<ArcJoint, 2> joints(const DotGrid& grid, const GridGap& gap, GapState state);
/// The joint where a line turns back at a side, as at the border.
ArcJoint turning_back(const DotGrid& grid, std::uint32_t dot, std::uint32_t side);

/// A step along a line, from the middle of one side of a dot to the middle of the next: along its arc.
struct ArcStep {
    std::uint32_t dot = 0;
    std::uint32_t arc = 0;      ///< between its sides `arc` and `arc + 1`
    bool anticlockwise = true;  ///< around the dot
    bool operator==(const ArcStep&) const = default;
};
/// Side of the dot that a step starts from.
std::uint32_t entry(const DotGrid& grid, const ArcStep& step);
/// Side of the dot that a step leads to.
std::uint32_t exit(const DotGrid& grid, const ArcStep& step);
/// Direction of a step, in full turns / sides(), anticlockwise: from up right in the square lattice, from right in
/// the triangular one.
std::uint32_t heading(const DotGrid& grid, const ArcStep& step);
ArcStep next_step(const DotGrid& grid, const GapStates& states, const ArcStep& step);

/// The first step of each line, in the order of the arcs they start with: by dot, then by number.
std::vector<ArcStep> line_starts(const DotGrid& grid, const GapStates& states, const Monitor& monitor = {});

/// Counts the closed lines by following them. Cost: linear.
std::size_t count_lines(const DotGrid& grid, const GapStates& states, const Monitor& monitor = {});

/// Computes the number of lines in another way: as the nullity over GF(2) of the Laplacian of the graph whose edges
/// are the crossings and whose vertices are the loops that remain when every crossing turns back: the dots, or where
/// gaps are joined, the outlines of groups of dots. Time: O(dots * width^2 / 64), memory O(width^2), where width is
/// the smaller of the grid's two, or with joined gaps anything up to the number of dots.
/// Source: Godsil & Royle, Algebraic Graph Theory, 2001, section 17.5 (straight-ahead walks of the medial graph).
std::size_t laplacian_nullity(const DotGrid& grid, const GapStates& states, const Monitor& monitor = {});

/// The line of each arc, and the positions of its ends on that line.
struct LineLabels {
    std::vector<std::uint32_t> line;  ///< by arc
    std::vector<std::uint32_t>
        entry;                    ///< by arc: twice its place on the line, plus 1 if the line enters it at its end
    std::vector<ArcStep> starts;  ///< by line
};
void label_lines(const DotGrid& grid, const GapStates& states, LineLabels& labels, const Monitor& monitor);

}  // namespace sikku
