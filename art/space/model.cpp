#include "art/space/model.h"

#include "art/space/tessellation.h"
#include "art/space/triangles.h"
#include "engine/base/output.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <numbers>
#include <span>
#include <stdexcept>
#include <utility>
#include <vector>

namespace sikku {
namespace {

constexpr int tube_sides = 8;    // sides of a tube
constexpr int sphere_rings = 8;  // from pole to pole
constexpr int sphere_sides = 12;
constexpr double sharpest = -0.5;  // cosine of the sharpest turn that a tube makes without ending

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
                meshes_.push_back({fills ? style_.fill_colour(pen) : style_.line_colour(pen),
                                   fills ? "fill" : "line",
                                   fills,
                                   {},
                                   {},
                                   {}});
            }
        }
        meshes_.push_back({Colour{255, 255, 255, 255}, "fill", true, {}, {}, {}});
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
            // Between two segments a ring lies in the plane that halves their angle, turned as little as possible.
            const bool is_inner = i > 0 && i + 1 < nodes.size();
            tangent = is_inner ? glm::normalize(direction(i - 1) + direction(i)) : direction(i > 0 ? i - 1 : 0);
            const glm::dvec3 turned = across - tangent * glm::dot(across, tangent);
            across = glm::dot(turned, turned) > 1e-12 ? glm::normalize(turned) : any_across(tangent);
            const glm::dvec3 third = glm::cross(tangent, across);
            std::uint32_t first = 0;
            for (int side = 0; side < tube_sides; ++side) {
                const double angle = 2 * std::numbers::pi * side / tube_sides;
                const glm::dvec3 out = across * std::cos(angle) + third * std::sin(angle);
                const std::uint32_t corner = mesh.add(nodes[i].at + out * nodes[i].radius, out);
                if (side == 0) first = corner;
            }
            for (std::uint32_t side = 0; i > 0 && side < tube_sides; ++side) {
                const std::uint32_t next = (side + 1) % tube_sides;
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
        for (int side = 0; side < tube_sides; ++side) {
            const double angle = 2 * std::numbers::pi * side / tube_sides;
            mesh.add(node.at + (across * std::cos(angle) + third * std::sin(angle)) * node.radius, outwards);
        }
        for (std::uint32_t side = 0; side < tube_sides; ++side) {
            mesh.triangle(centre, centre + 1 + side, centre + 1 + (side + 1) % tube_sides);
        }
    }

    /// Returns the same corner for polygons that share a vertex and its normal.
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
    return write_meshes(meshes, {.origin = modeller.origin()}, print, format, file, monitor, destination);
}

}  // namespace sikku
