// engine/import/cpfg_view.h: reads the view file of cpfg.
#pragma once

#include "engine/import/cpfg_report.h"

#include <string>

namespace sikku::cpfg {

/// The settings of a view as keys of patterns; empty if not set.
struct View {
    std::string angle;
    std::string stroke;
    std::string scale;
    double width_increment = 0;
};

/// Reads a view file. Settings without a counterpart in patterns are losses.
View read_view(const SourcePointer& file, Report& report);

}  // namespace sikku::cpfg
