// art/drawing/plot_scene.h: a drawing in space as the lines that a pen draws of it.
#pragma once

#include "art/plotter/plot.h"
#include "art/space/scene.h"

namespace sikku {

/// Draws into `sink`, in turtle steps as they are projected, strokes alone, in the pens of with_fill_pens():
/// - stems along their middles, joined where they go on; with a `pen_width`, those that are wider in several passes,
///   as wide at both ends as the stem is there;
/// - polygons as outlines, edges once, and not where a stem runs along them; hatched if that is asked for;
/// - spheres and dots filled by spirals.
///
/// What lies behind polygons, spheres and stems over 0.5 mm wide (and over one pen) is not drawn; HiddenLines says
/// how. Limits: a stem hides as a flat band through its middle that faces the eye; a polygon that is not flat hides
/// as the triangles of triangulate(), and its hatching lies on them, or in its mean plane if it is
/// folded on the page; folds are not drawn. Thinner stems hide nothing: what lies behind
/// them is covered by their ink.
/// @param print  placed, in a style that draws lines
/// Cost: 1 to 5 µs for each line and each surface in plants that were tried; more where many large surfaces overlap,
/// up to their product. @throws Stopped
void plot_scene(const Scene& scene, const Print& print, const PlotOptions& options, PathSink& sink,
                const Monitor& monitor = {});

}  // namespace sikku
