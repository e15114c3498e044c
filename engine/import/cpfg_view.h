// engine/import/cpfg_view.h: the view file of cpfg.
#pragma once

#include "engine/import/cpfg_report.h"

#include <string>

namespace sikku::cpfg {

/// What a view says, as keys of patterns; empty where it says nothing.
struct View {
    std::string angle;
    std::string stroke;
    std::string scale;
    double width_increment = 0;
};

/// Reads a view file; what patterns lack of it is a loss.
View read_view(const SourcePointer& file, Report& report);

}  // namespace sikku::cpfg
