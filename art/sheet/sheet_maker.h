// art/sheet/sheet_maker.h: lays out a sheet and writes it.
#pragma once

#include "art/drawing/drawing.h"
#include "art/drawing/drawing_cost.h"
#include "art/font/letters.h"
#include "art/raster/raster.h"
#include "art/sheet/sheet.h"
#include "art/sheet/sheet_pixels.h"

#include <cstddef>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

namespace sikku {

/// One sheet: measures its drawings, arranges them, and writes them.
class SheetMaker {
public:
    /// `cells` are kept by reference. @throws as draw_sheet()
    SheetMaker(const std::vector<SheetCell>& cells, const SheetOptions& options);

    const Print& print() const { return print_; }
    /// Lays out the sheet, before anything is written.
    const SheetLayout& arrange();
    /// Findings of the drawings. Call after writing.
    std::vector<DrawReport> reports() const;
    /// A warning of characters in its texts that the lettering lacks; empty if it has all.
    std::string missing() const;
    void write_vectors(PrintWriter& writer) const;
    /// Moves the sheet that was arranged to another place on its page, in millimetres.
    void move(glm::dvec2 by);
    /// Writes texts and drawings as parts of a page. The writer keeps references to this object until it begins
    /// another part.
    void write_parts(PrintWriter& writer) const;
    DrawReport write_plot(Output& output) const;
    void write_pixels(Output& output, const std::filesystem::path& file) const;

private:
    /// A line of text on the sheet; `at` in millimetres, y down.
    struct TextLine {
        std::string text;
        glm::dvec2 at;
        double height;
        Pen pen;
    };

    /// The facts about a cell that are known before it has a place.
    struct Subject {
        std::unique_ptr<Drawing> drawing;
        DrawingCost cost;  ///< cost of a picture
        DrawnExtent extent;
        glm::dvec2 size{0.0};  ///< in steps, without the pen
        std::size_t row = 0;   ///< number of the group under one heading; 0 without headings
    };

    /// Rows of cells, with the number of cells in each.
    struct Grid {
        int columns = 0;
        std::vector<int> rows;
        std::vector<bool> headed;  ///< true for rows below a heading
    };

    /// A cell with its place on the sheet.
    struct PlacedCell {
        Window window;
        Print print;  ///< page and placement are those of the sheet
        int row = 0;
    };

    struct Plan {
        SheetLayout layout;
        std::vector<TextLine> texts;
        std::vector<PlacedCell> cells;
    };

    /// The part of a picture that is made at a time.
    struct Room {
        int readers = 1;  ///< drawings
        int rows = 0;     ///< rows of a strip; 0: all
    };

    void watch(std::uint64_t symbols) const {
        if (!options_.watch) return;
        const std::lock_guard lock(watching_);
        options_.watch(symbols);
    }
    void measure();
    std::vector<Grid> grids() const;
    double caption_height(double width, double letters) const;
    void write_title(double left);
    void write_footer();
    double letters_of(double width) const;
    double score(const Grid& grid) const;
    struct Measures {
        double width = 0, height = 0;     ///< size of a cell's window
        double across = 0, down = 0;      ///< from one cell to the next
        glm::dvec2 first{0.0};            ///< the first cell's corner
        double caption = 0, letters = 0;  ///< heights
        double title = 0, heading = 0;    ///< heights that are kept free
        bool fits() const { return width > 1.0 && height > 1.0; }
    };
    Measures measures(const Grid& grid) const;
    double drawn_step(const Subject& subject, double width, double height, double factor) const;
    double pen_factor(const SheetCell& cell, double width, double height) const;
    void arrange_rows();
    void arrange_slots();
    void lay_out(const Grid& grid, const Measures& m);
    std::vector<double> shared_units() const;
    void place_drawings();
    void check_colouring();
    void check_inks() const;
    void write_caption(const SheetCell& cell, const Window& window, double letters);
    /// The beginning of a line of text within a place of that width.
    double aligned(const std::string& text, double height, double left, double width) const {
        return options_.is_centred ? left + (width - letters_.width(text, height)) / 2 : left;
    }
    void write_texts(double top, double bottom, PathSink& sink) const;
    std::vector<Strip> strips(PixelSize size, Colour ground) const;
    Room room(const std::vector<Strip>& strips, double stride) const;

    const std::vector<SheetCell>& cells_;
    SheetOptions options_;
    Letters letters_;
    Print print_;
    std::vector<Subject> subjects_;
    double usual_shape_ = 1.0;  ///< height by width of the drawings
    Plan plan_;
    std::vector<std::optional<RegionReport>> regions_;  ///< of colouring pages
    mutable std::mutex watching_;
};

}  // namespace sikku
