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

const std::array<float, 256>& linear_values() {
    static const std::array<float, 256> values = [] {
        std::array<float, 256> result{};
        for (std::size_t i = 0; i < result.size(); ++i) result[i] = to_linear(static_cast<float>(i));
        return result;
    }();
    return values;
}

glm::vec3 linear(Colour colour) {
    const auto& values = linear_values();
    return {values[colour.red], values[colour.green], values[colour.blue]};
}

glm::vec3 channels_of(Colour colour) {
    return {colour.red, colour.green, colour.blue};
}

// --- samples ---------------------------------------------------------------------------------------------------

/// A direction in 30 bits, 10 for each coordinate.
std::uint32_t packed(const glm::vec3& normal) {
    const auto coded = [](float value) { return static_cast<std::uint32_t>(static_cast<int>(value * 511 + 512.5F)); };
    return coded(normal.x) << 20 | coded(normal.y) << 10 | coded(normal.z);
}

/// About as long as it was.
glm::vec3 unpacked(std::uint32_t bits) {
    const auto decoded = [&](int shift) { return static_cast<float>(static_cast<int>(bits >> shift & 0x3ff) - 512); };
    return glm::vec3(decoded(20), decoded(10), decoded(0)) * (1 / 511.0F);
}

constexpr std::uint32_t thin_bit = 1U << 30;

struct Sample {
    float depth = -std::numeric_limits<float>::infinity();
    Colour colour;
    std::uint32_t normal = 0;  ///< packed(), and thin_bit
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

class Band : public SampleBand<Sample> {
public:
    using SampleBand::SampleBand;

    void triangle(const Corner& a, const Corner& b, const Corner& c, const Material& material) {
        const glm::dvec3 ab = b.at - a.at, ac = c.at - a.at;
        const double area = ab.x * ac.y - ab.y * ac.x;
        if (!(std::fabs(area) > 1e-12)) return;
        const glm::dvec3 ab_part = ab / area, ac_part = ac / area;
        each_run(a.at, b.at, c.at, [&](int y, Sample* row, int begin, int stop) {
            const double dy = y + 0.5 - a.at.y;
            for (int x = begin; x < stop; ++x) {
                const double dx = x + 0.5 - a.at.x;
                const double p = std::clamp(dx * ac_part.y - dy * ac_part.x, 0.0, 1.0);
                const double q = std::clamp(dy * ab_part.x - dx * ab_part.y, 0.0, 1.0 - p);
                const auto depth = static_cast<float>(a.at.z + p * ab.z + q * ac.z);
                if (!(depth > row[x].depth)) continue;
                const auto s = static_cast<float>(p), t = static_cast<float>(q);
                row[x] = {depth, coded(a.colour + s * (b.colour - a.colour) + t * (c.colour - a.colour), material),
                          packed_normal(a.normal + s * (b.normal - a.normal) + t * (c.normal - a.normal), material)};
            }
        });
    }

    /// A flat polygon that may cross itself. @param seen  its normal on the page
    void polygon(std::span<const glm::dvec3> outline, const glm::dvec3& seen, const Corner& like,
                 const Material& material) {
        const Colour colour = coded(like.colour, material);
        const std::uint32_t normal = packed_normal(like.normal, material);
        each_of_outline(outline, seen, [&](Sample& sample, float depth) {
            if (depth > sample.depth) sample = {depth, colour, normal};
        });
    }

    /// @param surface  returns the normal in the scene, and the depth, of an outward direction on the page
    template <class Surface>
    void sphere(const glm::dvec3& centre, double radius, const glm::vec3& colour, const Material& material,
                Surface&& surface) {
        each_of_ball(centre, radius, [&](Sample& sample, const glm::dvec3& out) {
            const auto [normal, depth] = surface(out);
            if (depth > sample.depth) sample = {depth, coded(colour, material), packed_normal(normal, material)};
        });
    }

private:
    static Colour coded(const glm::vec3& colour, const Material& material) {
        const auto channel = [](float value) {
            return static_cast<std::uint8_t>(std::clamp(value, 0.0F, 255.0F) + 0.5F);
        };
        return {channel(colour.x), channel(colour.y), channel(colour.z), material.alpha};
    }
    static std::uint32_t packed_normal(const glm::vec3& normal, const Material& material) {
        return packed(normal) | (material.is_thin ? thin_bit : 0);
    }
};

constexpr int most_block = 2;     // pixels, each way, that are lit together …
constexpr double fine_dpi = 200;  // … from this resolution on
constexpr int tile_width = 32;    // pixels; a multiple of the blocks

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

    bool takes(const Sample& sample, const glm::vec3& its_normal) const {
        constexpr float near = 3 * samples, alike = 0.85F;
        const float cosine = glm::dot(its_normal, normal);  // times the length of the sum
        return is_thin == ((sample.normal & thin_bit) != 0) && std::fabs(sample.depth - depth) < near && cosine > 0 &&
               cosine * cosine > alike * alike * glm::dot(normal, normal);
    }
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
        : SceneRendering(scene, print, collar),
          step_(print.placement.step),
          block_(print.dpi < fine_dpi ? 1 : most_block),
          daylight_(scene, print.style, print.placement.step, pixels(scene, print)) {
        find_bearers();
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
        const glm::dvec3 middle = stage_.point(centre);
        band.sphere(centre, radius, colour, material, [&](const glm::dvec3& seen) {
            const glm::dvec3 normal = glm::normalize(stage_.direction_back(seen));
            double depth = centre.z + seen.z;
            if (style_.camera.distance) {
                // The depth of that place of the ball in perspective.
                const glm::dvec3 rim = stage_.point(centre + glm::dvec3(radius, 0, 0));
                depth = stage_.place(glm::vec3(middle + normal * glm::distance(middle, rim))).z;
            }
            return std::pair(glm::vec3(normal), static_cast<float>(depth));
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

    /// Pixels that are lit together, so that neighbours look up the same parts of the maps.
    struct Tile {
        int left = 0, top = 0, width = 0, rows = 0;  ///< pixels, from the first row of the band
        int across = 0;                              ///< blocks in a row
        std::vector<LitPart> parts;                  ///< by blocks
        std::vector<std::size_t> first_parts;        ///< of each block, and the end
        std::vector<int> bare;                       ///< samples of each pixel that show the ground
        LitPlaces places;
        std::vector<Daylight::OnSurface> lights;  ///< of the parts
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
            tile.across = (tile.width + block_ - 1) / block_;
            collect(band, tile);
            light(tile, ground);
            write(tile, ground, channels, pixels);
        }
    }

    void collect(const Band& band, Tile& tile) const {
        tile.parts.clear();
        tile.first_parts.clear();
        tile.bare.assign(std::size_t(tile.width) * std::size_t(tile.rows), 0);
        const int blocks = tile.across * ((tile.rows + block_ - 1) / block_);
        for (std::size_t block = 0; block < std::size_t(blocks); ++block) {
            const std::size_t first = tile.parts.size();
            tile.first_parts.push_back(first);
            each_pixel(tile, block, [&](std::size_t pixel, int x, int y) {
                tile.bare[std::size_t(y * tile.width + x)] =
                    collect(band, tile.left + x, y, pixel, first, tile.parts);
            });
        }
        tile.first_parts.push_back(tile.parts.size());
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

    /// The pixels of a block, within the tile.
    template <class Visit>
    void each_pixel(const Tile& tile, std::size_t block, Visit&& visit) const {
        const int left = static_cast<int>(block) % tile.across * block_;
        const int top = static_cast<int>(block) / tile.across * block_;
        const int wide = std::min(block_, tile.width - left), high = std::min(block_, tile.rows - top);
        for (int i = 0; i < wide * high; ++i) visit(std::size_t(i), left + i % wide, top + i / wide);
    }

    void write(const Tile& tile, const GroundRows& ground, int channels, std::vector<std::uint8_t>& pixels) const {
        for (std::size_t block = 0; block + 1 < tile.first_parts.size(); ++block) {
            const std::size_t first = tile.first_parts[block], count = tile.first_parts[block + 1] - first;
            const auto parts = std::span(tile.parts).subspan(first, count);
            const auto lights = std::span(tile.lights).subspan(first, count);
            each_pixel(tile, block, [&](std::size_t pixel, int x, int y) {
                write(
                    parts, lights, pixel, tile.bare[std::size_t(y * tile.width + x)],
                    [&] { return ground.at(tile, block, x, y); }, channels,
                    pixels.data() + (std::size_t(y) * std::size_t(size_.width) + std::size_t(tile.left + x)) *
                                        std::size_t(channels));
            });
        }
    }

    /// Gathers the samples of a pixel of a block; returns the number of those that show the ground.
    /// @param first  first part of the block
    static int collect(const Band& band, int column, int line, std::size_t pixel, std::size_t first,
                       std::vector<LitPart>& parts) {
        if (!band.is_touched(column * samples, line * samples)) return samples * samples;
        int bare = 0;
        std::uint32_t last_bits = 0;
        glm::vec3 normal = unpacked(last_bits);
        for (int y = line * samples; y < (line + 1) * samples; ++y) {
            const auto row = band.row(y);
            for (int x = column * samples; x < (column + 1) * samples; ++x) {
                const Sample& sample = row[std::size_t(x)];
                if (!sample.is_covered()) {
                    ++bare;
                    continue;
                }
                if (sample.normal != last_bits) normal = unpacked(last_bits = sample.normal);
                auto found = std::find_if(parts.begin() + std::ptrdiff_t(first), parts.end(),
                                          [&](const LitPart& part) { return part.takes(sample, normal); });
                if (found == parts.end()) {
                    parts.push_back({.depth = sample.depth, .is_thin = (sample.normal & thin_bit) != 0});
                    found = parts.end() - 1;
                }
                found->at += glm::dvec3(x + 0.5, band.top() + y + 0.5, double{sample.depth});
                found->normal += normal;
                ++found->count;
                LitPart::Share& share = found->shares[pixel];
                share.colour += linear(sample.colour);
                share.alpha += sample.colour.alpha;
                ++share.count;
            }
        }
        return bare;
    }

    /// @param ground  returns the ground at the pixel
    template <class Ground>
    static void write(std::span<const LitPart> parts, std::span<const Daylight::OnSurface> lights, std::size_t pixel,
                      int bare, Ground&& ground, int channels, std::uint8_t* out) {
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
    std::optional<glm::ivec2> first_bare(const Tile& tile, std::size_t block) const {
        std::optional<glm::ivec2> result;
        each_pixel(tile, block, [&](std::size_t pixel, int x, int y) {
            if (result) return;
            bool is_bare = tile.bare[std::size_t(y * tile.width + x)] > 0;
            for (std::size_t i = tile.first_parts[block]; i < tile.first_parts[block + 1]; ++i) {
                const LitPart::Share& share = tile.parts[i].shares[pixel];
                is_bare = is_bare || share.alpha < 255 * share.count;
            }
            if (is_bare) result = glm::ivec2(x, y);
        });
        return result;
    }

    /// The place of the ground at a pixel, if the eye sees one there.
    std::optional<glm::vec3> ground_place(int x, int y) const {
        const glm::dvec3 point = stage_.point({(x + 0.5) * samples, (y + 0.5) * samples, 0.0});
        const glm::dvec3 eye = stage_.to_eye(glm::vec3(point));
        if (!(eye.y > 1e-3)) return std::nullopt;
        return glm::vec3(point - eye * ((point.y - double{daylight_.ground()}) / eye.y));
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
        const auto alpha = static_cast<std::uint32_t>(std::lround(255 * (1 - (1 - opaque) * (1 - dark))));
        const glm::vec3 colour = linear(ground_) * share * opaque;
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
            sun_.assign(tile.first_parts.size() - 1, std::nullopt);
            if (!raster_.style_.light.has_ground) return;
            std::vector<std::size_t> blocks;
            std::vector<glm::vec3> places;
            for (std::size_t block = 0; block < sun_.size(); ++block) {
                const auto pixel = raster_.first_bare(tile, block);
                if (!pixel) continue;
                const auto place = raster_.ground_place(tile.left + pixel->x, top_ + pixel->y);
                if (!place) continue;
                blocks.push_back(block);
                places.push_back(*place);
                raster_.each_pixel(tile, block, [&](std::size_t, int x, int y) { want(tile.left + x, y); });
            }
            const std::vector<float> suns = raster_.daylight_.sun_on_ground(places);
            for (std::size_t i = 0; i < blocks.size(); ++i) sun_[blocks[i]] = suns[i];
            light_corners();
        }

        /// The ground at a pixel of the tile that was lit last.
        Shown at(const Tile& tile, std::size_t block, int x, int y) const {
            if (!sun_[block]) return raster_.ground_in(glm::vec3(1.0F));
            const int column = (tile.left + x) / square_, row = y / square_;
            const float dx = static_cast<float>(tile.left + x - column * square_) / static_cast<float>(square_),
                        dy = static_cast<float>(y - row * square_) / static_cast<float>(square_);
            const float above = glm::mix(corner(column, row), corner(column + 1, row), dx);
            const float below = glm::mix(corner(column, row + 1), corner(column + 1, row + 1), dx);
            return raster_.ground_in(raster_.daylight_.on_ground(glm::mix(above, below, dy), *sun_[block]));
        }

    private:
        struct Corner {
            bool is_wanted = false;
            float sky = 1;
        };
        std::size_t number(int column, int row) const {
            return std::size_t(row) * (std::size_t(raster_.size_.width / square_) + 2) + std::size_t(column);
        }
        float corner(int column, int row) const { return corners_[number(column, row)].sky; }
        /// Notes that the corners around a pixel are needed.
        void want(int x, int y) {
            const int column = x / square_, row = y / square_;
            if (const std::size_t size = number(0, row + 2); corners_.size() < size) corners_.resize(size);
            for (const int below : {row, row + 1}) {
                for (const int right : {column, column + 1}) {
                    Corner& corner = corners_[number(right, below)];
                    if (corner.is_wanted) continue;
                    corner.is_wanted = true;
                    const auto place = raster_.ground_place(right * square_, top_ + below * square_);
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
        std::vector<Corner> corners_;            ///< of squares, by rows
        std::vector<std::ptrdiff_t> wanted_;     ///< corners to be lit …
        std::vector<glm::vec3> wanted_places_;   ///< … and where they are
    };

    double step_;
    int block_;  ///< pixels, each way, that are lit together
    mutable Daylight daylight_;
    mutable std::once_flag is_lit_;
    std::vector<std::uint32_t> bearers_;  ///< by segment
};

}  // namespace

std::unique_ptr<Rendering> make_lit_raster(const Scene& scene, const Print& print) {
    return std::make_unique<LitRaster>(scene, print);
}

}  // namespace sikku
