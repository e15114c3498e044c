// art/drawing/plot_scene.h: draws a scene in space with a pen, without hidden lines.
#pragma once

#include "art/plotter/shading.h"
#include "art/print/print.h"
#include "art/space/scene.h"

namespace sikku {

/// Draws a scene into `sink` as strokes, in projected turtle steps and in the pens of with_fill_pens():
/// - stems along their middles, joined where they continue; with a `pen_width`, wider ones in several passes,
///   each end as wide as the stem;
/// - polygons as outlines and, if requested, hatching; each edge once, and not where a stem runs along it;
/// - predefined surfaces as the edges of their patches and hatching;
/// - spheres and dots filled by spirals.
/// Polygons, spheres, and stems wider than 0.5 mm and one pen hide lines behind them: see HiddenLines. Limits: a stem
/// hides lines as a flat band through its middle that faces the eye; a polygon that is not flat is replaced by the
/// triangles of triangulate(), and its hatching lies on them, or in its mean plane if it appears folded; folds are
/// not drawn. Thinner stems do not hide lines: their ink covers the lines behind them.
/// @param print  placed, in a style that draws lines
/// Cost: 1 to 5 µs for each line and each surface in the plants measured; up to lines times surfaces where many large
/// surfaces overlap. @throws Stopped
void plot_scene(const Scene& scene, const Print& print, const PlotPen& pen, PathSink& sink,
                const Monitor& monitor = {});

}  // namespace sikku
