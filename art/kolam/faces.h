// art/kolam/faces.h: finds the faces of a planar graph, and those that closed lines enclose.
#pragma once

#include "art/kolam/planar_graph.h"

#include <cstdint>
#include <span>
#include <vector>

namespace sikku::kolam_plane {

/// Cycles of half-edges with a face on their left: the outline of each bounded face, and, for each component, one
/// that runs around all of it. Keeps a reference to the graph.
class Faces {
public:
    /// @param closed_times  how often closed lines draw each edge, modulo 2
    Faces(const PlanarGraph& graph, std::span<const char> closed_times, const KolamOptions& options);

    std::uint64_t components() const { return outer_.size(); }
    /// The number of bounded faces.
    std::uint64_t count() const { return begins_.size() - outer_.size(); }

    std::uint32_t cycles() const { return static_cast<std::uint32_t>(begins_.size()); }
    /// A half-edge of a cycle.
    std::uint32_t half_of(std::uint32_t cycle) const { return begins_[cycle]; }
    bool is_outer(std::uint32_t cycle) const { return outer_[component_[graph_.tail(begins_[cycle])]] == cycle; }
    /// True if the face of a cycle is odd: crossing a closed line changes the parity, and the outside is even.
    bool is_odd(std::uint32_t cycle) const { return odd_[cycle] != 0; }
    bool has_holes(std::uint32_t cycle) const { return has_holes_[cycle] != 0; }

    /// The bounded face that contains a point, which must not lie on an edge; `none` outside. Searches downwards for
    /// an edge; an edge includes its left end but not its right one.
    std::uint32_t at(glm::dvec2 point) const;

private:
    std::vector<double> find_cycles(Pulse& pulse);
    std::vector<std::uint32_t> find_components(std::span<const double> areas, Pulse& pulse);
    bool is_lower(std::uint32_t a, std::uint32_t b) const;

    const PlanarGraph& graph_;
    std::vector<std::uint32_t> cycle_;      // cycle of each half-edge
    std::vector<std::uint32_t> begins_;     // one half-edge of each cycle
    std::vector<std::uint32_t> component_;  // component of each vertex
    std::vector<std::uint32_t> outer_;      // cycle around each component
    std::vector<std::uint32_t> container_;  // face around each component, or none
    std::vector<char> odd_;                 // parity of the face of each cycle
    std::vector<char> has_holes_;
};

}  // namespace sikku::kolam_plane
