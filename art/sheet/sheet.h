// art/sheet/sheet.h: draws many prints on one sheet: a poster, rows of generations, a contact sheet.
#pragma once

#include "art/print/print.h"
#include "art/writer/draw.h"
#include "engine/base/cost.h"
#include "engine/language/grammar.h"

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace sikku {

/// One drawing of a sheet. It fills its cell, on its own ground, in its own style. Widths in millimetres are meant
/// for an A4 page, and are scaled with the drawing, but lines are not thinned below 0.1 mm. Rotation, mirroring and
/// step of the placement are used; `scale` is ignored.
/// Cells either all have slots, or are laid out in rows.
struct SheetCell : DrawingOptions {
    std::shared_ptr<const Grammar> grammar;
    Style style;
    std::string title;                 ///< title of its layers
    std::vector<std::string> caption;  ///< paragraphs, the first of them in larger letters
    std::string heading;               ///< if not empty, begins a row under this heading
    std::optional<Window> slot;        ///< place on the sheet, in millimetres; absent: in the rows of the sheet
    double budget = 200e6;             ///< maximum number of derivation nodes visited in one pass
};

struct SheetOptions : WriterOptions, PictureOptions, PlotSetup {
    SheetOptions() { page = {420.0, 594.0, 20.0}; }

    PrintFormat format = PrintFormat::svg;
    std::optional<Colour> ground = Colour{0xf7, 0xf4, 0xec, 255};  ///< ground between the cells
    std::optional<Floor> floor{};                                  ///< floor whose mean colour is the ground
    Colour ink{0x2a, 0x26, 0x22, 255};                             ///< colour of title and captions
    Colour pale_ink{0x66, 0x5f, 0x56, 255};                        ///< colour of their less important parts
    std::string title;                                             ///< title above all cells; empty: none
    std::string subtitle;                                          ///< line under the title
    std::shared_ptr<const Font> font{};  ///< font of all these texts and of captions; null: single strokes
    std::string footer;                  ///< line in the bottom margin, in the middle; empty: none
    int columns = 0;            ///< 0: the number for which the drawings are largest; rows under a heading may break
    std::optional<double> gap;  ///< millimetres between cells, exactly; absent: about a tenth of their width
    double inset = 0.08;        ///< space between a cell's border and its drawing, as part of the cell
    std::optional<double> letters;  ///< height of a caption's capitals in millimetres; absent: by the cell's width
    bool is_centred = false;        ///< headings and captions are centred instead of beginning on the left
    std::size_t caption_lines = 5;  ///< maximum number of lines of a caption; longer ones end in `…`
    /// Use one scale, in each row if rows have headings, otherwise in all: the same distance between dots if all
    /// draw dots, otherwise the same step length.
    bool same_scale = false;
    std::string pattern;   ///< text stored in the file, so that it can be made again
    std::string made;      ///< recipe stored in the file
    double memory = 0;     ///< bytes for the pixels and cells of a picture at a time; 0: no limit
    Monitor monitor = {};  ///< polled in long stages that read no words
    /// Called with the number of symbols read since the last call, from one thread at a time; may throw to stop.
    std::function<void(std::uint64_t symbols)> watch;
};

/// Height of the capitals of a sheet's title if it fits the page's width, in millimetres.
inline double sheet_title_height(const Page& page) {
    return std::clamp(0.032 * std::min(page.width, page.height), 2.0, 40.0);
}
/// Height of a title without a subtitle and of the space below it, as a multiple of the height of its capitals.
constexpr double sheet_title_room = 2.2;

/// The layout of a sheet, in millimetres from its top left corner.
struct SheetLayout {
    int columns = 0;
    int rows = 0;
    std::vector<Window> windows;  ///< windows of the cells, in their order
    double letters = 0.0;         ///< height of a caption's capitals
    std::optional<PlotReport> plot;
    std::uint64_t polygons = 0;       ///< number of filled polygons that can be named
    std::string letters_warning;      ///< warning of characters in its texts that the lettering lacks
    std::vector<DrawReport> reports;  ///< findings of the drawings, in their order; without places and plots
};

/// Draws the sheet into `file`, which appears whole or not at all; the same cells give the same bytes. Windows and,
/// in pictures, words of any order are handled as in draw(). Pictures are made row by row: memory holds the pixels of
/// one row and, for each thread, one drawing, as in Raster. If that exceeds the memory of the options, a row is made
/// in bands, with all its drawings in memory; the bytes are the same.
/// Plots (HP-GL, G-code, or with plot options) hold the lines and fills of all cells, without their grounds.
/// @throws BudgetError, WordError and std::runtime_error, naming the cell that cannot be drawn; SettingError if there
/// are no cells, the cells do not fit, only some have slots, or slots overlap in a picture; std::runtime_error if
/// memory is insufficient, or the file cannot be written
SheetLayout draw_sheet(const std::vector<SheetCell>& cells, const SheetOptions& options,
                       const std::filesystem::path& file, Destination& destination = file_system());

/// Estimates the bytes that draw_sheet() needs for a picture, before the sheet is laid out: those for whole rows if
/// the options allow that, otherwise the minimum. For other formats, the memory of the drawings.
/// @throws exceptions of draw_sheet() for cells that cannot be drawn
double sheet_memory(const std::vector<SheetCell>& cells, const SheetOptions& options);

/// Forecasts the cost of draw_sheet(). @throws as sheet_memory()
Cost sheet_cost(const std::vector<SheetCell>& cells, const SheetOptions& options);

/// The caption of a pattern: title, derivation length, angle, and productions, which are quoted from the file if they
/// have parameters, conditions or weights.
std::vector<std::string> caption_of(const Grammar& grammar, const std::string& title, const Pattern& pattern);

/// The cells of a row that shows derivation lengths from `first` to `last`, with captions `n = 2`, and the heading at
/// the first. `cell` is their model. @throws std::runtime_error if the schedule is too short
std::vector<SheetCell> generations(const SheetCell& cell, std::int64_t first, std::int64_t last);

}  // namespace sikku
