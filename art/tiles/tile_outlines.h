// art/tiles/tile_outlines.h: the outlines of tiles, in drawing order.
#pragma once

#include <glm/vec2.hpp>

#include <cstddef>
#include <span>
#include <vector>

namespace sikku {

/// Keeps the vertices of tiles, as they were drawn.
class TileOutlines {
public:
    void add(std::span<const glm::dvec2> vertices) {
        vertices_.insert(vertices_.end(), vertices.begin(), vertices.end());
        begins_.push_back(vertices_.size());
    }
    std::size_t size() const { return begins_.size() - 1; }
    std::span<const glm::dvec2> operator[](std::size_t tile) const {
        return std::span(vertices_).subspan(begins_[tile], begins_[tile + 1] - begins_[tile]);
    }
    /// The vertices of all tiles, one after another.
    const std::vector<glm::dvec2>& vertices() const { return vertices_; }

private:
    std::vector<glm::dvec2> vertices_;
    std::vector<std::size_t> begins_{0};
};

}  // namespace sikku
