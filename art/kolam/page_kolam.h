// art/kolam/page_kolam.h: kolams whose grid grows until it fills a page.
#pragma once

#include "art/kolam/dot_rectangle.h"
#include "art/kolam/grid_kolam.h"

#include <glm/vec2.hpp>
#include <optional>
#include <string>

namespace sikku {

/// The room that a kolam is to fill, and what is given of its grid.
struct PageFill {
    DotRectangle given;               ///< sides of 0 grow with the page
    glm::dvec2 room{0.0};             ///< width and height of the page within margins and border, in millimetres
    std::optional<double> spacing{};  ///< approximate distance between dots, in millimetres, if both sides grow
};

/// A kolam that fills a page.
struct PageKolam {
    DotGrid grid;
    GridKolam kolam;
    KolamPatternOptions look;  ///< with title and description
    KolamPattern pattern;
    double spacing = 0.0;      ///< millimetres between dots when the drawing fits the room
    double slack = 0.0;        ///< the larger of the spaces that are left across and down, in spacings
    std::string skipped = {};  ///< why a grid that fills the page better was not chosen; empty if there is none
};

/// Makes a kolam on the rectangle whose drawing has the proportions of the room as nearly as whole dots permit; with
/// a single line or a symmetry, on the nearest one that permits these. If the longer side grows, at most half a
/// spacing of slack remains on straight grids; a symmetry may add one. On interlaced grids, and with other rims than
/// round ones, loops at the rim differ in size: seeds derived from the given one are tried until half a spacing
/// suffices. Cost: one kolam, or up to 18.
/// @param look  how the pattern is drawn; title and description are replaced
/// @throws std::runtime_error if no grid fills the room, and as make_grid_kolam() and kolam_pattern()
PageKolam make_page_kolam(const PageFill& fill, const GridKolamOptions& options, const KolamPatternOptions& look,
                          const Monitor& monitor);

}  // namespace sikku
