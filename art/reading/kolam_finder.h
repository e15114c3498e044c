// art/reading/kolam_finder.h: finds all kolams in a picture.
#pragma once

#include "art/image/image_file.h"
#include "art/reading/kolam_part.h"
#include "art/reading/picture.h"

#include <cstddef>
#include <optional>
#include <vector>

namespace sikku {

/// Restrictions of a search in a picture.
struct KolamSearch {
    std::optional<DotLattice> lattice = {};  ///< accept only this one
    std::optional<DotGrid> grid = {};        ///< the dots of a kolam that the picture should have
};

/// Findings in a picture.
struct KolamFindings {
    DecodedPicture picture;
    std::vector<KolamPart> parts = {};  ///< those that have the expected grid first, then readable kolams
    std::vector<InkSpot> spots = {};    ///< in the sense of the best part
    bool is_dark = true;                ///< that sense
    bool is_rough = false;
    GreyPicture ink = {};
    bool is_ink_dark = true;  ///< sense in which that is positive

    std::size_t kolams() const;
    std::size_t readable() const;
    /// Share of the picture around which no kolam was found.
    double free() const;
    /// Reads a part again with other dots. @param places  places of its grid
    LineReading read_again(const KolamPart& part, const std::vector<GridDot>& places, const Monitor& monitor);
};

KolamFindings find_kolams(DecodedPicture picture, const KolamSearch& search, const Monitor& monitor);

/// Distances from spots to the nearest other one, for at most 400 of them.
std::vector<double> nearest_distances(const std::vector<InkSpot>& spots);

}  // namespace sikku
