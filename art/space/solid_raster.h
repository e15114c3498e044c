// art/space/solid_raster.h: renders a scene as pixels with hidden surfaces removed.
#pragma once

#include "art/raster/raster.h"
#include "art/space/scene.h"

#include <memory>

namespace sikku {

/// Renders lines as round stems with round ends, as wide at both ends as their pens, polygons with two sides, and
/// smooth spheres. 16 samples a pixel, each with the depth of the nearest surface; lines are at least a quarter of a
/// pixel wide. Partly transparent colours show only the ground through them. Memory: 4 bytes for each band of rows
/// that a segment, polygon or sphere touches, and for each thread and one more a band of 8 to 32 rows with 128 bytes
/// a pixel. `print` is placed; it and `scene` must outlive the result. For light other than flat: make_lit_raster().
/// @throws std::runtime_error if a side is over 500,000 pixels
std::unique_ptr<Rendering> make_solid_raster(const Scene& scene, const Print& print);

}  // namespace sikku
