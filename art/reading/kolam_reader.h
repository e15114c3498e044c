// art/reading/kolam_reader.h: reads the lines around the dots of a lattice from the ink of a picture.
#pragma once

#include "art/reading/dot_finder.h"
#include "art/reading/gap_reader.h"
#include "art/reading/picture.h"

#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

namespace sikku {

/// A kolam on a lattice of dots, as far as the ink agrees with one.
struct LineReading {
    FoundGrid grid;
    std::vector<GapEvidence> evidence = {};  ///< by gap
    double agreement = 0;                    ///< mean of the gaps, with their margins
    double explained = 0;             ///< share of the ink between and around the dots that agrees with the reading
    std::vector<GridDot> added = {};  ///< dots that were not seen, but have lines around them
    std::size_t joined = 0;           ///< dots that lines lead to from others
    std::vector<GridDot> open_ends = {};  ///< places beside the grid that strands lead to, without a dot
    std::vector<GridDot> missing = {};    ///< places that should have one, by the dots around them or by symmetry
    std::size_t left_out = 0;             ///< a few dots on the lattice without lines to the others
    bool reaches_edge = false;
    bool is_given = false;            ///< the dots were given
    std::vector<GridDot> blank = {};  ///< given dots that were not seen, without ink around them
    std::size_t outside = 0;          ///< given dots outside of the picture
};

/// Reads the kolams on the lattices of a picture.
class InkReader {
public:
    /// @param ink  is kept by reference
    explicit InkReader(const GreyPicture& ink) : ink_(ink) {}

    /// Reads the gaps of a grid, adds dots that have lines around them, and finds strands that leave the kolam. Dots
    /// without lines to it that are not close beside it are another kolam: the one within a frame comes first, then
    /// the one with more dots.
    /// @param grid  its map has to fit the picture
    /// Cost: about 0.1 s for 200 dots.
    std::vector<LineReading> read(const FoundGrid& grid, const Monitor& monitor);

    /// Reads the gaps between given dots, whether they were seen or not.
    /// @param grid    its map has to fit the picture
    /// @param places  of all dots, as places of `grid`; not empty
    LineReading read_as(const FoundGrid& grid, const std::vector<GridDot>& places, const Monitor& monitor);

private:
    const GreyPicture& smooth_for(const FoundGrid& grid);

    const GreyPicture& ink_;
    std::optional<std::pair<double, GreyPicture>> smooth_;  ///< blurred by a distance
    GapTemplates templates_;
};

}  // namespace sikku
