// art/print/tiles.h: a print over many sheets, to be glued together.
#pragma once

#include "art/print/print.h"

#include <filesystem>
#include <vector>

namespace sikku {

/// The sheets that a print is cut into.
struct TileOptions {
    Page sheet;             ///< upright or on its side; nothing is printed in its margins but the sheet's number
    double overlap = 10.0;  ///< millimetres that neighbouring sheets share
};

/// One sheet.
struct Tile {
    int row = 1, column = 1;  ///< from the top left, from 1
    Window area;              ///< of the print, in millimetres, that lies within the sheet's margins
    Window shown;             ///< the part of it that is on the page
    Window cut;               ///< what is left when the sheets are cut along the middle of what they share
};

/// How a print is cut.
struct Tiling {
    Page sheet;  ///< turned if fewer sheets are needed that way
    double overlap = 0;
    int rows = 0, columns = 0;
    std::vector<Tile> tiles;  ///< row by row
};

/// Cuts a page into as few sheets as hold what lies within its margins; the sheets are centred on the page, and show
/// as much of its margins as they have room for.
/// @throws std::runtime_error if the overlap leaves no room on a sheet, and for over 400 sheets
Tiling tiling_of(const Page& page, const TileOptions& options);

/// `kolam.svg` becomes `kolam-2-3.svg`.
std::filesystem::path tile_file(const std::filesystem::path& file, const Tile& tile);

/// Where the sheet's own top left corner lies on the print.
glm::dvec2 tile_corner(const Tiling& tiling, const Tile& tile);

/// Prints of lines and letters in millimetres, y up from the top left corner: what lies on the sheets beside the
/// print. They have no ground. Colour 0 is a halo in the colour of the ground of the whole print, colour 1 an ink
/// that stands out from it, and colour 2 black.
Print mark_print(const Page& page, double dpi, const std::optional<Colour>& ground);

/// Draws into a mark_print() crosses at the corners where sheets are cut: neighbouring sheets have them in the same
/// places of the print. And the title with the row and column, where a neighbour covers it, or else in the margin.
void draw_tile_marks(const Tiling& tiling, const Tile& tile, const std::string& title, PathSink& sink);

/// Draws into a mark_print() of one sheet where all sheets lie on the print, with their numbers.
/// @param place  of the print on the sheet, in millimetres; it keeps its shape
void draw_tile_overview(const Tiling& tiling, const Page& page, const Window& place, const std::string& title,
                        PathSink& sink);

}  // namespace sikku
