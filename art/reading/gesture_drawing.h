// art/reading/gesture_drawing.h: draws kolams whose lines meet in the middle of four dots, from gestures of the hand.
#pragma once

#include "art/kolam/dot_grid.h"
#include "art/reading/gesture_loops.h"

#include <cstddef>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace sikku {

/// True if a gesture passes through the middle of four dots (D, T). A grid of gaps has no crossing there.
/// @throws std::runtime_error as read_gesture_loops()
bool meets_between_four(std::string_view text);

/// Lines as control points of splines, and dots. Unit: half the distance of two dots, dots at even places, y up.
struct GestureDrawing {
    std::vector<std::vector<GridDot>> lines;  ///< closed; consecutive points are 1, sqrt(2) or 2 apart
    std::vector<GridDot> dots;                ///< ascending by row, then by column
    std::size_t decorated = 0;                ///< gestures whose decoration was left out
};

/// A point of a line: a place that the hand passes, or a dot and the way from it to the line around it.
struct HandPoint {
    GridDot at;
    GridDot way;
};
/// Dots, and the number of their sides on which lines pass; 2 where one leads around the dot. On one side of a
/// straight line there may be no dot.
using PassedDots = std::map<GridDot, int, decltype(&is_before)>;

/// Follows the gestures of a loop. @param decorated  increased by the number whose decoration is left out
/// @throws std::runtime_error as draw_gestures()
std::vector<HandPoint> follow_gestures(const GestureLoop& loop, std::size_t number, PassedDots& dots,
                                       std::size_t& decorated);

/// Follows gestures between two dots (O, C1, and H3 and OP without their decoration), through the middle of four dots
/// (D) and from one to the other (T). From a gap, a gesture of n quarters leads around the dot ahead; from the middle
/// of four dots around the one ahead on the left or right (L, R). `D1` without a side runs straight on. `On` and `Dn`
/// lead around n quarters of the dot, `Tn` an eighth further. Source of the gestures: T. Waring, Forma 27, 2012,
/// 83-92; the geometry agrees with the recorded places and headings of the study of Tran, Waring, Atmaca & Beheim
/// (2021).
/// @throws std::runtime_error with the loop and the gesture for anything else, and for loops that do not close
GestureDrawing draw_gestures(std::string_view text);

/// A pattern that draws the lines and dots. @param head  its first lines, as kolam_head() writes them
/// @throws std::runtime_error if the text is too long for a pattern file
std::string gesture_pattern(const GestureDrawing& drawing, const std::string& head);

}  // namespace sikku
