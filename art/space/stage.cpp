#include "art/space/stage.h"

#include "art/space/triangles.h"

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <algorithm>

namespace sikku {
namespace {

const glm::dvec3 page_light = glm::normalize(glm::dvec3(-0.45, 0.6, 0.75));  // x to the right, y up the page
constexpr double from_everywhere = 0.45;
constexpr double from_light = 0.6;

}  // namespace

Stage::Stage(const Scene& scene, const Print& print, const glm::dmat3x2& units, double unit)
    : scene_(scene),
      style_(print.style),
      projection_(print.style.camera, scene.bounds()),
      units_(units),
      from_units_(glm::inverse(glm::dmat2x2(units[0], units[1]))),
      unit_(unit),
      step_(print.placement.step) {
    // The same light on the page, however the drawing lies on it: from the page, whose y goes down, back to the
    // drawing, and on to the units.
    const glm::dmat2x2 to_page(print.placement.to_page[0], print.placement.to_page[1]);
    const glm::dvec2 flat =
        glm::dmat2x2(units[0], units[1]) * (glm::inverse(to_page) * glm::dvec2(page_light.x, -page_light.y));
    light_ = {flat * (step_ / unit), page_light.z};
}

glm::dvec3 Stage::place(const glm::vec3& point) const {
    const glm::dvec3 seen = projection_(scene_.at(point));
    return {units_ * glm::dvec3(seen.x, seen.y, 1.0), seen.z * unit_};
}

glm::dvec3 Stage::direction(const glm::vec3& point, const glm::vec3& along) const {
    const glm::dvec3 at = scene_.at(point);
    // A step so short that the perspective does not bend it, and long enough for doubles.
    const glm::dvec3 step = glm::dvec3(along) * (1e-6 * std::max(1.0, glm::length(at)));
    const glm::dvec3 seen = projection_(at + step) - projection_(at);
    return {glm::dmat2x2(units_[0], units_[1]) * glm::dvec2(seen), seen.z * unit_};
}

glm::dvec3 Stage::point(const glm::dvec3& place) const {
    const glm::dvec2 flat = from_units_ * (glm::dvec2(place) - units_[2]);
    return projection_.point({flat, place.z / unit_}) - scene_.at(glm::vec3(0.0F));
}

glm::dvec3 Stage::direction_back(const glm::dvec3& seen) const {
    const glm::dvec2 flat = from_units_ * glm::dvec2(seen);
    return projection_.turned_back({flat, seen.z / unit_});
}

glm::dvec3 Stage::to_eye(const glm::vec3& point) const {
    return projection_.turned_back(projection_.to_eye(scene_.at(point)));
}

double Stage::radius(const SceneWidth& width, const glm::vec3& at) const {
    return style_.line_width(width.pen(0), step_) / step_ * unit_ / 2 * projection_.scale(scene_.at(at));
}

double Stage::radius(const SceneSphere& sphere) const {
    return style_.disc_radius(sphere.radius, sphere.width.pen(0), step_) / step_ * unit_ *
           projection_.scale(scene_.at(sphere.centre));
}

double Stage::brightness(const glm::dvec3& normal) const {
    return brightness_towards(glm::dot(normal, light_) / glm::length(normal));
}

double Stage::brightness_towards(double cosine) const {
    return std::min(1.0, from_everywhere + from_light * std::max(0.0, cosine));
}

std::vector<double> corner_lights(const Scene& scene, const ScenePolygon& polygon, const Stage& stage) {
    const auto vertices = scene.vertices(polygon);
    const auto corners = scene.corners(polygon);
    std::vector<glm::vec3> seen;
    const glm::dvec3 first = stage.place(vertices.front());
    for (const glm::vec3& vertex : vertices) seen.emplace_back(stage.place(vertex) - first);
    const glm::dvec3 normal = area_normal(seen);
    std::vector<double> lights;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        // The page is mirrored: normals of the scene and of the projection may point to different sides.
        glm::dvec3 own = stage.direction(vertices[i], corners[i].normal);
        if (glm::dot(own, normal) < 0) own = -own;
        if (normal.z < 0) own = -own;
        lights.push_back(glm::length(own) > 0 ? stage.brightness(own) : 0.0);
    }
    return lights;
}

}  // namespace sikku
