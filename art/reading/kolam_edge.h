// art/reading/kolam_edge.h: recognises kolams that reach the edge of their picture.
#pragma once

#include "art/reading/dot_finder.h"
#include "art/reading/picture.h"

namespace sikku {

bool is_inside(const GreyPicture& picture, glm::dvec2 at);

/// Ink of most lines between the dots of a grid.
double line_level(const GreyPicture& ink, const FoundGrid& found);

/// True if a kolam seems to continue outside of its picture: the edge cuts the loop around a dot, or there is ink
/// where the line to the next place leaves the picture.
/// @param level  ink of most lines
bool reaches_edge(const GreyPicture& ink, const FoundGrid& found, double level);

}  // namespace sikku
