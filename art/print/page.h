// art/print/page.h: paper sizes, and the placement of a drawing on a page.
#pragma once

#include "engine/geometry/box.h"

#include <glm/mat3x2.hpp>
#include <glm/vec2.hpp>
#include <optional>
#include <string_view>

namespace sikku {

/// A sheet in millimetres.
struct Page {
    double width = 210.0;
    double height = 297.0;
    double margin = 10.0;  ///< on all four sides
};

/// Parses a paper size: a name, for an upright page (`A0` … `A10`, also `2A0`, `4A0`, `B0` … `B10`, `C0` … `C10`,
/// `JIS B0` … `JIS B10`, `RA0` … `RA4`, `SRA0` … `SRA4`, `letter`, `legal`, `tabloid`, `ledger`, `executive`,
/// `statement`, `ANSI A` … `ANSI E`, `Arch A` … `Arch E`, `Arch E1`; any case; blanks and hyphens are ignored), or
/// `WIDTHxHEIGHT` with units (`300x300mm`, `50x70cm`, `20cmx30cm`, `12x18in`; a unit at the end applies to both).
/// Returns width and height in millimetres; their range is not checked here.
std::optional<glm::dvec2> parse_size(std::string_view text, double dpi);

/// Maps pattern units to millimetres on the page, y down from the top left corner.
struct Placement {
    glm::dmat3x2 to_page{1.0};  ///< page = to_page * (x, y, 1)
    double step = 1.0;          ///< millimetres of one turtle step
};

/// The shape and the mass of a drawing, for its composition on a page.
struct Balance {
    double fullness = 1.0;  ///< share of the box that the convex hull covers
    glm::dvec2 mass{0.0};   ///< from the centre of the box to the centre of mass, as parts of the box's sides, y up
};

/// Options of the placement.
struct PlacementOptions {
    double rotate = 0.0;         ///< degrees anticlockwise, applied to the drawing
    bool mirror = false;         ///< left and right exchanged, before the rotation
    std::optional<double> step;  ///< millimetres of a step; absent: fit into the margins
    double scale = 1.0;          ///< fraction of the page that a fitted drawing fills (`scale factor:`)
    /// Composes the page: a fitted drawing leaves more room the more it fills its box and the less it has the page's
    /// proportions; its mass is moved towards the optical centre, above the middle, but the drawing stays within the
    /// margins. Absent: the box fills the page and lies in the middle.
    std::optional<Balance> balance{};
};

/// The rotation and mirroring alone, to measure the box of the drawing as it will lie on the page (y up).
glm::dmat3x2 orientation(const PlacementOptions& options);

/// Centres `box` (measured after orientation(), in turtle steps, y up) on the page. `ink_steps` and `ink_mm` widen
/// the box on every side for the half width of the pen, in steps or in millimetres. Fitting solves for the step
/// so that box and pen together touch the margins. A box without extent is drawn at 10 mm a step.
Placement place(const Box& box, const Page& page, const PlacementOptions& options, double ink_steps, double ink_mm);

}  // namespace sikku
