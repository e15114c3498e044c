// art/product/plot_remarks.h: the remarks about a finished drawing and its plot.
#pragma once

#include "art/plotter/hpgl.h"
#include "art/plotter/plot_options.h"
#include "art/product/draw_settings.h"
#include "art/style/style.h"
#include "art/writer/draw_options.h"
#include "engine/interpreter.h"

#include <span>
#include <string>
#include <vector>

namespace sikku {

/// Warns if `name-tiles` found no tile.
/// @param tiles  number of filled polygons
void warn_of_no_tiles(std::uint64_t tiles, const DrawSettings& settings, Made& made);

/// Warns that a text has characters that the lettering lacks. @param warning  of Letters::missing(); empty: none
void warn_of_letters(std::string warning, Made& made);

/// A fact about the regions of a colouring page.
std::string regions_text(const RegionReport& regions);

/// A warning that an ink is hardly visible.
std::string faint_text(const FaintInk& ink);
/// Warns of inks that are hardly visible, once of each kind and colour.
void warn_of_faint_inks(std::span<const FaintInk> inks, Made& made);

/// Adds the lengths and the time before and after arranging, and the merged pens.
/// @param rules  requested for single pens; those for pens that the plot does not use are reported
void report_plot(const PlotReport& plot, const PlotSpeeds& speeds, std::span<const PenRule> rules, Made& made);

/// Reports the position of an HP-GL plot, a margin that the plotter needs, and that it needs more pens than plotters
/// hold.
void report_hpgl(const PlotReport& plot, const DrawSettings& settings, const HpglOptions& options, Made& made);

/// Warnings that requested dots, fields, weaves or parallel lines were not drawn as requested.
/// @param report  of this drawing, after it was drawn
std::vector<std::string> drawing_warnings(const DrawReport& report, const Style& style, const DrawSettings& settings,
                                          bool is_plot);

/// Warnings that a requested camera or light has no effect.
/// @param is_spatial  the drawing is one in space
std::vector<std::string> space_warnings(const DrawSettings& settings, bool is_spatial, PrintFormat format);

}  // namespace sikku
