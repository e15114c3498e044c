// art/drawing/line_tips.h: pointed tips of lines, and what parallel lines inside of them leave out.
#pragma once

#include "art/kolam/curve_meetings.h"

#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

namespace sikku {

/// Places of each piece where its curvature is measured.
constexpr int places_of_piece = 8;

/// Share of a turn's radius by which a parallel line may be inside.
constexpr double tightest_inside = 0.75;

/// A short, sharp turn: farther inside than its radius, parallel lines cross each other before they reach it.
struct LineTip {
    std::size_t line = 0;
    double begin = 0.0;  ///< position where the sharp turn begins, in pieces
    double end = 0.0;    ///< position where it ends; on closed lines also beyond the last piece
    double from = 0.0;  ///< position of the crossing before, at most half a round away; on closed lines also negative
    double to = 0.0;    ///< position of the crossing behind, likewise
    int side = 1;       ///< 1 if it turns to the left, -1 to the right
};

/// Finds turns of at least 45 degrees on curves with a radius below `radius`.
/// @param meetings  may be empty, if lines do not have to end at crossings
/// Cost: 8 curvatures for each piece.
std::vector<LineTip> find_tips(const CurvedLines& lines, const CurveMeetings& meetings, double radius,
                               const Monitor& monitor);

/// The positions before and behind a tip where the parallel line `distance` inside crosses itself; none if there are
/// no such positions up to the nearest crossings. Errors of positions: below 1e-9 pieces.
std::optional<std::pair<double, double>> crossing_inside(const CurvedLines& lines, const LineTip& tip,
                                                         double distance);

}  // namespace sikku
