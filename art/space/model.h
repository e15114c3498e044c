// art/space/model.h: writes a drawing in space as a model: Wavefront OBJ or binary glTF 2.0.
#pragma once

#include "art/print/format.h"
#include "art/print/print.h"
#include "art/space/mesh_files.h"
#include "art/space/scene.h"
#include "engine/base/monitor.h"
#include "engine/base/output.h"

#include <filesystem>
#include <optional>

namespace sikku {

/// Writes stems as tubes of eight sides, joined where a line continues and closed at its ends, spheres, and polygons
/// as triangles with two sides; a material for each colour, and one for polygons whose vertices have their own.
/// Surfaces deviate from their patches by at most 1/40 of their size. One turtle step is one unit, y up, as in glTF.
/// Widths in millimetres are those of `print`, which is placed. The materials of NAME.obj are written beside it as
/// NAME.mtl, before the model. Memory: about 400 bytes a segment of a line that continues, 1500 of one that stands
/// alone, 5000 a sphere. Polygons that cross themselves are filled in part: see Triangulation.
/// @throws std::runtime_error if the file cannot be written, would be over 4 GB, or nothing in it has width or area;
/// Stopped
ModelReport write_model(const Scene& scene, const Print& print, PrintFormat format, const std::filesystem::path& file,
                        const Monitor& monitor = {}, Destination& destination = file_system());

}  // namespace sikku
