// art/reading/gap_reader.h: reads the state of a gap from the ink around it.
#pragma once

#include "art/kolam/dot_grid_lines.h"
#include "art/reading/lattice.h"
#include "art/reading/picture.h"

#include <array>
#include <vector>

namespace sikku {

/// Agreement of the ink around a gap with each state, -1 to 1.
struct GapEvidence {
    std::array<double, 3> agreement{};  ///< by GapState
    GapState best() const;
    /// Agreement of the best state minus that of the second best.
    double margin() const;
};

/// Compares the ink between two dots, straightened, with the strands that each state would have: correlation with
/// drawn ones of several widths and bends, a little displaced.
/// @param map         from the plane of the lattice to the picture
/// @param dot_radius  in spacings; the dots themselves are left out
/// Cost: about 60 us a gap.
std::vector<GapEvidence> read_gap_evidence(const GreyPicture& ink, const DotGrid& grid, const Homography& map,
                                           double dot_radius, const Monitor& monitor);

}  // namespace sikku
