#include "art/space/tessellation.h"

#include "engine/language/surface.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>

namespace sikku {
namespace {

constexpr std::array divisions = {1, 2, 3, 4, 6, 8, 12, 16, 24, 32, 48};
constexpr int least_of_curved = 3;
constexpr double most_facets = 1.5e6;

/// A patch at evenly spaced parameters: (n + 1)^2 points.
struct Grid {
    std::vector<glm::dvec3> points, normals;
    std::vector<char> is_shared;  ///< points shared with a neighbour
    double near = 0;              ///< points within this distance differ only by rounding
};

/// The shape of a surface, in its own coordinates.
struct Shape {
    double extent = 0;  ///< longest side of its box
    double bend = 0;    ///< bound of the deviation of an undivided patch from its corners' polygon
};

Shape shape_of(const Surface& surface) {
    Shape shape;
    glm::dvec3 low(1e300), high(-1e300);
    for (const Patch& patch : surface.patches) {
        const auto& p = patch.points;
        for (const glm::dvec3& point : p) {
            low = glm::min(low, point);
            high = glm::max(high, point);
        }
        double second = 0, mixed = 0;
        for (std::size_t i = 0; i < 4; ++i) {
            for (std::size_t k = 0; k < 2; ++k) {
                second = std::max(second, glm::length(p[4 * i + k] - 2.0 * p[4 * i + k + 1] + p[4 * i + k + 2]));
                second = std::max(second, glm::length(p[4 * k + i] - 2.0 * p[4 * k + 4 + i] + p[4 * k + 8 + i]));
            }
        }
        for (std::size_t i = 0; i < 3; ++i) {
            for (std::size_t k = 0; k < 3; ++k) {
                const std::size_t at = 4 * i + k;
                mixed = std::max(mixed, glm::length(p[at] - p[at + 1] - p[at + 4] + p[at + 5]));
            }
        }
        // Second derivatives are 6 and 9 times the differences; each direction contributes 1/8.
        shape.bend = std::max(shape.bend, (2 * 6 * second + 2 * 9 * mixed) / 8);
    }
    if (surface.patches.empty()) return shape;
    const glm::dvec3 size = high - low;
    shape.extent = std::max({size.x, size.y, size.z});
    if (shape.bend < 1e-9 * shape.extent) shape.bend = 0;
    return shape;
}

/// Factor of the lengths of a placed surface.
double scale_of(const SceneSurface& surface) {
    double scale = 0;
    for (int axis = 0; axis < 3; ++axis) scale = std::max(scale, double(glm::length(surface.map[axis])));
    return scale;
}

int divisions_from(double wanted) {
    const auto* found = std::lower_bound(divisions.begin(), divisions.end(), wanted);
    return found == divisions.end() ? divisions.back() : *found;
}

std::array<double, 4> weights(double t) {
    const double s = 1 - t;
    return {s * s * s, 3 * s * s * t, 3 * s * t * t, t * t * t};
}
std::array<double, 4> slopes(double t) {
    const double s = 1 - t;
    return {-3 * s * s, 3 * s * s - 6 * s * t, 6 * s * t - 3 * t * t, 3 * t * t};
}

glm::dvec3 sum(const Patch& patch, const std::array<double, 4>& rows, const std::array<double, 4>& columns) {
    glm::dvec3 result(0.0);
    for (std::size_t i = 0; i < 4; ++i) {
        for (std::size_t k = 0; k < 4; ++k) result += patch.points[4 * i + k] * (rows[i] * columns[k]);
    }
    return result;
}

/// The unit normal ds x dt. Where an edge has collapsed to a point, the normal of a place beside it.
glm::dvec3 normal_at(const Patch& patch, double s, double t) {
    for (const double aside : {0.0, 1e-3}) {
        const double u = s + (0.5 - s) * aside, v = t + (0.5 - t) * aside;
        const glm::dvec3 ds = sum(patch, weights(u), slopes(v)), dt = sum(patch, slopes(u), weights(v));
        const glm::dvec3 normal = glm::cross(ds, dt);
        const double length = glm::length(normal);
        if (length > 1e-9 * glm::length(ds) * glm::length(dt)) return normal / length;
    }
    return {0, 0, 1};
}

Grid grid_of(const Patch& patch, int n, double near) {
    Grid grid;
    grid.near = near;
    for (int i = 0; i <= n; ++i) {
        for (int k = 0; k <= n; ++k) {
            const double s = double(i) / n, t = double(k) / n;
            grid.points.push_back(sum(patch, weights(s), weights(t)));
            grid.normals.push_back(normal_at(patch, s, t));
        }
    }
    grid.is_shared.assign(grid.points.size(), 0);
    return grid;
}

/// Distance of a point from the plane of a triangle; 0 if the corners lie on a line.
double distance_from_plane(const glm::dvec3& point, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    const glm::dvec3 normal = glm::cross(b - a, c - a);
    const double length = glm::length(normal);
    const double sides = glm::length(b - a) * glm::length(c - a);
    return length > 1e-9 * sides ? std::fabs(glm::dot(point - a, normal)) / length : 0.0;
}

double distance_from_line(const glm::dvec3& point, const glm::dvec3& a, const glm::dvec3& b) {
    const glm::dvec3 along = b - a;
    const double length = glm::length(along);
    return length > 0 ? glm::length(glm::cross(point - a, along)) / length : glm::distance(point, a);
}

/// The largest distance of a patch from n by n quadrilaterals, at the middle of each and of its sides; on the rim of
/// the patch, the distance from the sides. Each quadrilateral may be divided along either diagonal.
double deviation_of(const Patch& patch, int n) {
    const auto at = [&](double row, double column) { return sum(patch, weights(row / n), weights(column / n)); };
    const auto corners = [&](int row) {
        std::vector<glm::dvec3> result;
        for (int k = 0; k <= n; ++k) result.push_back(at(row, k));
        return result;
    };
    double most = 0;
    std::vector<glm::dvec3> above = corners(0);
    for (int i = 0; i < n; ++i) {
        const std::vector<glm::dvec3> below = corners(i + 1);
        for (int k = 0; k < n; ++k) {
            const auto left = static_cast<std::size_t>(k), right = left + 1;
            const std::array<glm::dvec3, 4> round = {above[left], above[right], below[right], below[left]};
            const std::array<glm::dvec3, 4> middles = {at(i, k + 0.5), at(i + 0.5, k + 1), at(i + 1, k + 0.5),
                                                       at(i + 0.5, k)};
            const std::array<bool, 4> is_rim = {i == 0, k + 1 == n, i + 1 == n, k == 0};
            const glm::dvec3 middle = at(i + 0.5, k + 0.5);
            for (std::size_t side = 0; side < 4; ++side) {
                const glm::dvec3 &a = round[side], &b = round[(side + 1) % 4], &c = round[(side + 2) % 4];
                most = std::max({most, distance_from_plane(middle, a, b, c),
                                 is_rim[side] ? distance_from_line(middles[side], a, b)
                                              : distance_from_plane(middles[side], a, b, c)});
            }
        }
        above = below;
    }
    return most;
}

/// Indices of the points along the four edges.
std::vector<std::size_t> rim(int n) {
    std::vector<std::size_t> result;
    const auto width = static_cast<std::size_t>(n) + 1;
    for (std::size_t i = 0; i < width * width; ++i) {
        const std::size_t row = i / width, column = i % width;
        if (row == 0 || column == 0 || row + 1 == width || column + 1 == width) result.push_back(i);
    }
    return result;
}

bool are_neighbours(const Surface& surface, std::size_t a, std::size_t b) {
    const auto names = [&](std::size_t one, std::size_t other) {
        const std::vector<std::size_t>& around = surface.patches[one].neighbours;
        return std::binary_search(around.begin(), around.end(), other);
    };
    return a != b && (surface.is_smooth || names(a, b) || names(b, a));
}

/// A point on the rim of a patch.
struct PatchMeeting {
    glm::dvec3 cell;  ///< equal for points that differ only by rounding
    std::size_t patch;
    std::size_t point;
    bool operator<(const PatchMeeting& other) const {
        return std::tie(cell.x, cell.y, cell.z, patch, point) <
               std::tie(other.cell.x, other.cell.y, other.cell.z, other.patch, other.point);
    }
};

/// Averages the normals of patches and their neighbours along shared edges. Cost: n log n in the points.
void join(const Surface& surface, int n, std::vector<Grid>& grids) {
    constexpr std::size_t most_meeting = 64;  // patches in a point; more keep their own normals
    const std::vector<std::size_t> edge = rim(n);
    std::vector<PatchMeeting> meetings;
    for (std::size_t patch = 0; patch < grids.size(); ++patch) {
        const Grid& grid = grids[patch];
        const double side = std::max(100 * grid.near, 1e-300);
        for (const std::size_t i : edge) meetings.push_back({glm::floor(grid.points[i] / side + 0.37), patch, i});
    }
    std::sort(meetings.begin(), meetings.end());
    for (std::size_t first = 0, end = 0; first < meetings.size(); first = end) {
        std::vector<std::pair<std::size_t, glm::dvec3>> normals;  // one for each patch
        for (; end < meetings.size() && meetings[end].cell == meetings[first].cell; ++end) {
            const PatchMeeting& here = meetings[end];
            if (!normals.empty() && normals.back().first == here.patch) continue;
            normals.emplace_back(here.patch, grids[here.patch].normals[here.point]);
        }
        if (normals.size() > most_meeting) continue;
        for (std::size_t i = first; i < end; ++i) {
            Grid& grid = grids[meetings[i].patch];
            const glm::dvec3 own = grid.normals[meetings[i].point];
            glm::dvec3 normal = own;
            for (const auto& [other, met] : normals) {
                if (!are_neighbours(surface, meetings[i].patch, other)) continue;
                normal += glm::dot(met, own) < 0 ? -met : met;
                grid.is_shared[meetings[i].point] = 1;
            }
            if (glm::length(normal) > 0) grid.normals[meetings[i].point] = glm::normalize(normal);
        }
    }
}

/// Numbers of parts into which the surfaces of a scene are divided, and their points.
class Division {
public:
    Division(const std::vector<SceneSurface>& surfaces, const Fineness& fineness) : fineness_(fineness) {
        for (const SceneSurface& surface : surfaces) {
            shapes_.try_emplace(surface.surface.get(), shape_of(*surface.surface));
        }
        while (facets(surfaces) > most_facets && coarser_ < 1e9) coarser_ *= 2;
    }

    /// Number of parts of all surfaces.
    double facets(const std::vector<SceneSurface>& surfaces) const {
        double count = 0;
        for (const SceneSurface& surface : surfaces) {
            const int n = parts_of(surface);
            count += double(surface.surface->patches.size()) * n * n;
        }
        return count;
    }

    /// Parts of each patch, each way.
    int parts_of(const SceneSurface& surface) const {
        const Shape& shape = shapes_.at(surface.surface.get());
        if (!(shape.bend > 0)) return 1;
        const double scale = scale_of(surface);
        double wanted = coarser_ > 1 ? 1 : least_of_curved;
        const double deviation = std::max(fineness_.deviation, fineness_.share * shape.extent * scale) * coarser_;
        if (deviation > 0) wanted = std::max(wanted, std::sqrt(shape.bend * scale / deviation));
        if (fineness_.is_measured && deviation > 0) {
            wanted = measured(*surface.surface, deviation / scale, divisions_from(wanted));
        }
        if (fineness_.side > 0) wanted = std::max(wanted, shape.extent * scale / (fineness_.side * coarser_));
        return divisions_from(wanted);
    }

    /// The patches of a surface, in its own coordinates.
    const std::vector<Grid>& grids(const Surface& surface, int n) {
        const auto [found, fresh] = grids_.try_emplace({&surface, n});
        if (fresh) {
            const double near = 1e-9 * shapes_.at(&surface).extent;
            for (const Patch& patch : surface.patches) found->second.push_back(grid_of(patch, n, near));
            join(surface, n, found->second);
        }
        return found->second;
    }

private:
    /// The smallest number of parts that do not deviate more. @param most  number that a bound of the deviation
    /// requires
    int measured(const Surface& surface, double deviation, int most) const {
        constexpr double safety = 1.2;  // between the places where it is measured
        for (const int n : divisions) {
            if (n >= most) break;
            if (n < least_of_curved && coarser_ == 1) continue;
            const auto [found, fresh] = deviations_.try_emplace({&surface, n});
            if (fresh) {
                for (const Patch& patch : surface.patches) {
                    found->second = std::max(found->second, safety * deviation_of(patch, n));
                }
            }
            if (found->second <= deviation) return n;
        }
        return most;
    }

    Fineness fineness_;
    double coarser_ = 1;                                                   ///< a factor of the fineness
    mutable std::map<std::pair<const Surface*, int>, double> deviations_;  ///< measured
    std::map<const Surface*, Shape> shapes_;
    std::map<std::pair<const Surface*, int>, std::vector<Grid>> grids_;
};

}  // namespace

class Tessellation {
public:
    Tessellation(const Scene& scene, const Fineness& fineness, const Monitor& monitor)
        : scene_(scene), division_(scene.surfaces(), fineness), pulse_(monitor) {}

    Scene run() {
        organ_ = static_cast<std::uint32_t>(scene_.polygons_.size());
        std::vector<SceneSurface> surfaces = std::move(scene_.surfaces_);
        scene_.surfaces_.clear();
        reserve(static_cast<std::size_t>(division_.facets(surfaces)));
        for (const SceneSurface& surface : surfaces) {
            ++organ_;
            add(surface, division_.parts_of(surface));
        }
        return std::move(scene_);
    }

private:
    void reserve(std::size_t facets) {
        scene_.polygons_.reserve(scene_.polygons_.size() + facets);
        scene_.vertices_.reserve(scene_.vertices_.size() + 4 * facets);
        scene_.corners_.reserve(scene_.corners_.size() + 4 * facets);
    }

    void add(const SceneSurface& placed, int n) {
        const Surface& surface = *placed.surface;
        const std::vector<Grid>& parts = division_.grids(surface, n);
        const glm::dmat4x3 map(placed.map);
        // Normals turn with the cofactors, which also respect mirroring.
        const glm::dmat3 cofactors(glm::cross(map[1], map[2]), glm::cross(map[2], map[0]),
                                   glm::cross(map[0], map[1]));
        for (std::size_t part = 0; part < parts.size(); ++part) {
            const Grid& grid = parts[part];
            const std::int32_t own = scene_.patch_colours(surface)[part];
            const std::int32_t colour = own < 0 ? placed.colour : own;
            for (int i = 0; i < n; ++i) {
                for (int k = 0; k < n; ++k) add_facet(grid, n, i, k, map, cofactors, colour);
            }
        }
    }

    void add_facet(const Grid& grid, int n, int i, int k, const glm::dmat4x3& map, const glm::dmat3& cofactors,
                   std::int32_t colour) {
        pulse_();
        const auto at = [&](int row, int column) { return static_cast<std::size_t>(row * (n + 1) + column); };
        const std::array<std::size_t, 4> round = {at(i, k), at(i, k + 1), at(i + 1, k + 1), at(i + 1, k)};
        const std::array<bool, 4> is_rim = {i == 0, k + 1 == n, i + 1 == n, k == 0};
        ScenePolygon polygon{scene_.vertices_.size(), 0, colour, 0, scene_.corners_.size(), organ_};
        for (std::size_t side = 0; side < 4; ++side) {
            const std::size_t from = round[side], to = round[(side + 1) % 4];
            // Skips an edge that has collapsed.
            if (glm::distance(grid.points[from], grid.points[to]) <= grid.near) continue;
            const bool is_inner = !is_rim[side] || (grid.is_shared[from] && grid.is_shared[to]);
            polygon.inner_edges |= (is_inner ? 1U : 0U) << polygon.count;
            ++polygon.count;
            scene_.vertices_.emplace_back(map * glm::dvec4(grid.points[from], 1.0));
            const glm::dvec3 normal = cofactors * grid.normals[from];
            const double length = glm::length(normal);
            const std::size_t row = from / (static_cast<std::size_t>(n) + 1);
            scene_.corners_.push_back({glm::vec3(length > 0 ? normal / length : normal), colour,
                                       static_cast<float>(row) / static_cast<float>(n)});
        }
        if (polygon.count >= 3) return scene_.polygons_.push_back(polygon);
        scene_.vertices_.resize(polygon.first);
        scene_.corners_.resize(*polygon.corners);
    }

    Scene scene_;
    Division division_;
    Pulse pulse_;
    std::uint32_t organ_ = 0;
};

Scene tessellated(const Scene& scene, const Fineness& fineness, const Monitor& monitor) {
    return Tessellation(scene, fineness, monitor).run();
}

void each_divided_patch(const Scene& scene, const Fineness& fineness, const PatchVisitor& visit,
                        const Monitor& monitor) {
    Division division(scene.surfaces(), fineness);
    Pulse pulse(monitor);
    std::vector<glm::vec3> points;
    for (const SceneSurface& surface : scene.surfaces()) {
        const glm::dmat4x3 map(surface.map);
        const int n = division.parts_of(surface);
        for (const Grid& grid : division.grids(*surface.surface, n)) {
            pulse();
            points.clear();
            for (const glm::dvec3& point : grid.points) points.emplace_back(map * glm::dvec4(point, 1.0));
            visit(n, points);
        }
    }
}

double bend_of(const SceneSurface& surface) {
    return shape_of(*surface.surface).bend * scale_of(surface);
}

double polygons_of_patch(double bend, double deviation) {
    if (!(bend > 0)) return 1;
    const double divided = divisions_from(std::max<double>(least_of_curved, std::sqrt(bend / deviation)));
    return divided * divided;
}

}  // namespace sikku
