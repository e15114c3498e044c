// engine/tiling/polygon_place.h: positions of polygons: centroids, inner points, and the polygon at a point.
#pragma once

#include "engine/geometry/simple_polygon.h"
#include "engine/tiling/place_grid.h"
#include "engine/tiling/polygon_list.h"
#include "engine/tiling/tile_plane.h"

#include <glm/vec2.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace sikku {

struct PolygonMass {
    double area = 0;  ///< 0 or more
    glm::dvec2 centre{0.0};
};
/// Area and centroid; of polygons without area, the mean of their corners.
PolygonMass mass_of(std::span<const glm::dvec2> corners);

/// True if a point lies within a polygon that is widened by `margin`.
bool contains(std::span<const glm::dvec2> corners, glm::dvec2 point, double margin);

/// The middle of the largest disc within a polygon, to about a thousandth of its size; among several the one nearest
/// to the centroid. A polygon that is made smaller around it leaves gaps of similar width on all sides.
glm::dvec2 inner_middle(std::span<const glm::dvec2> corners);

/// Up to 25 points spread over the interior of a polygon; at least one.
std::vector<glm::dvec2> points_within(std::span<const glm::dvec2> corners);

/// Finds polygons by points within them. Keeps a reference to the list.
class PolygonFinder {
public:
    /// Cost: linear for polygons of similar sizes.
    explicit PolygonFinder(const PolygonList& polygons);
    /// The first polygon that contains the point, or no_number.
    std::uint32_t at(glm::dvec2 point) const;

private:
    const PolygonList& polygons_;
    Box box_;
    PlaceGrid grid_;
    CellLists<std::uint32_t> lists_;
};

}  // namespace sikku
