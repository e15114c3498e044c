// art/reading/spots.h: finds the dots of a kolam in a picture.
#pragma once

#include "art/reading/picture.h"

#include <glm/vec2.hpp>
#include <vector>

namespace sikku {

/// A spot of ink with ground all around it, which a point on a line does not have.
struct Spot {
    glm::dvec2 at{0.0};
    double radius = 0.0;    ///< in pixels
    double strength = 0.0;  ///< ink in its middle less the most ink around it
};

/// Pictures of the ink at several scales, and the spots in them.
class SpotFinder {
public:
    /// @param ink  positive on lines and dots
    SpotFinder(const GreyPicture& ink, const Monitor& monitor);

    /// All spots, the strongest first; none within another. At most 20,000.
    std::vector<Spot> find(const Monitor& monitor) const;
    /// The strongest spot of about that radius within `reach` of a place; strength 0 if there is none.
    Spot near(glm::dvec2 at, double radius, double reach) const;

private:
    double strength(std::size_t scale, glm::dvec2 at) const;
    std::vector<double> radii_;
    std::vector<GreyPicture> blurred_;
};

}  // namespace sikku
