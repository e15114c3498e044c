// cli/draw.h: a print as `sikku draw` makes it, for whoever else makes prints.
#pragma once

#include "art/draw.h"
#include "cli/command.h"

#include <optional>
#include <string>

namespace sikku {

/// Every option of `sikku draw`, as it was given.
struct DrawSettings {
    PatternOptions pattern;
    std::string output;
    std::string size = "A4";
    bool landscape = false;
    std::string margin = "10mm";
    bool fit = false;
    std::optional<std::string> step;    ///< instead of fitting the page
    std::optional<std::string> window;  ///< what of the drawing fills the page
    double rotate = 0.0;                ///< degrees anticlockwise
    bool mirror = false;
    double dpi = 300.0;
    double budget = 200e6;  ///< most nodes of the derivation
    int compression = 6;    ///< of PNG, 1 to 9
    int threads = 0;        ///< for pictures; 0: one for each core
};

/// What of a print is known before its pattern is read.
struct PlannedPrint {
    Print print;  ///< page and dpi
    DrawOptions drawing;
};
/// @throws UsageError for settings that no print can have
PlannedPrint plan_print(const DrawSettings& settings);

/// Draws it into `settings.output`, which appears whole or not at all.
/// @throws UsageError, PatternError, and what draw() throws
void draw_print(const DrawSettings& settings, const Telling& telling);

}  // namespace sikku
