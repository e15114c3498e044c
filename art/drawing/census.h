// art/drawing/census.h: counts the lines, polygons and surfaces of a word for forecasts, by reading it or a
// shorter one.
#pragma once

#include "art/print/page.h"
#include "art/style/style.h"
#include "engine/language/grammar.h"

#include <glm/mat3x2.hpp>

#include <vector>

namespace sikku {

/// Patches of surfaces with about the same bend.
struct BentPatches {
    double bend = 0;  ///< see bend_of()
    double count = 0;
};

/// The shapes drawn in one pass. Lengths are in turtle steps.
struct DrawnCensus {
    double nodes = 0;                 ///< visited nodes of the derivation
    double strokes = 0;               ///< lines without a lift
    double lines = 0;                 ///< segments of strokes
    double length = 0;                ///< length of all lines
    double polygons = 0;              ///< polygons and areas
    double corners = 0;               ///< corners of polygons
    double discs = 0;                 ///< discs and spheres
    double patches = 0;               ///< patches of surfaces in space
    double area = 0;                  ///< area of polygons, discs and patches
    Box box;                          ///< box of all points, after orientation(), or projected if in space
    double widest = 0;                ///< widest pen, in the unit of the style's stroke
    double mean_width = 0;            ///< width of lines, weighted by length, in the same unit
    double deepest = 0;               ///< extent along the line of sight, in space
    std::vector<BentPatches> bent{};  ///< the patches; bends that differ by less than a fifth are grouped
    bool is_read = false;             ///< the word itself was read, and not a shorter one
};

/// Reads at most about `most` nodes. For a longer word it reads the largest shorter one that is known to cost
/// less, and extrapolates by the numbers of symbols or, where these are unknown, by growth.
/// Cost: 20 ns a node. @param grammar  without a map
/// @throws WordError
DrawnCensus drawn_census(const Grammar& grammar, const Style& style, const glm::dmat3x2& orientation, double most);

}  // namespace sikku
