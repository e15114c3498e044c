// cli/draw.h: a print as `sikku draw` makes it, for whoever else makes prints.
#pragma once

#include "art/drawing/draw.h"
#include "cli/command.h"

#include <optional>
#include <string>
#include <vector>

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
    double budget = 200e6;                   ///< most nodes of the derivation
    int compression = 6;                     ///< of PNG, 1 to 9
    int threads = 0;                         ///< for pictures; 0: one for each core
    bool frames = false;                     ///< each generation is a file
    std::optional<double> frame_time;        ///< seconds of each in an animation
    std::optional<double> hold;              ///< minimum seconds for the last frame
    bool fit_frames = false;                 ///< scale each generation to the page separately
    std::string view;                        ///< of drawings in space: see parse_camera(); empty: as the pattern says
    std::optional<std::string> dots;         ///< of a kolam: empty, `only`, or a size and a colour
    std::optional<std::string> dot_spacing;  ///< length between the nearest
    std::string border;                      ///< `kaavi`
    std::string colour_by;                   ///< `strand`
    std::string generations;                 ///< derivation lengths A:B, side by side
    std::optional<std::string> animate;      ///< seconds; empty: 20
    std::optional<std::string> tile;         ///< size of the sheets that the print is cut into
    std::string overlap = "10mm";
    bool plotter = false;
    std::string split;    ///< length of the longest stroke
    bool travel = false;  ///< show the ways of the lifted pen
    PlotSpeeds speeds;    ///< for the estimate, and of G-code
    std::string profile = "grbl";
    std::optional<std::string> gcode_start;
    std::optional<std::string> gcode_end;
    std::string bleed = "0mm";       ///< what the ground goes on beyond the page
    bool marks = false;              ///< crop marks
    std::vector<std::string> spots;  ///< NAME=COLOUR each
    std::string cmyk;                ///< ICC profile of the inks
    int bits = 8;                    ///< a channel
    std::string screen;              ///< for one bit: see parse_screen(); empty: a threshold
    bool icc = true;                 ///< pictures hold the profile of their colours
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
