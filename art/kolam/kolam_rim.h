// art/kolam/kolam_rim.h: shapes the loops at the rim of a kolam.
#pragma once

#include "art/kolam/dot_grid_pattern.h"

#include <glm/vec2.hpp>
#include <span>
#include <vector>

namespace sikku {

/// Loops at the rim: lines that turn back on more than half of the sides of a dot, but not on all, whose middle
/// side has no neighbour. Where shapes would meet each other or another dot, loops are pointed instead, or stay
/// round.
class KolamRim {
public:
    KolamRim(const DotGrid& grid, const GapStates& states, RimStyle style);

    /// Number of loops that are not round: they have the style, or are pointed.
    std::size_t shaped() const { return shaped_; }
    /// Replaces the control points of a line in the loops, except the first and the last of each.
    /// @param points  where the steps end, in spacings from the middle of the grid's box
    std::vector<glm::dvec2> reshaped(std::span<const ArcStep> steps, const std::vector<glm::dvec2>& points) const;

private:
    void find_loops(const GapStates& states, RimStyle style);
    std::vector<std::uint32_t> loops_that_meet() const;

    const DotGrid& grid_;
    glm::dvec2 centre_;
    std::vector<glm::dvec2> outwards_;             // by dot, of loops
    std::vector<std::vector<glm::dvec2>> shapes_;  // by dot: the control points anticlockwise, or none
    std::size_t shaped_ = 0;
};

}  // namespace sikku
