#include "art/space/daylight.h"

#include "engine/base/threads.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat2x2.hpp>
#include <glm/mat3x2.hpp>
#include <glm/matrix.hpp>
#include <glm/vec2.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>
#include <span>
#include <utility>

namespace sikku {
namespace {

constexpr int sky_maps = 64, sun_maps = 40;
constexpr double sun_radius = 2.4;  // degrees: some ten times the real one, as in thin haze
const double golden_angle = std::numbers::pi * (3 - std::sqrt(5.0));
constexpr int tile_side = 8;  // side of the tiles of open ground, in squares

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

Daylight::Daylight(const Scene& scene, const Style& style, double step, double pixels)
    : light_(style.light),
      side_(pixels < 512     ? 512
            : pixels <= 2048 ? 1024
                             : 2048),
      casters_(scene, style, step, side_) {
    if (!scene.surfaces().empty()) coarse_.emplace(scene, style, step, side_ / 2);
    light_.azimuth += style.camera.azimuth;
}

void Daylight::build(int threads, const std::function<void()>& watch) {
    const std::vector<glm::vec3> sky = sky_directions();
    const std::vector<glm::vec3> sun = sun_directions(light_.azimuth, light_.elevation);
    // An earlier call may have been stopped.
    sky_.clear();
    sky_weights_.clear();
    sun_.clear();
    float sum = 0;
    for (const glm::vec3& towards : sky) {
        sky_.emplace_back(towards, casters_.low(), casters_.high(), side_ / 2);
        sky_weights_.push_back((1 + 2 * towards.y) / 3);
        sum += sky_weights_.back() * towards.y;
    }
    for (float& weight : sky_weights_) weight /= sum;
    for (const glm::vec3& towards : sun) sun_.emplace_back(towards, casters_.low(), casters_.high(), side_);
    const std::vector<DepthMap*> maps = make_heights();
    on_threads(threads, [&] {
        for_each_index(maps.size(), [&](std::size_t i) {
            if (watch) watch();
            const bool is_of_sky = shines_sky() && i < sky_.size();
            (is_of_sky && coarse_ ? *coarse_ : casters_).draw(*maps[i]);
        });
    });
    Parts open_ground{.sky = 1};
    for (const DepthMap& map : sun_)
        open_ground.sun += std::max(0.0F, map.towards.y) / static_cast<float>(sun_.size());
    open_sun_ = open_ground.sun;
    open_ = mixed(open_ground);
    find_open_ground();
}

/// Allocates and returns the maps that are looked up: none for a sun or a sky that does not shine.
std::vector<DepthMap*> Daylight::make_heights() {
    std::vector<DepthMap*> maps;
    if (shines_sky())
        std::transform(sky_.begin(), sky_.end(), std::back_inserter(maps), [](DepthMap& map) { return &map; });
    if (shines_sun())
        std::transform(sun_.begin(), sun_.end(), std::back_inserter(maps), [](DepthMap& map) { return &map; });
    std::size_t count = 0;
    for (const DepthMap* const map : maps) count += map->squares();
    heights_ = LargeArray<std::uint16_t>(count);
    std::size_t first = 0;
    for (DepthMap* const map : maps) {
        map->heights = heights_.part(first, map->squares());
        first += map->squares();
    }
    return maps;
}

void Daylight::add_sky(LitPlaces& places) const {
    if (!shines_sky()) return;
    for (std::size_t i = 0; i < sky_.size(); ++i) sky_[i].shine(sky_weights_[i], places);
}

void Daylight::add_sun(LitPlaces& places) const {
    if (!shines_sun()) return;
    for (const DepthMap& map : sun_) map.shine(1.0F / static_cast<float>(sun_.size()), places);
}

glm::vec3 Daylight::mixed(const Parts& parts) const {
    const auto sun = static_cast<float>(light_.sun);
    return exposure * (sky_tint * ((1 - sun) * parts.sky) + sun_tint * (sun * parts.sun));
}

void Daylight::on_surfaces(LitPlaces& places, std::vector<OnSurface>& lights) const {
    lights.resize(places.size());
    std::vector<Parts> fronts(places.size()), backs(places.size());
    const float* const front = places.column(LitPlaces::front);
    const float* const behind = places.column(LitPlaces::behind);
    places.darken();
    add_sky(places);
    for (std::size_t i = 0; i < places.size(); ++i) {
        fronts[i].sky = front[i];
        backs[i].sky = behind[i];
    }
    places.darken();
    add_sun(places);
    for (std::size_t i = 0; i < places.size(); ++i) {
        fronts[i].sun = front[i];
        backs[i].sun = behind[i];
        OnSurface& light = lights[i];
        light.front = mixed(fronts[i]) + open_ * from_around;
        if (light_.has_ground) {
            // Open places receive more of the light that the ground reflects.
            const float facing = 0.5F - 0.5F * places.column(LitPlaces::normal_y)[i];
            const float openness = 0.4F + 0.6F * std::min(1.0F, fronts[i].sky);
            light.front += open_ * ground_tint * (from_ground * facing * openness);
        }
        const bool is_thin = places.column(LitPlaces::is_thin)[i] != 0;
        light.behind = is_thin ? mixed(backs[i]) : glm::vec3(0.0F);
    }
}

std::vector<float> Daylight::sky_on_ground(std::span<const glm::vec3> points) const {
    const glm::vec3 up(0, 1, 0);
    // The mean around each place, over more than the resolution of the maps.
    const float aside = 4 * sky_.front().nudge;
    const std::array steps = {glm::vec3(0.0F), glm::vec3(aside, 0, 0), glm::vec3(-aside, 0, 0),
                              glm::vec3(0, 0, aside), glm::vec3(0, 0, -aside)};
    LitPlaces places;
    for (const glm::vec3& point : points) {
        for (const glm::vec3& step : steps) places.add(point + step, up, false);
    }
    add_sky(places);
    std::vector<float> result;
    for (std::size_t i = 0; i < places.size(); i += steps.size()) {
        const float* const light = places.column(LitPlaces::front) + i;
        result.push_back(std::accumulate(light, light + steps.size(), 0.0F) / static_cast<float>(steps.size()));
    }
    return result;
}

std::vector<float> Daylight::sun_on_ground(std::span<const glm::vec3> points) const {
    std::vector<float> result(points.size(), open_sun_);
    if (!shines_sun()) return result;
    LitPlaces places;
    std::vector<std::size_t> dark;
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (!may_be_dark(points[i])) continue;
        places.add(points[i], glm::vec3(0, 1, 0), false);
        dark.push_back(i);
    }
    add_sun(places);
    for (std::size_t i = 0; i < dark.size(); ++i) result[dark[i]] = places.column(LitPlaces::front)[i];
    return result;
}

bool Daylight::may_be_dark(const glm::vec3& point) const {
    const glm::ivec2 at = tile_at(glm::vec2(sun_.front().seen(point)));
    return is_tile(at.x, at.y) && may_be_dark_[std::size_t(at.y) * std::size_t(columns_) + std::size_t(at.x)] != 0;
}

glm::vec3 Daylight::on_ground(float sky, float sun) const {
    return glm::min(mixed({.sky = sky, .sun = sun}) / open_, glm::vec3(1.0F));
}

/// Tiles around the first sun's map, as far as shadows in other directions reach when the sun is lowest.
int Daylight::tiles_around() const {
    return side_ * 5 / 8 / tile_side;
}

glm::ivec2 Daylight::tile_at(const glm::vec2& square) const {
    const auto at = [&](float place) {
        return static_cast<int>(std::floor(std::clamp(place / tile_side, -1e6F, 1e6F))) + tiles_around();
    };
    return {at(square.x), at(square.y)};
}

bool Daylight::is_tile(int column, int row) const {
    return column >= 0 && row >= 0 && column < columns_ &&
           std::size_t(row) * std::size_t(columns_) < may_be_dark_.size();
}

void Daylight::find_open_ground() {
    may_be_dark_.clear();
    if (!shines_sun()) return;
    const DepthMap& map = sun_.front();
    columns_ = map.width / tile_side + 1 + 2 * tiles_around();
    may_be_dark_.assign(std::size_t(columns_) * std::size_t(map.rows / tile_side + 1 + 2 * tiles_around()), 0);
    for (const DepthMap& other : sun_) find_shadow(other);
}

void Daylight::find_shadow(const DepthMap& map) {
    // Squares of the first map from those of this one, for places on the ground, by three of them.
    const float far = glm::length(casters_.high() - casters_.low());
    const std::array places = {glm::vec3(0, ground(), 0), glm::vec3(far, ground(), 0), glm::vec3(0, ground(), far)};
    const auto frame = [&](const DepthMap& seen_in) {
        const glm::vec2 origin(seen_in.seen(places[0]));
        return glm::mat3x2(glm::vec2(seen_in.seen(places[1])) - origin, glm::vec2(seen_in.seen(places[2])) - origin,
                           origin);
    };
    const glm::mat3x2 own = frame(map), first = frame(sun_.front());
    const glm::mat2 turn = glm::mat2(first[0], first[1]) * glm::inverse(glm::mat2(own[0], own[1]));
    const auto is_covered = [&](int left, int top) {
        for (int y = top; y < std::min(top + tile_side, map.rows); ++y) {
            const auto row = map.heights.subspan(std::size_t(y) * std::size_t(map.width), std::size_t(map.width));
            const auto part = row.subspan(std::size_t(left), std::size_t(std::min(tile_side, map.width - left)));
            if (std::any_of(part.begin(), part.end(), [](std::uint16_t height) { return height > 0; })) return true;
        }
        return false;
    };
    for (int top = 0; top < map.rows; top += tile_side) {
        for (int left = 0; left < map.width; left += tile_side) {
            if (!is_covered(left, top)) continue;
            // The light is smooth over the next square.
            glm::vec2 low(1e30F), high(-1e30F);
            for (const float x : {-1.0F, tile_side + 1.0F}) {
                for (const float y : {-1.0F, tile_side + 1.0F}) {
                    const glm::vec2 corner(static_cast<float>(left) + x, static_cast<float>(top) + y);
                    const glm::vec2 at = first[2] + turn * (corner - own[2]);
                    low = glm::min(low, at);
                    high = glm::max(high, at);
                }
            }
            const glm::ivec2 begin = tile_at(low), end = tile_at(high);
            for (int y = begin.y; y <= end.y; ++y) {
                for (int x = begin.x; x <= end.x; ++x) {
                    if (is_tile(x, y)) may_be_dark_[std::size_t(y) * std::size_t(columns_) + std::size_t(x)] = 1;
                }
            }
        }
    }
}

}  // namespace sikku
