// art/reading/kolam_svg.h: reads a kolam from the paths of an SVG.
#pragma once

#include "art/reading/read_kolam.h"

#include <optional>
#include <string_view>

namespace sikku {

/// Reads the stroked paths, polylines and polygons of an SVG as lines, and filled circles and ellipses as dots;
/// without any, dots are placed as tradition does. Transforms of elements apply; style sheets, `use`, clips and
/// masks do not. Open lines are left out, and noted. Safe for untrusted texts.
/// @param lattice  accept only this one
/// @throws std::runtime_error for damaged XML and paths, and if no lattice of dots fits
ReadKolam read_kolam_svg(std::string_view text, std::optional<DotLattice> lattice = std::nullopt,
                         const Monitor& monitor = {});

}  // namespace sikku
