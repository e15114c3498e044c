#include "art/space/casters.h"

#include "art/space/outline_runs.h"
#include "art/space/tessellation.h"
#include "art/space/triangles.h"

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include <algorithm>
#include <cmath>
#include <span>

namespace sikku {
namespace {

constexpr int most_of_small = 16;            // squares around a small triangle
constexpr std::size_t most_of_chunk = 2048;  // corners, unless a polygon has more

/// The first row or column whose middle is not before a coordinate.
int first_after(float coordinate, int end) {
    return static_cast<int>(std::clamp(coordinate + 0.5F, 0.0F, static_cast<float>(end)));
}

/// Draws surfaces into a map.
class MapDrawer {
public:
    explicit MapDrawer(DepthMap& map) : map_(map), width_(map.width), height_(map.rows) {}

    /// Corners in squares of the map, and their heights.
    void triangle(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
        const float area = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
        if (!(std::fabs(area) > 1e-6F)) return;
        const int first = first_after(std::min({a.y, b.y, c.y}), height_);
        const int end = first_after(std::max({a.y, b.y, c.y}), height_);
        const int left_most = first_after(std::min({a.x, b.x, c.x}), width_);
        const int right_end = first_after(std::max({a.x, b.x, c.x}), width_);
        if ((end - first) * (right_end - left_most) <= most_of_small) {
            return small_triangle(a, b, c, area, {left_most, right_end}, {first, end});
        }
        const float slope_x = ((b.z - a.z) * (c.y - a.y) - (c.z - a.z) * (b.y - a.y)) / area;
        const float slope_y = ((c.z - a.z) * (b.x - a.x) - (b.z - a.z) * (c.x - a.x)) / area;
        const float lowest = std::min({a.z, b.z, c.z}), top = std::max({a.z, b.z, c.z});
        const TriangleRuns<glm::vec3> runs(a, b, c);
        for (int y = first; y < end; ++y) {
            const float middle = static_cast<float>(y) + 0.5F;
            const auto [left, right] = runs.at(middle);
            const float start = a.z + (middle - a.y) * slope_y;
            cover(y, left, right, [&](int x) {
                const float height = start + (static_cast<float>(x) + 0.5F - a.x) * slope_x;
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
        const auto height = whole(sum / static_cast<float>(corners.size()));
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
    /// Tests each of a few squares, which is faster than finding where the triangle begins and ends in each row.
    void small_triangle(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c, float area,
                        std::pair<int, int> columns, std::pair<int, int> rows) {
        const float part = 1 / area;
        const glm::vec3 ab = (b - a) * part, ac = (c - a) * part;
        for (int y = rows.first; y < rows.second; ++y) {
            std::uint16_t* const row = map_.heights.data() + std::size_t(y) * std::size_t(width_);
            const float dy = static_cast<float>(y) + 0.5F - a.y;
            for (int x = columns.first; x < columns.second; ++x) {
                const float dx = static_cast<float>(x) + 0.5F - a.x;
                const float to_b = dx * ac.y - dy * ac.x, to_c = dy * ab.x - dx * ab.y;
                if (!(to_b >= 0 && to_c >= 0 && to_b + to_c <= 1)) continue;
                row[x] = std::max(row[x], whole(a.z + to_b * (b.z - a.z) + to_c * (c.z - a.z)));
            }
        }
    }
    static std::uint16_t whole(float height) {
        return static_cast<std::uint16_t>(std::clamp(height, 0.0F, DepthMap::highest));
    }
    void disc(const glm::vec3& centre, float radius) {
        const auto height = whole(centre.z);
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

    DepthMap& map_;
    int width_, height_;
};

/// Corners of a chunk in the coordinates of a map.
struct SeenCorners {
    std::array<std::vector<float>, 3> at;
    /// The first column, and times 2^16 the first row, that are not before the corner.
    std::vector<std::uint32_t> cells;

    glm::vec3 operator[](std::size_t i) const { return {at[0][i], at[1][i], at[2][i]}; }

    void see(const DepthMap& map, const std::array<const float*, 3>& points, std::size_t count) {
        for (int axis = 0; axis < 3; ++axis) {
            at[std::size_t(axis)].resize(count);
            const glm::vec3 along = axis == 0 ? map.across : axis == 1 ? map.along : map.depth;
            const float offset = map.offset[axis];
            float* const out = at[std::size_t(axis)].data();
            const float *const x = points[0], *const y = points[1], *const z = points[2];
            for (std::size_t i = 0; i < count; ++i)
                out[i] = offset + (x[i] * along.x + y[i] * along.y + z[i] * along.z);
        }
        cells.resize(count);
        std::uint32_t* const out = cells.data();
        const float *const x = at[0].data(), *const y = at[1].data();
        // The map lies around all corners, unless its scale is beyond the accuracy of numbers.
        const auto cell = [](float value) {
            return static_cast<std::int32_t>(value > 0 ? std::min(value + 0.5F, 32767.0F) : 0.0F);
        };
        for (std::size_t i = 0; i < count; ++i) {
            out[i] = static_cast<std::uint32_t>(cell(x[i]) | cell(y[i]) << 16);
        }
    }
};

}  // namespace

Casters::Casters(const Scene& scene, const Style& style, double step, int parts) {
    const glm::dvec3 origin = scene.at(glm::vec3(0.0F));
    low_ = glm::vec3(scene.bounds().low - origin);
    high_ = glm::vec3(scene.bounds().high - origin);
    ground_ = low_.y;
    const glm::vec3 size = high_ - low_;
    const double extent = std::max({size.x, size.y, size.z});
    add_polygons(scene);
    add_surfaces(scene, extent / parts);
    add_rounds(scene, style, step);
}

std::size_t Casters::make_room(std::size_t count) {
    if (chunks_.empty() || chunks_.back().end + count > chunks_.back().first + most_of_chunk) {
        const std::size_t corner = corners_[0].size(), triangle = triangles_.size();
        chunks_.push_back({corner, corner, triangle, triangle});
    }
    return chunks_.back().end - chunks_.back().first;
}

void Casters::add_corners(std::span<const glm::vec3> corners) {
    for (const glm::vec3& corner : corners) {
        for (int axis = 0; axis < 3; ++axis) corners_[std::size_t(axis)].push_back(corner[axis]);
    }
    chunks_.back().end = corners_[0].size();
}

void Casters::add_triangle(std::size_t a, std::size_t b, std::size_t c) {
    triangles_.push_back(
        {static_cast<std::uint16_t>(a), static_cast<std::uint16_t>(b), static_cast<std::uint16_t>(c)});
    chunks_.back().end_triangle = triangles_.size();
}

void Casters::add_polygons(const Scene& scene) {
    for (const ScenePolygon& polygon : scene.polygons()) {
        const auto vertices = scene.vertices(polygon);
        const Triangulation parts = triangulate(vertices);
        const std::size_t first = make_room(vertices.size());
        if (!parts.is_whole) outlines_.push_back({corners_[0].size(), vertices.size()});
        add_corners(vertices);
        if (!parts.is_whole) continue;
        for (const auto& [a, b, c] : parts.triangles) add_triangle(first + a, first + b, first + c);
    }
}

void Casters::add_surfaces(const Scene& scene, double deviation) {
    each_divided_patch(
        scene, {.deviation = deviation, .is_measured = true}, [&](int parts, std::span<const glm::vec3> points) {
            const std::size_t first = make_room(points.size());
            add_corners(points);
            const auto n = static_cast<std::size_t>(parts);
            for (std::size_t row = 0; row < n; ++row) {
                for (std::size_t column = 0; column < n; ++column) {
                    const std::size_t corner = first + row * (n + 1) + column, opposite = corner + n + 2;
                    add_triangle(corner, corner + 1, opposite);
                    add_triangle(corner, opposite, opposite - 1);
                }
            }
        });
}

void Casters::add_rounds(const Scene& scene, const Style& style, double step) {
    float widest = 0;
    const auto radius = [&](const SceneWidth& width) {
        const auto half = static_cast<float>(style.line_width(width.pen(0), step) / step / 2);
        widest = std::max(widest, half);
        return half;
    };
    for (const SceneSegment& segment : scene.segments()) {
        const Round stem{segment.from, segment.to, radius(segment.before), radius(segment.after)};
        rounds_.push_back(stem);
        // A level stem reaches down by its radius, an upright one, which is cut flat, does not.
        const glm::vec3 along = stem.to - stem.from;
        const float length = glm::length(along);
        const float level = length > 0 ? std::hypot(along.x, along.z) / length : 1.0F;
        ground_ = std::min({ground_, stem.from.y - stem.before * level, stem.to.y - stem.after * level});
    }
    for (const SceneSphere& sphere : scene.spheres()) {
        const auto half = static_cast<float>(style.disc_radius(sphere.radius, sphere.width.pen(0), step) / step);
        widest = std::max(widest, half);
        rounds_.push_back({sphere.centre, sphere.centre, half, half});
        ground_ = std::min(ground_, sphere.centre.y - half);
    }
    low_ -= widest;
    high_ += widest;
}

void Casters::draw(DepthMap& map) const {
    std::fill(map.heights.begin(), map.heights.end(), std::uint16_t{0});
    draw_triangles(map);
    draw_outlines(map);
    MapDrawer drawer(map);
    for (const Round& round : rounds_) {
        drawer.round(map.seen(round.from), round.before * map.scale, map.seen(round.to), round.after * map.scale);
    }
}

void Casters::draw_triangles(DepthMap& map) const {
    MapDrawer drawer(map);
    SeenCorners seen;
    for (const Chunk& chunk : chunks_) {
        seen.see(
            map,
            {corners_[0].data() + chunk.first, corners_[1].data() + chunk.first, corners_[2].data() + chunk.first},
            chunk.end - chunk.first);
        const std::uint32_t* const cells = seen.cells.data();
        for (std::size_t i = chunk.first_triangle; i < chunk.end_triangle; ++i) {
            const auto [a, b, c] = triangles_[i];
            // Most triangles of fine surfaces lie between the middles of two rows or columns.
            const std::uint32_t apart = (cells[a] ^ cells[b]) | (cells[a] ^ cells[c]);
            if ((apart & 0xffff) == 0 || apart >> 16 == 0) continue;
            drawer.triangle(seen[a], seen[b], seen[c]);
        }
    }
}

void Casters::draw_outlines(DepthMap& map) const {
    MapDrawer drawer(map);
    std::vector<glm::vec3> seen;
    for (const auto& [first, count] : outlines_) {
        seen.clear();
        for (std::size_t i = first; i < first + count; ++i) seen.push_back(map.seen(corner(i)));
        drawer.outline(seen);
    }
}

}  // namespace sikku
