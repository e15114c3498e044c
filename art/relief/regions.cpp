#include "art/relief/regions.h"

#include "art/relief/constrained_triangulation.h"
#include "art/relief/crossings.h"
#include "engine/derivation/derivation.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace sikku {
namespace {

bool is_before(Micrometres a, Micrometres b) {
    return a.x != b.x ? a.x < b.x : a.y < b.y;
}

Micrometres clamped(Micrometres point) {
    constexpr std::int32_t most = ConstrainedTriangulation::largest_coordinate - 1;
    return {std::clamp(point.x, -most, most), std::clamp(point.y, -most, most)};
}

/// An edge between two places, with the winding number of a layer on its left minus that on its right.
struct Border {
    Micrometres from, to;
    std::uint32_t layer = 0;
    std::int32_t count = 0;

    bool lies_with(const Border& other) const { return from == other.from && to == other.to; }
};

/// Each edge once for each layer, without those that cancel each other.
std::vector<Border> borders_of(std::span<const LayerEdge> edges, const Monitor& monitor) {
    std::vector<Border> borders;
    borders.reserve(edges.size());
    for (const LayerEdge& edge : edges) {
        const Micrometres from = clamped(edge.from), to = clamped(edge.to);
        if (from == to) continue;
        const bool is_back = is_before(to, from);
        borders.push_back({is_back ? to : from, is_back ? from : to, edge.layer, is_back ? -1 : 1});
    }
    std::sort(borders.begin(), borders.end(), stoppable(monitor, [](const Border& a, const Border& b) {
                  if (!(a.from == b.from)) return is_before(a.from, b.from);
                  if (!(a.to == b.to)) return is_before(a.to, b.to);
                  return a.layer < b.layer;
              }));
    std::size_t kept = 0;
    for (std::size_t i = 0, next = 0; i < borders.size(); i = next) {
        Border sum = borders[i];
        for (next = i + 1; next < borders.size() && borders[next].lies_with(sum) && borders[next].layer == sum.layer;
             ++next) {
            sum.count += borders[next].count;
        }
        if (sum.count != 0) borders[kept++] = sum;
    }
    borders.resize(kept);
    return borders;
}

/// The position along a Z-order curve, which keeps neighbours together.
std::uint64_t curve_place(Micrometres point, Micrometres low) {
    const auto spread = [](std::uint64_t bits) {
        bits = (bits | bits << 16) & 0x0000ffff0000ffffU;
        bits = (bits | bits << 8) & 0x00ff00ff00ff00ffU;
        bits = (bits | bits << 4) & 0x0f0f0f0f0f0f0f0fU;
        bits = (bits | bits << 2) & 0x3333333333333333U;
        return (bits | bits << 1) & 0x5555555555555555U;
    };
    return spread(static_cast<std::uint32_t>(point.x - low.x)) | spread(static_cast<std::uint32_t>(point.y - low.y))
                                                                     << 1;
}

/// All ends of borders, ascending, and their numbers in a triangulation.
class Ends {
public:
    Ends(const std::vector<Border>& borders, const Monitor& monitor) {
        for (const Border& border : borders) places_.insert(places_.end(), {border.from, border.to});
        std::sort(places_.begin(), places_.end(), stoppable(monitor, is_before));
        places_.erase(std::unique(places_.begin(), places_.end()), places_.end());
    }
    std::pair<Micrometres, Micrometres> frame() const {
        Micrometres low{places_.front().x, places_.front().y}, high{places_.back().x, places_.front().y};
        for (const Micrometres place : places_) {
            low.y = std::min(low.y, place.y);
            high.y = std::max(high.y, place.y);
        }
        return {{low.x - 1, low.y - 1}, {high.x + 1, high.y + 1}};
    }
    void enter(ConstrainedTriangulation& triangulation, const Monitor& monitor) {
        std::vector<std::pair<std::uint64_t, std::uint32_t>> order;
        const Micrometres low = frame().first;
        for (std::uint32_t i = 0; i < places_.size(); ++i) order.emplace_back(curve_place(places_[i], low), i);
        std::sort(order.begin(), order.end(), stoppable(monitor, std::less<>()));
        points_.resize(places_.size());
        for (const auto& [along, i] : order) points_[i] = triangulation.add(places_[i]);
    }
    std::size_t size() const { return places_.size(); }
    std::uint32_t operator[](Micrometres place) const {
        return points_[static_cast<std::size_t>(std::lower_bound(places_.begin(), places_.end(), place, is_before) -
                                                places_.begin())];
    }

private:
    std::vector<Micrometres> places_;
    std::vector<std::uint32_t> points_;
};

void connect(const std::vector<Border>& borders, const Ends& ends, Windings& windings,
             ConstrainedTriangulation& triangulation) {
    for (std::size_t i = 0, next = 0; i < borders.size(); i = next) {
        Windings::Id sum = 0;
        for (next = i; next < borders.size() && borders[next].lies_with(borders[i]); ++next) {
            sum = windings.sum(sum, windings.of(borders[next].layer, borders[next].count));
        }
        triangulation.connect(ends[borders[i].from], ends[borders[i].to], sum);
    }
}

/// Refuses borders with too many crossings before any is triangulated, which takes 3 us and more for each.
void require_affordable(const std::vector<Border>& borders, std::size_t ends, double tolerance,
                        const Monitor& monitor) {
    constexpr std::size_t few = 5'000;  // segments whose crossings are always found in less than a second
    constexpr std::size_t most = ConstrainedTriangulation::most_points;
    if (borders.size() < few) return;
    std::vector<OutlineEdge> segments;
    segments.reserve(borders.size());
    for (std::size_t i = 0; i < borders.size(); ++i) {
        if (i == 0 || !borders[i].lies_with(borders[i - 1])) segments.push_back({borders[i].from, borders[i].to});
    }
    const std::size_t left = most - std::min(most, ends);
    const std::size_t crossings = count_crossings(segments, tolerance, left, monitor);
    if (crossings <= left) return;
    throw BudgetError(fmt::format(
        "with its crossings the relief has more than {} million points; choose a shorter derivation or a window",
        most / 1'000'000));
}

/// The region of each triangle, from one of the frame inwards.
void find_regions(const ConstrainedTriangulation& triangulation, Windings& windings, const RegionOf& region_of,
                  PlaneRegions& plane) {
    const auto& triangles = triangulation.triangles();
    constexpr Windings::Id unknown = ~Windings::Id{0};
    std::vector<Windings::Id> found(triangles.size(), unknown);
    std::vector<std::int32_t> regions;  // region of each number of windings
    std::vector<std::uint32_t> pending = {0};
    for (std::uint32_t i = 0; i < triangles.size(); ++i) {
        const auto& neighbours = triangles[i].neighbours;
        if (std::find(neighbours.begin(), neighbours.end(), ConstrainedTriangulation::none) != neighbours.end())
            pending[0] = i;
    }
    found[pending[0]] = 0;
    while (!pending.empty()) {
        const std::uint32_t here = pending.back();
        pending.pop_back();
        for (std::size_t i = 0; i < 3; ++i) {
            const std::uint32_t beyond = triangles[here].neighbours[i];
            if (beyond == ConstrainedTriangulation::none || found[beyond] != unknown) continue;
            found[beyond] = windings.sum(found[here], windings.negative(triangles[here].windings[i]));
            pending.push_back(beyond);
        }
    }
    for (Windings::Id id = 0; id < windings.size(); ++id) regions.push_back(region_of(windings.at(id)));
    for (std::size_t i = 0; i < triangles.size(); ++i) {
        plane.triangles.push_back({triangles[i].corners, triangles[i].neighbours, regions[found[i]]});
    }
}

/// The neighbours of a point along outlines: two of them, and their number.
struct EdgeMeeting {
    std::array<std::uint32_t, 2> others{};
    std::uint32_t count = 0;

    void add(std::uint32_t other) {
        if (count < 2) others[count] = other;
        ++count;
    }
};

bool is_straight(Micrometres a, Micrometres b, Micrometres c) {
    return std::int64_t{b.x - a.x} * (c.y - b.y) == std::int64_t{b.y - a.y} * (c.x - b.x);
}

}  // namespace

PlaneRegions divide_plane(std::span<const LayerEdge> edges, double tolerance, const RegionOf& region_of,
                          const Monitor& monitor) {
    PlaneRegions plane;
    const std::vector<Border> borders = borders_of(edges, monitor);
    if (borders.empty()) return plane;
    Ends ends(borders, monitor);
    require_affordable(borders, ends.size(), tolerance, monitor);
    Windings windings;
    const auto [low, high] = ends.frame();
    ConstrainedTriangulation triangulation(low, high, tolerance, windings, monitor);
    ends.enter(triangulation, monitor);
    connect(borders, ends, windings, triangulation);
    plane.points = triangulation.points();
    plane.triangles.reserve(triangulation.triangles().size());
    find_regions(triangulation, windings, region_of, plane);
    return plane;
}

std::vector<LayerEdge> outlines_of(const PlaneRegions& plane, const std::function<std::int32_t(std::int32_t)>& merged,
                                   bool keeps_points) {
    struct Side {
        std::uint32_t from, to;
        std::int32_t region;
    };
    std::vector<Side> sides;  // sides of regions, which lie on the left
    std::vector<EdgeMeeting> meetings(plane.points.size());
    const auto region_of = [&](std::uint32_t triangle) {
        if (triangle == PlaneRegions::none) return PlaneRegions::outside;
        const std::int32_t region = plane.triangles[triangle].region;
        return region == PlaneRegions::outside ? region : merged(region);
    };
    for (std::uint32_t t = 0; t < plane.triangles.size(); ++t) {
        const PlaneRegions::Triangle& triangle = plane.triangles[t];
        const std::int32_t region = region_of(t);
        for (std::size_t i = 0; i < 3; ++i) {
            const std::int32_t beyond = region_of(triangle.neighbours[i]);
            if (beyond == region) continue;
            const std::uint32_t from = triangle.corners[i], to = triangle.corners[(i + 1) % 3];
            meetings[from].add(to);  // the other side of the edge adds the other end
            if (region != PlaneRegions::outside) sides.push_back({from, to, region});
        }
    }
    const auto is_left_out = [&](std::uint32_t point) {
        const EdgeMeeting& meeting = meetings[point];
        return !keeps_points && meeting.count == 2 &&
               is_straight(plane.points[meeting.others[0]], plane.points[point], plane.points[meeting.others[1]]);
    };
    std::vector<LayerEdge> edges;
    for (const auto& [from, to, region] : sides) {
        if (is_left_out(from)) continue;
        std::uint32_t last = from, here = to;
        while (is_left_out(here)) {
            const auto& others = meetings[here].others;
            last = std::exchange(here, others[0] == last ? others[1] : others[0]);
        }
        edges.push_back({plane.points[from], plane.points[here], static_cast<std::uint32_t>(region)});
    }
    return edges;
}

std::vector<LayerEdge> united(std::span<const LayerEdge> edges, std::int32_t least, const Monitor& monitor) {
    const auto region_of = [least](std::span<const Winding> windings) {
        if (windings.empty()) return PlaneRegions::outside;
        return least == 0 || windings.front().count >= least ? 0 : PlaneRegions::outside;
    };
    return outlines_of(divide_plane(edges, 0, region_of, monitor), [](std::int32_t region) { return region; });
}

}  // namespace sikku
