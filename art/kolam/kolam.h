// art/kolam/kolam.h: examines a drawing as a kolam: lines, crossings, faces, dots and symmetry.
#pragma once

#include "art/kolam/link_diagram.h"
#include "engine/base/monitor.h"
#include "engine/geometry/path.h"
#include "engine/language/grammar.h"

#include <cstdint>
#include <functional>
#include <glm/vec2.hpp>
#include <optional>
#include <string>
#include <vector>

namespace sikku {

/// Rotations and mirrors that map a drawing onto itself: a cyclic or a dihedral group.
struct KolamSymmetry {
    std::uint32_t rotations = 1;  ///< the identity included
    std::uint32_t mirrors = 0;    ///< 0, or as many as rotations
    double axis = 0;              ///< direction of one of the mirrors in radians, if there are mirrors
    std::string name() const;     ///< C1, C4, D1, D4, …
};

/// A dot, placed by tradition or by the pattern, in turtle steps.
struct KolamDot {
    glm::dvec2 at{0.0};
    bool is_enclosed = false;  ///< closed lines enclose it; an odd number of times for dots set by tradition
    bool is_alone = false;     ///< the whole outline of its face is visible from it; true for dots of the pattern
    bool is_on_line = false;   ///< a line runs through it, as in radial kolams; only of dots of the pattern
};

/// The examination of a drawing. Vertices are where the turtle pauses and where segments meet; edges are the pieces
/// of segments between them, each counted once however often it is drawn.
///
/// Dots: faces are coloured like a chessboard by the closed lines, the outside even; each odd face carries one dot,
/// at its centroid or, where that lies outside of it, elsewhere inside. So every loop has its dot, and the gaps
/// between loops have none. Open lines do not enclose faces. A pattern that draws or marks three dots or more (`@.`),
/// and one of them elsewhere, has its own dots: a line has to run around or through each, as lines of radial kolams
/// do, or closed lines enclose a field in which it is alone, as those around centred dots.
///
/// A spline is examined by its control polygon, which the curve follows. The curve passes through a crossing where
/// both strands continue straight, and keeps strands apart that turn back (touchings). The curve itself decides
/// whether dots are enclosed. Polygons and discs are ignored.
struct KolamExamination {
    bool is_exact = false;   ///< computed in whole numbers, except for the positions of dots
    double tolerance = 0.0;  ///< otherwise the distance in steps below which points are merged
    bool is_spline = false;
    std::uint64_t segments = 0;  ///< steps that draw (or guide a spline), as often as they are drawn
    std::uint64_t strokes = 0;

    std::uint64_t lines = 0;                    ///< as drawn; strokes that meet end to end are one line
    std::uint64_t open_lines = 0;               ///< number of open lines
    std::vector<std::uint32_t> line_of_stroke;  ///< line of each stroke, numbered by first strokes
    std::vector<std::uint32_t> orbit_of_line;   ///< lines that are images of each other share a number
    std::vector<bool> is_open;                  ///< for each line
    /// For each end of a stroke (2i is the beginning of stroke i, 2i + 1 its end) the end that continues it, or
    /// 2^32 - 1.
    std::vector<std::uint32_t> continuation;
    std::uint64_t straight_lines = 0;  ///< number of lines when continuing straight on wherever edges meet

    std::uint64_t vertices = 0;
    std::uint64_t edges = 0;
    std::uint64_t components = 0;
    std::uint64_t faces = 0;         ///< number of bounded faces
    std::uint64_t reused_edges = 0;  ///< edges drawn more than once

    std::uint64_t meetings = 0;       ///< vertices that are visited more than once
    std::uint64_t crossings = 0;      ///< visited by two strands that cross
    std::uint64_t skew = 0;           ///< crossings other than of two straight strands at right angles
    std::uint64_t sixty = 0;          ///< skew crossings of two straight strands at 60 degrees, as on interlaced dots
    std::uint64_t mid_crossings = 0;  ///< crossings inside of segments, where the turtle does not pause
    std::uint64_t touchings = 0;      ///< visited by two strands that do not cross
    std::uint64_t multiple = 0;       ///< visited by more than two

    /// The lines as an alternating diagram of a knot or link: they pass over and under each other alternately.
    std::optional<DiagramFacts> diagram;
    std::string no_diagram;  ///< the reason if there is no diagram

    KolamSymmetry symmetry;
    glm::dvec2 centre{0.0};  ///< centre of symmetry

    std::vector<KolamDot> dots;  ///< sorted by y, then by x
    bool has_own_dots = false;   ///< the dots are those of the pattern

    std::uint64_t dots_on_lines() const;
    std::uint64_t loose_dots() const;  ///< dots not on a line that are not enclosed or not alone

    /// Violations of the rules of kolams: every dot is encircled, every line is closed, nothing is drawn twice. Empty
    /// for a kolam.
    /// Source: Gopalan & VanLeeuwen, Forma 30 (2015), section 2.
    std::vector<std::string> faults() const;
    /// Unusual features that are allowed: several lines, crossings of more than two strands or not at right angles
    /// (at 60 degrees on interlaced dots).
    std::vector<std::string> remarks() const;
    bool is_kolam() const { return faults().empty(); }
};

struct KolamOptions {
    bool spline = false;  ///< the pattern's `line: spline`
    /// Maximum number of derivation nodes visited. A crossing takes the memory and time of 10 nodes.
    double budget = 200e6;
    std::function<bool(const Pen&)> draws = {};  ///< true for visible lines; null: all are visible
    /// Called as DerivationOptions::watch is, and with 0 from time to time; may throw to stop.
    std::function<void(std::uint64_t symbols)> watch = {};
    Monitor monitor = {};          ///< polled throughout the examination
    bool moves_lift = false;       ///< `spline with lifts`: undrawn steps are not control points
    double nodes_of_segment = 40;  ///< memory and time of a segment, in nodes
};

/// Examines the drawing of the turtle: in Z[zeta], without rounding, where its angles and lengths allow that
/// (engine/geometry/lattice.h), else with a tolerance of 1e-6 steps.
/// Cost: for n segments that are of similar length, O(n log n) time and O(n) memory; 3 s and 250 MB for a million.
/// @throws BudgetError, WordError; std::runtime_error if no segment is drawn
KolamExamination examine_kolam(const Grammar& grammar, const KolamOptions& options);

/// The positions of the dots.
std::vector<glm::dvec2> dot_places(const KolamExamination& examination);

}  // namespace sikku
