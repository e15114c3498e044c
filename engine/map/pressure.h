// engine/map/pressure.h: places the vertices of a map by springs in its edges and pressure in its cells.
#pragma once

#include "engine/base/monitor.h"
#include "engine/map/map_step.h"

#include <glm/vec2.hpp>
#include <optional>
#include <vector>

namespace sikku {

/// A map in which each edge pulls its ends with a force of stiffness x length, and each cell presses on its walls
/// with content / area. At rest the energy E = sum of stiffness x length² / 2 over the edges - sum of content x
/// ln(area) over the cells has a local minimum. Source: Fracchia, Prusinkiewicz & de Boer 1990.
class PressedMap {
public:
    /// All edges have stiffness 1, all cells content 1.
    PressedMap(const Map& map, std::vector<glm::dvec2> vertices);

    /// Follows a derivation step: the parts of an edge divide its length equally; k parts have k^(1 - growth) times
    /// its stiffness, d daughters d^(growth - 1) times the content of their mother; walls have stiffness 1.
    void follow(const Map& before, const Map& after, const MapOrigins& origins, double growth);

    /// The first cell without positive area, which has no energy.
    std::optional<std::size_t> cell_without_area(const Map& map) const;

    /// Moves the vertices until no component of a force is 1e-8 or more. All areas must be positive, and stay so.
    /// Newton's method, with conjugate gradients for each step. Cost: about 15 to 30 steps.
    /// @throws std::runtime_error if 1,000 steps are not enough; Stopped
    void relax(const Map& map, const Monitor& monitor = {});

    double energy(const Map& map) const;
    const std::vector<glm::dvec2>& vertices() const { return vertices_; }
    void set_vertices(std::vector<glm::dvec2> vertices) { vertices_ = std::move(vertices); }
    const std::vector<double>& stiffness() const { return stiffness_; }  ///< of each edge
    const std::vector<double>& contents() const { return contents_; }    ///< of each cell

private:
    std::vector<glm::dvec2> vertices_;
    std::vector<double> stiffness_;
    std::vector<double> contents_;
};

/// The area of a cell, positive if its wall runs clockwise.
double area_of_cell(const Map& map, std::size_t cell, const std::vector<glm::dvec2>& vertices);

/// Positions of the vertices after a step: new ones divide their edge into equal parts.
std::vector<glm::dvec2> divided_equally(const Map& before, const MapOrigins& origins,
                                        const std::vector<glm::dvec2>& vertices);

}  // namespace sikku
