// art/print/border.h: frames around drawings: traditional ones, and repeats of a recorded drawing.
#pragma once

#include "art/print/print.h"
#include "engine/geometry/recorded_path.h"

#include <memory>
#include <vector>

namespace sikku {

/// The repeat or the corner of a border, in steps, y up.
struct BorderMotif {
    RecordedPath path;
    Box box;      ///< box of its ink, without the width of pens
    Style style;  ///< style of its pens
};

/// A border that is ready to be drawn.
struct Border {
    BorderKind kind = BorderKind::kaavi;
    std::shared_ptr<const BorderMotif> repeat{};  ///< motif of BorderKind::pattern, upright at the top edge
    std::shared_ptr<const BorderMotif> corner{};  ///< motif of the top left corner; null: a dot in a ring
    double weight = 1.0;                          ///< border_weight() of the drawing
};

/// Approximate length of a step, in millimetres, of a drawing that fills a page within a border.
/// @param size  width and height of the drawing, in steps
double step_within_border(const Page& page, glm::dvec2 size);
/// Factor of a border's size that fits it to the lines of a drawing: borders around unusually bold lines are larger,
/// those around unusually fine lines smaller, by the square root of the line's width relative to the page. From 0.8
/// to 1.25.
/// @param line  millimetres
double border_weight(const Page& page, double line);

/// Depth of the border inwards from the margin, in millimetres; it grows with the page's shorter side and the weight.
double border_depth(const Border& border, const Page& page);
/// Depth of the border and of the space between it and the drawing.
double border_room(const Border& border, const Page& page);
/// Colours of draw_border(): those of a traditional border are rice flour and red earth (*kaavi*), in tones that
/// stand out from the ground, or, on light ground, dark and light red earth; those of a pattern come from its style,
/// except where its lines would vanish on the ground: they become rice flour or dark red earth.
/// Without a ground, the paper is white.
std::vector<Colour> border_colours(const Border& border, const std::optional<Colour>& ground);

/// Numbers of repeats along the sides, chosen so that the lengths of repeats differ as little as possible.
struct BorderRepeats {
    int across = 1, down = 1;
};
/// @param across, down  lengths of the sides without the corners, above 0 @param length  approximate length of a
/// repeat
BorderRepeats border_repeats(double across, double down, double length);

/// Draws a frame within the margin of a window of the page; all its lines close at the corners. `print` is placed;
/// `colour` is the index of the first of border_colours() in its palette. Parts of the border do not overlap, except,
/// in pictures and vectors, those of BorderKind::kaavi.
void draw_border(const Border& border, const Print& print, const Window& window, int colour, PathSink& sink);

}  // namespace sikku
