// art/print/outline.h: outlines of pieces to cut: allowances, dashes, and places for labels.
#pragma once

#include "art/print/page.h"
#include "engine/geometry/path.h"

#include <glm/vec2.hpp>

#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace sikku {

/// Lengths are millimetres, y up.

/// Turns points about the origin. @param angle  radians anticlockwise
std::vector<glm::dvec2> turned(std::span<const glm::dvec2> points, double angle);

/// Moves an outline outwards by a distance. Corners are mitred; mitres longer than twice the distance are cut off
/// there.
/// @param corners  anticlockwise
/// @throws std::runtime_error if the result crosses itself, as in notches narrower than twice the distance
std::vector<glm::dvec2> offset_outline(std::span<const glm::dvec2> corners, double distance);

/// offset_outline() without the search for crossings, which costs k^2; nullopt if a side would be reversed.
std::optional<std::vector<glm::dvec2>> offset_sides(std::span<const glm::dvec2> corners, double distance);

void draw_closed(const std::vector<glm::dvec2>& outline, glm::dvec2 offset, const Pen& pen, PathSink& sink);
/// Draws a dashed outline; each side begins and ends with a dash.
void draw_dashed(const std::vector<glm::dvec2>& outline, glm::dvec2 offset, const Pen& pen, PathSink& sink);

/// Start of a text, and the height of its capital letters: see write_text().
struct LabelPlace {
    glm::dvec2 start{0.0};
    double height = 0;
};
/// The roomiest place for a text within an outline. Cost: 1,000 times the number of sides.
LabelPlace label_place(std::string_view text, std::span<const glm::dvec2> outline, double most_height);

}  // namespace sikku
