// art/space/stage.h: projects and lights a scene, in the units of the caller.
#pragma once

#include "art/print/print.h"
#include "art/space/scene.h"
#include "art/style/camera.h"

#include <glm/geometric.hpp>
#include <glm/mat3x2.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <vector>

namespace sikku {

class Stage {
public:
    /// A stage for a placed print. Places are x and y times `units`, with z towards the eye in the same unit; `unit`
    /// is the length of one step.
    Stage(const Scene& scene, const Print& print, const glm::dmat3x2& units, double unit);

    /// Projects a point of the scene to a place on the page.
    glm::dvec3 place(const glm::vec3& point) const;
    /// Projects a direction at a point of the scene; the length of the result is arbitrary.
    glm::dvec3 direction(const glm::vec3& point, const glm::vec3& along) const;
    /// The inverse of place().
    glm::dvec3 point(const glm::dvec3& place) const;
    /// The inverse of direction() without perspective.
    glm::dvec3 direction_back(const glm::dvec3& seen) const;
    /// Unit vector in the scene from a point to the eye.
    glm::dvec3 to_eye(const glm::vec3& point) const;
    /// Half the width of a line at a point.
    double radius(const SceneWidth& width, const glm::vec3& at) const;
    /// Radius of a sphere; for a dot, that of the pen.
    double radius(const SceneSphere& sphere) const;
    /// Brightness of a surface by its normal (of any length but 0), from 0 to 1; `glm::dvec3(0, 0, 1)` faces the eye.
    /// The light comes from above on the left of the page, and a little of it from everywhere.
    double brightness(const glm::dvec3& normal) const;
    /// Brightness by the cosine of the angle between normal and light.
    double brightness_towards(double cosine) const;
    /// The brightest point of a ball of radius 1 around 0 0.
    glm::dvec2 flat_light() const { return glm::dvec2(light_); }

private:
    const Scene& scene_;
    const Style style_;  ///< a copy, because a sheet keeps the stage longer than the print
    Projection projection_;
    glm::dmat3x2 units_;
    glm::dmat2x2 from_units_;
    double unit_;
    double step_;  ///< millimetres
    glm::dvec3 light_;
};

/// The brightness of a polygon at its corners, which are lit on the side that faces the eye.
std::vector<double> corner_lights(const Scene& scene, const ScenePolygon& polygon, const Stage& stage);

/// A colour at a brightness: white has the brightness itself; the darker a colour, the stronger its sheen where it is
/// brightest, so that black has a shape.
inline Colour lit(Colour colour, double brightness) {
    constexpr double sheen = 56;
    const double added = sheen * std::max(0.0, brightness - 0.6) / 0.4;
    const auto channel = [&](std::uint8_t value) {
        return static_cast<std::uint8_t>(std::lround(value * brightness + added * (255 - value) / 255));
    };
    return {channel(colour.red), channel(colour.green), channel(colour.blue), colour.alpha};
}

}  // namespace sikku
