// art/space/lit_raster.h: renders a scene as pixels in the light of a sun and a sky.
#pragma once

#include "art/raster/raster.h"
#include "art/space/scene.h"

#include <memory>

namespace sikku {

/// Like make_solid_raster(), but lit by the style's light, with shadows. Stems begin flat where they are not
/// attached, join smoothly where a line continues, and widen to a collar where they leave a thicker one; colours
/// blend along a line. Leaves are thin, so that light shines through; each has a slightly different tone, darker at
/// the base. The ground, which is level and as low as the scene, shows only the shadow.
///
/// The samples hold the nearest surface, whose normal and colour are computed once for a pixel. All samples of a
/// pixel (of 2 by 2 pixels at 200 dpi or more, or in drawings of more than 2,048 pixels) that lie on one surface with
/// similar normals are lit together. The shadow of the sky on the ground, which has no edges, is computed eight
/// times as far apart. Memory: for each thread and one more, a band with 8 bytes for each of 16 samples a pixel and
/// 112 for each triangle that is seen in it; Daylight; and 24 bytes a segment. `print` is placed; it and `scene` must
/// outlive the result. @throws std::runtime_error if a side is over 500,000 pixels
std::unique_ptr<Rendering> make_lit_raster(const Scene& scene, const Print& print);

}  // namespace sikku
