// art/hand/hand_order.h: the order and the direction in which a hand draws lines.
#pragma once

#include "art/hand/hand_line.h"

#include <vector>

namespace sikku {

/// Puts lines into the order of a hand and gives each a start and a direction, seen with y up, before the drawing is
/// rotated or mirrored on its page:
/// - A closed line begins in a run at the upper left of its box and goes round anticlockwise. An open one begins at
///   its upper left end. People begin at the top left and, with the right hand, draw circles anticlockwise.
/// - Lines follow each other from the centre of the drawing outwards, as around the first dots. Lines of equal length
///   and distance from the centre, images of each other, form a group that is drawn anticlockwise from the top left.
/// Cost: O(n log n). Source: Goodnow & Levine, The grammar of action, Cognitive Psychology 4 (1973); van Sommers,
/// Drawing and Cognition, 1984.
void order_by_hand(std::vector<HandLine>& lines);

}  // namespace sikku
