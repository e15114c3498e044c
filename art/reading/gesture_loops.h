// art/reading/gesture_loops.h: parses kolams that are written as gestures of the hand.
#pragma once

#include "art/kolam/dot_grid.h"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace sikku {

/// A drawn loop. Places are in half spacings of dots, with dots at even places, y up: a loop starts midway between
/// two dots or in the middle of four.
struct GestureLoop {
    std::vector<std::string> gestures;  ///< in lower case
    std::optional<GridDot> start;       ///< always set by read_gesture_loops()
    int heading = 45;                   ///< degrees clockwise from the top
};

/// True if a text has `sequence:`, or begins with gestures.
bool is_gestures(std::string_view text);

/// Parses gestures; for the formats see read_gestures(). Does not check that the gestures exist. Safe for untrusted
/// texts.
/// @throws std::runtime_error with the loop for anything else, empty loops and loops without a start
std::vector<GestureLoop> read_gesture_loops(std::string_view text);

}  // namespace sikku
