// art/plotter/gcode.h: writes strokes as G-code, for plotters with grbl and similar controllers.
#pragma once

#include "art/plotter/pen_rules.h"
#include "art/plotter/plot_writer.h"
#include "art/print/print.h"
#include "engine/base/output.h"

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace sikku {

/// Commands of a machine and their parameters. Commands are lines; in them `{lift}` and `{down}` stand for the
/// heights of the pen, `{pen}` for its number, `{colour}` for its colour, `{seconds}` and `{milliseconds}` for a
/// pause.
struct GcodeOptions {
    std::string setup = "G21 G90 G17";  ///< units and modes: absolute millimetres, arcs in the plane of X and Y
    std::string pen_up = "M5";
    std::string pen_down = "M3 S{down}";
    std::string pen_change = "T{pen}\nM0";  ///< between two pens, pen up
    std::string dwell = "G4 P{seconds}";    ///< after lifting and lowering the pen, unless the pause is 0
    char comment = '(';                ///< `(` for comments in parentheses, `;` for comments up to the line's end
    double lift = 5.0;                 ///< height of the raised pen, in the unit of the machine
    double down = 1000.0;              ///< height of the lowered pen, or the power that lowers it
    double pause = 0.2;                ///< seconds that the pen takes to move; 0: no pause
    double drawing_feed = 2400.0;      ///< mm/min, pen down
    double travel_feed = 4800.0;       ///< mm/min, pen up
    bool arcs = true;                  ///< follow curves by arcs as well as lines
    double least_arc = 0.0;            ///< millimetres; shorter arcs become lines
    std::optional<glm::dvec2> park{};  ///< place of the pen while it is changed, as in write_gcode()
    std::vector<PenRule> rules{};      ///< settings of single pens
    std::string start{};               ///< lines before the first stroke, after `setup`
    std::string end = "G0 X0 Y0\nM2";  ///< lines after the last stroke, pen up
};

/// The first X, Y or Z of G-code lines that is not a number within 10 m, such as `Xnan` or `Y1e300`; empty if there
/// is none. Comments are skipped. The result points into `lines`.
std::string_view unreachable_word(std::string_view lines);

/// Position of the pen after the closing G-code lines, in millimetres from the bottom left corner of the page: the
/// last X and Y of their G0 and G1 moves (in absolute coordinates); nullopt without such moves, as after homing.
/// @throws std::runtime_error for coordinates that are not within 10 m
std::optional<glm::dvec2> gcode_home(const GcodeOptions& options);

/// Formats a comment that no controller executes: `(label: text)`. The label keeps LinuxCNC from executing active
/// comments such as `(MSG,…` and `(LOGOPEN,…`. Omits `!`, `?` and `~`, which Grbl obeys anywhere, `%`, which begins
/// and ends programs, `(`, `)` and `;`, and control characters; replaces non-ASCII characters, some of whose bytes
/// are also Grbl commands, with `_`. Keeps 60 characters of the text: Grbl reads lines of 80.
/// @param label  of letters, digits and blanks
/// Source: Grbl 1.1, real-time commands; LinuxCNC, G code reference, comments.
/// @param mark  `(`, or `;` for `; label: text`
std::string gcode_comment(std::string_view label, std::string_view text, char mark = '(');

/// Begins the file. Absolute millimetres with 3 decimals, from the bottom left corner of the page, y up. Straight
/// lines are G1; curves are followed within 0.01 mm by as few arcs (G2 and G3 with I J, below 270 degrees, radius up
/// to 1 m) and lines as a greedy search finds. Between two pens the machine parks and stops. Title, recipe and the
/// pens' colours are the only comments. `print` and `file` are kept by reference. After finish() the file is
/// complete, but not committed.
/// @throws std::runtime_error for feeds that are not finite and above 0, heights that are not finite, a pause or a
/// least arc that is not finite and at least 0, and commands with unknown placeholders; from here and from every call
/// of the writer if the file cannot be written; and if the drawing leaves the page
/// Source: NIST RS274/NGC Interpreter, version 3, 2000; grbl 1.1.
std::unique_ptr<PlotWriter> write_gcode(const Print& print, const GcodeOptions& options, Output& file);

}  // namespace sikku
