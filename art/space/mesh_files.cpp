#include "art/space/mesh_files.h"

#include "art/print/recipe_comments.h"
#include "engine/base/text.h"

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <utility>

namespace sikku {
namespace {

std::string material_name(const Mesh& mesh) {
    if (!mesh.colours.empty()) return fmt::format("{}-blend", mesh.kind);
    return fmt::format("{}-{:02x}{:02x}{:02x}{}", mesh.kind, mesh.colour.red, mesh.colour.green, mesh.colour.blue,
                       mesh.colour.alpha < 255 ? fmt::format("{:02x}", mesh.colour.alpha) : "");
}

// --- Wavefront OBJ: Wavefront Technologies, Advanced Visualizer Manual, appendix B1 --------------------------------

/// Puts a name on one line.
std::string one_line(std::string text) {
    std::replace_if(
        text.begin(), text.end(), [](char byte) { return byte == '\n' || byte == '\r'; }, ' ');
    return text;
}

void write_obj(const std::vector<Mesh>& meshes, const MeshPlacement& placement, const Print& print,
               const std::filesystem::path& file, const Monitor& monitor, Destination& destination) {
    Pulse pulse(monitor);
    std::filesystem::path materials_file = file;
    materials_file.replace_extension(".mtl");
    const std::string name = materials_file.filename().string();
    if (std::any_of(name.begin(), name.end(), [](char byte) { return byte >= 0 && byte < ' '; })) {
        throw std::runtime_error(
            "the name of an OBJ file cannot contain control characters, because the file contains its name");
    }
    const auto materials_opened = destination.open(materials_file);
    const auto opened = destination.open(file);
    Output& materials = *materials_opened;
    Output& output = *opened;
    output.write(fmt::format("# {}, {}\n", one_line(print.title), one_line(print.made)));
    for (const std::string& piece : recipe_comments(print.pattern, print.made)) output.write("# " + piece + "\n");
    output.write(fmt::format("mtllib {}\n", name));
    std::size_t first = 1, next = 1;  // position of the mesh, and of the next one with positions
    for (const Mesh& mesh : meshes) {
        if (!mesh.positions.empty()) first = std::exchange(next, next + mesh.positions.size());
        const std::string material = material_name(mesh);
        materials.write(fmt::format("newmtl {}\nKd {:.4f} {:.4f} {:.4f}\nd {:.4f}\nillum 1\n", material,
                                    mesh.colour.red / 255.0, mesh.colour.green / 255.0, mesh.colour.blue / 255.0,
                                    mesh.colour.alpha / 255.0));
        if (!mesh.positions.empty()) output.write(fmt::format("o {}\n", material));
        output.write(fmt::format("usemtl {}\n", material));
        for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
            pulse();
            const glm::dvec3 at = placement.origin + glm::dvec3(mesh.positions[i]);
            output.write(fmt::format("v {:.9g} {:.9g} {:.9g}", at.x, at.y, at.z));
            if (!mesh.colours.empty()) {
                const Colour& own = mesh.colours[i];
                output.write(
                    fmt::format(" {:.4f} {:.4f} {:.4f}", own.red / 255.0, own.green / 255.0, own.blue / 255.0));
            }
            output.write("\n");
        }
        for (const glm::vec3& n : mesh.normals) {
            pulse();
            output.write(fmt::format("vn {:.4f} {:.4f} {:.4f}\n", n.x, n.y, n.z));
        }
        for (std::size_t i = 0; i + 2 < mesh.corners.size(); i += 3) {
            pulse();
            const std::size_t a = first + mesh.corners[i], b = first + mesh.corners[i + 1],
                              c = first + mesh.corners[i + 2];
            output.write(mesh.normals.empty() ? fmt::format("f {} {} {}\n", a, b, c)
                                              : fmt::format("f {0}//{0} {1}//{1} {2}//{2}\n", a, b, c));
        }
    }
    materials.commit();
    output.commit();
}

// --- binary glTF: Khronos Group, glTF 2.0 specification, sections 3 and 4 ------------------------------------------

std::string bytes_of(std::uint32_t number) {
    std::string bytes;
    for (int shift = 0; shift < 32; shift += 8) bytes += static_cast<char>(number >> shift & 0xff);
    return bytes;
}

template <class Element>
void write_raw(Output& output, const std::vector<Element>& elements, const Monitor& monitor) {
    static_assert(std::endian::native == std::endian::little);
    constexpr std::size_t block = std::size_t{1} << 24;
    std::string_view rest(reinterpret_cast<const char*>(elements.data()), elements.size() * sizeof(Element));
    for (; !rest.empty(); rest.remove_prefix(std::min(block, rest.size()))) {
        monitor.check();
        output.write(rest.substr(0, block));
    }
}

/// The recipe as a member of the asset, with a leading comma; empty if it is too large.
std::string extras_of(const Print& print) {
    std::string list;
    for (const std::string& piece : recipe_comments(print.pattern, print.made)) {
        list += (list.empty() ? "" : ",") + json_string(piece);
    }
    return list.empty() ? list : ",\"extras\":{\"recipe\":[" + list + "]}";
}

/// The lists of a file's JSON.
class GlbLists {
public:
    void add(const Mesh& mesh) {
        if (!mesh.positions.empty()) add_positions(mesh);
        const std::size_t corners = add_accessor("SCALAR", mesh.corners.size(), unsigned_int);
        add_view(mesh.corners.size() * sizeof(std::uint32_t), indices);
        std::string attributes = fmt::format(R"("POSITION":{})", positions_);
        if (normals_) attributes += fmt::format(R"(,"NORMAL":{})", *normals_);
        if (!mesh.colours.empty()) {
            attributes += fmt::format(R"(,"COLOR_0":{})", add_accessor("VEC3", mesh.colours.size(), single));
            add_view(mesh.colours.size() * sizeof(glm::vec3), vertices);
        }
        append(primitives,
               fmt::format(R"({{"attributes":{{{}}},"indices":{},"material":{}}})", attributes, corners, meshes_++));
        append(
            materials,
            fmt::format(R"({{"name":"{}","pbrMetallicRoughness":{{"baseColorFactor":[{:.6f},{:.6f},{:.6f},{:.6f}],)"
                        R"("metallicFactor":0,"roughnessFactor":0.85}}{}{}}})",
                        material_name(mesh), linear_light(mesh.colour.red), linear_light(mesh.colour.green),
                        linear_light(mesh.colour.blue), mesh.colour.alpha / 255.0,
                        mesh.two_sided ? R"(,"doubleSided":true)" : "",
                        mesh.colour.alpha < 255 ? R"(,"alphaMode":"BLEND")" : ""));
    }

    std::string accessors, views, materials, primitives;
    std::uint64_t bytes = 0;  ///< size of all views

private:
    static constexpr int single = 5126, unsigned_int = 5125;  // types of numbers
    static constexpr int vertices = 34962, indices = 34963;   // uses of views

    static void append(std::string& list, const std::string& item) { list += (list.empty() ? "" : ",") + item; }

    std::size_t add_accessor(std::string_view type, std::size_t count, int number, const std::string& bounds = "") {
        append(accessors, fmt::format(R"({{"bufferView":{},"componentType":{},"count":{},"type":"{}"{}}})",
                                      accessors_, number, count, type, bounds));
        return accessors_++;
    }
    void add_view(std::uint64_t size, int use) {
        append(views, fmt::format(R"({{"buffer":0,"byteOffset":{},"byteLength":{},"target":{}}})", bytes, size, use));
        bytes += size;
    }
    void add_positions(const Mesh& mesh) {
        const auto triple = [](const glm::vec3& v) { return fmt::format("[{},{},{}]", v.x, v.y, v.z); };
        glm::vec3 low = mesh.positions.front(), high = low;
        for (const glm::vec3& position : mesh.positions) {
            low = glm::min(low, position);
            high = glm::max(high, position);
        }
        positions_ = add_accessor("VEC3", mesh.positions.size(), single,
                                  fmt::format(R"(,"min":{},"max":{})", triple(low), triple(high)));
        add_view(mesh.positions.size() * sizeof(glm::vec3), vertices);
        normals_.reset();
        if (mesh.normals.empty()) return;
        normals_ = add_accessor("VEC3", mesh.normals.size(), single);
        add_view(mesh.normals.size() * sizeof(glm::vec3), vertices);
    }

    std::size_t accessors_ = 0, meshes_ = 0, positions_ = 0;
    std::optional<std::size_t> normals_;
};

/// Members of the node: where the mesh lies in metres, y up, or in the steps of a turtle.
std::string node_place(const MeshPlacement& placement) {
    const glm::dvec3& origin = placement.origin;
    if (!placement.is_solid) return fmt::format(R"("translation":[{},{},{}])", origin.x, origin.y, origin.z);
    return R"("rotation":[-0.70710678,0,0,0.70710678],"scale":[0.001,0.001,0.001])";
}

void write_glb(const std::vector<Mesh>& meshes, const MeshPlacement& placement, const Print& print,
               const std::filesystem::path& file, const Monitor& monitor, Destination& destination) {
    GlbLists lists;
    for (const Mesh& mesh : meshes) lists.add(mesh);
    const std::string name = json_string(print.title.empty() ? "drawing" : print.title);
    std::string json = fmt::format(
        R"({{"asset":{{"version":"2.0","generator":{}{}}},"scene":0,"scenes":[{{"name":{},"nodes":[0]}}],)"
        R"("nodes":[{{"name":{},"mesh":0,{}}}],"meshes":[{{"name":{},"primitives":[{}]}}],"materials":[{}],)"
        R"("accessors":[{}],"bufferViews":[{}],"buffers":[{{"byteLength":{}}}]}})",
        json_string(print.made), extras_of(print), name, name, node_place(placement), name, lists.primitives,
        lists.materials, lists.accessors, lists.views, lists.bytes);
    json.resize((json.size() + 3) / 4 * 4, ' ');
    const std::uint64_t size = 12 + 8 + json.size() + 8 + lists.bytes;
    if (size > UINT32_MAX) throw std::runtime_error("the model is larger than the 4 GB that a .glb file holds");
    const auto opened = destination.open(file);
    Output& output = *opened;
    output.write("glTF" + bytes_of(2) + bytes_of(static_cast<std::uint32_t>(size)));
    output.write(bytes_of(static_cast<std::uint32_t>(json.size())) + "JSON" + json);
    output.write(bytes_of(static_cast<std::uint32_t>(lists.bytes)) + std::string("BIN\0", 4));
    for (const Mesh& mesh : meshes) {
        write_raw(output, mesh.positions, monitor);
        write_raw(output, mesh.normals, monitor);
        write_raw(output, mesh.corners, monitor);
        std::vector<glm::vec3> colours;
        for (const Colour& colour : mesh.colours) {
            colours.emplace_back(linear_light(colour.red), linear_light(colour.green), linear_light(colour.blue));
        }
        write_raw(output, colours, monitor);
    }
    output.commit();
}

}  // namespace

std::uint32_t Mesh::add(const glm::dvec3& position, const glm::dvec3& normal) {
    if (!(glm::length(position) < 1e30)) throw std::runtime_error("the model has corners that are not finite");
    if (positions.size() >= UINT32_MAX - 1) throw std::runtime_error("the model has over 2^32 corners");
    positions.emplace_back(position);
    normals.emplace_back(glm::normalize(normal));
    return static_cast<std::uint32_t>(positions.size() - 1);
}

ModelReport write_meshes(const std::vector<Mesh>& meshes, const MeshPlacement& placement, const Print& print,
                         PrintFormat format, const std::filesystem::path& file, const Monitor& monitor,
                         Destination& destination) {
    (format == PrintFormat::obj ? write_obj : write_glb)(meshes, placement, print, file, monitor, destination);
    ModelReport report{0, meshes.size()};
    for (const Mesh& mesh : meshes) report.triangles += mesh.corners.size() / 3;
    return report;
}

}  // namespace sikku
