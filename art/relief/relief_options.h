// art/relief/relief_options.h: options of a relief, and the report about the result.
#pragma once

#include "art/print/format.h"
#include "art/style/colour.h"

#include <glm/vec3.hpp>

#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

namespace sikku {

/// Lengths are millimetres. Heights are measured from the top of the base; negative ones are depths.
struct ReliefOptions {
    std::vector<double> heights{2.0};  ///< heights of colours, in the order of the palette, repeated
    std::vector<double> ridges{};      ///< the same for lines; empty: `heights` apply to lines, too
    double base = 1.2;                 ///< thickness, 0 or more
    std::optional<double> beyond{};    ///< how far the base reaches beyond the drawing; absent: it is the page
    double groove = 0.4;               ///< width between polygons
    PrintFormat format = PrintFormat::stl;
};

struct ReliefReport {
    std::size_t triangles = 0;
    std::size_t materials = 0;
    glm::dvec3 size{0.0};                            ///< millimetres
    double volume = 0;                               ///< cubic millimetres
    std::vector<std::pair<Colour, double>> heights;  ///< heights above the base, in the order of the options
    std::vector<std::pair<Colour, double>> ridges;   ///< the same for lines that have their own
    std::size_t lost = 0;                            ///< polygons that are narrower than the groove
    double narrowest = 0;                            ///< width of the narrowest line in millimetres; 0: without lines
};

}  // namespace sikku
