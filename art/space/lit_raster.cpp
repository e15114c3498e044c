#include "art/space/lit_raster.h"

#include "art/space/daylight.h"
#include "art/space/scene_rendering.h"
#include "engine/base/bits.h"

#include <glm/common.hpp>
#include <glm/exponential.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <mutex>
#include <numbers>
#include <optional>
#include <unordered_map>
#include <utility>
#include <vector>

namespace sikku {
namespace {

constexpr int samples = SceneBands::samples;
constexpr double collar = 1.7;          // widest collar of a stem, in its own radii
constexpr double sharpest_joint = 0.3;  // cosine of the sharpest turn that a stem makes smoothly
constexpr float through = 0.55F;        // share of the light from behind that thin surfaces show
constexpr std::uint32_t none = UINT32_MAX;

// --- colours in linear light ---------------------------------------------------------------------------------

float to_linear(float value) {
    value /= 255;
    return value <= 0.04045F ? value / 12.92F : std::pow((value + 0.055F) / 1.055F, 2.4F);
}

/// The inverse, from a table of where each byte begins.
class LinearBytes {
public:
    LinearBytes() {
        for (std::size_t i = 0; i < begins_.size(); ++i) begins_[i] = to_linear(static_cast<float>(i) - 0.5F);
        std::size_t byte = 0;
        for (std::size_t i = 0; i < lowest_.size(); ++i) {
            while (byte < 255 && begins_[byte + 1] * float{cells} <= static_cast<float>(i)) ++byte;
            lowest_[i] = static_cast<std::uint8_t>(byte);
        }
    }
    std::uint8_t operator()(float value) const {
        std::size_t byte =
            lowest_[static_cast<std::size_t>((value > 0 ? std::min(value, 1.0F) : 0.0F) * float{cells})];
        while (byte < 255 && value >= begins_[byte + 1]) ++byte;
        return static_cast<std::uint8_t>(byte);
    }

private:
    static constexpr int cells = 4096;
    std::array<float, 256> begins_{};
    std::array<std::uint8_t, cells + 1> lowest_{};  ///< byte at the beginning of each cell
};

std::uint8_t from_linear(float value) {
    static const LinearBytes bytes;
    return bytes(value);
}

/// Compresses bright light instead of cutting it off; light beyond white makes a colour paler.
glm::vec3 compressed(const glm::vec3& colour) {
    constexpr float knee = 0.75F;
    glm::vec3 result = colour;
    float beyond = 0;
    for (int i = 0; i < 3; ++i) {
        if (colour[i] <= knee) continue;
        result[i] = knee + (1 - knee) * (1 - std::exp((knee - colour[i]) / (1 - knee)));
        beyond += colour[i] - result[i];
    }
    return glm::min(result + 0.12F * beyond, glm::vec3(1.0F));
}

/// Linear values of 0 to 255, and one more for interpolation.
const std::array<float, 257>& linear_values() {
    static const std::array<float, 257> values = [] {
        std::array<float, 257> result{};
        for (std::size_t i = 0; i < result.size(); ++i) result[i] = to_linear(static_cast<float>(i));
        return result;
    }();
    return values;
}

/// The linear value of a colour whose channels are from 0 to 255.
glm::vec3 linear(const glm::vec3& colour) {
    const auto& values = linear_values();
    const auto channel = [&](float value) {
        value = value > 0 ? std::min(value, 255.0F) : 0.0F;
        const auto below = static_cast<std::size_t>(value);
        return glm::mix(values[below], values[below + 1], value - static_cast<float>(below));
    };
    return {channel(colour.x), channel(colour.y), channel(colour.z)};
}

glm::vec3 channels_of(Colour colour) {
    return {colour.red, colour.green, colour.blue};
}

// --- samples ---------------------------------------------------------------------------------------------------

/// The surface nearest to the eye.
struct Sample {
    float depth = -std::numeric_limits<float>::infinity();
    std::uint32_t facet = 0;  ///< index in the band
    bool is_covered() const { return depth > -std::numeric_limits<float>::max(); }
};

/// A point of a surface: its place in samples, its normal in the scene, its colour from 0 to 255.
struct Corner {
    glm::dvec3 at;
    glm::vec3 normal;
    glm::vec3 colour;
};

struct Material {
    std::uint8_t alpha = 255;
    bool is_thin = false;  ///< a polygon that lets light through, like a leaf
};

/// The normal and colour of a triangle, a flat polygon or a ball at each place.
struct Facet {
    glm::dvec2 at;                       ///< place of a corner, or the middle of a ball, in samples
    glm::vec2 to_b{0.0F}, to_c{0.0F};    ///< gradients of the shares of the corners b and c
    std::array<glm::vec3, 3> normals{};  ///< at the corner, and by how much the other two differ
    std::array<glm::vec3, 3> colours{};  ///< likewise, from 0 to 255
    float radius = 0;                    ///< of a ball, in samples, or 0
    Material material;

    /// The share of the corner b in x and that of c in y.
    glm::vec2 shares(const glm::dvec2& place) const {
        const glm::vec2 away(place - at);
        const float b = std::clamp(away.x * to_b.x + away.y * to_b.y, 0.0F, 1.0F);
        return {b, std::clamp(away.x * to_c.x + away.y * to_c.y, 0.0F, 1.0F - b)};
    }
    static glm::vec3 mixed(const std::array<glm::vec3, 3>& values, const glm::vec2& shares) {
        return values[0] + shares.x * values[1] + shares.y * values[2];
    }
};

/// The nearest facets of some rows. Normals and colours are computed when the rows are complete, once for a pixel
/// instead of for each of its samples.
class Band : public SampleBand<Sample> {
public:
    using SampleBand::SampleBand;

    void begin(int top, int rows) {
        SampleBand::begin(top, rows);
        facets_.clear();
    }
    const Facet& facet(std::uint32_t number) const { return facets_[number]; }

    void triangle(const Corner& a, const Corner& b, const Corner& c, const Material& material) {
        const glm::dvec3 ab = b.at - a.at, ac = c.at - a.at;
        const double area = ab.x * ac.y - ab.y * ac.x;
        if (!(std::fabs(area) > 1e-12)) return;
        const double slope_x = (ab.z * ac.y - ac.z * ab.y) / area, slope_y = (ac.z * ab.x - ab.z * ac.x) / area;
        const auto farthest = static_cast<float>(std::min({a.at.z, b.at.z, c.at.z}));
        const auto nearest = static_cast<float>(std::max({a.at.z, b.at.z, c.at.z}));
        const std::uint32_t own = next();
        bool is_seen = false;
        each_run(a.at, b.at, c.at, [&](int y, Sample* row, int begin, int stop) {
            const double start = a.at.z + (y + 0.5 - a.at.y) * slope_y + (0.5 - a.at.x) * slope_x;
            for (int x = begin; x < stop; ++x) {
                const float depth = std::clamp(static_cast<float>(start + x * slope_x), farthest, nearest);
                if (!(depth > row[x].depth)) continue;
                row[x] = {depth, own};
                is_seen = true;
            }
        });
        if (!is_seen) return;
        facets_.push_back({.at = glm::dvec2(a.at),
                           .to_b = glm::vec2(glm::dvec2(ac.y, -ac.x) / area),
                           .to_c = glm::vec2(glm::dvec2(-ab.y, ab.x) / area),
                           .normals = {a.normal, b.normal - a.normal, c.normal - a.normal},
                           .colours = {a.colour, b.colour - a.colour, c.colour - a.colour},
                           .material = material});
    }

    /// A flat polygon that may cross itself. @param seen  its normal on the page
    void polygon(std::span<const glm::dvec3> outline, const glm::dvec3& seen, const Corner& like,
                 const Material& material) {
        const std::uint32_t own = next();
        bool is_seen = false;
        each_of_outline(outline, seen, [&](Sample& sample, float depth) {
            if (!(depth > sample.depth)) return;
            sample = {depth, own};
            is_seen = true;
        });
        if (!is_seen) return;
        facets_.push_back(
            {.at = glm::dvec2(like.at), .normals = {like.normal}, .colours = {like.colour}, .material = material});
    }

    /// @param depth  returns the depth of an outward direction on the page
    template <class Depth>
    void sphere(const glm::dvec3& centre, double radius, const glm::vec3& colour, const Material& material,
                Depth&& depth) {
        const std::uint32_t own = next();
        bool is_seen = false;
        each_of_ball(centre, radius, [&](Sample& sample, const glm::dvec3& out) {
            const float height = depth(out);
            if (!(height > sample.depth)) return;
            sample = {height, own};
            is_seen = true;
        });
        if (!is_seen) return;
        facets_.push_back({.at = glm::dvec2(centre),
                           .colours = {colour},
                           .radius = static_cast<float>(radius),
                           .material = material});
    }

private:
    std::uint32_t next() const { return static_cast<std::uint32_t>(facets_.size()); }

    std::vector<Facet> facets_;  ///< also those that nearer ones hide
};

constexpr int most_block = 2;           // pixels, each way, that are lit together …
constexpr double fine_dpi = 200;        // … from this resolution on …
constexpr double fine_drawing = 2'048;  // … or in drawings of more pixels, which are finer than the maps
constexpr int tile_width = 32;          // pixels; a multiple of the blocks

/// Samples of a block of pixels that lie on one surface and are lit together.
struct LitPart {
    /// The share of a pixel of the block.
    struct Share {
        glm::vec3 colour{0.0F};  ///< sum over its samples, linear
        int count = 0;
        int alpha = 0;  ///< sum
    };
    glm::dvec3 at{0.0};  ///< sums over all samples
    glm::vec3 normal{0.0F};
    float depth = 0;  ///< depth of the first sample
    int count = 0;
    bool is_thin = false;
    std::array<Share, most_block * most_block> shares{};

    /// @param alike  least cosine of the angle to the normal
    bool takes(bool thin, float its_depth, const glm::vec3& its_normal, float alike) const {
        constexpr float near = 3 * samples;
        const float cosine = glm::dot(its_normal, normal);  // times the length of the sum
        return is_thin == thin && std::fabs(its_depth - depth) < near && cosine > 0 &&
               cosine * cosine > alike * alike * glm::dot(normal, normal);
    }
};

/// The samples of a pixel in which a facet is seen.
struct SeenFacet {
    std::uint32_t facet;
    int count = 0, x = 0, y = 0;  ///< sums of columns and rows, from the first of the pixel
    float depth = 0;              ///< sum
};

/// A pseudorandom number from 0 to 1, evenly distributed.
float scattered(std::uint32_t number) {
    std::uint64_t hash = (number + 1ULL) * 0x9e3779b97f4a7c15U;
    hash = (hash ^ hash >> 32) * 0xd6e8feb86659fd93U;
    return static_cast<float>(hash >> 40) / 16777216.0F;
}

class LitRaster final : public SceneRendering<Band> {
public:
    LitRaster(const Scene& scene, const Print& print)
        : SceneRendering(scene, print, collar, {.deviation = fine_deviation(print), .is_measured = true}),
          step_(print.placement.step),
          block_(print.dpi < fine_dpi && pixels(scene, print) <= fine_drawing ? 1 : most_block),
          linear_ground_(linear(channels_of(ground_))),
          daylight_(scene, print.style, print.placement.step, pixels(scene, print)) {
        find_bearers();
        level_ground_ = level_ground();
    }

    int channels() const override { return ground_.alpha < 255 ? 4 : 3; }

private:
    static double pixels(const Scene& scene, const Print& print) {
        const glm::dvec3 size = scene.bounds().high - scene.bounds().low;
        return std::max({size.x, size.y, size.z}) * print.placement.step * print.dpi / 25.4;
    }

    void prepare(int threads) const override {
        std::call_once(is_lit_, [&] { daylight_.build(threads, watch_); });
    }

    /// Finds for each segment the one that ends at its beginning: the one that it continues or is attached to.
    void find_bearers() {
        const auto& segments = scene_.segments();
        bearers_.assign(segments.size(), none);
        const auto number = [](const glm::vec3& point) {
            std::uint64_t hash = 0;
            for (int axis = 0; axis < 3; ++axis) {
                hash = (hash ^ bit_cast<std::uint32_t>(point[axis] + 0.0F)) * 0x9e3779b97f4a7c15U;
                hash ^= hash >> 29;
            }
            return hash;
        };
        std::unordered_map<std::uint64_t, std::uint32_t> ends;
        for (std::size_t i = 0; i < segments.size(); ++i) {
            if (i > 0 && segments[i].goes_on) {
                bearers_[i] = static_cast<std::uint32_t>(i - 1);
            } else if (const auto found = ends.find(number(segments[i].from)); found != ends.end()) {
                bearers_[i] = found->second;
            }
            ends.try_emplace(number(segments[i].to), static_cast<std::uint32_t>(i));
        }
    }

    // --- drawing -------------------------------------------------------------------------------------------

    void draw_sphere(Band& band, const SceneSphere& sphere) const override {
        const Colour colour = fill_colours_[std::size_t(sphere.colour)];
        draw_sphere(band, stage_.place(sphere.centre), bands_.radius(sphere), channels_of(colour), {colour.alpha});
    }

    void draw_sphere(Band& band, const glm::dvec3& centre, double radius, const glm::vec3& colour,
                     const Material& material) const {
        if (!style_.camera.distance) {
            return band.sphere(centre, radius, colour, material,
                               [&](const glm::dvec3& seen) { return static_cast<float>(centre.z + seen.z); });
        }
        const glm::dvec3 middle = stage_.point(centre);
        const double reach = glm::distance(middle, stage_.point(centre + glm::dvec3(radius, 0, 0)));
        band.sphere(centre, radius, colour, material, [&](const glm::dvec3& seen) {
            // The depth of that place of the ball in perspective.
            const glm::dvec3 normal = glm::normalize(stage_.direction_back(seen));
            return static_cast<float>(stage_.place(glm::vec3(middle + normal * reach)).z);
        });
    }

    // --- stems

    static glm::dvec3 direction(const SceneSegment& segment) {
        const glm::dvec3 along = glm::dvec3(segment.to) - glm::dvec3(segment.from);
        const double length = glm::length(along);
        return length > 0 ? along / length : glm::dvec3(0.0);
    }
    double radius_in_steps(const SceneWidth& width) const {
        return style_.line_width(width.pen(0), step_) / step_ / 2;
    }

    /// The half of a ring around a stem that faces the eye.
    struct Ring {
        glm::dvec3 at;  ///< in steps, from the scene's origin
        glm::dvec3 tangent;
        double radius;  ///< in steps
        double slope;   ///< by how much the stem narrows for each step along it
        glm::vec3 colour;
    };

    void draw_stem(Band& band, std::size_t index) const override {
        const auto& segments = scene_.segments();
        const SceneSegment& segment = segments[index];
        const Colour own = line_colours_[std::size_t(segment.colour)];
        const Material material{own.alpha};
        const glm::vec3 colour = channels_of(own);
        const double seen_before = bands_.radius(segment.before, segment.from);
        const double seen_after = bands_.radius(segment.after, segment.to);
        const glm::dvec3 ahead = direction(segment);
        if (glm::length(ahead) == 0) return draw_sphere(band, stage_.place(segment.to), seen_after, colour, material);
        // Stems under a sample are widened, as they would be lost.
        const double before = widened(segment.before, segment.from), after = widened(segment.after, segment.to);
        const bool has_ends = std::max(seen_before, seen_after) > 0.75 * samples;
        const std::uint32_t bearer = bearers_[index];
        const bool goes_on = index + 1 < segments.size() && segments[index + 1].goes_on;
        Ring first{segment.from, ahead, before, 0, colour}, last{segment.to, ahead, after, 0, colour};
        if (bearer != none) {
            const SceneSegment& below = segments[bearer];
            const double thick = widened(below.after, below.to);
            const glm::dvec3 came = direction(below);
            const bool is_same_stem = before > 0.7 * thick;
            if (is_same_stem && glm::dot(came, ahead) > sharpest_joint) {
                first.tangent = glm::normalize(came + ahead);
            } else if (has_ends) {
                draw_sphere(band, stage_.place(segment.from), seen_before, colour, material);
            }
            if (is_same_stem) first.colour = channels_of(line_colours_[std::size_t(below.colour)]);
            if (!is_same_stem && has_ends) return draw_collared(band, first, last, thick, material);
        } else if (has_ends) {
            draw_cut(band, first, material);
        }
        if (goes_on) {
            const glm::dvec3 next = direction(segments[index + 1]);
            if (glm::dot(next, ahead) > sharpest_joint) last.tangent = glm::normalize(next + ahead);
        }
        if (has_ends && (!goes_on || last.tangent == ahead)) {
            draw_sphere(band, stage_.place(segment.to), seen_after, colour, material);
        }
        first.slope = last.slope = (before - after) / glm::distance(first.at, last.at);
        draw_tube(band, first, last, material);
    }

    double widened(const SceneWidth& width, const glm::vec3& at) const {
        const double seen = stage_.radius(width, at);
        return radius_in_steps(width) * std::max(1.0, 0.5 / std::max(seen, 1e-9));
    }

    /// A stem that widens towards a thicker one, whose radius is `thick`.
    void draw_collared(Band& band, const Ring& first, const Ring& last, double thick,
                       const Material& material) const {
        constexpr int parts = 4;
        const double length = glm::distance(first.at, last.at);
        const double reach = std::min(0.6 * length, thick + 2 * first.radius);
        const double wide = std::min(collar * first.radius, thick);
        const auto ring = [&](double at) {
            const double left = 1 - at / reach;
            const double share = at / length;
            const double straight = first.radius + (last.radius - first.radius) * share;
            const double narrows = 2 * (wide - first.radius) * left / reach + (first.radius - last.radius) / length;
            return Ring{first.at + first.tangent * at, first.tangent, straight + (wide - first.radius) * left * left,
                        narrows, first.colour};
        };
        Ring here = ring(0);
        for (int i = 1; i <= parts; ++i) {
            const Ring next = ring(reach * i / parts);
            draw_tube(band, here, next, material);
            here = next;
        }
        Ring end = last;
        end.slope = here.slope = (first.radius - last.radius) / length;
        draw_tube(band, here, end, material);
        draw_sphere(band, stage_.place(glm::vec3(last.at)), last.radius / first.radius * seen_radius(first),
                    last.colour, material);
    }
    double seen_radius(const Ring& ring) const {
        const glm::dvec3 eye = stage_.to_eye(glm::vec3(ring.at));
        const glm::dvec3 across = across_of(ring.tangent, eye);
        return glm::distance(stage_.place(glm::vec3(ring.at)),
                             stage_.place(glm::vec3(ring.at + across * ring.radius)));
    }

    static glm::dvec3 across_of(const glm::dvec3& tangent, const glm::dvec3& eye) {
        const glm::dvec3 across = glm::cross(tangent, eye);
        const double length = glm::length(across);
        if (length > 1e-6) return across / length;
        return glm::normalize(glm::cross(tangent, glm::dvec3(eye.y, eye.z, eye.x) + glm::dvec3(0, 0.1, 0)));
    }

    void draw_tube(Band& band, const Ring& from, const Ring& to, const Material& material) const {
        const double thickest = std::max(seen_radius(from), seen_radius(to));
        const int sides = std::clamp(static_cast<int>(2 + 2 * std::sqrt(thickest)), 3, 48);
        const glm::dvec3 eye = stage_.to_eye(glm::vec3((from.at + to.at) / 2.0));
        const auto corner = [&](const Ring& ring, double angle) {
            const glm::dvec3 across = across_of(ring.tangent, eye);
            const glm::dvec3 out = across * std::cos(angle) + glm::cross(across, ring.tangent) * std::sin(angle);
            return Corner{stage_.place(glm::vec3(ring.at + out * ring.radius)),
                          glm::vec3(glm::normalize(out + ring.tangent * ring.slope)), ring.colour};
        };
        Corner left = corner(from, 0), left_on = corner(to, 0);
        for (int i = 1; i <= sides; ++i) {
            const double angle = std::numbers::pi * i / sides;
            const Corner right = corner(from, angle), right_on = corner(to, angle);
            band.triangle(left, right, right_on, material);
            band.triangle(left, right_on, left_on, material);
            left = right;
            left_on = right_on;
        }
    }

    /// The flat end of a stem that is not attached.
    void draw_cut(Band& band, const Ring& ring, const Material& material) const {
        const glm::dvec3 eye = stage_.to_eye(glm::vec3(ring.at));
        if (glm::dot(eye, ring.tangent) >= 0) return;
        const glm::dvec3 across = across_of(ring.tangent, eye), up = glm::cross(across, ring.tangent);
        const glm::vec3 normal(-ring.tangent);
        constexpr int sides = 24;
        const auto corner = [&](int i) {
            const double angle = 2 * std::numbers::pi * i / sides;
            const glm::dvec3 out = across * std::cos(angle) + up * std::sin(angle);
            return Corner{stage_.place(glm::vec3(ring.at + out * ring.radius)), normal, ring.colour};
        };
        const Corner middle{stage_.place(glm::vec3(ring.at)), normal, ring.colour};
        for (int i = 0; i < sides; ++i) band.triangle(middle, corner(i), corner(i + 1), material);
    }

    // --- polygons

    void draw_polygon(Band& band, const ScenePolygon& polygon) const override {
        const auto vertices = scene_.vertices(polygon);
        const glm::dvec3 area = area_normal(vertices);
        if (!(glm::length(area) > 0)) return;
        const glm::dvec3 eye = stage_.to_eye(vertices.front());
        const float side = glm::dot(area, eye) < 0 ? -1.0F : 1.0F;
        const glm::vec3 flat = glm::vec3(glm::normalize(area)) * side;
        const auto corners = scene_.corners(polygon);
        std::vector<Corner> placed;
        for (std::size_t i = 0; i < vertices.size(); ++i) {
            const int slot = corners.empty() ? polygon.colour : corners[i].colour;
            const Colour colour = fill_colours_[std::size_t(slot)];
            glm::vec3 normal = corners.empty() ? flat : corners[i].normal * side;
            // Parts that curve away from the eye are lit like the rim.
            if (const auto facing = glm::dot(normal, glm::vec3(eye)); facing < 0.05F) {
                normal = glm::normalize(normal + glm::vec3(eye) * (0.05F - facing));
            }
            placed.push_back({stage_.place(vertices[i]), normal,
                              channels_of(colour) * tone(polygon.organ, corners.empty() ? 0.5F : corners[i].along)});
        }
        const Material material{fill_colours_[std::size_t(polygon.colour)].alpha, true};
        Triangulation own;
        const Triangulation& parts = triangles_of(polygon, vertices, own);
        if (!parts.is_whole) {
            std::vector<glm::dvec3> outline;
            std::vector<glm::vec3> seen;
            for (const Corner& corner : placed) {
                outline.push_back(corner.at);
                seen.emplace_back(corner.at - placed.front().at);
            }
            Corner like = placed.front();
            like.normal = flat;
            const glm::dvec3 normal = area_normal(seen);
            return normal.z == 0 ? void() : band.polygon(outline, normal, like, material);
        }
        for (const auto& [a, b, c] : parts.triangles) {
            band.triangle(placed[a], placed[b], placed[c], material);
        }
    }

    /// Leaves differ a little, and are lighter towards their tips.
    static glm::vec3 tone(std::uint32_t organ, float along) {
        if (organ == 0) return glm::vec3(1.0F);
        const float light = 1 + 0.14F * (scattered(2 * organ) - 0.5F) + 0.12F * (along - 0.5F);
        const float warm = 0.10F * (scattered(2 * organ + 1) - 0.5F);
        return light * glm::vec3(1 + warm, 1 + 0.2F * warm, 1 - warm);
    }

    // --- light

    class GroundRows;

    /// Neighbouring pixels; their samples that lie on one surface are lit together.
    struct Block {
        int left = 0, top = 0, right = 0, bottom = 0;  ///< within the tile
        std::size_t first = 0, end = 0;                ///< its parts
    };

    /// Blocks that are lit together, so that neighbours look up the same parts of the maps.
    struct Tile {
        int left = 0, width = 0, rows = 0;  ///< pixels, from the first row of the band
        std::vector<Block> blocks;
        std::vector<LitPart> parts;  ///< by blocks
        std::vector<int> bare;       ///< samples of each pixel that show the ground
        LitPlaces places;
        std::vector<Daylight::OnSurface> lights;  ///< of the parts
        int& bare_at(int x, int y) { return bare[std::size_t(y * width + x)]; }
        int bare_at(int x, int y) const { return bare[std::size_t(y * width + x)]; }
    };

    void resolve(const Band& band, int channels, std::vector<std::uint8_t>& pixels) const override {
        const int width = size_.width, rows = band.rows() / samples, top = band.top() / samples;
        pixels.resize(std::size_t(width) * std::size_t(rows) * std::size_t(channels));
        GroundRows ground(*this, top);
        Tile tile;
        for (int left = 0; left < width; left += tile_width) {
            tile.left = left;
            tile.width = std::min(tile_width, width - left);
            tile.rows = rows;
            collect(band, tile);
            light(tile, ground);
            write(tile, ground, channels, pixels);
        }
    }

    void collect(const Band& band, Tile& tile) const {
        tile.parts.clear();
        tile.blocks.clear();
        tile.bare.resize(std::size_t(tile.width) * std::size_t(tile.rows));
        for (int top = 0; top < tile.rows; top += block_) {
            for (int left = 0; left < tile.width; left += block_) {
                Block block{left, top, std::min(left + block_, tile.width), std::min(top + block_, tile.rows),
                            tile.parts.size()};
                each_pixel(block, [&](std::size_t pixel, int x, int y) {
                    tile.bare_at(x, y) = collect(band, tile.left + x, y, pixel, block.first, tile.parts);
                });
                block.end = tile.parts.size();
                tile.blocks.push_back(block);
            }
        }
    }

    void light(Tile& tile, GroundRows& ground) const {
        tile.places.clear();
        for (const LitPart& part : tile.parts) {
            const glm::vec3 point(stage_.point(part.at / double(part.count)));
            const float length = glm::length(part.normal);
            tile.places.add(point, length > 0 ? part.normal / length : glm::vec3(stage_.to_eye(point)), part.is_thin);
        }
        daylight_.on_surfaces(tile.places, tile.lights);
        ground.light(tile);
    }

    /// The pixels of a block, with their places in the tile.
    template <class Visit>
    static void each_pixel(const Block& block, Visit&& visit) {
        std::size_t pixel = 0;
        for (int y = block.top; y < block.bottom; ++y) {
            for (int x = block.left; x < block.right; ++x) visit(pixel++, x, y);
        }
    }

    void write(const Tile& tile, const GroundRows& ground, int channels, std::vector<std::uint8_t>& pixels) const {
        for (std::size_t i = 0; i < tile.blocks.size(); ++i) {
            const Block& block = tile.blocks[i];
            const auto parts = std::span(tile.parts).subspan(block.first, block.end - block.first);
            const auto lights = std::span(tile.lights).subspan(block.first, block.end - block.first);
            each_pixel(block, [&](std::size_t pixel, int x, int y) {
                write(
                    parts, lights, pixel, tile.bare_at(x, y), [&] { return ground.at(i, x, y); }, channels,
                    pixels.data() + (std::size_t(y) * std::size_t(size_.width) + std::size_t(tile.left + x)) *
                                        std::size_t(channels));
            });
        }
    }

    /// Gathers the samples of a pixel of a block; returns the number of those that show the ground.
    /// @param first  first part of the block
    int collect(const Band& band, int column, int line, std::size_t pixel, std::size_t first,
                std::vector<LitPart>& parts) const {
        if (!band.is_touched(column * samples, line * samples)) return samples * samples;
        std::array<SeenFacet, samples * samples> seen;
        std::size_t count = 0;
        int bare = 0;
        for (int y = 0; y < samples; ++y) {
            const Sample* const row = band.row(line * samples + y).data() + column * samples;
            for (int x = 0; x < samples; ++x) {
                const Sample& sample = row[x];
                if (!sample.is_covered()) {
                    ++bare;
                    continue;
                }
                std::size_t i = count;
                while (i > 0 && seen[i - 1].facet != sample.facet) --i;
                if (i == 0) {
                    seen[count] = {.facet = sample.facet};
                    i = ++count;
                }
                SeenFacet& facet = seen[i - 1];
                ++facet.count;
                facet.x += x;
                facet.y += y;
                facet.depth += sample.depth;
            }
        }
        const glm::dvec2 corner(column * samples, band.top() + line * samples);
        for (const SeenFacet& facet : std::span(seen).first(count)) {
            add(band.facet(facet.facet), facet, corner, pixel, first, parts);
        }
        return bare;
    }

    /// @param corner  upper left corner of the pixel
    void add(const Facet& facet, const SeenFacet& seen, const glm::dvec2& corner, std::size_t pixel,
             std::size_t first, std::vector<LitPart>& parts) const {
        const auto count = static_cast<float>(seen.count);
        const glm::dvec2 place = corner + 0.5 + glm::dvec2(seen.x, seen.y) / double(seen.count);
        const float depth = seen.depth / count;
        const glm::vec2 shares = facet.shares(place);
        const glm::vec3 normal =
            facet.radius > 0 ? normal_of_ball(facet, place) : Facet::mixed(facet.normals, shares);
        // With a smaller cosine, blocks would be visible on narrow stems.
        const float alike = block_ == 1 ? 0.85F : 0.985F;
        auto found = std::find_if(parts.begin() + std::ptrdiff_t(first), parts.end(), [&](const LitPart& part) {
            return part.takes(facet.material.is_thin, depth, normal, alike);
        });
        if (found == parts.end()) {
            parts.push_back({.depth = depth, .is_thin = facet.material.is_thin});
            found = parts.end() - 1;
        }
        found->at += glm::dvec3(place, double{depth}) * double(seen.count);
        found->normal += normal * count;
        found->count += seen.count;
        LitPart::Share& share = found->shares[pixel];
        share.colour += linear(Facet::mixed(facet.colours, shares)) * count;
        share.alpha += facet.material.alpha * seen.count;
        share.count += seen.count;
    }

    glm::vec3 normal_of_ball(const Facet& ball, const glm::dvec2& place) const {
        const glm::dvec2 out = place - ball.at;
        const double height = double{ball.radius} * double{ball.radius} - glm::dot(out, out);
        return glm::vec3(glm::normalize(stage_.direction_back({out, std::sqrt(std::max(0.0, height))})));
    }

    /// @param ground  returns the ground at the pixel
    template <class Ground>
    static void write(std::span<const LitPart> parts, std::span<const Daylight::OnSurface> lights, std::size_t pixel,
                      int bare, Ground&& ground, int channels, std::uint8_t* out) {
        if (parts.empty()) {
            const auto [colour, alpha] = ground();
            for (std::size_t i = 0; i < 3; ++i) out[channels == 1 ? 0 : i] = alpha == 0 ? std::uint8_t{0} : colour[i];
            if (channels == 4) out[3] = static_cast<std::uint8_t>(alpha);
            return;
        }
        // Sums over the samples, of colours with their alpha.
        std::array<std::uint32_t, 3> sums{};
        std::uint32_t alphas = 0;
        const auto add = [&](const std::array<std::uint8_t, 3>& colour, std::uint32_t alpha) {
            for (std::size_t i = 0; i < 3; ++i) sums[i] += colour[i] * alpha;
            alphas += alpha;
        };
        std::uint32_t shown = static_cast<std::uint32_t>(bare) * 255;  // share of the ground
        for (std::size_t i = 0; i < parts.size(); ++i) {
            const LitPart::Share& share = parts[i].shares[pixel];
            if (share.count == 0) continue;
            const glm::vec3 own = share.colour / static_cast<float>(share.count);
            // Light that has passed a leaf has been coloured by it twice.
            const glm::vec3 colour =
                compressed(own * lights[i].front + through * own * glm::sqrt(own) * lights[i].behind);
            add({from_linear(colour.x), from_linear(colour.y), from_linear(colour.z)},
                static_cast<std::uint32_t>(share.alpha));
            shown += static_cast<std::uint32_t>(share.count) * 255 - static_cast<std::uint32_t>(share.alpha);
        }
        if (shown > 0) {
            const auto [colour, alpha] = ground();
            add(colour, (shown * alpha + 127) / 255);
        }
        for (std::size_t i = 0; i < 3; ++i) {
            const std::uint32_t mean = alphas == 0 ? 0 : (sums[i] + alphas / 2) / alphas;
            out[channels == 1 ? 0 : i] = static_cast<std::uint8_t>(mean);
        }
        if (channels == 4) out[3] = static_cast<std::uint8_t>((alphas + samples * samples / 2) / (samples * samples));
    }

    /// The first pixel of a block that shows the ground, also through what is transparent.
    static std::optional<glm::ivec2> first_bare(const Tile& tile, const Block& block) {
        std::size_t pixel = 0;
        for (int y = block.top; y < block.bottom; ++y) {
            for (int x = block.left; x < block.right; ++x, ++pixel) {
                if (tile.bare_at(x, y) > 0) return glm::ivec2(x, y);
                for (std::size_t i = block.first; i < block.end; ++i) {
                    const LitPart::Share& share = tile.parts[i].shares[pixel];
                    if (share.alpha < 255 * share.count) return glm::ivec2(x, y);
                }
            }
        }
        return std::nullopt;
    }

    /// The place of the ground at a pixel, if the eye sees one there.
    std::optional<glm::vec3> ground_place(int x, int y) const {
        if (style_.camera.distance) {
            const auto place = ground_seen_at(x, y);
            return place ? std::optional(glm::vec3(*place)) : std::nullopt;
        }
        if (!level_ground_) return std::nullopt;
        const auto& [first, right, below] = *level_ground_;
        return glm::vec3(first + double(x) * right + double(y) * below);
    }
    std::optional<glm::dvec3> ground_seen_at(int x, int y) const {
        const glm::dvec3 point = stage_.point({(x + 0.5) * samples, (y + 0.5) * samples, 0.0});
        const glm::dvec3 eye = stage_.to_eye(glm::vec3(point));
        if (!(eye.y > 1e-3)) return std::nullopt;
        return point - eye * ((point.y - double{daylight_.ground()}) / eye.y);
    }
    /// Without perspective: the place at pixel 0 0, and the vectors from a pixel to the next on the right and below.
    std::optional<std::array<glm::dvec3, 3>> level_ground() const {
        constexpr int apart = 1024;
        const auto first = ground_seen_at(0, 0), right = ground_seen_at(apart, 0), below = ground_seen_at(0, apart);
        if (!first || !right || !below) return std::nullopt;
        return std::array{*first, (*right - *first) / double{apart}, (*below - *first) / double{apart}};
    }

    struct Shown {
        std::array<std::uint8_t, 3> colour;
        std::uint32_t alpha;
    };
    /// The ground in a share of its light.
    Shown ground_in(const glm::vec3& share) const {
        const float dark = 1 - (share.x + share.y + share.z) / 3;
        if (!(dark > 0)) return {{ground_.red, ground_.green, ground_.blue}, ground_.alpha};
        // Where the ground is transparent, the shadow is a dark veil.
        const float opaque = static_cast<float>(ground_.alpha) / 255;
        const auto alpha = static_cast<std::uint32_t>(255 * (1 - (1 - opaque) * (1 - dark)) + 0.5F);
        const glm::vec3 colour = linear_ground_ * share * opaque;
        return {{from_linear(colour.x), from_linear(colour.y), from_linear(colour.z)}, alpha};
    }

    /// The ground in a band. The shadow of the sky, which has no edges, is computed at the corners of squares of
    /// pixels.
    class GroundRows {
    public:
        /// @param top  first row of the band
        GroundRows(const LitRaster& raster, int top)
            : raster_(raster), top_(top), square_(std::min(8 * raster.block_, raster.bands_.height())) {}

        /// Lights the blocks of a tile that show the ground, one place for each.
        void light(const Tile& tile) {
            sun_.assign(tile.blocks.size(), std::nullopt);
            if (!raster_.style_.light.has_ground) return;
            columns_ = squares(tile.left, tile.width);
            rows_ = squares(0, tile.rows);
            std::vector<std::size_t> blocks;
            std::vector<glm::vec3> places;
            for (std::size_t i = 0; i < sun_.size(); ++i) {
                const auto pixel = first_bare(tile, tile.blocks[i]);
                if (!pixel) continue;
                const std::optional<glm::vec3> place = raster_.ground_place(tile.left + pixel->x, top_ + pixel->y);
                if (!place) continue;
                blocks.push_back(i);
                places.push_back(*place);
                each_pixel(tile.blocks[i], [&](std::size_t, int x, int y) {
                    want(columns_[std::size_t(x)].number, rows_[std::size_t(y)].number);
                });
            }
            const std::vector<float> suns = raster_.daylight_.sun_on_ground(places);
            for (std::size_t i = 0; i < blocks.size(); ++i) sun_[blocks[i]] = suns[i];
            light_corners();
        }

        /// The ground at a pixel of the tile that was lit last. @param block  number of its block
        Shown at(std::size_t block, int x, int y) const {
            if (!sun_[block]) return raster_.ground_in(glm::vec3(1.0F));
            const Square &across = columns_[std::size_t(x)], &down = rows_[std::size_t(y)];
            const Corner* const above = corners_.data() + number(across.number, down.number);
            const Corner* const below = above + number(0, 1);
            const float sky = glm::mix(glm::mix(above[0].sky, above[1].sky, across.share),
                                       glm::mix(below[0].sky, below[1].sky, across.share), down.share);
            return raster_.ground_in(raster_.daylight_.on_ground(sky, *sun_[block]));
        }

    private:
        struct Corner {
            bool is_wanted = false;
            float sky = 1;
        };
        /// The square of a row or column of pixels, and the position in it.
        struct Square {
            int number = 0;
            float share = 0;  ///< from the beginning of the square to its end
        };
        std::vector<Square> squares(int first, int count) const {
            std::vector<Square> result;
            for (int i = first; i < first + count; ++i) {
                result.push_back({i / square_, static_cast<float>(i % square_) / static_cast<float>(square_)});
            }
            return result;
        }
        std::size_t number(int column, int row) const {
            return std::size_t(row) * (std::size_t(raster_.size_.width / square_) + 2) + std::size_t(column);
        }
        /// Notes that the corners of a square are needed.
        void want(int column, int row) {
            if (column == wanted_square_.x && row == wanted_square_.y) return;
            wanted_square_ = {column, row};
            if (const std::size_t size = number(0, row + 2); corners_.size() < size) corners_.resize(size);
            for (const int below : {row, row + 1}) {
                for (const int right : {column, column + 1}) {
                    Corner& corner = corners_[number(right, below)];
                    if (corner.is_wanted) continue;
                    corner.is_wanted = true;
                    const std::optional<glm::vec3> place =
                        raster_.ground_place(right * square_, top_ + below * square_);
                    if (!place) continue;
                    wanted_.push_back(&corner - corners_.data());
                    wanted_places_.push_back(*place);
                }
            }
        }
        void light_corners() {
            const std::vector<float> skies = raster_.daylight_.sky_on_ground(wanted_places_);
            for (std::size_t i = 0; i < wanted_.size(); ++i) corners_[std::size_t(wanted_[i])].sky = skies[i];
            wanted_.clear();
            wanted_places_.clear();
        }

        const LitRaster& raster_;
        int top_;
        int square_;                             ///< side in pixels; divides the height of every band
        std::vector<std::optional<float>> sun_;  ///< on the blocks of the tile
        std::vector<Square> columns_, rows_;     ///< by pixels of the tile
        glm::ivec2 wanted_square_{-1, -1};       ///< the last one
        std::vector<Corner> corners_;            ///< of squares, by rows
        std::vector<std::ptrdiff_t> wanted_;     ///< corners to be lit …
        std::vector<glm::vec3> wanted_places_;   ///< … and where they are
    };

    double step_;
    int block_;  ///< pixels, each way, that are lit together
    glm::vec3 linear_ground_;
    std::optional<std::array<glm::dvec3, 3>> level_ground_;
    mutable Daylight daylight_;
    mutable std::once_flag is_lit_;
    std::vector<std::uint32_t> bearers_;  ///< by segment
};

}  // namespace

std::unique_ptr<Rendering> make_lit_raster(const Scene& scene, const Print& print) {
    return std::make_unique<LitRaster>(scene, print);
}

}  // namespace sikku
