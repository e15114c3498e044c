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
    /// For a print that is placed. What is drawn comes out as x and y times `units`, z towards the eye in the same
    /// measure; `unit` is that of one step.
    Stage(const Scene& scene, const Print& print, const glm::dmat3x2& units, double unit);

    /// Place of a point of the scene on the page.
    glm::dvec3 place(const glm::vec3& point) const;
    /// A direction of the scene at a point of it, as it is seen; its length has no meaning.
    glm::dvec3 direction(const glm::vec3& point, const glm::vec3& along) const;
    /// The point of the scene at a place of the page.
    glm::dvec3 point(const glm::dvec3& place) const;
    /// The direction of the scene that is seen so at a point without perspective.
    glm::dvec3 direction_back(const glm::dvec3& seen) const;
    /// The direction of the scene from a point to the eye; of length 1.
    glm::dvec3 to_eye(const glm::vec3& point) const;
    /// Half the width of a line there.
    double radius(const SceneWidth& width, const glm::vec3& at) const;
    /// Radius of a sphere; that of a dot is the pen's.
    double radius(const SceneSphere& sphere) const;
    /// How bright a surface with that normal (of any length but 0) is, from 0 to 1; `glm::dvec3(0, 0, 1)` faces the
    /// eye. The light comes from above on the left of the page, and a little of it from everywhere.
    double brightness(const glm::dvec3& normal) const;
    /// The same by the cosine of the angle between normal and light.
    double brightness_towards(double cosine) const;
    /// Where a ball of radius 1 around 0 0 is brightest.
    glm::dvec2 flat_light() const { return glm::dvec2(light_); }

private:
    const Scene& scene_;
    const Style style_;  ///< a copy, because a sheet keeps the stage longer than the print
    Projection projection_;
    glm::dmat3x2 units_;
    double unit_;
    double step_;  ///< millimetres
    glm::dvec3 light_;
};

/// The brightness of a polygon at its corners, which are lit on the side that faces the eye.
std::vector<double> corner_lights(const Scene& scene, const ScenePolygon& polygon, const Stage& stage);

/// A colour as bright as that: of white, the brightness itself; the darker it is the more of a sheen it has where it
/// is brightest, so that black has a shape.
inline Colour lit(Colour colour, double brightness) {
    constexpr double sheen = 56;
    const double added = sheen * std::max(0.0, brightness - 0.6) / 0.4;
    const auto channel = [&](std::uint8_t value) {
        return static_cast<std::uint8_t>(std::lround(value * brightness + added * (255 - value) / 255));
    };
    return {channel(colour.red), channel(colour.green), channel(colour.blue), colour.alpha};
}

}  // namespace sikku
