// art/plotter/shading.h: lines that fill shapes for pens: hatching of polygons, spirals in discs.
#pragma once

#include "art/print/page.h"
#include "engine/base/monitor.h"

#include <glm/vec2.hpp>

#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace sikku {

/// Hatching of filled shapes.
struct Hatch {
    double spacing = 0.0;     ///< millimetres between lines; 0: the width of the pen
    double angle = 45.0;      ///< degrees on the page, anticlockwise from its lower edge
    bool is_crossed = false;  ///< hatched a second time, at right angles
};

/// The pen of a plot, and the areas that it fills.
struct PlotPen {
    double pen_width = 0.0;           ///< millimetres; 0: each stroke is drawn with a pen of its own width
    std::optional<Hatch> hatch = {};  ///< hatching of filled shapes; absent: outlines only
    bool leaves_tiles = false;        ///< polygons are not drawn: draw_plot() passes them to the writer of the file
};

/// The one or two directions of the lines, as unit vectors of the drawing that have the given angles on the page.
std::vector<glm::dvec2> hatch_directions(const Hatch& hatch, const Placement& placement);

/// The least and the largest height of a shape along the unit vector `across` its hatching.
/// @throws std::runtime_error for over 10^6 lines in one shape
std::pair<double, double> hatched_heights(std::span<const glm::dvec2> vertices, glm::dvec2 across, double spacing);

/// Hatches a polygon (non-zero winding rule; it may cross itself) with lines along the unit vector `along`,
/// `spacing` apart. All polygons share one set of lines, so that the hatching of neighbours lines up. Ends stay
/// `inset` inside the outline. Ends of successive lines are joined along the outline where nothing lies between them,
/// so that a convex shape becomes a single zigzag; the joins deviate from the outline by less than half the spacing.
/// All lengths are in the units of the vertices.
/// Cost: O(k log k) for k crossings of lines and edges. @throws std::runtime_error for over 10^6 lines in one shape;
/// Stopped
std::vector<std::vector<glm::dvec2>> hatch_lines(std::span<const glm::dvec2> vertices, glm::dvec2 along,
                                                 double spacing, double inset, const Monitor& monitor = {});

/// Fills a disc with a pen that is `pen` wide: a circle half a pen inside the edge, then a spiral to the centre whose
/// turns are at most one pen apart. The spiral is omitted if the circle covers the whole disc. Starts at the right.
/// @param radius  above 0, in the same unit as `pen`
/// @return the start, then three control points for each Bézier, within 0.01 percent of the radius
std::vector<glm::dvec2> spiral(glm::dvec2 centre, double radius, double pen);
/// Radius of the ink of such a spiral: that of the disc, or more if the pen is wider.
double spiral_reach(double radius, double pen);

}  // namespace sikku
