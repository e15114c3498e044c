// art/drawing/drawing_options.h: what a drawing shows, and where on its page.
#pragma once

#include "art/drawing/view_window.h"
#include "art/print/page.h"
#include "art/print/repeat.h"
#include "art/style/style.h"

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace sikku {

class Font;
class Grammar;
class LessonMemo;
class MapFrames;

/// Bounds of the visible drawing in the orientation of the page: in turtle steps, y up, without the pen's width.
struct DrawnExtent {
    Box box;
    double widest = 0.0;  ///< width of pens and dots, in the unit of the style's stroke
    double around = 0.0;  ///< the same for lines that continue outside a window
};

/// A pattern that is drawn as a part of a border.
struct BorderPattern {
    std::shared_ptr<const Grammar> grammar;
    Style style;
};

/// A parallelogram in the coordinates of a drawing.
struct Cell {
    glm::dvec2 corner{0.0};
    std::array<glm::dvec2, 2> sides{};
};

/// A hole between lines that is closed with ink, in steps.
struct Speck {
    glm::dvec2 centre{0.0};
    double radius = 0;
};

/// Size, weight and place of a title line.
struct TitleLook {
    enum class Side : std::uint8_t { left, centre, right };

    std::optional<double> size;  ///< height of capitals in millimetres; absent: by the size of the page
    std::optional<double> stem;  ///< width of single strokes in millimetres, instead of `weight`
    double weight = 0.085;       ///< the same as a share of the height of capitals
    bool is_above = false;       ///< above the drawing, else below
    Side side = Side::left;
};

/// Options of a drawing that users choose.
struct DrawingSettings {
    PlacementOptions placement;
    std::optional<double> dot_spacing;  ///< millimetres between the nearest dots, instead of the placement's step
    std::optional<ViewWindow> window;   ///< the part of the drawing that fills the page within its margins
    bool only_dots = false;             ///< draw only the dots of a kolam, to practise on
    bool colours_strokes = false;       ///< draw each stroke in the next colour of the palette
    std::optional<Repeat> repeat{};     ///< copies of the drawing
    bool composes = false;              ///< place it by its shape and mass: see PlacementOptions::balance
    std::optional<std::string> title_line{};  ///< text above or below the drawing
    TitleLook title_look{};
    std::string edition{};               ///< text below the drawing on the right, such as 3/50; empty: none
    std::shared_ptr<const Font> font{};  ///< font of both texts; null: single strokes
    double kerf = 0;  ///< millimetres; the border of united edges of tiles moves outwards by half of it
    /// A colouring page, in a style from prepare_colouring(), whose closed regions have at least this area in mm².
    std::optional<double> colouring{};
};

/// Contents and place of a drawing, on a page of its own or in a cell of a sheet.
struct DrawingOptions : DrawingSettings {
    std::optional<DrawnExtent> frame;  ///< extent to place on the page instead of the drawing's own
    glm::dvec2 stretch{1.0};           ///< scale of the placed drawing, across and down, about the middle of the page
    bool may_be_empty = false;  ///< a drawing without lines gives an empty page, as for one of several generations
    std::optional<std::size_t> lesson_step;     ///< show this step of a lesson, from 0: see LessonDrawing
    std::vector<Speck> specks{};                ///< holes of a colouring page that are filled
    std::optional<double> traced;               ///< share of the steps of a lesson that are pale: a page to trace
    std::size_t most_steps = 40;                ///< maximum steps of a lesson; more are joined
    std::shared_ptr<LessonMemo> lesson_memo{};  ///< shared by the drawings of all steps; null: none
    std::shared_ptr<MapFrames> map_frames{};    ///< shared by all generations of a map; null: none
    double map_share = 1;                       ///< progress of a map from the step before, for animations
    std::shared_ptr<const BorderPattern> border_repeat{};  ///< the pattern that the style's border repeats
    std::shared_ptr<const BorderPattern> border_corner{};  ///< the pattern in its corners
    std::optional<Cell> cell{};                            ///< draw only this part, and the ground only there
    /// Colours of tiles by their neighbours repeat under these translations, in steps.
    std::optional<std::array<glm::dvec2, 2>> tile_period{};
};

}  // namespace sikku
