#include "art/relief/solid.h"

#include <algorithm>
#include <numeric>
#include <utility>
#include <vector>

namespace sikku {
namespace {

constexpr std::uint32_t frame_points = 4;
constexpr double first_joint = 25;  // half the side of the squares, in micrometres
constexpr int rounds_of_joints = 3;

/// Visits the triangles around a point anticlockwise, from one of them on.
template <class Visit>
void visit_around(const PlaneRegions& plane, std::uint32_t triangle, std::uint32_t point, Visit&& visit) {
    std::uint32_t here = triangle;
    do {
        visit(here);
        const auto& corners = plane.triangles[here].corners;
        const std::size_t corner = corners[0] == point ? 0 : corners[1] == point ? 1 : 2;
        here = plane.triangles[here].neighbours[(corner + 2) % 3];
    } while (here != triangle);
}

double area_of(const PlaneRegions& plane, std::uint32_t triangle) {
    const auto at = [&](std::size_t i) { return plane.points[plane.triangles[triangle].corners[i]]; };
    const double x = at(1).x - at(0).x, y = at(1).y - at(0).y;
    return 0.5 * (x * (at(2).y - at(0).y) - y * (at(2).x - at(0).x));
}

/// Heights of a solid over the triangles of a plane.
class Heights {
public:
    Heights(const PlaneRegions& plane, std::span<const ReliefRegion> regions) : plane_(plane), regions_(regions) {}

    std::int32_t of(std::uint32_t triangle) const {
        if (triangle == PlaneRegions::none) return 0;
        const std::int32_t region = plane_.triangles[triangle].region;
        return region == PlaneRegions::outside ? 0 : regions_[static_cast<std::size_t>(region)].height;
    }

    /// The heights around a point, anticlockwise from one of its triangles, equal neighbours once.
    void around(std::uint32_t triangle, std::uint32_t point, std::vector<std::int32_t>& heights) const {
        heights.clear();
        visit_around(plane_, triangle, point, [&](std::uint32_t here) {
            const std::int32_t height = of(here);
            if (heights.empty() || heights.back() != height) heights.push_back(height);
        });
        if (heights.size() > 1 && heights.front() == heights.back()) heights.pop_back();
    }

private:
    const PlaneRegions& plane_;
    std::span<const ReliefRegion> regions_;
};

/// True if prisms around a point touch only along the edge above it: the part above some level is then in several
/// pieces, so heights rise more than once around the point.
bool is_pinched(const std::vector<std::int32_t>& heights) {
    std::size_t peaks = 0;
    for (std::size_t i = 0; i < heights.size(); ++i) {
        const std::int32_t before = heights[(i + heights.size() - 1) % heights.size()];
        const std::int32_t after = heights[(i + 1) % heights.size()];
        if (before < heights[i] && after < heights[i]) ++peaks;
    }
    return peaks > 1;
}

void add_square(Micrometres centre, std::int32_t half, std::uint32_t layer, std::vector<LayerEdge>& edges) {
    const std::array<Micrometres, 4> corners = {Micrometres{centre.x - half, centre.y - half},
                                                {centre.x + half, centre.y - half},
                                                {centre.x + half, centre.y + half},
                                                {centre.x - half, centre.y + half}};
    for (std::size_t i = 0; i < 4; ++i) edges.push_back({corners[i], corners[(i + 1) % 4], layer});
}

/// Squares over all points that need them, in layers after those of the regions.
std::vector<LayerEdge> joints(const PlaneRegions& plane, std::span<const ReliefRegion> regions, std::int32_t half) {
    const Heights heights(plane, regions);
    std::vector<bool> is_seen(plane.points.size());
    std::vector<std::int32_t> around;
    std::vector<LayerEdge> edges;
    for (std::uint32_t t = 0; t < plane.triangles.size(); ++t) {
        for (const std::uint32_t point : plane.triangles[t].corners) {
            if (point < frame_points || is_seen[point]) continue;
            is_seen[point] = true;
            heights.around(t, point, around);
            if (around.size() < 4 || !is_pinched(around)) continue;
            const std::int32_t highest = *std::max_element(around.begin(), around.end());
            const auto region = std::find_if(regions.begin(), regions.end(),
                                             [&](const ReliefRegion& each) { return each.height == highest; });
            add_square(
                plane.points[point], half,
                static_cast<std::uint32_t>(regions.size() + static_cast<std::size_t>(region - regions.begin())),
                edges);
        }
    }
    return edges;
}

/// Triangles around a point that have the same height, and stand side by side.
struct Sector {
    std::vector<std::uint32_t> triangles;
    std::int32_t height = 0;
    double area = 0;
};

std::vector<Sector> sectors_of(const PlaneRegions& plane, const Heights& heights, std::uint32_t triangle,
                               std::uint32_t point) {
    std::vector<Sector> sectors;
    visit_around(plane, triangle, point, [&](std::uint32_t here) {
        if (sectors.empty() || sectors.back().height != heights.of(here))
            sectors.push_back({{}, heights.of(here), 0});
        sectors.back().triangles.push_back(here);
        sectors.back().area += area_of(plane, here);
    });
    if (sectors.size() > 1 && sectors.front().height == sectors.back().height) {
        Sector& first = sectors.front();
        first.triangles.insert(first.triangles.end(), sectors.back().triangles.begin(),
                               sectors.back().triangles.end());
        first.area += sectors.back().area;
        sectors.pop_back();
    }
    return sectors;
}

/// Raises the smaller valleys between prisms that touch at a point only: joints do not help if their sides round to
/// the same micrometres. Every step raises some triangles, so this terminates.
void fill_valleys(PlaneRegions& plane, std::span<const ReliefRegion> regions, const Monitor& monitor) {
    Pulse pulse(monitor);
    const Heights heights(plane, regions);
    std::vector<std::uint32_t> pending(plane.triangles.size());
    std::iota(pending.begin(), pending.end(), 0U);
    std::vector<std::int32_t> around;
    while (!pending.empty()) {
        pulse();
        const std::uint32_t triangle = pending.back();
        pending.pop_back();
        for (const std::uint32_t point : plane.triangles[triangle].corners) {
            if (point < frame_points) continue;
            for (heights.around(triangle, point, around); is_pinched(around);
                 heights.around(triangle, point, around)) {
                const std::vector<Sector> sectors = sectors_of(plane, heights, triangle, point);
                const Sector *least = nullptr, *rim = nullptr;
                for (std::size_t i = 0; i < sectors.size(); ++i) {
                    const Sector& before = sectors[(i + sectors.size() - 1) % sectors.size()];
                    const Sector& after = sectors[(i + 1) % sectors.size()];
                    if (!(sectors[i].height < before.height && sectors[i].height < after.height)) continue;
                    if (least && least->area <= sectors[i].area) continue;
                    least = &sectors[i];
                    rim = before.height < after.height ? &before : &after;
                }
                for (const std::uint32_t raised : least->triangles) {
                    plane.triangles[raised].region = plane.triangles[rim->triangles.front()].region;
                    pending.push_back(raised);
                }
            }
        }
    }
}

/// The walls over the edges of a plane between different heights.
class Walls {
public:
    Walls(const PlaneRegions& plane, const Heights& heights, const Solid::Visit& visit)
        : plane_(plane), heights_(heights), visit_(visit) {}

    /// The wall over edge i of a triangle, if the region beyond is lower. All heights around its ends are corners of
    /// the wall.
    void add(std::uint32_t triangle, std::size_t i) {
        const PlaneRegions::Triangle& here = plane_.triangles[triangle];
        const std::int32_t top = heights_.of(triangle), foot = heights_.of(here.neighbours[i]);
        if (!(foot < top)) return;
        const std::uint32_t from = here.corners[i], to = here.corners[(i + 1) % 3];
        find_levels(triangle, from, foot, top, left_);
        find_levels(triangle, to, foot, top, right_);
        const auto at = [&](std::uint32_t point, std::int32_t level) {
            return SolidPoint{plane_.points[point].x, plane_.points[point].y, level};
        };
        const auto region = static_cast<std::uint32_t>(here.region);
        for (std::size_t l = 0, r = 0; l + 1 < left_.size() || r + 1 < right_.size();) {
            const SolidPoint one = at(from, left_[l]), two = at(to, right_[r]);
            const bool climbs_left =
                r + 1 == right_.size() || (l + 1 < left_.size() && left_[l + 1] <= right_[r + 1]);
            visit_(region, {one, two, climbs_left ? at(from, left_[++l]) : at(to, right_[++r])});
        }
    }

private:
    void find_levels(std::uint32_t triangle, std::uint32_t point, std::int32_t foot, std::int32_t top,
                     std::vector<std::int32_t>& levels) const {
        heights_.around(triangle, point, levels);
        std::sort(levels.begin(), levels.end());
        levels.erase(std::unique(levels.begin(), levels.end()), levels.end());
        std::erase_if(levels, [&](std::int32_t level) { return level < foot || level > top; });
    }

    const PlaneRegions& plane_;
    const Heights& heights_;
    const Solid::Visit& visit_;
    std::vector<std::int32_t> left_, right_;
};

std::int32_t same(std::int32_t region) {
    return region;
}

std::int32_t all(std::int32_t) {
    return 0;
}

/// Regions of outlines and joints; a joint has the highest region.
RegionOf region_with_joints(std::span<const ReliefRegion> regions) {
    return [regions](std::span<const Winding> windings) {
        std::int32_t found = PlaneRegions::outside;
        for (const Winding& winding : windings) {
            const auto region = static_cast<std::int32_t>(winding.layer % regions.size());
            const bool is_joint = winding.layer >= regions.size();
            if (found == PlaneRegions::outside || (is_joint && regions[static_cast<std::size_t>(region)].height >=
                                                                   regions[static_cast<std::size_t>(found)].height)) {
                found = region;
            }
        }
        return found;
    };
}

PlaneRegions with_joints(PlaneRegions plane, std::span<const ReliefRegion> regions, const Monitor& monitor) {
    const RegionOf region_of = region_with_joints(regions);
    double half = first_joint;
    for (int round = 0; round < rounds_of_joints; ++round, half *= 1.4) {
        const std::vector<LayerEdge> squares = joints(plane, regions, static_cast<std::int32_t>(half));
        if (squares.empty()) return plane;
        std::vector<LayerEdge> edges = outlines_of(plane, same);
        edges.insert(edges.end(), squares.begin(), squares.end());
        plane = divide_plane(edges, 0, region_of, monitor);
        plane = divide_plane(outlines_of(plane, same), 0, region_of, monitor);
    }
    fill_valleys(plane, regions, monitor);
    return plane;
}

}  // namespace

Solid::Solid(PlaneRegions plane, std::vector<ReliefRegion> regions, const Monitor& monitor)
    : plane_(with_joints(std::move(plane), regions, monitor)),
      bottom_(divide_plane(outlines_of(plane_, all, true), 0, region_with_joints(regions), monitor)),
      regions_(std::move(regions)),
      monitor_(monitor) {}

void Solid::visit(const Visit& visit) const {
    Pulse pulse(monitor_);
    const Heights heights(plane_, regions_);
    Walls walls(plane_, heights, visit);
    for (std::uint32_t t = 0; t < plane_.triangles.size(); ++t) {
        pulse();
        const PlaneRegions::Triangle& triangle = plane_.triangles[t];
        if (triangle.region == PlaneRegions::outside) continue;
        SolidTriangle top;
        for (std::size_t i = 0; i < 3; ++i) {
            const Micrometres point = plane_.points[triangle.corners[i]];
            top[i] = {point.x, point.y, heights.of(t)};
        }
        visit(static_cast<std::uint32_t>(triangle.region), top);
        for (std::size_t i = 0; i < 3; ++i) walls.add(t, i);
    }
    for (const PlaneRegions::Triangle& triangle : bottom_.triangles) {
        pulse();
        if (triangle.region == PlaneRegions::outside) continue;
        SolidTriangle down;
        for (std::size_t i = 0; i < 3; ++i) {
            const Micrometres point = bottom_.points[triangle.corners[2 - i]];
            down[i] = {point.x, point.y, 0};
        }
        visit(0, down);
    }
}

double Solid::volume() const {
    double sum = 0;
    const Heights heights(plane_, regions_);
    for (std::uint32_t t = 0; t < plane_.triangles.size(); ++t) {
        sum += 1e-9 * area_of(plane_, t) * heights.of(t);
    }
    return sum;
}

glm::dvec3 Solid::size() const {
    SolidPoint low{1 << 30, 1 << 30, 0}, high{-(1 << 30), -(1 << 30), 0};
    const Heights heights(plane_, regions_);
    for (std::uint32_t t = 0; t < plane_.triangles.size(); ++t) {
        if (plane_.triangles[t].region == PlaneRegions::outside) continue;
        high.z = std::max(high.z, heights.of(t));
        for (const std::uint32_t corner : plane_.triangles[t].corners) {
            const Micrometres point = plane_.points[corner];
            low = {std::min(low.x, point.x), std::min(low.y, point.y), 0};
            high = {std::max(high.x, point.x), std::max(high.y, point.y), high.z};
        }
    }
    return glm::dvec3(high.x - low.x, high.y - low.y, high.z) / 1000.0;
}

}  // namespace sikku
