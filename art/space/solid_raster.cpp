#include "art/space/solid_raster.h"

#include "art/space/lit_raster.h"
#include "art/space/scene_rendering.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <unordered_map>
#include <utility>
#include <vector>

namespace sikku {
namespace {

constexpr int samples = SceneBands::samples;

struct Sample {
    float depth = -std::numeric_limits<float>::infinity();
    Colour colour;
};

/// A point of a surface, in samples.
struct Corner {
    glm::dvec3 at;
    double brightness;
};

class Band : public SampleBand<Sample> {
public:
    using SampleBand::SampleBand;

    void triangle(const Corner& a, const Corner& b, const Corner& c, Colour colour) {
        shaded_triangle(a, b, c, [&](double, double, double light) { return lit(colour, light); });
    }

    /// Draws a triangle with a colour for each corner.
    void triangle(const Corner& a, const Corner& b, const Corner& c, const std::array<Colour, 3>& colours) {
        const glm::dvec2 ab(b.at - a.at), ac(c.at - a.at);
        const double area = ab.x * ac.y - ab.y * ac.x;
        shaded_triangle(a, b, c, [&](double dx, double dy, double light) {
            const double p = std::clamp((dx * ac.y - dy * ac.x) / area, 0.0, 1.0);
            const double q = std::clamp((dy * ab.x - dx * ab.y) / area, 0.0, 1.0 - p);
            return lit(blend(colours, {1 - p - q, p, q}), light);
        });
    }

    /// @param shade  returns the colour of a place relative to `a`, and the light there
    template <class Shade>
    void shaded_triangle(const Corner& a, const Corner& b, const Corner& c, Shade&& shade) {
        const glm::dvec3 ab = b.at - a.at, ac = c.at - a.at;
        const double area = ab.x * ac.y - ab.y * ac.x;
        if (!(std::fabs(area) > 1e-12)) return;
        const auto slope_x = [&](double p, double q) { return (p * ac.y - q * ab.y) / area; };
        const auto slope_y = [&](double p, double q) { return (q * ab.x - p * ac.x) / area; };
        const double lb = b.brightness - a.brightness, lc = c.brightness - a.brightness;
        const double depth_x = slope_x(ab.z, ac.z), depth_y = slope_y(ab.z, ac.z);
        const double light_x = slope_x(lb, lc), light_y = slope_y(lb, lc);
        const double darkest = std::min({a.brightness, b.brightness, c.brightness});
        const double brightest = std::max({a.brightness, b.brightness, c.brightness});
        each_run(a.at, b.at, c.at, [&](int y, Sample* row, int begin, int stop) {
            const double dx = begin + 0.5 - a.at.x, dy = y + 0.5 - a.at.y;
            double depth = a.at.z + dx * depth_x + dy * depth_y;
            double light = a.brightness + dx * light_x + dy * light_y;
            for (int x = begin; x < stop; ++x, depth += depth_x, light += light_x) {
                if (static_cast<float>(depth) > row[x].depth) {
                    row[x] = {static_cast<float>(depth),
                              shade(x + 0.5 - a.at.x, dy, std::clamp(light, darkest, brightest))};
                }
            }
        });
    }

    /// Draws everything within the outline, at the depth of its plane.
    void polygon(std::span<const glm::dvec3> outline, const glm::dvec3& normal, double light, Colour colour) {
        const Colour shaded = lit(colour, light);
        each_of_outline(outline, normal, [&](Sample& sample, float depth) {
            if (depth > sample.depth) sample = {depth, shaded};
        });
    }

    template <class Brightness>
    void sphere(const glm::dvec3& centre, double radius, Colour colour, Brightness&& brightness) {
        each_of_ball(centre, radius, [&](Sample& sample, const glm::dvec3& out) {
            const auto depth = static_cast<float>(centre.z + out.z);
            if (depth > sample.depth) sample = {depth, lit(colour, brightness(out))};
        });
    }

    void resolve(Colour ground, int channels, std::vector<std::uint8_t>& pixels) const {
        const int count_of_pixels = width() / samples;
        pixels.resize(std::size_t(count_of_pixels) * std::size_t(rows() / samples) * std::size_t(channels));
        std::uint8_t* out = pixels.data();
        constexpr std::uint32_t count = samples * samples;
        for (int y = 0; y < rows(); y += samples) {
            for (int x = 0; x < width(); x += samples, out += channels) {
                std::uint32_t red = 0, green = 0, blue = 0, alpha = 0;
                for (int i = 0; i < samples; ++i) {
                    const Sample* const in = row(y + i).data() + x;
                    for (int j = 0; j < samples; ++j) {
                        const Colour colour =
                            in[j].depth < -std::numeric_limits<float>::max() ? ground : over(in[j].colour, ground);
                        red += colour.red * std::uint32_t{colour.alpha};
                        green += colour.green * std::uint32_t{colour.alpha};
                        blue += colour.blue * std::uint32_t{colour.alpha};
                        alpha += colour.alpha;
                    }
                }
                const auto mean = [&](std::uint32_t sum) {
                    return static_cast<std::uint8_t>(alpha == 0 ? 0 : (sum + alpha / 2) / alpha);
                };
                out[0] = alpha == 0 ? ground.red : mean(red);
                if (channels == 1) continue;
                out[1] = alpha == 0 ? ground.green : mean(green);
                out[2] = alpha == 0 ? ground.blue : mean(blue);
                if (channels == 4) out[3] = static_cast<std::uint8_t>((alpha + count / 2) / count);
            }
        }
    }

private:
    static Colour blend(const std::array<Colour, 3>& colours, const std::array<double, 3>& shares) {
        const auto channel = [&](std::uint8_t Colour::*which) {
            double sum = 0;
            for (std::size_t i = 0; i < 3; ++i) sum += shares[i] * colours[i].*which;
            return static_cast<std::uint8_t>(std::lround(sum));
        };
        return {channel(&Colour::red), channel(&Colour::green), channel(&Colour::blue), channel(&Colour::alpha)};
    }
    static Colour over(Colour upper, Colour ground) {
        if (upper.alpha == 255 || ground.alpha < 255) return upper;
        const auto mixed = [&](std::uint8_t u, std::uint8_t g) {
            return static_cast<std::uint8_t>((u * upper.alpha + g * (255 - upper.alpha) + 127) / 255);
        };
        return {mixed(upper.red, ground.red), mixed(upper.green, ground.green), mixed(upper.blue, ground.blue), 255};
    }
};

class SolidRaster final : public SceneRendering<Band> {
public:
    SolidRaster(const Scene& scene, const Print& print)
        : SceneRendering(scene, print, 1.0, {.deviation = fine_deviation(print)}) {
        note_channels();
    }

    int channels() const override { return channels_; }

private:
    void note_channels() {
        bool has_alpha = ground_.alpha < 255;
        bool is_grey = ground_.red == ground_.green && ground_.green == ground_.blue;
        std::vector<char> lines(line_colours_.size(), 0), fills(fill_colours_.size(), 0);
        for (const SceneSegment& segment : scene_.segments()) lines[std::size_t(segment.colour)] = 1;
        for (const ScenePolygon& polygon : scene_.polygons()) {
            fills[std::size_t(polygon.colour)] = 1;
            for (const SceneCorner& corner : scene_.corners(polygon)) fills[std::size_t(corner.colour)] = 1;
        }
        for (const SceneSphere& sphere : scene_.spheres()) fills[std::size_t(sphere.colour)] = 1;
        const auto note = [&](const std::vector<char>& used, const std::vector<Colour>& colours) {
            for (std::size_t i = 0; i < used.size(); ++i) {
                if (used[i])
                    is_grey = is_grey && colours[i].red == colours[i].green && colours[i].green == colours[i].blue;
            }
        };
        note(lines, line_colours_);
        note(fills, fill_colours_);
        channels_ = has_alpha ? 4 : is_grey ? 1 : 3;
    }

    void resolve(const Band& band, int channels, std::vector<std::uint8_t>& pixels) const override {
        band.resolve(ground_, channels, pixels);
    }

    void draw_sphere(Band& band, const SceneSphere& sphere) const override {
        draw_sphere(band, stage_.place(sphere.centre), bands_.radius(sphere),
                    fill_colours_[std::size_t(sphere.colour)]);
    }
    void draw_sphere(Band& band, const glm::dvec3& centre, double radius, Colour colour) const {
        band.sphere(centre, radius, colour, [this](const glm::dvec3& normal) {
            return stage_.brightness(normal.z > 0 ? normal : normal + glm::dvec3(0, 0, 1e-9));
        });
    }

    void draw_stem(Band& band, std::size_t index) const override {
        const SceneSegment& segment = scene_.segments()[index];
        const Colour colour = line_colours_[std::size_t(segment.colour)];
        const glm::dvec3 from = stage_.place(segment.from), to = stage_.place(segment.to);
        const double before = bands_.radius(segment.before, segment.from);
        const double after = bands_.radius(segment.after, segment.to);
        const double thickest = std::max(before, after);
        // Under a pixel and a half the shape of an end is invisible.
        const bool has_ends = thickest > 0.75 * samples;
        const glm::dvec3 along = to - from;
        const double length = glm::length(along);
        const double flat = std::hypot(along.x, along.y);
        if (has_ends || flat < 1) {
            draw_sphere(band, to, after, colour);
            if (!segment.goes_on) draw_sphere(band, from, before, colour);
        }
        if (!(flat > 0) || !(length > 0)) return;
        const glm::dvec3 ahead = along / length;
        const glm::dvec3 across(-along.y / flat, along.x / flat, 0);
        const glm::dvec3 facing = glm::cross(across, ahead);  // towards the eye, as across lies in the page
        const glm::dvec3 front = facing.z < 0 ? -facing : facing;
        if (!has_ends) {
            const double light = stage_.brightness(front);
            const Corner a{from + across * before, light}, b{from - across * before, light};
            const Corner c{to - across * after, light}, d{to + across * after, light};
            band.triangle(a, b, c, colour);
            band.triangle(a, c, d, colour);
            return;
        }
        // The half that faces the eye.
        const int sides = std::clamp(static_cast<int>(4 + 2 * std::sqrt(thickest)), 6, 48);
        const glm::dvec3 slope = ahead * ((before - after) / length);
        Corner last_from, last_to;
        for (int i = 0; i <= sides; ++i) {
            const double angle = std::numbers::pi * i / sides;
            const glm::dvec3 out = across * std::cos(angle) + front * std::sin(angle);
            const double light = stage_.brightness(out + slope);
            const Corner at_from{from + out * before, light}, at_to{to + out * after, light};
            if (i > 0) {
                band.triangle(last_from, at_from, at_to, colour);
                band.triangle(last_from, at_to, last_to, colour);
            }
            last_from = at_from;
            last_to = at_to;
        }
    }

    void draw_polygon(Band& band, const ScenePolygon& polygon) const override {
        std::vector<glm::vec3> flat;
        std::vector<glm::dvec3> placed;
        for (const glm::vec3& vertex : scene_.vertices(polygon)) {
            placed.push_back(stage_.place(vertex));
            flat.emplace_back(placed.back() - placed.front());
        }
        glm::dvec3 normal = area_normal(flat);
        if (normal.z < 0) normal = -normal;
        if (!(glm::length(normal) > 0)) return;
        const double light = stage_.brightness(normal);
        const Colour colour = fill_colours_[std::size_t(polygon.colour)];
        Triangulation own;
        const Triangulation& parts = triangles_of(polygon, flat, own);
        if (!parts.is_whole) return band.polygon(placed, normal, light, colour);
        if (polygon.corners) return draw_smooth(band, polygon, placed, parts);
        for (const auto& [a, b, c] : parts.triangles) {
            band.triangle({placed[a], light}, {placed[b], light}, {placed[c], light}, colour);
        }
    }

    /// Draws a polygon with the light and the colours of its corners.
    void draw_smooth(Band& band, const ScenePolygon& polygon, std::span<const glm::dvec3> placed,
                     const Triangulation& parts) const {
        const std::vector<double> lights = corner_lights(scene_, polygon, stage_);
        const auto corners = scene_.corners(polygon);
        const auto colour = [&](std::uint32_t i) { return fill_colours_[std::size_t(corners[i].colour)]; };
        for (const auto& [a, b, c] : parts.triangles) {
            const Corner at_a{placed[a], lights[a]}, at_b{placed[b], lights[b]}, at_c{placed[c], lights[c]};
            if (colour(a) == colour(b) && colour(b) == colour(c)) {
                band.triangle(at_a, at_b, at_c, colour(a));
            } else {
                band.triangle(at_a, at_b, at_c, std::array{colour(a), colour(b), colour(c)});
            }
        }
    }

    int channels_ = 3;
};

}  // namespace

std::unique_ptr<Rendering> make_solid_raster(const Scene& scene, const Print& print) {
    if (!print.style.light.is_flat) return make_lit_raster(scene, print);
    return std::make_unique<SolidRaster>(scene, print);
}

}  // namespace sikku
