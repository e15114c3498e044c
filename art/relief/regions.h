// art/relief/regions.h: divides the plane into regions along the outlines of layers, as triangles.
#pragma once

#include "art/print/micrometres.h"
#include "art/relief/windings.h"
#include "engine/base/monitor.h"

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace sikku {

/// An edge of the outline of a layer, which lies on its left. y grows upwards.
struct LayerEdge {
    Micrometres from, to;
    std::uint32_t layer = 0;
};

/// Triangles without gaps, overlaps or corners within edges, and the region of each.
struct PlaneRegions {
    static constexpr std::int32_t outside = -1;  ///< region outside all layers
    static constexpr std::uint32_t none = ~std::uint32_t{0};

    struct Triangle {
        std::array<std::uint32_t, 3> corners{};     ///< numbers of points, anticlockwise
        std::array<std::uint32_t, 3> neighbours{};  ///< beyond the edges from each corner to the next; or none
        std::int32_t region = outside;
    };
    std::vector<Micrometres> points;
    std::vector<Triangle> triangles;
};

/// The region of a place, from the winding numbers of layers around it.
using RegionOf = std::function<std::int32_t(std::span<const Winding>)>;

/// Divides the plane along outlines, which have to be closed, and may cross, touch and repeat each other. Those that
/// pass a point at less than `tolerance` micrometres are led through it. Coordinates beyond 268 m are moved there.
/// Cost: n log n in the edges and their crossings, about 3 µs for each, and more where long edges cross very many
/// others; memory: 350 bytes. @throws Stopped; BudgetError for more than ConstrainedTriangulation::most_points
PlaneRegions divide_plane(std::span<const LayerEdge> edges, double tolerance, const RegionOf& region_of,
                          const Monitor& monitor);

/// The outlines of the regions, one layer each; regions with the same value of `merged` are one. Points within
/// straight outlines are left out, unless more than two regions meet there, or `keeps_points`.
std::vector<LayerEdge> outlines_of(const PlaneRegions& plane, const std::function<std::int32_t(std::int32_t)>& merged,
                                   bool keeps_points = false);

/// The outlines of the places around which some polygons wind `least` times or more, or, for 0, at all.
std::vector<LayerEdge> united(std::span<const LayerEdge> edges, std::int32_t least, const Monitor& monitor);

}  // namespace sikku
