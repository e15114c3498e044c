// art/plotter/hpgl.h: writes strokes as HP-GL, for pen plotters and vinyl cutters.
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

/// The usual plotter unit in millimetres.
constexpr double hpgl_unit = 0.025;

/// The area of a sheet that a plotter reaches. Coordinates are millimetres from the plotter's origin, x along the
/// long side.
struct HpglPaper {
    std::string name;     ///< for messages: `A4`
    glm::dvec2 low{0.0};  ///< hard-clip limits
    glm::dvec2 high{0.0};
    glm::dvec2 centre{0.0};   ///< centre of the sheet
    bool is_hp7475a = false;  ///< the limits are those of the HP 7475A
};

/// Parses a paper. A4, A3, letter and tabloid are the sheets of the HP 7475A, whose origin lies inside the bottom
/// left corner of the sheet and whose limits are 11,040 x 7,721 units on A4 (276 x 193 mm) and 16,158 x 11,040 units
/// on A3. Any other size that parse_size() accepts gives the limits themselves, in either orientation, with the
/// origin in their bottom left corner. With `,centre`, as for large drafting plotters (HP 7585, DraftMaster), every
/// size gives the limits, with the origin in the middle. Returns nullopt for anything else. Source: Hewlett-Packard,
/// HP 7475A Interfacing and Programming Manual, 1983: hard-clip limits; the frame of the scaling points P1 and P2,
/// which is centred on the sheet.
std::optional<HpglPaper> parse_hpgl_paper(std::string_view text, double dpi);

/// The sheet of the HP 7475A that has the size of the page, if `paper` is one of its sheets; else `paper`.
HpglPaper paper_for(const HpglPaper& paper, const Page& page);

/// Converts a sheet of the HP 7475A, whose limits are counted in units, to a machine with a unit of another length;
/// other papers are unchanged.
HpglPaper with_unit(const HpglPaper& paper, double unit);

/// The margin of the page, in whole tenths of a millimetre, that lets the plotter reach everything inside it in
/// either orientation.
double hpgl_margin(const HpglPaper& paper, const Page& page);

struct HpglOptions {
    std::optional<HpglPaper> paper;    ///< absent: the page itself, with the origin in its corner
    std::optional<glm::dvec2> park{};  ///< place of the pen before it is changed, in mm of the page, y up
    std::vector<PenRule> rules{};      ///< speeds of single pens
    double speed = 40.0;               ///< mm/s of the pens without a rule, if any pen has one
    double unit = hpgl_unit;           ///< millimetres of a plotter unit
};

/// Initial position of the pen: the plotter's origin, in millimetres from the bottom left corner of the page, y up.
glm::dvec2 hpgl_origin(const Page& page, const HpglOptions& options);

/// Describes origin and orientation in a sentence.
std::string describe_hpgl(const Page& page, const HpglOptions& options);

/// Begins the file. Absolute coordinates in plotter units; curves are flattened to lines that stay within
/// one unit of the exact curve. Pen n of the plotter is the style's n-th colour.
///
/// The x axis of plotters lies along the long side of their sheet. A portrait page is therefore turned by 90 degrees
/// anticlockwise, so that its top is at the left of the plotter. The coordinates are turned, because many devices do
/// not support the instruction `RO90`. Without a paper, the origin is the bottom left corner of the sheet, which
/// suits cutters and plotters whose origin is set by hand; with one, the page is centred on the sheet or, if only
/// limits are known, within them. Scaling is left off (no IP and SC), so that lengths are true.
/// If pens have their own speeds, VS sets each, in cm/s.
/// Otherwise only IN, SP, PU and PD are used, which every device of the family supports; devices older than HP-GL/2
/// accept at most 32767 units, 819 mm. At the end SP0 returns the pen to its stall, near the origin. `print`,
/// `options` and `file` are kept by reference. After finish() the file is complete, but not committed.
/// @throws std::runtime_error, from here and from every call of the writer, if the file cannot be written, or if the
/// drawing lies off the page or beyond the limits of the paper
/// Source: Hewlett-Packard, HP-GL/2 and HP RTL Reference Guide, 1997.
std::unique_ptr<PlotWriter> write_hpgl(const Print& print, const HpglOptions& options, Output& file);

}  // namespace sikku
