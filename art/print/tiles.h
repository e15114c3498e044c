// art/print/tiles.h: cuts a print into sheets that are glued together.
#pragma once

#include "art/print/print.h"

#include <filesystem>
#include <vector>

namespace sikku {

/// Options of a tiled print.
struct TileOptions {
    Page sheet;             ///< in either orientation; only the sheet's number is printed in its margins
    double overlap = 10.0;  ///< millimetres that neighbouring sheets share
};

/// One sheet of a tiled print.
struct Tile {
    int row = 1, column = 1;  ///< from the top left, from 1
    Window area;              ///< part of the print within the sheet's margins, in millimetres
    Window shown;             ///< the part of `area` that lies on the page
    Window cut;               ///< the part left when the sheets are cut along the middle of their overlaps
};

/// The layout of a tiled print.
struct Tiling {
    Page sheet;  ///< turned if fewer sheets are needed that way
    double overlap = 0;
    int rows = 0, columns = 0;
    std::vector<Tile> tiles;  ///< row by row
};

/// Covers the area within a page's margins with as few sheets as possible. The sheets are centred on the page, and
/// show as much of its margins as they have room for.
/// @throws std::runtime_error if the overlap leaves no room on a sheet, and for over 400 sheets
Tiling tiling_of(const Page& page, const TileOptions& options);

/// Names the file of a sheet: `kolam.svg` becomes `kolam-2-3.svg`.
std::filesystem::path tile_file(const std::filesystem::path& file, const Tile& tile);

/// The position of the sheet's top left corner on the print.
glm::dvec2 tile_corner(const Tiling& tiling, const Tile& tile);

/// Makes a print for the marks on a sheet: lines and letters in millimetres, y up from the top left corner, without
/// ground. Colour 0 is a halo in the colour of the ground of the whole print, colour 1 an ink that stands out from
/// it, and colour 2 black.
Print mark_print(const Page& page, double dpi, const std::optional<Colour>& ground);

/// Draws the marks of a sheet into a mark_print(): crosses at the corners where sheets are cut, at the same places of
/// the print on neighbouring sheets; and the title with row and column, where a neighbour covers it or in the margin.
void draw_tile_marks(const Tiling& tiling, const Tile& tile, const std::string& title, PathSink& sink);

/// Draws an overview into a mark_print(): the positions of all sheets on the print, with their numbers.
/// @param place  position of the print on the sheet, in millimetres, in the proportions of the print
void draw_tile_overview(const Tiling& tiling, const Page& page, const Window& place, const std::string& title,
                        PathSink& sink);

}  // namespace sikku
