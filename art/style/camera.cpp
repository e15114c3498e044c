#include "art/style/camera.h"

#include "art/style/values.h"
#include "engine/base/diagnostic.h"

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

namespace sikku {
namespace {

constexpr double usual_distance = 4.0;

std::optional<double> number(std::string_view text) {
    double value = 0.0;
    if (!read_number(text, value) || !std::isfinite(value)) return std::nullopt;
    return value;
}

/// The unit vector at an angle, exact at quarter turns, so that a view from the front is exact.
glm::dvec2 direction(double degrees) {
    const double turned = std::fmod(degrees, 360.0);
    const double quarters = turned / 90;
    if (quarters == std::floor(quarters)) {
        constexpr glm::dvec2 exact[] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}};
        return exact[(static_cast<int>(quarters) + 4) % 4];
    }
    const double angle = turned * std::numbers::pi / 180;
    return {std::cos(angle), std::sin(angle)};
}

}  // namespace

std::optional<Camera> parse_camera(std::string_view text) {
    const std::vector<std::string> words = words_of(text, 5);
    if (words.size() > 4) return std::nullopt;
    Camera camera;
    std::size_t next = 0;
    if (words.empty()) return std::nullopt;
    if (words[0] == "front" || words[0] == "side" || words[0] == "top") {
        if (words[0] == "side") camera.azimuth = 90;
        if (words[0] == "top") camera.elevation = 90;
        next = 1;
    } else {
        const auto azimuth = number(words[0]);
        const auto elevation = words.size() > 1 ? number(words[1]) : std::nullopt;
        if (!azimuth || !elevation || std::fabs(*elevation) > 90) return std::nullopt;
        camera.azimuth = *azimuth;
        camera.elevation = *elevation;
        next = 2;
    }
    if (next == words.size()) return camera;
    if (words[next] != "perspective") return std::nullopt;
    camera.distance = usual_distance;
    if (++next < words.size()) {
        const auto distance = number(words[next++]);
        if (!distance || !(*distance >= 1.01) || *distance > 1e6) return std::nullopt;
        camera.distance = *distance;
    }
    if (next != words.size()) return std::nullopt;
    return camera;
}

Projection::Projection(const Camera& camera, const SpaceBounds& drawing) {
    const SpaceBounds aim = camera.aim.value_or(drawing);
    middle_ = (aim.low + aim.high) / 2.0;
    const glm::dvec2 azimuth = direction(camera.azimuth);
    const glm::dvec2 elevation = direction(camera.elevation);
    const glm::dvec3 right(azimuth.x, 0, -azimuth.y);
    const glm::dvec3 eye(azimuth.y * elevation.x, elevation.y, azimuth.x * elevation.x);
    axes_ = glm::transpose(glm::dmat3(right, glm::cross(eye, right), eye));
    if (camera.distance) {
        const double radius = glm::distance(aim.low, aim.high) / 2;
        distance_ = *camera.distance * (radius > 0 ? radius : 1.0);
    }
}

double Projection::scale(const glm::dvec3& point) const {
    if (distance_ == 0) return 1.0;
    return distance_ / (distance_ - (axes_ * (point - middle_)).z);
}

glm::dvec3 Projection::operator()(const glm::dvec3& point) const {
    const glm::dvec3 seen = axes_ * point;
    if (distance_ == 0) return seen;
    const glm::dvec3 centre = axes_ * middle_;
    const glm::dvec3 away = seen - centre;
    const double factor = distance_ / (distance_ - away.z);
    // This is the measure of nearness that keeps planes flat.
    return {centre.x + away.x * factor, centre.y + away.y * factor, distance_ * (factor - 1)};
}

glm::dvec3 Projection::point(const glm::dvec3& seen) const {
    if (distance_ == 0) return turned_back(seen);
    const glm::dvec3 centre = axes_ * middle_;
    const double factor = seen.z / distance_ + 1;
    const glm::dvec3 away((seen.x - centre.x) / factor, (seen.y - centre.y) / factor, distance_ - distance_ / factor);
    return turned_back(centre + away);
}

glm::dvec3 Projection::to_eye(const glm::dvec3& point) const {
    if (distance_ == 0) return {0, 0, 1};
    return glm::normalize(glm::dvec3(0, 0, distance_) - axes_ * (point - middle_));
}

}  // namespace sikku
