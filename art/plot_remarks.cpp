#include "art/plot_remarks.h"

#include "art/style/colour.h"
#include "engine/base/text.h"

#include <fmt/format.h>

namespace sikku {

void report_plot(const PlotReport& plot, const PlotSpeeds& speeds, Made& made) {
    const auto line = [&](const PlotTally& tally) {
        return fmt::format("{:.2f} m drawn, {:.2f} m pen-up travel{}, {}, about {}", tally.drawn / 1000,
                           tally.travelled / 1000, plot.returns ? ", return included" : "",
                           counted(tally.lifts, "lift"), time_text(plot_seconds(tally, speeds)));
    };
    made.fact("before: " + line(plot.before));
    made.fact("plot:   " + line(plot.after));
    if (plot.duplicates > 0) {
        made.fact(fmt::format("{} drawn twice in the pattern, once here", counted(plot.duplicates, "segment")));
    }
    if (!plot.merged.empty()) {
        made.fact(fmt::format("{} in {}:", counted(plot.colours, "colour"),
                              counted(plot.colours - plot.merged.size(), "pen")));
    }
    for (const MergedPen& merged : plot.merged) {
        made.fact(fmt::format("  {} ({:.2f} m) is drawn with pen {}, {}", colour_name(merged.colour),
                              merged.drawn / 1000, merged.number, colour_name(merged.pen)));
    }
}

}  // namespace sikku
