#include "art/space/daylight.h"

#include "art/space/outline_runs.h"
#include "art/space/tessellation.h"
#include "art/space/triangles.h"
#include "engine/base/threads.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>
#include <utility>

namespace sikku {
namespace {

constexpr int sky_maps = 64, sun_maps = 40;
constexpr double sun_radius = 2.4;  // degrees: some ten times the real one, as in thin haze
const double golden_angle = std::numbers::pi * (3 - std::sqrt(5.0));
constexpr int tiles_around = 5;  // around occupied tiles, in the map of open ground
constexpr float highest = 65535.0F;

constexpr float exposure = 1.35F;
const glm::vec3 sun_tint(1.05F, 1.0F, 0.91F);
const glm::vec3 sky_tint(0.93F, 0.99F, 1.09F);
const glm::vec3 ground_tint(1.03F, 1.0F, 0.93F);
constexpr float from_ground = 0.2F;   // share of the light that the ground reflects
constexpr float from_around = 0.08F;  // share of the light that everything else reflects

glm::vec3 direction(double azimuth, double height) {
    const double flat = std::sqrt(std::max(0.0, 1 - height * height));
    return {flat * std::sin(azimuth), height, flat * std::cos(azimuth)};
}

std::pair<glm::vec3, glm::vec3> axes_across(const glm::vec3& towards) {
    const glm::vec3 reference = std::fabs(towards.y) < 0.9F ? glm::vec3(0, 1, 0) : glm::vec3(1, 0, 0);
    const glm::vec3 across = glm::normalize(glm::cross(reference, towards));
    return {across, glm::cross(towards, across)};
}

/// Directions spread evenly over the upper half of a sphere.
std::vector<glm::vec3> sky_directions() {
    std::vector<glm::vec3> result;
    for (int i = 0; i < sky_maps; ++i) result.push_back(direction(i * golden_angle, 1 - (i + 0.5) / sky_maps));
    return result;
}

/// Directions spread evenly over the disc of the sun.
std::vector<glm::vec3> sun_directions(double azimuth, double elevation) {
    const double radians = std::numbers::pi / 180;
    const glm::vec3 middle = direction(azimuth * radians, std::sin(elevation * radians));
    const auto [across, along] = axes_across(middle);
    const double size = std::tan(sun_radius * radians);
    std::vector<glm::vec3> result;
    for (int i = 0; i < sun_maps; ++i) {
        const double radius = size * std::sqrt((i + 0.5) / sun_maps), angle = i * golden_angle;
        result.push_back(glm::normalize(middle + across * static_cast<float>(radius * std::cos(angle)) +
                                        along * static_cast<float>(radius * std::sin(angle))));
    }
    return result;
}

}  // namespace

/// Draws surfaces into a map.
class Daylight::Drawer {
public:
    explicit Drawer(Map& map) : map_(map), width_(map.width), height_(map.rows) {}

    /// Corners in squares of the map, and their heights.
    void triangle(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
        const float area = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
        if (!(std::fabs(area) > 1e-6F)) return;
        const int first = first_after(std::min({a.y, b.y, c.y}), height_);
        const int end = first_after(std::max({a.y, b.y, c.y}), height_);
        const float slope_x = ((b.z - a.z) * (c.y - a.y) - (c.z - a.z) * (b.y - a.y)) / area;
        const float slope_y = ((c.z - a.z) * (b.x - a.x) - (b.z - a.z) * (c.x - a.x)) / area;
        const float lowest = std::min({a.z, b.z, c.z}), top = std::max({a.z, b.z, c.z});
        for (int y = first; y < end; ++y) {
            const float middle = static_cast<float>(y) + 0.5F;
            const auto [left, right] = triangle_run(a, b, c, middle);
            cover(y, left, right, [&](int x) {
                const float height = a.z + (static_cast<float>(x) + 0.5F - a.x) * slope_x + (middle - a.y) * slope_y;
                return static_cast<std::uint16_t>(std::clamp(height, lowest, top));
            });
        }
    }

    /// Draws a polygon that may cross itself, at the mean height of its corners.
    void outline(std::span<const glm::vec3> corners) {
        float low = 1e30F, high = -1e30F, sum = 0;
        for (const glm::vec3& corner : corners) {
            low = std::min(low, corner.y);
            high = std::max(high, corner.y);
            sum += corner.z;
        }
        const auto height =
            static_cast<std::uint16_t>(std::clamp(sum / static_cast<float>(corners.size()), 0.0F, highest));
        each_outline_run(corners, first_after(low, height_), first_after(high, height_),
                         [&](int y, double from, double to) {
                             cover(y, static_cast<float>(from), static_cast<float>(to), [&](int) { return height; });
                         });
    }

    void round(const glm::vec3& from, float before, const glm::vec3& to, float after) {
        // Shapes narrower than a square would be lost.
        before = std::max(before, 0.5F);
        after = std::max(after, 0.5F);
        const glm::vec2 along(to - from);
        if (const float length = glm::length(along); length > 0) {
            const glm::vec3 across(-along.y / length, along.x / length, 0);
            triangle(from + across * before, from - across * before, to - across * after);
            triangle(from + across * before, to - across * after, to + across * after);
        }
        if (after > 1) disc(to, after);
    }

private:
    void disc(const glm::vec3& centre, float radius) {
        const auto height = static_cast<std::uint16_t>(std::clamp(centre.z, 0.0F, highest));
        for (int y = first_after(centre.y - radius, height_), end = first_after(centre.y + radius, height_); y < end;
             ++y) {
            const float dy = static_cast<float>(y) + 0.5F - centre.y;
            const float half = std::sqrt(std::max(0.0F, radius * radius - dy * dy));
            cover(y, centre.x - half, centre.x + half, [&](int) { return height; });
        }
    }
    /// Raises the squares of a row between two coordinates. @param height  returns the height of a column
    template <class Height>
    void cover(int y, float from, float to, Height&& height) {
        std::uint16_t* const row = map_.heights.data() + std::size_t(y) * std::size_t(width_);
        for (int x = first_after(from, width_), stop = first_after(to, width_); x < stop; ++x) {
            row[x] = std::max<std::uint16_t>(row[x], height(x));
        }
    }
    /// The first row or column whose middle is not before a coordinate.
    static int first_after(float coordinate, int end) {
        return static_cast<int>(std::clamp(std::ceil(coordinate - 0.5F), 0.0F, static_cast<float>(end)));
    }

    Map& map_;
    int width_, height_;
};

glm::vec3 Daylight::Map::seen(const glm::vec3& point) const {
    return offset + glm::vec3(glm::dot(point, across), glm::dot(point, along), glm::dot(point, depth));
}

float Daylight::Map::reaches(const glm::vec3& point) const {
    const glm::vec3 at = seen(point);
    // Points below the scene are below its lowest height.
    const float x = at.x - 0.5F, y = at.y - 0.5F, height = std::max(0.0F, at.z + bias);
    // The outermost squares are empty.
    if (!(x >= 0 && y >= 0 && x < static_cast<float>(width - 1) && y < static_cast<float>(rows - 1))) return 1.0F;
    const int column = static_cast<int>(x), line = static_cast<int>(y);
    const float dx = x - static_cast<float>(column), dy = y - static_cast<float>(line);
    const std::uint16_t* const row = heights.data() +
                                     static_cast<std::size_t>(line) * static_cast<std::size_t>(width) +
                                     static_cast<std::size_t>(column);
    const auto passes = [&](std::uint16_t stored) { return static_cast<float>(stored) <= height ? 1.0F : 0.0F; };
    const float above = passes(row[0]) * (1 - dx) + passes(row[1]) * dx;
    const float below = passes(row[width]) * (1 - dx) + passes(row[width + 1]) * dx;
    return above * (1 - dy) + below * dy;
}

Daylight::Daylight(const Scene& scene, const Style& style, double step, double pixels)
    : light_(style.light),
      side_(pixels < 512     ? 512
            : pixels <= 2048 ? 1024
                             : 2048) {
    light_.azimuth += style.camera.azimuth;
    const glm::dvec3 origin = scene.at(glm::vec3(0.0F));
    low_ = glm::vec3(scene.bounds().low - origin);
    high_ = glm::vec3(scene.bounds().high - origin);
    ground_ = low_.y;
    const glm::vec3 size = high_ - low_;
    const double extent = std::max({size.x, size.y, size.z});
    const Scene divided = scene.surfaces().empty() ? Scene() : tessellated(scene, {.deviation = extent / side_});
    const Scene& casters = scene.surfaces().empty() ? scene : divided;
    for (const ScenePolygon& polygon : casters.polygons()) {
        const auto vertices = casters.vertices(polygon);
        const auto first = static_cast<std::uint32_t>(corners_.size());
        corners_.insert(corners_.end(), vertices.begin(), vertices.end());
        const Triangulation parts = triangulate(vertices);
        if (!parts.is_whole) outlines_.emplace_back(first, static_cast<std::uint32_t>(vertices.size()));
        for (const auto& triangle : parts.is_whole ? parts.triangles : decltype(parts.triangles)()) {
            for (const std::uint32_t corner : triangle) triangles_.push_back(first + corner);
        }
    }
    float widest = 0;
    const auto radius = [&](const SceneWidth& width) {
        const auto half = static_cast<float>(style.line_width(width.pen(0), step) / step / 2);
        widest = std::max(widest, half);
        return half;
    };
    for (const SceneSegment& segment : casters.segments()) {
        const Round stem{segment.from, segment.to, radius(segment.before), radius(segment.after)};
        rounds_.push_back(stem);
        // A level stem reaches down by its radius, an upright one, which is cut flat, does not.
        const glm::vec3 along = stem.to - stem.from;
        const float length = glm::length(along);
        const float level = length > 0 ? std::hypot(along.x, along.z) / length : 1.0F;
        ground_ = std::min({ground_, stem.from.y - stem.before * level, stem.to.y - stem.after * level});
    }
    for (const SceneSphere& sphere : casters.spheres()) {
        const auto half = static_cast<float>(style.disc_radius(sphere.radius, sphere.width.pen(0), step) / step);
        widest = std::max(widest, half);
        rounds_.push_back({sphere.centre, sphere.centre, half, half});
        ground_ = std::min(ground_, sphere.centre.y - half);
    }
    low_ -= widest;
    high_ += widest;
}

Daylight::Map Daylight::framed(const glm::vec3& towards, int side) const {
    Map map;
    map.towards = towards;
    const auto [across, along] = axes_across(towards);
    glm::vec3 least(1e30F), most(-1e30F);
    for (int i = 0; i < 8; ++i) {
        const glm::vec3 corner((i & 1) ? high_.x : low_.x, (i & 2) ? high_.y : low_.y, (i & 4) ? high_.z : low_.z);
        const glm::vec3 seen(glm::dot(corner, across), glm::dot(corner, along), glm::dot(corner, towards));
        least = glm::min(least, seen);
        most = glm::max(most, seen);
    }
    const glm::vec3 size = glm::max(most - least, glm::vec3(1e-20F));
    constexpr float rim = 2;
    const float scale = (static_cast<float>(side) - 2 * rim) / std::max(size.x, size.y);
    const float depth = (highest - 2) / size.z;
    map.across = across * scale;
    map.along = along * scale;
    map.depth = towards * depth;
    map.offset = {rim - least.x * scale, rim - least.y * scale, 1 - least.z * depth};
    map.bias = depth / scale;
    map.nudge = 1.5F / scale;
    map.width = static_cast<int>(size.x * scale + 2 * rim) + 1;
    map.rows = static_cast<int>(size.y * scale + 2 * rim) + 1;
    map.heights.assign(std::size_t(map.width) * std::size_t(map.rows), 0);
    return map;
}

void Daylight::draw(Map& map) const {
    Drawer drawer(map);
    for (std::size_t i = 0; i + 2 < triangles_.size(); i += 3) {
        drawer.triangle(map.seen(corners_[triangles_[i]]), map.seen(corners_[triangles_[i + 1]]),
                        map.seen(corners_[triangles_[i + 2]]));
    }
    std::vector<glm::vec3> seen;
    for (const auto& [first, count] : outlines_) {
        seen.clear();
        for (std::uint32_t i = 0; i < count; ++i) seen.push_back(map.seen(corners_[first + i]));
        drawer.outline(seen);
    }
    const float scale = glm::length(map.across);
    for (const Round& round : rounds_) {
        drawer.round(map.seen(round.from), round.before * scale, map.seen(round.to), round.after * scale);
    }
}

void Daylight::build(int threads, const std::function<void()>& watch) {
    double sum = 0;
    for (const glm::vec3& towards : sky_directions()) {
        sky_.push_back(framed(towards, side_ / 2));
        sky_weights_.push_back((1 + 2 * towards.y) / 3);
        sum += double{sky_weights_.back()} * towards.y;
    }
    for (float& weight : sky_weights_) weight /= static_cast<float>(sum);
    for (const glm::vec3& towards : sun_directions(light_.azimuth, light_.elevation)) {
        sun_.push_back(framed(towards, side_));
    }
    on_threads(threads, [&] {
        for_each_index(sky_.size() + sun_.size(), [&](std::size_t i) {
            if (watch) watch();
            draw(i < sky_.size() ? sky_[i] : sun_[i - sky_.size()]);
        });
    });
    Parts open_ground{.sky = 1};
    for (const Map& map : sun_) open_ground.sun += std::max(0.0F, map.towards.y) / static_cast<float>(sun_.size());
    open_sun_ = open_ground.sun;
    open_ = mixed(open_ground);
    find_open_ground();
}

float Daylight::sky(const glm::vec3& point, const glm::vec3& normal) const {
    float sum = 0;
    if (light_.sun == 1) return sum;
    for (std::size_t i = 0; i < sky_.size(); ++i) {
        const float cosine = glm::dot(normal, sky_[i].towards);
        if (cosine > 0) sum += sky_weights_[i] * cosine * sky_[i].reaches(point + normal * sky_[i].nudge);
    }
    return sum;
}

float Daylight::sun(const glm::vec3& point, const glm::vec3& normal) const {
    float sum = 0;
    if (light_.sun == 0) return sum;
    for (const Map& map : sun_) {
        const float cosine = glm::dot(normal, map.towards);
        if (cosine > 0) sum += cosine * map.reaches(point + normal * map.nudge);
    }
    return sum / static_cast<float>(sun_.size());
}

Daylight::Parts Daylight::parts(const glm::vec3& point, const glm::vec3& normal) const {
    return {.sky = sky(point, normal), .sun = sun(point, normal)};
}

glm::vec3 Daylight::mixed(const Parts& parts) const {
    const auto sun = static_cast<float>(light_.sun);
    return exposure * (sky_tint * ((1 - sun) * parts.sky) + sun_tint * (sun * parts.sun));
}

Daylight::OnSurface Daylight::on_surface(const glm::vec3& point, const glm::vec3& normal, bool is_thin) const {
    const Parts front = parts(point, normal);
    OnSurface result;
    result.front = mixed(front) + open_ * from_around;
    if (light_.has_ground) {
        // Light that the ground reflects reaches open places more.
        const float facing = 0.5F - 0.5F * normal.y, openness = 0.4F + 0.6F * std::min(1.0F, front.sky);
        result.front += open_ * ground_tint * (from_ground * facing * openness);
    }
    if (is_thin) result.behind = mixed(parts(point, -normal));
    return result;
}

float Daylight::sky_on_ground(const glm::vec3& point) const {
    const glm::vec3 up(0, 1, 0);
    // The mean around the place, over more than the resolution of the maps.
    const float aside = 4 * sky_.front().nudge;
    float sum = sky(point, up);
    for (const glm::vec3& step :
         {glm::vec3(aside, 0, 0), glm::vec3(-aside, 0, 0), glm::vec3(0, 0, aside), glm::vec3(0, 0, -aside)}) {
        sum += sky(point + step, up);
    }
    return sum / 5;
}

float Daylight::sun_on_ground(const glm::vec3& point) const {
    const glm::vec3 seen = sun_.front().seen(point);
    const int column =
        static_cast<int>(std::clamp(seen.x / float(tile()) + float{tiles_around}, -1.0F, float{1 << 20}));
    const int row = static_cast<int>(std::clamp(seen.y / float(tile()) + float{tiles_around}, -1.0F, float{1 << 20}));
    const bool is_inside = column >= 0 && row >= 0 && column < columns_ &&
                           std::size_t(row) * std::size_t(columns_) < may_be_dark_.size();
    if (!is_inside || !may_be_dark_[std::size_t(row) * std::size_t(columns_) + std::size_t(column)]) return open_sun_;
    return sun(point, glm::vec3(0, 1, 0));
}

glm::vec3 Daylight::on_ground(float sky, float sun) const {
    return glm::min(mixed({.sky = sky, .sun = sun}) / open_, glm::vec3(1.0F));
}

void Daylight::find_open_ground() {
    // Directions to the sun differ by at most twice its radius, so that the shadows of an object at most as far away
    // as the map is wide lie within a few tiles.
    const Map& map = sun_.front();
    columns_ = map.width / tile() + 1 + 2 * tiles_around;
    const int rows = map.rows / tile() + 1 + 2 * tiles_around;
    may_be_dark_.assign(std::size_t(columns_) * std::size_t(rows), 0);
    for (int y = 0; y < map.rows; ++y) {
        for (int x = 0; x < map.width; ++x) {
            if (map.heights[std::size_t(y) * std::size_t(map.width) + std::size_t(x)] == 0) continue;
            char& own = may_be_dark_[std::size_t(y / tile() + tiles_around) * std::size_t(columns_) +
                                     std::size_t(x / tile() + tiles_around)];
            own = 1;
        }
    }
    const std::vector<char> covered = may_be_dark_;
    for (int y = 0; y < rows; ++y) {
        for (int x = 0; x < columns_; ++x) {
            if (!covered[std::size_t(y) * std::size_t(columns_) + std::size_t(x)]) continue;
            for (int v = std::max(0, y - tiles_around); v <= std::min(rows - 1, y + tiles_around); ++v) {
                for (int u = std::max(0, x - tiles_around); u <= std::min(columns_ - 1, x + tiles_around); ++u) {
                    may_be_dark_[std::size_t(v) * std::size_t(columns_) + std::size_t(u)] = 1;
                }
            }
        }
    }
}

}  // namespace sikku
