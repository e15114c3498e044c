// art/space/solid_raster.h: renders a scene as pixels with hidden surfaces removed.
#pragma once

#include "art/raster/raster.h"
#include "art/space/scene.h"

#include <memory>

namespace sikku {

/// Lines are round stems with round ends, as wide at both ends as their pens; polygons have two sides; spheres are
/// smooth. 16 samples a pixel, each with the depth of the nearest surface; lines are a quarter of a pixel wide at
/// least. Colours that are partly transparent show the ground through them, and nothing else of the drawing. Memory:
/// 4 bytes for each band of rows that a segment, polygon or sphere is seen in, and for each thread and one more a
/// band of 8 to 32 rows with 128 bytes a pixel. `print` is placed; it and `scene` must outlive what is made. @throws
/// std::runtime_error if a side is over 500,000 pixels
/// In a light other than flat: make_lit_raster().
std::unique_ptr<Rendering> make_solid_raster(const Scene& scene, const Print& print);

}  // namespace sikku
