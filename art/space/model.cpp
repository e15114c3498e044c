#include "art/space/model.h"

#include "art/print/recipe_comments.h"

#include "art/space/tessellation.h"
#include "art/space/triangles.h"
#include "engine/base/output.h"
#include "engine/base/text.h"

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <map>
#include <numbers>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace sikku {
namespace {

constexpr int sides = 8;         // of a tube
constexpr int sphere_rings = 8;  // from pole to pole
constexpr int sphere_sides = 12;
constexpr double sharpest = -0.5;  // cosine of the sharpest turn that a tube makes without ending

/// All of one material.
struct Mesh {
    Colour colour;
    bool two_sided = false;
    std::vector<glm::vec3> positions;
    std::vector<glm::vec3> normals;      // of length 1, one for each position
    std::vector<std::uint32_t> corners;  // three for each triangle, anticlockwise from outside
    std::vector<Colour> colours{};       // one for each position, or none: all have `colour`

    std::uint32_t add(const glm::dvec3& position, const glm::dvec3& normal) {
        if (!(glm::length(position) < 1e30)) throw std::runtime_error("the model has corners that are not finite");
        if (positions.size() >= UINT32_MAX - 1) throw std::runtime_error("the model has over 2^32 corners");
        positions.emplace_back(position);
        normals.emplace_back(glm::normalize(normal));
        return static_cast<std::uint32_t>(positions.size() - 1);
    }
    void triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) { corners.insert(corners.end(), {a, b, c}); }
};

/// A node of a tube.
struct Node {
    glm::dvec3 at;
    double radius;
};

glm::dvec3 any_across(const glm::dvec3& direction) {
    const glm::dvec3 size = glm::abs(direction);
    const glm::dvec3 axis = size.x <= size.y && size.x <= size.z ? glm::dvec3(1, 0, 0)
                            : size.y <= size.z                   ? glm::dvec3(0, 1, 0)
                                                                 : glm::dvec3(0, 0, 1);
    return glm::normalize(glm::cross(direction, axis));
}

class Modeller {
public:
    Modeller(const Scene& scene, const Print& print, const Monitor& monitor)
        : scene_(scene), style_(print.style), step_(print.placement.step), pulse_(monitor) {
        for (const bool fills : {false, true}) {
            for (int slot = 0; slot < static_cast<int>(style_.palette.size()); ++slot) {
                const Pen pen{.colour = slot};
                meshes_.push_back({fills ? style_.fill_colour(pen) : style_.line_colour(pen), fills, {}, {}, {}});
            }
        }
        meshes_.push_back({Colour{255, 255, 255, 255}, true, {}, {}, {}});
        // Colours that are the same share a material.
        line_slots_ = style_.line_slots();
        fill_slots_ = style_.fill_slots();
        add_stems();
        for (const ScenePolygon& polygon : scene.polygons()) {
            pulse_();
            add_polygon(polygon);
        }
        for (const SceneSphere& sphere : scene.spheres()) {
            pulse_();
            add_sphere(sphere);
        }
        std::erase_if(meshes_, [](const Mesh& mesh) { return mesh.corners.empty(); });
    }

    const std::vector<Mesh>& meshes() const { return meshes_; }
    glm::dvec3 origin() const { return scene_.at(glm::vec3(0)); }

private:
    Mesh& lines(int colour) {
        return meshes_[static_cast<std::size_t>(line_slots_[static_cast<std::size_t>(colour)])];
    }
    Mesh& fills(int colour) {
        return meshes_[line_slots_.size() + static_cast<std::size_t>(fill_slots_[static_cast<std::size_t>(colour)])];
    }
    /// The mesh of polygons whose vertices have colours of their own.
    Mesh& blends() { return meshes_.back(); }
    double radius(const SceneWidth& width) const { return style_.line_width(width.pen(0), step_) / step_ / 2; }

    void add_stems() {
        std::vector<Node> nodes;
        const SceneSegment* last = nullptr;
        for (const SceneSegment& segment : scene_.segments()) {
            pulse_();
            const glm::dvec3 from(segment.from), to(segment.to);
            if (from == to) continue;
            const bool goes_on =
                last && segment.goes_on && last->colour == segment.colour && !nodes.empty() &&
                last->to == segment.from &&
                glm::dot(glm::normalize(to - from), glm::normalize(from - nodes[nodes.size() - 2].at)) > sharpest;
            if (!goes_on) {
                if (last) add_tube(nodes, lines(last->colour));
                nodes = {{from, radius(segment.before)}};
            }
            nodes.push_back({to, radius(segment.after)});
            last = &segment;
        }
        if (last) add_tube(nodes, lines(last->colour));
    }

    static void add_tube(const std::vector<Node>& nodes, Mesh& mesh) {
        if (nodes.size() < 2) return;
        const auto direction = [&](std::size_t i) { return glm::normalize(nodes[i + 1].at - nodes[i].at); };
        glm::dvec3 tangent = direction(0);
        glm::dvec3 across = any_across(tangent);
        std::uint32_t before = 0;
        add_end(nodes.front(), -tangent, across, mesh);
        for (std::size_t i = 0; i < nodes.size(); ++i) {
            // Between two segments a ring lies in the plane that halves their angle, turned as little as can be.
            const bool is_inner = i > 0 && i + 1 < nodes.size();
            tangent = is_inner ? glm::normalize(direction(i - 1) + direction(i)) : direction(i > 0 ? i - 1 : 0);
            const glm::dvec3 turned = across - tangent * glm::dot(across, tangent);
            across = glm::dot(turned, turned) > 1e-12 ? glm::normalize(turned) : any_across(tangent);
            const glm::dvec3 third = glm::cross(tangent, across);
            std::uint32_t first = 0;
            for (int side = 0; side < sides; ++side) {
                const double angle = 2 * std::numbers::pi * side / sides;
                const glm::dvec3 out = across * std::cos(angle) + third * std::sin(angle);
                const std::uint32_t corner = mesh.add(nodes[i].at + out * nodes[i].radius, out);
                if (side == 0) first = corner;
            }
            for (std::uint32_t side = 0; i > 0 && side < sides; ++side) {
                const std::uint32_t next = (side + 1) % sides;
                mesh.triangle(before + side, before + next, first + next);
                mesh.triangle(before + side, first + next, first + side);
            }
            before = first;
        }
        add_end(nodes.back(), tangent, across, mesh);
    }

    static void add_end(const Node& node, const glm::dvec3& outwards, const glm::dvec3& across, Mesh& mesh) {
        const glm::dvec3 third = glm::cross(outwards, across);
        const std::uint32_t centre = mesh.add(node.at, outwards);
        for (int side = 0; side < sides; ++side) {
            const double angle = 2 * std::numbers::pi * side / sides;
            mesh.add(node.at + (across * std::cos(angle) + third * std::sin(angle)) * node.radius, outwards);
        }
        for (std::uint32_t side = 0; side < sides; ++side) {
            mesh.triangle(centre, centre + 1 + side, centre + 1 + (side + 1) % sides);
        }
    }

    /// The same corner for polygons that share a vertex and its normal.
    std::uint32_t shared_corner(Mesh& mesh, const glm::vec3& position, const glm::vec3& normal) {
        const std::array key = {position.x, position.y, position.z, normal.x, normal.y, normal.z};
        const auto [found, fresh] = shared_.try_emplace({&mesh, key}, 0);
        if (fresh) found->second = mesh.add(position, normal);
        return found->second;
    }

    void add_polygon(const ScenePolygon& polygon) {
        const std::span<const glm::vec3> vertices = scene_.vertices(polygon);
        const glm::dvec3 normal = area_normal(vertices);
        if (!(glm::length(normal) > 0)) return;
        const auto corners = scene_.corners(polygon);
        const bool is_blend = std::any_of(corners.begin(), corners.end(), [&](const SceneCorner& corner) {
            return corner.colour != corners[0].colour;
        });
        Mesh& mesh = is_blend ? blends() : fills(corners.empty() ? polygon.colour : corners[0].colour);
        std::vector<std::uint32_t> indices;
        for (std::size_t i = 0; i < vertices.size(); ++i) {
            const glm::vec3 own = corners.empty() ? glm::vec3(0.0F) : corners[i].normal;
            if (!is_blend && glm::length(own) > 0) {
                indices.push_back(shared_corner(mesh, vertices[i], own));
                continue;
            }
            indices.push_back(mesh.add(vertices[i], glm::length(own) > 0 ? glm::dvec3(own) : normal));
            if (is_blend) mesh.colours.push_back(style_.fill_colour({.colour = corners[i].colour}));
        }
        for (const auto& [a, b, c] : triangulate(vertices).triangles)
            mesh.triangle(indices[a], indices[b], indices[c]);
    }

    void add_sphere(const SceneSphere& sphere) {
        Mesh& mesh = fills(sphere.colour);
        const double radius = style_.disc_radius(sphere.radius, sphere.width.pen(0), step_) / step_;
        const glm::dvec3 centre(sphere.centre);
        const auto corner = [&](int ring, int side) {
            const double down = std::numbers::pi * ring / sphere_rings;
            const double around = 2 * std::numbers::pi * side / sphere_sides;
            const glm::dvec3 out(std::sin(down) * std::sin(around), std::cos(down),
                                 std::sin(down) * std::cos(around));
            return mesh.add(centre + out * radius, out);
        };
        const std::uint32_t top = corner(0, 0);
        for (int ring = 1; ring < sphere_rings; ++ring) {
            for (int side = 0; side < sphere_sides; ++side) corner(ring, side);
        }
        const std::uint32_t bottom = corner(sphere_rings, 0);
        const auto at = [&](int ring, int side) {
            return top + 1 + static_cast<std::uint32_t>((ring - 1) * sphere_sides + side % sphere_sides);
        };
        for (int side = 0; side < sphere_sides; ++side) {
            mesh.triangle(top, at(1, side), at(1, side + 1));
            for (int ring = 1; ring + 1 < sphere_rings; ++ring) {
                mesh.triangle(at(ring, side), at(ring + 1, side), at(ring + 1, side + 1));
                mesh.triangle(at(ring, side), at(ring + 1, side + 1), at(ring, side + 1));
            }
            mesh.triangle(at(sphere_rings - 1, side), bottom, at(sphere_rings - 1, side + 1));
        }
    }

    const Scene& scene_;
    const Style& style_;
    double step_;
    Pulse pulse_;
    std::map<std::pair<const Mesh*, std::array<float, 6>>, std::uint32_t> shared_;
    std::vector<Mesh> meshes_;  ///< by colour: of lines, then of fills
    std::vector<int> line_slots_, fill_slots_;
};

std::string material_name(const Mesh& mesh) {
    if (!mesh.colours.empty()) return "fill-blend";
    return fmt::format("{}-{:02x}{:02x}{:02x}{}", mesh.two_sided ? "fill" : "line", mesh.colour.red,
                       mesh.colour.green, mesh.colour.blue,
                       mesh.colour.alpha < 255 ? fmt::format("{:02x}", mesh.colour.alpha) : "");
}

// --- Wavefront OBJ: Wavefront Technologies, Advanced Visualizer Manual, appendix B1 --------------------------------

/// A line of a file: no line ends in names.
std::string one_line(std::string text) {
    std::replace_if(
        text.begin(), text.end(), [](char byte) { return byte == '\n' || byte == '\r'; }, ' ');
    return text;
}

void write_obj(const std::vector<Mesh>& meshes, const glm::dvec3& origin, const Print& print,
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
    std::size_t first = 1;
    for (const Mesh& mesh : meshes) {
        const std::string material = material_name(mesh);
        materials.write(fmt::format("newmtl {}\nKd {:.4f} {:.4f} {:.4f}\nd {:.4f}\nillum 1\n", material,
                                    mesh.colour.red / 255.0, mesh.colour.green / 255.0, mesh.colour.blue / 255.0,
                                    mesh.colour.alpha / 255.0));
        output.write(fmt::format("o {}\nusemtl {}\n", material, material));
        for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
            pulse();
            const glm::dvec3 at = origin + glm::dvec3(mesh.positions[i]);
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
            output.write(fmt::format("f {0}//{0} {1}//{1} {2}//{2}\n", a, b, c));
        }
        first += mesh.positions.size();
    }
    materials.commit();
    output.commit();
}

// --- binary glTF: Khronos Group, glTF 2.0 specification, sections 3 and 4 ------------------------------------------

double linear(std::uint8_t channel) {
    const double value = channel / 255.0;
    return value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4);
}

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

void write_glb(const std::vector<Mesh>& meshes, const glm::dvec3& origin, const Print& print,
               const std::filesystem::path& file, const Monitor& monitor, Destination& destination) {
    std::string accessors, views, materials, primitives;
    std::uint64_t offset = 0;
    int next = 0;
    const auto comma = [](std::string& list) { list += list.empty() ? "" : ","; };
    const auto view = [&](std::uint64_t bytes, int target) {
        comma(views);
        views += fmt::format(R"({{"buffer":0,"byteOffset":{},"byteLength":{},"target":{}}})", offset, bytes, target);
        offset += bytes;
    };
    const auto triple = [](const glm::vec3& v) { return fmt::format("[{},{},{}]", v.x, v.y, v.z); };
    for (std::size_t i = 0; i < meshes.size(); ++i) {
        const Mesh& mesh = meshes[i];
        glm::vec3 low = mesh.positions.front(), high = low;
        for (const glm::vec3& position : mesh.positions) {
            low = glm::min(low, position);
            high = glm::max(high, position);
        }
        comma(accessors);
        accessors += fmt::format(
            R"({{"bufferView":{0},"componentType":5126,"count":{3},"type":"VEC3","min":{5},"max":{6}}},)"
            R"({{"bufferView":{1},"componentType":5126,"count":{3},"type":"VEC3"}},)"
            R"({{"bufferView":{2},"componentType":5125,"count":{4},"type":"SCALAR"}})",
            next, next + 1, next + 2, mesh.positions.size(), mesh.corners.size(), triple(low), triple(high));
        if (!mesh.colours.empty()) {
            accessors += fmt::format(R"(,{{"bufferView":{},"componentType":5126,"count":{},"type":"VEC3"}})",
                                     next + 3, mesh.colours.size());
        }
        constexpr int vertices = 34962, indices = 34963;
        view(mesh.positions.size() * sizeof(glm::vec3), vertices);
        view(mesh.normals.size() * sizeof(glm::vec3), vertices);
        view(mesh.corners.size() * sizeof(std::uint32_t), indices);
        if (!mesh.colours.empty()) view(mesh.colours.size() * sizeof(glm::vec3), vertices);
        comma(materials);
        materials += fmt::format(
            R"({{"name":"{}","pbrMetallicRoughness":{{"baseColorFactor":[{:.6f},{:.6f},{:.6f},{:.6f}],)"
            R"("metallicFactor":0,"roughnessFactor":0.85}}{}{}}})",
            material_name(mesh), linear(mesh.colour.red), linear(mesh.colour.green), linear(mesh.colour.blue),
            mesh.colour.alpha / 255.0, mesh.two_sided ? R"(,"doubleSided":true)" : "",
            mesh.colour.alpha < 255 ? R"(,"alphaMode":"BLEND")" : "");
        comma(primitives);
        primitives +=
            fmt::format(R"({{"attributes":{{"POSITION":{},"NORMAL":{}{}}},"indices":{},"material":{}}})", next,
                        next + 1, mesh.colours.empty() ? "" : fmt::format(R"(,"COLOR_0":{})", next + 3), next + 2, i);
        next += mesh.colours.empty() ? 3 : 4;
    }
    const std::string name = json_string(print.title.empty() ? "drawing" : print.title);
    std::string json = fmt::format(
        R"({{"asset":{{"version":"2.0","generator":{}{}}},"scene":0,"scenes":[{{"name":{},"nodes":[0]}}],)"
        R"("nodes":[{{"name":{},"mesh":0,"translation":[{},{},{}]}}],"meshes":[{{"name":{},"primitives":[{}]}}],"materials":[{}],)"
        R"("accessors":[{}],"bufferViews":[{}],"buffers":[{{"byteLength":{}}}]}})",
        json_string(print.made), extras_of(print), name, name, origin.x, origin.y, origin.z, name, primitives,
        materials, accessors, views, offset);
    json.resize((json.size() + 3) / 4 * 4, ' ');
    const std::uint64_t size = 12 + 8 + json.size() + 8 + offset;
    if (size > UINT32_MAX) throw std::runtime_error("the model is larger than the 4 GB that a .glb file holds");
    const auto opened = destination.open(file);
    Output& output = *opened;
    output.write("glTF" + bytes_of(2) + bytes_of(static_cast<std::uint32_t>(size)));
    output.write(bytes_of(static_cast<std::uint32_t>(json.size())) + "JSON" + json);
    output.write(bytes_of(static_cast<std::uint32_t>(offset)) + std::string("BIN\0", 4));
    for (const Mesh& mesh : meshes) {
        write_raw(output, mesh.positions, monitor);
        write_raw(output, mesh.normals, monitor);
        write_raw(output, mesh.corners, monitor);
        std::vector<glm::vec3> colours;
        for (const Colour& colour : mesh.colours) {
            colours.emplace_back(linear(colour.red), linear(colour.green), linear(colour.blue));
        }
        write_raw(output, colours, monitor);
    }
    output.commit();
}

}  // namespace

ModelReport write_model(const Scene& scene, const Print& print, PrintFormat format, const std::filesystem::path& file,
                        const Monitor& monitor, Destination& destination) {
    if (!scene.surfaces().empty()) {
        return write_model(tessellated(scene, {.share = 1.0 / 40}, monitor), print, format, file, monitor,
                           destination);
    }
    const Modeller modeller(scene, print, monitor);
    const std::vector<Mesh>& meshes = modeller.meshes();
    if (meshes.empty()) throw std::runtime_error("nothing to model: every line and polygon lacks width and area");
    if (format == PrintFormat::obj) {
        write_obj(meshes, modeller.origin(), print, file, monitor, destination);
    } else {
        write_glb(meshes, modeller.origin(), print, file, monitor, destination);
    }
    ModelReport report;
    report.materials = meshes.size();
    for (const Mesh& mesh : meshes) report.triangles += mesh.corners.size() / 3;
    return report;
}

}  // namespace sikku
