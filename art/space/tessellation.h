// art/space/tessellation.h: divides the predefined surfaces of a scene into polygons.
#pragma once

#include "art/space/scene.h"
#include "engine/base/monitor.h"

#include <glm/vec3.hpp>

#include <functional>
#include <span>

namespace sikku {

/// Resolution of divided surfaces. A flat patch is one polygon.
struct Fineness {
    double deviation = 0;  ///< maximum distance of the polygons from the surface, in turtle steps; 0: any
    double share = 0;      ///< the same as a share of the surface's size
    double side = 0;       ///< longest side of a polygon of a curved surface, in turtle steps; 0: any
    /// Whether `deviation` is measured at the middle of each polygon and of its sides; otherwise a bound is used,
    /// which requires up to twice as many divisions each way. Cost: 1 µs for each polygon of a patch, once for each
    /// surface.
    bool is_measured = false;
};

/// Replaces the surfaces of a scene by smoothly shaded polygons. Each patch is divided evenly, into at most 48 by 48
/// polygons, and all patches into at most 1.5 million, unless there are more patches.
/// Cost: 0.1 µs for each polygon; memory: 160 bytes for each. @throws Stopped
/// Source: de Casteljau's and Bernstein's form; deviation of a chord: Filip, Magedson and Markot 1986.
Scene tessellated(const Scene& scene, const Fineness& fineness, const Monitor& monitor = {});

/// Receives a patch divided into n by n parts: its (n + 1)^2 points, by rows.
using PatchVisitor = std::function<void(int n, std::span<const glm::vec3> points)>;
/// Calls `visit` for each patch of the scene's surfaces, divided as by tessellated(). Cost: 5 ns a point. @throws
/// Stopped
void each_divided_patch(const Scene& scene, const Fineness& fineness, const PatchVisitor& visit,
                        const Monitor& monitor = {});

/// Bound of the deviation of a surface's undivided patches from the polygons of their corners, in turtle steps; 0 if
/// they are flat. Cost: linear in the patches.
double bend_of(const SceneSurface& surface);

/// The number of polygons into which a patch of that bend is divided. @param deviation  as in Fineness, above 0
double polygons_of_patch(double bend, double deviation);

}  // namespace sikku
