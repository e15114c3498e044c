// art/space/mesh_files.h: triangles of one material each, and their files: Wavefront OBJ and binary glTF 2.0.
#pragma once

#include "art/print/format.h"
#include "art/print/print.h"
#include "art/style/colour.h"
#include "engine/base/monitor.h"
#include "engine/base/output.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace sikku {

/// All triangles of one material.
struct Mesh {
    Colour colour;
    std::string_view kind{};  ///< kind of material, for its name
    bool two_sided = false;
    std::vector<glm::vec3> positions{};    ///< empty: those of the last mesh with positions
    std::vector<glm::vec3> normals{};      ///< of length 1, one for each position; or none: triangles are flat
    std::vector<std::uint32_t> corners{};  ///< three for each triangle, anticlockwise from outside
    std::vector<Colour> colours{};         ///< one for each position, or none: all have `colour`

    /// @throws std::runtime_error if the position is not finite or the last of 2^32
    std::uint32_t add(const glm::dvec3& position, const glm::dvec3& normal);
    void triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) { corners.insert(corners.end(), {a, b, c}); }
};

/// Place and units of a mesh.
struct MeshPlacement {
    glm::dvec3 origin{0.0};
    bool is_solid = false;  ///< in millimetres, z up; glTF uses metres, y up
};

struct ModelReport {
    std::size_t triangles = 0;
    std::size_t materials = 0;
};

/// Writes a model as OBJ, with its materials beside NAME.obj as NAME.mtl, which is in place first, or as glTF.
/// @param format  obj or glb
/// @throws std::runtime_error if the file cannot be written, or a .glb would be over 4 GB; Stopped
ModelReport write_meshes(const std::vector<Mesh>& meshes, const MeshPlacement& placement, const Print& print,
                         PrintFormat format, const std::filesystem::path& file, const Monitor& monitor,
                         Destination& destination);

}  // namespace sikku
