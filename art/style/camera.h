// art/style/camera.h: the camera of drawings in space, and its projection.
#pragma once

#include "engine/geometry/space_bounds.h"

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <string_view>

namespace sikku {

/// The position of the eye. At 0 0 it is in front of the drawing, on the positive z axis: x is to the right, y
/// upwards.
struct Camera {
    double azimuth = 0.0;              ///< degrees to the right around the drawing
    double elevation = 0.0;            ///< degrees upwards, -90 to 90
    std::optional<double> distance;    ///< eye's distance in radii of the drawing, 1.01 to 10^6; absent: orthographic
    std::optional<SpaceBounds> aim{};  ///< bounds that set the perspective; absent: those of the drawing
    bool operator==(const Camera&) const = default;
};

/// Parses `AZIMUTH ELEVATION [perspective [DISTANCE]]`, separated by blanks or commas, or `front`, `side` or `top` in
/// place of the angles. Returns nullopt for anything else. The default distance of a perspective is 4 radii.
std::optional<Camera> parse_camera(std::string_view text);

/// The projection of a camera: maps points in space to points of the picture and their nearness, in turtle steps.
class Projection {
public:
    Projection(const Camera& camera, const SpaceBounds& drawing);

    /// Projects a point: x to the right, y up, z towards the eye. Straight lines stay straight, planes stay planes.
    /// Lengths are kept without perspective; with it, only those at the middle of the drawing.
    glm::dvec3 operator()(const glm::dvec3& point) const;
    /// The inverse: the point in space for a projected point.
    glm::dvec3 point(const glm::dvec3& seen) const;
    /// Size in the picture of a step at this point, in steps.
    double scale(const glm::dvec3& point) const;
    /// Turns a direction into the axes of the eye.
    glm::dvec3 turned(const glm::dvec3& direction) const { return axes_ * direction; }
    /// The inverse of turned().
    glm::dvec3 turned_back(const glm::dvec3& seen) const { return seen * axes_; }
    /// Unit vector from a point in space to the eye, in the axes of the eye.
    glm::dvec3 to_eye(const glm::dvec3& point) const;

private:
    glm::dmat3 axes_;         ///< rows: right, up, towards the eye
    glm::dvec3 middle_{0.0};  ///< middle of the drawing
    double distance_ = 0.0;   ///< distance of the eye from it, in steps; 0: orthographic
};

}  // namespace sikku
