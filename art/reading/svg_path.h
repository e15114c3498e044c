// art/reading/svg_path.h: the path data of SVG as polylines.
#pragma once

#include <cstddef>
#include <glm/vec2.hpp>
#include <string_view>
#include <vector>

namespace sikku {

struct FlatPath {
    std::vector<glm::dvec2> points;
    bool is_closed = false;  ///< by `z`; the first point is not repeated
};

/// Flattens path data: each curve becomes 12 chords, each arc at most 30 degrees a chord.
/// Source: SVG 1.1 (Second Edition), sections 8.3 and F.6.
/// @param most_points  limit over all subpaths
/// @throws std::runtime_error for damaged data, and for more points
std::vector<FlatPath> flatten_path(std::string_view data, std::size_t most_points);

/// A polygon or polyline of an SVG; a polyline that returns to its first point is closed, too.
FlatPath path_of_points(const std::vector<double>& coordinates, bool is_polygon);

/// The place of the first curve or arc, as an index into the data, or npos. Cost: linear.
std::size_t first_curve(std::string_view data);

}  // namespace sikku
