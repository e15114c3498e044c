// art/plotter/gcode.h: writes strokes as G-code, for plotters with grbl and similar controllers.
#pragma once

#include "art/plotter/plot.h"
#include "art/print/print.h"
#include "engine/base/output.h"

#include <memory>
#include <optional>
#include <string>
#include <string_view>

namespace sikku {

struct GcodeOptions {
    bool lifts_by_z = false;       ///< the pen is lifted along Z; else by M5 and lowered by M3, as a servo or a laser
    double z_up = 5.0;             ///< mm
    double z_down = 0.0;           ///< mm
    double z_feed = 600.0;         ///< mm/min
    double power = 1000.0;         ///< S of M3
    double pause = 0.2;            ///< seconds that a servo takes; 0: no pause
    double drawing_feed = 2400.0;  ///< mm/min, pen down
    double travel_feed = 4800.0;   ///< mm/min, pen up
    std::string start;             ///< lines before the first stroke, after the units are set
    std::string end = "G0 X0 Y0\nM2";  ///< lines after the last stroke, pen up
};

/// The options of a kind of machine: `grbl` (M3 and M5) or `z`; nullopt for another name.
std::optional<GcodeOptions> gcode_profile(std::string_view name);

/// Position of the pen after the closing G-code lines, in millimetres from the bottom left corner of the page: the
/// last X and Y of their G0 and G1 moves (in absolute coordinates); nullopt if there are none, as after homing.
std::optional<glm::dvec2> gcode_home(const GcodeOptions& options);

/// Formats a comment that no controller executes: `(label: text)`. The label keeps LinuxCNC from executing active
/// comments such as `(MSG,…` and `(LOGOPEN,…`. Omits `!`, `?` and `~`, which Grbl obeys anywhere, `%`, which begins
/// and ends programs, `(`, `)` and `;`, and control characters; replaces non-ASCII characters, some of whose bytes
/// are also Grbl commands, with `_`. Keeps 60 characters of the text: Grbl reads lines of 80.
/// @param label  of letters, digits and blanks
/// Source: Grbl 1.1, real-time commands; LinuxCNC, G code reference, comments.
std::string gcode_comment(std::string_view label, std::string_view text);

/// Begins the file. Absolute millimetres (G21 G90 G17) with 3 decimals, from the bottom left corner of the page, y
/// up. Straight lines are G1; curves are followed within 0.01 mm by as few arcs (G2 and G3 with I J, below 270
/// degrees, radius up to 1 m) and lines as a greedy search finds. Between two pens the machine stops (T n, M0). The
/// title and the pens' colours are the only comments. `print` and `file` are kept by reference. After finish() the
/// file is complete, but not committed.
/// @throws std::runtime_error for feeds that are not finite and above 0, heights that are not finite, power and pause
/// that are not finite and at least 0; from here and from every call of the writer if the file cannot be written; and
/// for what lies off the page
/// Source: NIST RS274/NGC Interpreter, version 3, 2000; grbl 1.1.
std::unique_ptr<PlotWriter> write_gcode(const Print& print, const GcodeOptions& options, Output& file);

}  // namespace sikku
