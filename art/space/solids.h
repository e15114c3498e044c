// art/space/solids.h: draws a scene as polygons from back to front, for vector formats.
#pragma once

#include "art/print/print.h"
#include "art/space/scene.h"
#include "engine/base/monitor.h"
#include "engine/geometry/path.h"

namespace sikku {

/// Adds all shades of each colour in the light to the palette, after its own colours.
Style with_shades(const Style& style);

/// Draws into `sink`, in projected turtle steps: polygons, stems and spheres in the order of their depth (by the mean
/// of a polygon's vertices, and the nearest surface of stems and spheres), so that nearer ones lie over farther ones;
/// where they intersect one lies over the other. Stems are outlines as wide at both ends as their pens, lit in strips
/// where they are wide on paper.
/// @param print  placed, in the style that with_shades() makes
/// Cost: sorting; memory: 16 bytes for each of them besides the scene. @throws Stopped
void draw_solids(const Scene& scene, const Print& print, PathSink& sink, const Monitor& monitor = {});

/// The visible extent of a scene, in turtle steps, after `orientation` (see orientation()), and its widest pen in the
/// unit of the style's stroke.
struct SceneExtent {
    Box box;
    double widest = 0.0;
};
SceneExtent extent_of(const Scene& scene, const Style& style, const glm::dmat3x2& orientation,
                      const Monitor& monitor = {});

}  // namespace sikku
