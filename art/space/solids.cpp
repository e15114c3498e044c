#include "art/space/solids.h"

#include "art/space/stage.h"
#include "art/space/tessellation.h"
#include "art/space/triangles.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <numeric>
#include <span>
#include <tuple>
#include <vector>

namespace sikku {
namespace {

constexpr int shades = 24;
constexpr double wide_stem = 0.8;    // millimetres; wider ones are lit in strips
constexpr int strips = 6;            // number of strips
constexpr double widening = 0.06;    // millimetres by which polygons within a surface are widened
constexpr double least_part = 0.5;   // millimetres; smallest part of a polygon in several shades
constexpr double longest_side = 4;   // millimetres; longest side of a polygon of a surface
constexpr double round_stem = 0.35;  // millimetres; wider ones have round ends

/// The colours of a palette that with_shades() made.
class Shades {
public:
    explicit Shades(const Style& style) : colours_(static_cast<int>(style.palette.size()) / (1 + 2 * shades)) {}
    Pen pen(int colour, bool fills, double brightness) const {
        const int shade = std::clamp(static_cast<int>(std::lround(brightness * shades)) - 1, 0, shades - 1);
        return Pen{.colour = colours_ * (1 + 2 * shade + (fills ? 1 : 0)) + colour};
    }

private:
    int colours_;
};

struct Item {
    float depth;
    std::uint32_t index;  ///< segments, then polygons, then spheres
};

class Painter {
public:
    Painter(const Scene& scene, const Print& print, PathSink& sink)
        : scene_(scene),
          stage_(scene, print, glm::dmat3x2(1.0), 1.0),
          shades_(print.style),
          sink_(sink),
          step_(print.placement.step),
          flat_light_(stage_.flat_light()) {}

    void draw(const Monitor& monitor) {
        Pulse pulse(monitor);
        const std::size_t segments = scene_.segments().size(), polygons = scene_.polygons().size();
        std::vector<Item> items;
        const auto add = [&](double depth) {
            items.push_back({static_cast<float>(depth), static_cast<std::uint32_t>(items.size())});
        };
        items.reserve(segments + polygons + scene_.spheres().size());
        for (const SceneSegment& segment : scene_.segments()) {
            pulse();
            add((stage_.place(segment.from).z + stage_.place(segment.to).z +
                 stage_.radius(segment.before, segment.from) + stage_.radius(segment.after, segment.to)) /
                2);
        }
        for (const ScenePolygon& polygon : scene_.polygons()) {
            pulse();
            double sum = 0;
            for (const glm::vec3& vertex : scene_.vertices(polygon)) sum += stage_.place(vertex).z;
            add(sum / static_cast<double>(polygon.count));
        }
        for (const SceneSphere& sphere : scene_.spheres()) {
            add(stage_.place(sphere.centre).z + stage_.radius(sphere));
        }
        // The depth of a round shape is that of its nearest point. At equal depth, the later item lies over the
        // earlier.
        std::stable_sort(items.begin(), items.end(),
                         stoppable(monitor, [](const Item& a, const Item& b) { return a.depth < b.depth; }));
        for (const Item& item : items) {
            pulse();
            if (item.index < segments) {
                draw_stem(scene_.segments()[item.index]);
            } else if (item.index < segments + polygons) {
                draw_polygon(scene_.polygons()[item.index - segments]);
            } else {
                draw_sphere(scene_.spheres()[item.index - segments - polygons]);
            }
        }
    }

private:
    void fill(int colour, bool fills, double brightness) {
        sink_.polygon(outline_, shades_.pen(colour, fills, brightness));
        outline_.clear();
    }

    /// Adds part of a circle, from one angle to another, both excluded.
    void add_arc(glm::dvec2 centre, double radius, double from, double to, int pieces) {
        for (int i = 1; i < pieces; ++i) {
            const double angle = from + (to - from) * i / pieces;
            outline_.push_back(centre + radius * glm::dvec2(std::cos(angle), std::sin(angle)));
        }
    }

    /// Draws circles over each other, from the outline to the brightest point.
    void draw_ball(const glm::dvec3& centre, double radius, int colour, bool fills) {
        const double width = 2 * radius * step_;
        const int pieces = width > 8 ? 64 : width > wide_stem ? 32 : 10;
        const int circles = width > 8 ? 12 : width > wide_stem ? 6 : 1;
        for (int circle = 0; circle < circles; ++circle) {
            const double part = static_cast<double>(circle) / circles;
            add_arc(glm::dvec2(centre) + part * radius * flat_light_, radius * (1 - part),
                    -2 * std::numbers::pi / pieces, 2 * std::numbers::pi, pieces + 1);
            // At the outline, the mean for a ball over all sides.
            const double cosine = circles == 1 ? 0.65 : 0.2 + 0.8 * std::sqrt(part + 0.5 / circles);
            fill(colour, fills, stage_.brightness_towards(cosine));
        }
    }

    void draw_stem(const SceneSegment& segment) {
        const glm::dvec3 from = stage_.place(segment.from), to = stage_.place(segment.to);
        const double before = stage_.radius(segment.before, segment.from);
        const double after = stage_.radius(segment.after, segment.to);
        const glm::dvec3 along = to - from;
        const double flat = std::hypot(along.x, along.y), length = glm::length(along);
        const double thickest = std::max(before, after);
        if (!(thickest > 0)) return;
        if (!(flat > 1e-6 * thickest))
            return draw_ball(along.z > 0 ? to : from, along.z > 0 ? after : before, segment.colour, false);
        const glm::dvec3 across(-along.y / flat, along.x / flat, 0);
        glm::dvec3 front = glm::cross(across, along / length);
        if (front.z < 0) front = -front;
        const glm::dvec2 a(from), b(to), side(across);
        const double left = std::atan2(side.y, side.x);
        const double width = 2 * thickest * step_;
        const int pieces = width > wide_stem ? 8 : width > round_stem ? 4 : 2;
        outline_.push_back(a + side * before);
        if (!segment.goes_on) add_arc(a, before, left, left + std::numbers::pi, pieces);
        outline_.push_back(a - side * before);
        outline_.push_back(b - side * after);
        add_arc(b, after, left - std::numbers::pi, left, pieces);
        outline_.push_back(b + side * after);
        std::reverse(outline_.begin(), outline_.end());
        fill(segment.colour, false, stage_.brightness(front));
        if (!(width > wide_stem)) return;
        for (int i = 0; i < strips; ++i) {
            const double first = std::numbers::pi * i / strips, last = std::numbers::pi * (i + 1) / strips;
            const double middle = (first + last) / 2;
            for (const auto& [angle, at, radius] : {std::tuple(first, a, before), std::tuple(last, a, before),
                                                    std::tuple(last, b, after), std::tuple(first, b, after)}) {
                outline_.push_back(at + side * (radius * std::cos(angle)));
            }
            fill(segment.colour, false, stage_.brightness(across * std::cos(middle) + front * std::sin(middle)));
        }
    }

    void draw_polygon(const ScenePolygon& polygon) {
        std::vector<glm::vec3> placed;
        for (const glm::vec3& vertex : scene_.vertices(polygon)) {
            const glm::dvec3 at = stage_.place(vertex);
            placed.emplace_back(at);
            outline_.emplace_back(at.x, at.y);
        }
        glm::dvec3 normal = area_normal(placed);
        if (normal.z < 0) normal = -normal;
        if (!(glm::length(normal) > 0)) return outline_.clear();
        if (polygon.corners) return draw_smooth(polygon);
        fill(polygon.colour, true, stage_.brightness(normal));
    }

    /// The whole polygon in its mean brightness; on it parts in that of their places.
    void draw_smooth(const ScenePolygon& polygon) {
        const std::vector<double> lights = corner_lights(scene_, polygon, stage_);
        const auto corners = scene_.corners(polygon);
        const std::vector<glm::dvec2> points = outline_;
        const double light = std::accumulate(lights.begin(), lights.end(), 0.0) / static_cast<double>(lights.size());
        const bool is_even = std::all_of(corners.begin(), corners.end(), [&](const SceneCorner& corner) {
            return corner.colour == corners[0].colour;
        });
        overlap(polygon.inner_edges);
        fill(is_even ? corners[0].colour : polygon.colour, true, light);
        double size = 0;
        for (const glm::dvec2 point : points) size = std::max(size, glm::distance(point, points[0]));
        const auto [low, high] = std::minmax_element(lights.begin(), lights.end());
        const double steps = is_even ? (*high - *low) * shades : 8;
        const int parts = std::min({8, static_cast<int>(steps), static_cast<int>(size * step_ / least_part)});
        if (parts < 2) return;
        for (const auto& [a, b, c] : triangulate(scene_.vertices(polygon)).triangles) {
            draw_parts({points[a], points[b], points[c]}, {lights[a], lights[b], lights[c]},
                       {corners[a].colour, corners[b].colour, corners[c].colour}, parts);
        }
    }

    /// Widens the outline beyond edges that lie within a surface, so that the ground is not visible between its
    /// polygons.
    void overlap(std::uint32_t inner_edges) {
        const std::vector<glm::dvec2> points = outline_;
        double area = 0;
        const auto next = [&](std::size_t i) { return i + 1 < points.size() ? i + 1 : 0; };
        for (std::size_t i = 0; i < points.size(); ++i) {
            area += points[i].x * points[next(i)].y - points[i].y * points[next(i)].x;
        }
        for (std::size_t i = 0; i < std::min<std::size_t>(points.size(), 32); ++i) {
            const glm::dvec2 along = points[next(i)] - points[i];
            if ((inner_edges >> i & 1U) == 0 || !(glm::length(along) > 0)) continue;
            const glm::dvec2 out = glm::normalize(glm::dvec2(along.y, -along.x)) * (area < 0 ? -widening : widening);
            outline_[i] += out / step_;
            outline_[next(i)] += out / step_;
        }
    }

    /// Draws a triangle as parts^2 small ones, each in the light of its middle and the colour of the nearest corner.
    void draw_parts(const std::array<glm::dvec2, 3>& points, const std::array<double, 3>& lights,
                    const std::array<std::int32_t, 3>& colours, int parts) {
        const auto shares = [&](double p, double q) { return glm::dvec3(parts - p - q, p, q) / double(parts); };
        for (int i = 0; i < parts; ++i) {
            for (int k = 0; k < parts - i; ++k) {
                for (const bool is_upper : {false, true}) {
                    if (is_upper && i + k + 2 > parts) continue;
                    const double third = is_upper ? 2.0 / 3 : 1.0 / 3;
                    const glm::dvec3 middle = shares(i + third, k + third);
                    const auto add = [&](double p, double q) {
                        // Enlarged within the triangle, so that there are no gaps.
                        glm::dvec3 share = glm::max(middle + (shares(p, q) - middle) * 1.6, glm::dvec3(0.0));
                        share /= share.x + share.y + share.z;
                        outline_.push_back(points[0] * share.x + points[1] * share.y + points[2] * share.z);
                    };
                    if (is_upper) add(i + 1, k + 1);
                    add(i + 1, k);
                    if (!is_upper) add(i, k);
                    add(i, k + 1);
                    const int nearest = middle.x >= middle.y && middle.x >= middle.z ? 0
                                        : middle.y >= middle.z                       ? 1
                                                                                     : 2;
                    fill(colours[std::size_t(nearest)], true,
                         lights[0] * middle.x + lights[1] * middle.y + lights[2] * middle.z);
                }
            }
        }
    }

    void draw_sphere(const SceneSphere& sphere) {
        draw_ball(stage_.place(sphere.centre), stage_.radius(sphere), sphere.colour, true);
    }

    const Scene& scene_;
    Stage stage_;
    Shades shades_;
    PathSink& sink_;
    double step_;
    glm::dvec2 flat_light_;
    std::vector<glm::dvec2> outline_;
};

}  // namespace

Style with_shades(const Style& style) {
    Style result = style;
    const std::size_t colours = style.palette.size();
    for (int shade = 1; shade <= shades; ++shade) {
        for (const bool fills : {false, true}) {
            for (std::size_t i = 0; i < colours; ++i) {
                const Pen pen{.colour = static_cast<int>(i)};
                result.palette.push_back(lit(fills ? style.fill_colour(pen) : style.line_colour(pen),
                                             static_cast<double>(shade) / shades));
            }
        }
    }
    return result;
}

void draw_solids(const Scene& scene, const Print& print, PathSink& sink, const Monitor& monitor) {
    if (scene.surfaces().empty()) return Painter(scene, print, sink).draw(monitor);
    const double step = print.placement.step;
    const Scene divided = tessellated(scene, {.deviation = 0.15 / step, .side = longest_side / step}, monitor);
    Painter(divided, print, sink).draw(monitor);
}

SceneExtent extent_of(const Scene& scene, const Style& style, const glm::dmat3x2& orientation,
                      const Monitor& monitor) {
    Pulse pulse(monitor);
    SceneExtent extent;
    const Projection projection(style.camera, scene.bounds());
    const auto place = [&](const glm::vec3& point) {
        const glm::dvec3 seen = projection(scene.at(point));
        return orientation * glm::dvec3(seen.x, seen.y, 1.0);
    };
    for (const SceneSegment& segment : scene.segments()) {
        pulse();
        extent.box.add(place(segment.from));
        extent.box.add(place(segment.to));
        extent.widest = std::max({extent.widest,
                                  style.pen_width(segment.before.pen(0)) * projection.scale(scene.at(segment.from)),
                                  style.pen_width(segment.after.pen(0)) * projection.scale(scene.at(segment.to))});
    }
    for (const ScenePolygon& polygon : scene.polygons()) {
        for (const glm::vec3& vertex : scene.vertices(polygon)) extent.box.add(place(vertex));
    }
    each_divided_patch(
        scene, {.share = 1.0 / 2000},
        [&](int, std::span<const glm::vec3> points) {
            for (const glm::vec3& point : points) extent.box.add(place(point));
        },
        monitor);
    for (const SceneSphere& sphere : scene.spheres()) {
        const double scale = projection.scale(scene.at(sphere.centre));
        const glm::dvec2 at = place(sphere.centre);
        extent.box.add(at - sphere.radius * scale);
        extent.box.add(at + sphere.radius * scale);
        if (sphere.radius > 0) continue;
        extent.widest = std::max(extent.widest, 2 * style.pen_width(sphere.width.pen(0)) * scale);
    }
    return extent;
}

}  // namespace sikku
