// art/space/scene.h: holds a drawing in space in memory, because depth is known only when it is complete.
#pragma once

#include "art/style/style.h"
#include "engine/geometry/space_turtle.h"
#include "engine/language/grammar.h"

#include <cstddef>
#include <cstdint>
#include <glm/mat4x3.hpp>
#include <glm/vec3.hpp>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace sikku {

/// A width of the turtle: a factor of the style's stroke, or, if negative, the width that was set.
class SceneWidth {
public:
    SceneWidth() = default;
    explicit SceneWidth(const Pen& pen) : value_(static_cast<float>(pen.width_set ? -pen.width : pen.width)) {}
    Pen pen(int colour) const {
        return value_ < 0 ? Pen{-static_cast<double>(value_), true, colour}
                          : Pen{static_cast<double>(value_), false, colour};
    }

private:
    float value_ = 0;
};

/// A patch takes about as much memory and time as this many segments, once it is divided.
constexpr double parts_of_patch = 40;

/// A segment. Coordinates are turtle steps from the scene's origin, because floats have few digits: see Scene::at().
/// Colours are indices into the style's palette.
struct SceneSegment {
    glm::vec3 from, to;
    SceneWidth before, after;  ///< widths at its ends
    std::int32_t colour = 0;
    bool goes_on = false;  ///< the previous one in the list ends where it begins
};
struct ScenePolygon {
    std::size_t first = 0;  ///< first of its vertices
    std::size_t count = 0;
    std::int32_t colour = 0;
    std::uint32_t inner_edges = 0;       ///< bit i: the edge after vertex i lies within a surface
    std::optional<std::size_t> corners;  ///< first of its corners, if it is shaded smoothly
    std::uint32_t organ = 0;             ///< the leaf or petal that it is part of, from 1; 0: none
};
/// A vertex of a polygon that is shaded smoothly.
struct SceneCorner {
    glm::vec3 normal{0.0F};  ///< on the side from which the polygon runs anticlockwise
    std::int32_t colour = 0;
    float along = 0.5F;  ///< place along its organ, from 0 at the base to 1 at the tip
};
/// A predefined surface.
struct SceneSurface {
    std::shared_ptr<const Surface> surface;
    glm::mat4x3 map;  ///< map from its coordinates
    std::int32_t colour = 0;
};
struct SceneSphere {
    glm::vec3 centre;
    float radius = 0;  ///< 0: a dot, as wide as the pen
    SceneWidth width;
    std::int32_t colour = 0;
};

/// The visible parts of a drawing. Memory: 40 bytes a segment, 12 a vertex, 20 more if it is shaded smoothly, 56 a
/// polygon, 24 a sphere, 80 a surface.
class Scene {
public:
    /// Collects the visible parts in one pass over the word. The contexts of `grammar` are resolved.
    /// @param most  maximum number of segments, vertices and spheres; more throw BudgetError
    static Scene of(const Grammar& grammar, const Style& style, const DerivationOptions& derivation, double most);

    const std::vector<SceneSegment>& segments() const { return segments_; }
    const std::vector<ScenePolygon>& polygons() const { return polygons_; }
    const std::vector<SceneSphere>& spheres() const { return spheres_; }
    std::span<const glm::vec3> vertices(const ScenePolygon& polygon) const {
        return std::span(vertices_).subspan(polygon.first, polygon.count);
    }
    /// The corners of a polygon, one for each vertex; empty if it is flat.
    std::span<const SceneCorner> corners(const ScenePolygon& polygon) const {
        return polygon.corners ? std::span(corners_).subspan(*polygon.corners, polygon.count)
                               : std::span<const SceneCorner>();
    }
    const std::vector<SceneSurface>& surfaces() const { return surfaces_; }
    /// The colours of the patches of a surface.
    const std::vector<std::int32_t>& patch_colours(const Surface& surface) const {
        return patch_colours_.at(&surface);
    }
    /// Position of such a point.
    glm::dvec3 at(const glm::vec3& point) const { return origin_ + glm::dvec3(point); }
    bool empty() const { return segments_.empty() && polygons_.empty() && spheres_.empty() && surfaces_.empty(); }
    /// Bounds of all points, without the width of pens.
    const SpaceBounds& bounds() const { return bounds_; }

private:
    friend class SceneCollector;
    friend class Tessellation;
    /// Gives polygons that share vertices common normals there.
    void smooth();
    /// Arches single polygons, such as leaves, so that the light on them changes from side to side.
    void arch();

    glm::dvec3 origin_{0.0};  ///< the first point seen
    std::vector<SceneSegment> segments_;
    std::vector<ScenePolygon> polygons_;
    std::vector<SceneSphere> spheres_;
    std::vector<glm::vec3> vertices_;
    std::vector<SceneCorner> corners_;
    std::vector<SceneSurface> surfaces_;
    std::map<const Surface*, std::vector<std::int32_t>> patch_colours_;  ///< -1: colour of the turtle
    SpaceBounds bounds_;
};

}  // namespace sikku
