// engine/map/map.h: planar maps: vertices, edges with labels and directions, and cells as walls of half-edges.
#pragma once

#include "engine/language/map_system.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string_view>
#include <vector>

namespace sikku {

/// An edge, walked from its tail to its head or the other way.
class HalfEdge {
public:
    HalfEdge() = default;
    HalfEdge(std::size_t edge, bool is_reversed)
        : value_(static_cast<std::uint32_t>(edge * 2 + (is_reversed ? 1 : 0))) {}
    std::uint32_t edge() const { return value_ >> 1; }
    bool is_reversed() const { return (value_ & 1) != 0; }
    HalfEdge opposite() const { return {edge(), !is_reversed()}; }
    bool operator==(const HalfEdge&) const = default;

private:
    std::uint32_t value_ = 0;
};

/// Maximum number of edges of a map: half-edges are numbers of 32 bits.
constexpr std::size_t most_map_edges = std::size_t{1} << 31;

struct MapEdge {
    Label label = 0;
    std::uint32_t tail = 0;
    std::uint32_t head = 0;
    std::uint32_t born = 0;  ///< derivation step in which its wall was made; 0: the axiom
    bool operator==(const MapEdge&) const = default;
};

/// A connected planar map without islands. A wall is the cyclic list of half-edges around a region, which lies on
/// their right. Memory: 16 bytes for an edge, 8 for its half-edges, 8 for a cell.
class Map {
public:
    Map() = default;
    /// Creates the cell that the axiom states, and the outside.
    explicit Map(const MapSystem& system);

    std::size_t vertices() const { return vertices_; }
    const std::vector<MapEdge>& edges() const { return edges_; }
    std::size_t cells() const { return ends_.empty() ? 0 : ends_.size() - 1; }
    /// The wall of a cell. @param index  below cells()
    std::span<const HalfEdge> cell(std::size_t index) const {
        const std::size_t begin = index == 0 ? 0 : ends_[index - 1];
        return std::span(half_edges_).subspan(begin, ends_[index] - begin);
    }
    /// The wall of the outside: it runs anticlockwise around the map.
    std::span<const HalfEdge> outer() const { return cell(cells()); }

    std::uint32_t start(HalfEdge half) const {
        const MapEdge& edge = edges_[half.edge()];
        return half.is_reversed() ? edge.head : edge.tail;
    }
    std::uint32_t end(HalfEdge half) const { return start(half.opposite()); }

private:
    friend class MapStepper;
    std::size_t vertices_ = 0;
    std::vector<MapEdge> edges_;
    std::vector<HalfEdge> half_edges_;  // wall after wall, the outer one last
    std::vector<std::uint64_t> ends_;   // of each wall
};

/// Writes the map as text, piece by piece: `edge LABEL TAIL HEAD BORN` for each edge, then `cell +0 -3 …` for each
/// cell, then `outer …`. Two maps are equal if their texts are.
void print_map(const Map& map, const MapSystem& system, const std::function<void(std::string_view)>& write);

}  // namespace sikku
