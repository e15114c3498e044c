// art/relief/outlines.h: the outlines of polygons, strokes and discs in whole micrometres.
#pragma once

#include "art/relief/regions.h"
#include "engine/base/monitor.h"

#include <glm/vec2.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace sikku {

/// Collects outlines as edges of layers. Outlines wind a positive number of times around each place that a shape
/// covers, so that shapes of one layer unite. Lengths are millimetres, y grows upwards; arcs are chords.
class Outlines {
public:
    /// @param tolerance  maximum deviation of chords from arcs
    Outlines(double tolerance, const Monitor& monitor) : tolerance_(tolerance), monitor_(monitor) {}

    /// Adds a polygon that may cross itself (non-zero winding rule).
    void add_polygon(std::span<const glm::dvec2> corners, std::uint32_t layer);
    /// Adds a polygon with its sides moved inwards: the places at least `distance` from its outline, except the tips
    /// of mitres where it turns outwards by up to 120 degrees. @return false if nothing is left
    bool add_inside(std::span<const glm::dvec2> corners, double distance, std::uint32_t layer);
    /// Adds a line with round joins and caps. @param points  at least one; of a closed line, the first again at the
    /// end
    void add_stroke(std::span<const glm::dvec2> points, bool is_closed, double radius, std::uint32_t layer);
    void add_disc(glm::dvec2 centre, double radius, std::uint32_t layer);

    const std::vector<LayerEdge>& edges() const { return edges_; }

private:
    void add_ring(std::span<const glm::dvec2> corners, std::uint32_t layer);
    void add_edges(const std::vector<LayerEdge>& edges, std::uint32_t layer);
    void add_wedge(glm::dvec2 centre, glm::dvec2 first, glm::dvec2 last, double angle, std::uint32_t layer);

    double tolerance_;
    Monitor monitor_;
    std::vector<LayerEdge> edges_;
};

/// Number of chords for an arc. @param angle  in radians, positive
int chords_of(double angle, double radius, double tolerance);

}  // namespace sikku
