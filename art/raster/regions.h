// art/raster/regions.h: finds the regions of light paper that dark lines enclose in a picture.
#pragma once

#include "art/raster/raster.h"

#include <glm/vec2.hpp>
#include <vector>

namespace sikku {

/// A closed region, in pixels.
struct ClosedRegion {
    double pixels = 0;       ///< area; pixels on its outline count by their lightness
    glm::dvec2 centre{0.0};  ///< centre of mass, y down
};

/// Finds the 4-connected regions of pixels at least half as light as white that do not reach the edge of the picture,
/// in the order of their first pixels. Cost: linear in pixels. Memory: 40 bytes for each run of light pixels in a
/// row.
/// @param size  of the picture
std::vector<ClosedRegion> closed_regions(Rendering& rendering, PixelSize size);

}  // namespace sikku
