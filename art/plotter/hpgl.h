// art/plotter/hpgl.h: strokes as HP-GL, for pen plotters and vinyl cutters.
#pragma once

#include "art/plotter/plot.h"
#include "art/print/print.h"
#include "engine/base/output.h"

#include <memory>

namespace sikku {

/// Begins the file. Absolute coordinates in plotter units of 0.025 mm from the bottom left corner of the page, y up;
/// curves are flattened so that all of the line stays within one unit of what it ought to be. Pen n of the plotter is
/// the style's n-th colour. Only IN, SP, PU and PD are used, which every device of the family knows; those from
/// before HP-GL/2 take no more than 32767 units, 819 mm. `print` and `file` are kept by reference. After finish() the
/// file is complete, but not committed.
/// @throws std::runtime_error, from here and from every call of the writer, if the file cannot be written, and for
/// what lies off the page
/// Source: Hewlett-Packard, HP-GL/2 and HP RTL Reference Guide, 1997.
std::unique_ptr<PlotWriter> write_hpgl(const Print& print, Output& file);

}  // namespace sikku
