// art/print/repeat.h: repeats of a drawing: friezes, the wallpaper groups, rings.
#pragma once

#include "art/print/page.h"

#include <glm/mat3x2.hpp>
#include <glm/vec2.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace sikku {

/// The repetition of a drawing.
struct Repeat {
    std::string group;             ///< `frieze`, `p4m`, `packed`, `ring`, …
    int columns = 1, rows = 1;     ///< translation cells; of a ring, `columns` copies
    double gap = 0.08;             ///< space between neighbouring copies; negative: they overlap
    bool gap_is_in_steps = false;  ///< the gap is in turtle steps, not a part of the drawing's larger side
    /// Cover the page: `columns` cells are as wide as the page within its margins, unless the step is fixed, and the
    /// wallpaper extends to the edges.
    bool fills = false;

    /// Number of copies of the drawing; if they fill a page, about the number on an upright page of paper.
    int copies() const;
};

/// Maximum number of copies.
constexpr int most_copies = 10'000;

/// Parses `GROUP[:COUNT][,gap=GAP]`. The group is a wallpaper group by its name (p1 p2 pm pg cm pmm pmg pgg cmm p4
/// p4m p4g p3 p3m1 p31m p6 p6m), or `packed` for translated copies as in densest_lattice(), with `COLUMNSxROWS` cells
/// (3x3), or `fill` or `COLUMNSxfill` to cover the page; a
/// frieze group: frieze (translations alone), frieze-p11g, -p1m1, -p11m, -p2, -p2mg, -p2mm, with a number of cells
/// (5), or `fill` for a row from edge to edge of the page; or ring with a number of copies (8). The gap is in steps,
/// or in percent of the drawing's larger side (8%). Nullopt for anything else and for more than most_copies.
std::optional<Repeat> parse_repeat(std::string_view text);

/// All names of groups, in the order of parse_repeat().
std::vector<std::string_view> repeat_groups();

/// Returns the maps that make the copies, in drawing order: row by row and cell by cell, or clockwise around a ring
/// from the top. The drawing lies in the asymmetric unit of the group with the least cell for which no two copies
/// come closer than the gap (measured by their convex hulls, in rectangular units by their boxes). The origin of the
/// maps is that of the group in the International Tables for Crystallography, vol. A.
/// @param hull  points of the convex hull of the drawing; at least one
/// @param ink   width of its lines in steps, which is added to the gap
std::vector<glm::dmat3x2> copies_of(const Repeat& repeat, std::span<const glm::dvec2> hull, double ink = 0);

/// An endless wallpaper: the copies of one cell, and the vectors by which the cell is repeated.
struct Wallpaper {
    std::vector<glm::dmat3x2> cell;
    glm::dvec2 across{0.0}, up{0.0};
    bool is_row = false;  ///< a frieze, which repeats across only
};
/// The wallpaper of a group, with copies as in copies_of(). @param repeat  not a ring
Wallpaper wallpaper_of(const Repeat& repeat, std::span<const glm::dvec2> hull, double ink = 0);

/// Share of a wallpaper or frieze that the convex hulls of its copies cover, 0 to 1. @param repeat  not a ring
double covered_share(const Repeat& repeat, std::span<const glm::dvec2> hull, double ink = 0);

/// The copies of a wallpaper that may reach into an area, row by row from the top.
/// @param box  box of the copied drawing @param area  in the coordinates of the copies
/// @throws std::runtime_error for more than most_copies
std::vector<glm::dmat3x2> covering_copies(const Wallpaper& wallpaper, const Box& box, const Box& area);

}  // namespace sikku
