// art/relief/relief_files.h: writes a solid as STL, OBJ or glTF.
#pragma once

#include "art/print/print.h"
#include "art/relief/solid.h"
#include "art/space/mesh_files.h"
#include "engine/base/monitor.h"
#include "engine/base/output.h"

#include <filesystem>

namespace sikku {

/// The beginning of the 80 bytes before the triangles of an STL.
constexpr std::string_view stl_title = "Binary STL in millimetres, sikku ";

/// @param format  stl, obj or glb  @throws std::runtime_error if the file cannot be written; Stopped
ModelReport write_solid(const Solid& solid, const Print& print, PrintFormat format, const std::filesystem::path& file,
                        const Monitor& monitor, Destination& destination);

}  // namespace sikku
