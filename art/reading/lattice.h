// art/reading/lattice.h: fits a lattice of dots through points, in perspective.
#pragma once

#include "art/kolam/dot_grid.h"
#include "engine/base/monitor.h"

#include <array>
#include <cstddef>
#include <glm/vec2.hpp>
#include <optional>
#include <span>
#include <vector>

namespace sikku {

/// A projective map of the plane. The default is the identity.
class Homography {
public:
    Homography() = default;
    /// Fits points to their images: the least squares of the linear equations of Hartley & Zisserman, Multiple View
    /// Geometry, 2004, section 4.1. Three points, or points on two lines at most, give an affine map.
    /// @return nullopt if they do not determine a map
    static std::optional<Homography> fit(std::span<const glm::dvec2> from, std::span<const glm::dvec2> to);

    glm::dvec2 operator()(glm::dvec2 point) const;
    /// The derivatives by x and y at a point.
    std::array<glm::dvec2, 2> derivatives(glm::dvec2 point) const;
    std::optional<Homography> inverse() const;

private:
    std::array<double, 9> m_ = {1, 0, 0, 0, 1, 0, 0, 0, 1};
};

/// The middle one of values, or the upper of the two; 0 if there are none.
double median(std::vector<double> values);

/// The place of the lattice nearest to a point of its plane.
GridDot nearest_place(DotLattice lattice, glm::dvec2 point);

struct LatticeFit {
    DotLattice lattice = DotLattice::square;
    Homography map;                              ///< maps the plane of the lattice to that of the points
    std::vector<std::optional<GridDot>> places;  ///< place of each point; absent if it lies off the lattice
    std::size_t fitted = 0;                      ///< points that have a place
    double angle = 90;                           ///< degrees between its two shortest steps, 60 to 90, in the middle
    Homography patch_map;                        ///< fitted to the patch alone
    std::vector<std::optional<GridDot>> patch;   ///< place of each point of the patch, which follows bent rows
};

/// Fits a lattice through most of the points; others may lie between its places, and places may be empty. Grows a
/// patch from each of several points, by steps that follow the perspective, and fits a map to the largest one.
/// Steps nearer to 60 than to 90 degrees make a triangular lattice.
/// @param y_down   the points' y points down, as in pictures
/// @param lattice  accept only this one
/// @param step     length of its steps, if known
/// @return nullopt for fewer than two points
/// Cost: about 0.1 s for 2000 points.
std::optional<LatticeFit> fit_lattice(const std::vector<glm::dvec2>& points, bool y_down,
                                      std::optional<DotLattice> lattice = std::nullopt, const Monitor& monitor = {},
                                      std::optional<double> step = std::nullopt);

}  // namespace sikku
