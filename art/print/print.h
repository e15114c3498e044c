// art/print/print.h: the data of a print besides its drawing, and the interface of print writers.
#pragma once

#include "art/print/page.h"
#include "art/print/press.h"
#include "art/style/style.h"
#include "engine/geometry/path.h"

#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace sikku {

/// One step of a lesson in an SVG, and its timing.
struct LessonPart {
    int number = 0;                   ///< from 0
    int of = 1;                       ///< number of steps, the last of which stays
    double seconds = 3.0;             ///< display time of each step
    double drawing = 2.0;             ///< seconds in which its new lines are drawn
    int first_new = 0, last_new = 0;  ///< indices of the colours of new lines
};

/// Animation of a part of an SVG: attributes of its elements; the style sheet of the file describes their classes.
struct PartMotion {
    std::string part;               ///< attributes of its group
    std::string polygons;           ///< attributes of the group of its polygons
    std::string lines;              ///< attributes of the groups of its lines and discs
    std::vector<std::string> each;  ///< attributes of its polygons, in their order
};

/// Options of a print or of a sheet that writers of files apply.
struct WriterOptions {
    Page page{};
    double dpi = 300.0;                 ///< pixels per inch of pictures
    std::optional<double> animation{};  ///< seconds in which an SVG draws its lines, in the order of the turtle
    bool names_tiles = false;           ///< name the polygons of an SVG, put those of a PDF into layers
    Press press{};                      ///< settings for the print shop
};

/// A print about to be made. Writers keep it by reference and must not outlive it.
struct Print : WriterOptions {
    Style style;
    Placement placement;
    glm::dvec2 floor_corner{0.0};              ///< place of the page's top left corner on the floor, in millimetres
    std::string title;                         ///< title of the pattern, UTF-8
    std::string pattern;                       ///< the text of the pattern file, so that the print can be made again
    std::string made;                          ///< the recipe: `sikku 0.2.0, -n 4`
    std::optional<int> travel_colour;          ///< index of the colour that shows pen-up travel
    bool is_plot = false;                      ///< mark layers that no pen draws
    std::map<int, std::string> layer_names{};  ///< names of line layers by colour index, instead of number and colour
    std::optional<LessonPart> lesson;          ///< lesson of a part of an SVG: see PrintWriter::begin_part()
    const PartMotion* motion = nullptr;        ///< motion of a part of an SVG; kept by reference
    std::string style_sheet{};                 ///< style sheet of an SVG whose parts move
};

/// A part of a sheet, in millimetres from its top left corner.
struct Window {
    double left = 0.0, top = 0.0;
    double width = 0.0, height = 0.0;
    bool clips = false;   ///< cut off parts of the drawing outside
    double margin = 0.0;  ///< margin within it on all four sides, outside of a border
};

/// The ink of parts too small to be visible: length of lines and their spread, in turtle steps.
struct Blot {
    glm::dvec3 spread{0.0};  ///< covariance: xx, xy, yy
    glm::dvec2 size{0.0};    ///< size of the part's box: the ink covers at most the box widened by the pen
    double length = 0.0;
};

/// Receives a drawing in which some parts are blots.
class BlotSink : public PathSink {
public:
    /// Begins a line of the turtle at a position; its visible parts follow as strokes, until it ends at another
    /// position.
    virtual void begin_line(glm::dvec2) {}
    virtual void end_line(glm::dvec2) {}
    /// Prepares a kind of blot and returns its number; equal requests may be repeated.
    virtual std::size_t prepare(const Blot& blot, const Pen& pen) = 0;
    /// Draws a prepared blot around its centre of mass.
    virtual void blot(std::size_t prepared, glm::dvec2 centre) = 0;
};

/// Receives the drawing of a print and writes it into a file.
class PrintWriter : public PathSink {
public:
    /// Ends the drawing so far and begins another on the same sheet, over the first: with the style, the placement
    /// and the title of `part`, which is kept by reference until the next part or finish(). Its page is the sheet,
    /// but its ground fills only `window`.
    virtual void begin_part(const Print& part, const Window& window) = 0;
    /// Completes the document. Call once, after the last stroke.
    virtual void finish() = 0;
    /// Number of filled polygons drawn so far, in formats that can name them (WriterOptions::names_tiles).
    virtual std::uint64_t polygons() const { return 0; }
};

}  // namespace sikku
