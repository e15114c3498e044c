// art/space/solids.h: draws a scene as polygons from back to front, for vector formats.
#pragma once

#include "art/print/print.h"
#include "art/space/scene.h"
#include "engine/base/monitor.h"
#include "engine/geometry/path.h"

namespace sikku {

/// The same style with a palette that holds, after its own colours, each of them in all shades of the light.
Style with_shades(const Style& style);

/// Draws into `sink`, in turtle steps as they are projected: polygons, stems and spheres in the order of their depth
/// (of the middle of what is nearest of each), so that what is in front lies over what is behind; where they run
/// through each other one lies over the other. Stems are outlines as wide at both ends as their pens, lit in strips
/// where they are wide on paper.
/// @param print  placed, in the style that with_shades() makes
/// Cost: sorting; memory 16 bytes for each of them beside the scene. @throws Stopped
void draw_solids(const Scene& scene, const Print& print, PathSink& sink, const Monitor& monitor = {});

/// What is seen of the scene, in turtle steps, after `orientation` (see orientation()), and its widest pen in the
/// measure of the style's stroke.
struct SceneExtent {
    Box box;
    double widest = 0.0;
};
SceneExtent extent_of(const Scene& scene, const Style& style, const glm::dmat3x2& orientation,
                      const Monitor& monitor = {});

}  // namespace sikku
