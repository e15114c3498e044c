// art/relief/relief.h: a relief of a drawing: shapes raised from a base, or sunk into it, as one closed solid.
#pragma once

#include "art/print/print.h"
#include "art/relief/relief_options.h"
#include "art/relief/shapes.h"
#include "engine/base/monitor.h"
#include "engine/base/output.h"

#include <filesystem>

namespace sikku {

/// Writes a relief: for each visible shape a prism of the height of its colour, with lines over polygons and areas,
/// otherwise the highest where shapes overlap, and a base below them, as one solid that neither crosses nor touches
/// itself. Polygons are inset by half a groove, and lines along their edges are left out, unless the style has fields
/// between lines. Shapes end at the edge of the page. The solid is in millimetres, z up, from the bottom left corner
/// of the page, rounded to micrometres; a .glb has a node that turns them into metres, y up, and a material for each
/// colour. A binary STL contains neither colours nor the pattern. Cost: about 1 µs and 100 bytes for each triangle.
/// @throws BudgetError for more than most_relief_triangles; std::runtime_error if nothing is raised, or a depth does
/// not fit into the base; Stopped
ReliefReport write_relief(ReliefShapes& shapes, const Print& print, const ReliefOptions& options,
                          const std::filesystem::path& file, const Monitor& monitor, Destination& destination);

}  // namespace sikku
