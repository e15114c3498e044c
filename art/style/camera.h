// art/style/camera.h: the camera of drawings in space, and its projection.
#pragma once

#include "engine/geometry/space_turtle.h"

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <string_view>

namespace sikku {

/// The eye. At 0 0 it stands in front of the drawing, on the side of z: x lies to the right, y upwards.
struct Camera {
    double azimuth = 0.0;              ///< degrees to the right around the drawing
    double elevation = 0.0;            ///< degrees upwards, -90 to 90
    std::optional<double> distance;    ///< radii of the drawing to the eye, 1.01 to 10^6; absent: orthographic
    std::optional<SpaceBounds> aim{};  ///< bounds for which a perspective is arranged; absent: those of the drawing
    bool operator==(const Camera&) const = default;
};

/// `AZIMUTH ELEVATION [perspective [DISTANCE]]`, separated by blanks or commas, or in place of the angles `front`,
/// `side` or `top`. Nullopt for anything else. The default distance of a perspective is 4 radii.
std::optional<Camera> parse_camera(std::string_view text);

/// A camera that looks at a drawing: from points in space to points of the picture, in turtle steps, and how near
/// they are.
class Projection {
public:
    Projection(const Camera& camera, const SpaceBounds& drawing);

    /// x to the right, y up, z towards the eye; straight lines stay straight, planes stay planes. Without perspective
    /// lengths are kept; with it, lengths at the middle of the drawing.
    glm::dvec3 operator()(const glm::dvec3& point) const;
    /// The point that is seen there.
    glm::dvec3 point(const glm::dvec3& seen) const;
    /// Size of a step at this point in the picture, in steps.
    double scale(const glm::dvec3& point) const;
    /// A direction as the eye sees it.
    glm::dvec3 turned(const glm::dvec3& direction) const { return axes_ * direction; }
    /// The direction that the eye sees so.
    glm::dvec3 turned_back(const glm::dvec3& seen) const { return seen * axes_; }
    /// From there to the eye, as the eye sees it; of length 1.
    glm::dvec3 to_eye(const glm::dvec3& point) const;

private:
    glm::dmat3 axes_;         ///< rows: right, up, towards the eye
    glm::dvec3 middle_{0.0};  ///< middle of the drawing
    double distance_ = 0.0;   ///< distance of the eye from it, in steps; 0: orthographic
};

}  // namespace sikku
