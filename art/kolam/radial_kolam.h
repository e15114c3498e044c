// art/kolam/radial_kolam.h: radial kolams (*Hridaya kamalam*): lines through dots on arms around a centre.
#pragma once

#include "art/kolam/dot_grid_pattern.h"

#include <cstdint>
#include <string_view>
#include <vector>

namespace sikku {

/// Arms of dots around a centre. A line goes from arm to arm, and on each arm to the dot that follows in the order.
struct RadialKolam {
    static constexpr std::uint32_t most_dots = 100'000;

    std::uint32_t arms = 0;
    std::vector<std::uint32_t> order;  ///< order of the dots of an arm, counted from 1 next to the centre

    std::uint32_t dots() const { return static_cast<std::uint32_t>(order.size()); }
    /// The number of lines: the greatest common divisor of arms and dots, since a line returns to its beginning after
    /// as many steps as their least common multiple.
    /// Source: arXiv 2510.18907 (dots of arm r in the order (k arms + r) mod dots).
    std::uint32_t lines() const;
};

/// Parses `ARMSxDOTS`, such as 8x5, and the order of the dots, such as 1-3-5-2-4; empty: odd numbers, then even ones.
/// @throws std::runtime_error for fewer than 2 arms, over RadialKolam::most_dots dots, and orders that do not contain
/// each dot once
RadialKolam parse_radial_kolam(std::string_view size, std::string_view order = {});

/// Title and description for radial_pattern().
KolamPatternOptions describe_radial_kolam(const RadialKolam& kolam);

/// The first arm points up, and lines go round clockwise; dots are one step apart. A line is a spline through its
/// dots (to 1e-9 steps). Where it turns back towards or away from the centre, it is at right angles to the arm;
/// through other dots it runs on steadily. The turtle steps between its control points, 4 for each dot. `dot_symbols`
/// draws the dots and the centre; otherwise dots are marked with a transparent pen.
KolamPattern radial_pattern(const RadialKolam& kolam, const KolamPatternOptions& options = {});

}  // namespace sikku
