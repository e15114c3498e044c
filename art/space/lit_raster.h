// art/space/lit_raster.h: renders a scene as pixels in the light of a sun and a sky.
#pragma once

#include "art/raster/raster.h"
#include "art/space/scene.h"

#include <memory>

namespace sikku {

/// As make_solid_raster(), but lit by the style's light, with shadows. Stems begin flat where nothing bears them,
/// join smoothly where a line goes on, and widen to a collar where they leave a thicker one; colours of a line pass
/// into each other. Leaves are thin, so that light from behind shows; each has a tone a little its own, darker at the
/// base. The ground, which is level and as low as the scene, shows only its shadow.
///
/// All samples of a pixel, or from 200 dpi on of 2 by 2 pixels, that lie on one surface are lit together. Memory: 12
/// bytes for each of 16 samples a pixel of a band for each thread and one more; Daylight; and 24 bytes a segment.
/// `print` is placed; it and `scene` must outlive what is made. @throws std::runtime_error if a side is over 500,000
/// pixels
std::unique_ptr<Rendering> make_lit_raster(const Scene& scene, const Print& print);

}  // namespace sikku
