// engine/tiling/polygon_list.h: polygons that were not drawn by a turtle.
#pragma once

#include <glm/vec2.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace sikku {

/// Closed polygons in the order of their file, in its units, with the y axis up.
struct PolygonList {
    std::string title{};
    std::vector<glm::dvec2> corners{};
    std::vector<std::size_t> begin{0};   ///< index of the first corner of each polygon, and of the end of the last
    std::vector<std::int32_t> colour{};  ///< colour of each polygon
    std::vector<std::string> colour_names{};  ///< names of colours from 0 on, as far as they have one
    std::vector<std::string> notes{};         ///< omissions, one line each

    std::size_t size() const { return colour.size(); }
    std::span<const glm::dvec2> polygon(std::size_t i) const {
        return std::span(corners).subspan(begin[i], begin[i + 1] - begin[i]);
    }
    /// Completes a polygon of the corners that were added since the last one.
    void end_polygon(std::int32_t with_colour) {
        begin.push_back(corners.size());
        colour.push_back(with_colour);
    }
};

}  // namespace sikku
