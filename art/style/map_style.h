// art/style/map_style.h: how maps are drawn, from the keys cells, tension, inset, wall width, fill and tissue.
#pragma once

#include "art/style/colour.h"
#include "engine/language/pattern.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace sikku {

/// Style of the outlines of a map's cells.
enum class CellOutlines : std::uint8_t { walls, splines, both };
/// The property that determines the colour of a cell.
enum class CellFill : std::uint8_t { none, colour, age, sides };

struct MapStyle {
    CellOutlines cells = CellOutlines::walls;
    double tension = 0;          ///< tension of splines, 0 or more; 0 is the uniform B-spline
    double inset = 0.07;         ///< share by which a spline's control points move towards the cell's middle, 0 to <1
    bool widths_by_age = false;  ///< walls are as many strokes wide as they are steps old, counted from 1
    CellFill fill = CellFill::none;
    std::optional<Colour> tissue;  ///< colour of the area within the outer wall, under the cells; absent: none
    /// Colours for ages 0, 1, 2 … or for 3, 4, 5 … sides; the last one stands for all above.
    std::vector<Colour> classes;

    bool draws_walls() const { return cells != CellOutlines::splines; }
    bool draws_splines() const { return cells != CellOutlines::walls; }
};

/// Reads the keys of maps. `palette:` gives the classes. The colour of CellFill::colour is read by read_style().
/// @param palette  palette of the pattern; empty if it has none
MapStyle read_map_style(const Pattern& pattern, const std::vector<Colour>& palette, Diagnostics& diagnostics);

}  // namespace sikku
