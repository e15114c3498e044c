#include "art/space/stage.h"

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

}  // namespace sikku
