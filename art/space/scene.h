// art/space/scene.h: holds a drawing in space in memory, because depth is known only when it is complete.
#pragma once

#include "art/style/style.h"
#include "engine/geometry/space_turtle.h"
#include "engine/language/grammar.h"

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <vector>

namespace sikku {

/// A width as the turtle has it: a factor of the style's stroke, or, below 0, what it was set to.
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

/// In turtle steps, from the scene's origin, as floats have only so many digits: Scene::at(). Colours are indices of
/// the style's palette.
struct SceneSegment {
    glm::vec3 from, to;
    SceneWidth before, after;  ///< at its ends
    std::int32_t colour = 0;
    bool goes_on = false;  ///< the one before in the list ends where it begins
};
struct ScenePolygon {
    std::size_t first = 0;  ///< of its vertices
    std::size_t count = 0;
    std::int32_t colour = 0;
};
struct SceneSphere {
    glm::vec3 centre;
    float radius = 0;  ///< 0: a dot, as wide as the pen says
    SceneWidth width;
    std::int32_t colour = 0;
};

/// All that is seen of a drawing. Memory: 40 bytes a segment, 12 a vertex, 24 a polygon or sphere.
class Scene {
public:
    /// One pass over the word; what leaves nothing on paper is left out. `grammar` has its contexts resolved.
    /// @param most  segments, vertices and spheres; more are a BudgetError
    static Scene of(const Grammar& grammar, const Style& style, const DerivationOptions& derivation, double most);

    const std::vector<SceneSegment>& segments() const { return segments_; }
    const std::vector<ScenePolygon>& polygons() const { return polygons_; }
    const std::vector<SceneSphere>& spheres() const { return spheres_; }
    std::span<const glm::vec3> vertices(const ScenePolygon& polygon) const {
        return std::span(vertices_).subspan(polygon.first, polygon.count);
    }
    /// Where such a point is.
    glm::dvec3 at(const glm::vec3& point) const { return origin_ + glm::dvec3(point); }
    bool empty() const { return segments_.empty() && polygons_.empty() && spheres_.empty(); }
    /// Of all points, without the width of pens.
    const SpaceBounds& bounds() const { return bounds_; }

private:
    friend class SceneCollector;
    glm::dvec3 origin_{0.0};  ///< the first point seen
    std::vector<SceneSegment> segments_;
    std::vector<ScenePolygon> polygons_;
    std::vector<SceneSphere> spheres_;
    std::vector<glm::vec3> vertices_;
    SpaceBounds bounds_;
};

}  // namespace sikku
