// art/plot_remarks.h: the remarks about a finished plot.
#pragma once

#include "art/plotter/plot.h"
#include "engine/interpreter.h"

namespace sikku {

/// Adds the lengths and the time before and after arranging, and the merged pens.
void report_plot(const PlotReport& plot, const PlotSpeeds& speeds, Made& made);

}  // namespace sikku
