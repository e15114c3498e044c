// art/drawing/drawing_cost.h: the cost of a drawing, and of the stages of its print.
#pragma once

#include "art/raster/raster.h"

#include <glm/vec2.hpp>

#include <utility>
#include <vector>

namespace sikku {

/// Rough estimate of the cost of a drawing.
struct DrawingCost {
    double nodes = 0;          ///< derivation nodes visited in a pass
    bool is_doubtful = false;  ///< by its growth so far, the word exceeds the budget
    double lines = 0;          ///< lines, polygons and discs drawn in a pass
    double points = 0;         ///< ends of lines, corners of polygons and discs that a writer receives
    double strokes = 0;        ///< lines without a lift
    double polygons = 0;       ///< polygons, in space without those of patches
    double patches = 0;        ///< patches of surfaces in space
    std::vector<std::pair<double, double>> bent{};  ///< bends of patches in millimetres, and their numbers
    double length = 0;                              ///< millimetres of lines
    double ink = 0;                                 ///< square millimetres of lines, however often they cross
    double area = 0;                                ///< square millimetres of polygons, discs and patches, likewise
    glm::dvec2 size{0.0};                           ///< millimetres of the drawing
    double reach = 0;                               ///< longest side in space, in millimetres
    double seconds = 0;                             ///< processor time of making the drawing and reading it once
    double memory = 0;                              ///< bytes, on one thread
    double thread_memory = 0;                       ///< bytes for each further thread
    double kept_memory = 0;                         ///< bytes of `memory` that the drawing itself keeps
    double lines_memory = 0;  ///< bytes of `memory` kept by a Raster when it has read the whole drawing
};

// Seconds of processor time and bytes of memory, measured with tests/bench/forecast_table.cpp on the machine of
// docs/performance.md.
constexpr double seconds_of_node = 12e-9;   // in a walk through parts
constexpr double seconds_of_part = 150e-9;  // in a drawing through a view, composed once
constexpr double seconds_of_child = 8e-9;
constexpr double seconds_of_blot = 60e-9;
constexpr double raster_line_bytes = 5;  // for a line in a raster

/// Number of lines that approximate a piece of a spline whose step has this length in pixels.
double curve_lines(double pixels);
/// Bytes of a thread that renders lines, for each pixel of a band.
double band_bytes(PixelSize size);

}  // namespace sikku
