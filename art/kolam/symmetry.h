// art/kolam/symmetry.h: what maps a drawing onto itself.
#pragma once

#include "art/kolam/lines.h"

#include <cstdint>
#include <glm/vec2.hpp>
#include <vector>

namespace sikku::kolam_plane {

struct SymmetryFound {
    KolamSymmetry group;
    glm::dvec2 centre{0.0};
    std::vector<std::uint32_t> orbit_of_line;  ///< as KolamExamination has it
};

/// Finds the symmetries of a drawing. Of straight lines the longest straight pieces must be mapped onto each other,
/// of splines the control points with both neighbours. Plane is ExactPlane or RoughPlane.
template <class Plane>
SymmetryFound find_symmetry(const Plane& plane, const PlanarGraph& graph, const Strokes& strokes, const Lines& lines,
                            const KolamOptions& options);

}  // namespace sikku::kolam_plane
