// art/reading/spots.h: finds the dots of a kolam in a picture.
#pragma once

#include "art/reading/picture.h"

#include <algorithm>
#include <cstddef>
#include <glm/vec2.hpp>
#include <vector>

namespace sikku {

/// A spot of ink with ground all around it, unlike a point on a line.
struct InkSpot {
    glm::dvec2 at{0.0};
    double radius = 0.0;    ///< in pixels
    double strength = 0.0;  ///< ink in its middle minus the maximum around it
};

/// Pictures of the ink at several scales, and the spots in them.
class SpotFinder {
public:
    /// @param ink  positive on lines and dots
    SpotFinder(const GreyPicture& ink, const Monitor& monitor);

    /// The longer side of the picture.
    double longer_side() const { return static_cast<double>(std::max(blurred_[0].width, blurred_[0].height)); }
    /// Exchanges ink and ground, as in a negative.
    void negate();
    /// All spots, the strongest first; none within another. At most `most_spots`.
    std::vector<InkSpot> find(const Monitor& monitor) const;
    static constexpr std::size_t most_spots = 20'000;
    /// The strongest spot of about this radius within `reach` of a place; strength 0 if none is found.
    InkSpot near(glm::dvec2 at, double radius, double reach) const;

private:
    /// The strength of a spot at a place; 0 if it is not above a limit.
    double strength(std::size_t scale, glm::dvec2 at, double limit) const;
    /// Pieces of ink that are small and round, however near other ink is.
    void find_pieces(std::vector<InkSpot>& spots, const Monitor& monitor) const;
    /// Peaks of the ink at a scale that are higher than the ink around them.
    void find_peaks(std::size_t scale, std::vector<InkSpot>& spots) const;
    std::vector<double> radii_;
    std::vector<GreyPicture> blurred_;
};

}  // namespace sikku
