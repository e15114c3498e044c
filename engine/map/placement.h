// engine/map/placement.h: places the vertices of maps in the plane.
#pragma once

#include "engine/map/map_step.h"
#include "engine/map/pressure.h"

#include <glm/vec2.hpp>
#include <optional>
#include <stdexcept>
#include <vector>

namespace sikku {

/// A map that cannot be placed as its pattern states.
class PlacementError : public std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// Derives a map and places its vertices in every step, as its system states: on straight lines, each in the middle
/// of its neighbours, or where springs and pressure are at rest. y points up. The polygon of the axiom has the radius
/// 1 around 0 0; maps under pressure have the size at which they are at rest, with the centroid of their outline at 0
/// 0.
class PlacedMap {
public:
    /// @param grammar  has a map; must outlive this object
    /// @throws PlacementError if the axiom has fewer than 3 edges; BudgetError
    explicit PlacedMap(const Grammar& grammar, const MapLimits& limits = {}, const Monitor& monitor = {});

    /// Makes the next step; false if there is none. @throws BudgetError, Stopped; PlacementError for a cell that
    /// pressure cannot open: one of two edges, or one without area even under gravity
    bool next();
    const Map& map() const { return derivation_.map(); }
    const MapDerivation& derivation() const { return derivation_; }
    /// Positions of the vertices, stretched. Cost: linear; under gravity that of solving for them. @throws Stopped
    std::vector<glm::dvec2> vertices() const;
    /// The springs and the pressure, or null under another placement.
    const PressedMap* pressed() const { return pressed_ ? &*pressed_ : nullptr; }

private:
    void relax();

    const MapSystem& system_;
    Monitor monitor_;
    MapDerivation derivation_;
    std::vector<glm::dvec2> straight_;  // empty under pressure
    std::optional<PressedMap> pressed_;
};

/// Positions of the axiom's vertices: a regular polygon around 0 0 with the radius 1, vertex 0 lowest, or at the left
/// end of the lowest side.
std::vector<glm::dvec2> axiom_polygon(const MapSystem& system);

/// Places each inner vertex in the middle of its neighbours. @param outline  positions; those of inner vertices are
/// ignored. Cost: conjugate gradients with about as many steps as the map has edges across.
/// Source: Tutte 1963, How to draw a graph.
std::vector<glm::dvec2> placed_by_gravity(const Map& map, std::vector<glm::dvec2> outline,
                                          const Monitor& monitor = {});

/// Places the outer vertices at equal steps on the circle of radius 1, vertex 0 in the direction `first`.
/// Other vertices are at 0 0.
std::vector<glm::dvec2> outline_on_circle(const Map& map, const glm::dvec2& first);

}  // namespace sikku
