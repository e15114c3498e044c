// art/print/tiles.h: a print over many sheets, to be glued together.
#pragma once

#include "art/print/print.h"

#include <filesystem>
#include <vector>

namespace sikku {

/// The sheets that a print is cut into. Each shows what of it lies within its margins, and what goes on into them;
/// neighbours share `overlap` millimetres.
struct TileOptions {
    Page sheet;
    double overlap = 10.0;
};

struct Tile {
    int row = 1, column = 1;  ///< from the top left, from 1
    Window shown;             ///< of the print, in millimetres; what lies within the sheet's margins
};

/// Row by row. @throws std::runtime_error if the overlap leaves no room on a sheet, and for over 400 sheets
std::vector<Tile> tiles_of(const Page& page, const TileOptions& options);

/// `kolam.pdf` becomes `kolam-2-3.pdf`.
std::filesystem::path tile_file(const std::filesystem::path& file, const Tile& tile);

/// The print on one sheet: page, placement and title of its own.
Print tile_print(const Print& print, const Tile& tile, const TileOptions& options);

/// Crosses at the corners of what is shown, where neighbours are laid on each other, and the sheet's number below:
/// in thin lines of that colour.
void draw_tile_marks(const Print& sheet, const Tile& tile, const TileOptions& options, int colour, PathSink& sink);

/// Passes on what of a drawing may be seen in a box of it, in strokes of their own where it leaves and comes back.
class ClipSink : public PathSink {
public:
    /// @param box  in steps, the pen's width around it included
    ClipSink(PathSink& sink, const Box& box) : sink_(sink), box_(box) {}

    void begin_stroke(glm::dvec2 start, const Pen& pen) override;
    void lines(std::span<const glm::dvec2> ends) override;
    void curves(std::span<const glm::dvec2> controls) override;
    void change_pen(const Pen& pen) override;
    void end_stroke(bool closed) override;
    void polygon(std::span<const glm::dvec2> vertices, const Pen& pen) override;
    void area(std::span<const glm::dvec2> outline, const Pen& pen) override;
    void disc(glm::dvec2 centre, double radius, const Pen& pen) override;

private:
    bool sees(std::span<const glm::dvec2> points) const;
    void lift(bool closed);
    void start();

    PathSink& sink_;
    Box box_;
    Pen pen_;
    glm::dvec2 at_{0.0};
    bool is_down_ = false;
    bool is_whole_ = true;  ///< nothing of the stroke was left out
};

}  // namespace sikku
