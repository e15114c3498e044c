// art/drawing/drawing_cost.h: the costs of drawings and prints, and of their stages.
#pragma once

#include "art/drawing/division.h"
#include "art/drawing/division_file.h"
#include "art/drawing/drawing.h"
#include "art/drawing/growth.h"
#include "engine/base/cost.h"

namespace sikku {

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

/// The cost of a print of a drawing, in a program that makes nothing else.
/// @throws BudgetError if the word is too long to be read
Cost print_cost(const Grammar& grammar, const Print& print, const DrawOptions& options);

/// The cost of a model in space, or of a relief if the options have one. @param format  format of the file
Cost solid_cost(const Grammar& grammar, const Print& print, const DrawOptions& options, PrintFormat format);

/// The cost of an animation or of one file for each generation.
Cost growth_cost(const Grammar& grammar, const Print& print, const DrawOptions& options, const GrowthOptions& growth);

/// The cost of an animation of tiles that divide.
Cost division_cost(const Grammar& grammar, const Print& print, const DrawOptions& options,
                   const DivisionOptions& division);

/// The cost of a lesson, as an animation, as pages and as cells of a picture.
Cost lesson_cost(const Grammar& grammar, const Print& print, const DrawOptions& options, bool is_animation);

/// The part of a cost that is shared within one program: the program, and the library of pictures.
Cost base_cost(bool pictures);

}  // namespace sikku
