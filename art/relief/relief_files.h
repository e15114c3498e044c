// art/relief/relief_files.h: writes a solid as STL, OBJ or glTF.
#pragma once

#include "art/print/print.h"
#include "art/relief/solid.h"
#include "engine/base/monitor.h"
#include "engine/base/output.h"

#include <cstddef>
#include <filesystem>

namespace sikku {

/// The beginning of the 80 bytes before the triangles of an STL.
constexpr std::string_view stl_title = "Binary STL in millimetres, sikku ";

struct SolidReport {
    std::size_t triangles = 0, materials = 0;
};

/// @param format  stl, obj or glb  @throws std::runtime_error if the file cannot be written; Stopped
SolidReport write_solid(const Solid& solid, const Print& print, PrintFormat format, const std::filesystem::path& file,
                        const Monitor& monitor, Destination& destination);

}  // namespace sikku
