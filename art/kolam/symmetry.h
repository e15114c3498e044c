// art/kolam/symmetry.h: finds the symmetries of a drawing.
#pragma once

#include "art/kolam/lines.h"

#include <cstdint>
#include <glm/vec2.hpp>
#include <vector>

namespace sikku::kolam_plane {

struct SymmetryFound {
    KolamSymmetry group;
    glm::dvec2 centre{0.0};
    std::vector<std::uint32_t> orbit_of_line;  ///< as in KolamExamination
};

/// Finds the symmetries of a drawing. A symmetry maps the maximal straight pieces of straight lines, or the control
/// points of splines with their neighbours, onto each other. Plane is ExactPlane or RoughPlane.
template <class Plane>
SymmetryFound find_symmetry(const Plane& plane, const PlanarGraph& graph, const Strokes& strokes, const Lines& lines,
                            const KolamOptions& options);

}  // namespace sikku::kolam_plane
