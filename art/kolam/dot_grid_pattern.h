// art/kolam/dot_grid_pattern.h: writes a kolam on a grid of dots as a pattern file.
#pragma once

#include "art/kolam/dot_grid_symmetry.h"

#include <cstdint>
#include <glm/vec2.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace sikku {

/// Maximum number of gaps for which a pattern lists its grid and gaps, so that the kolam can be read back.
constexpr std::size_t most_listed_gaps = 1000;

/// Shape of the loops at the rim.
enum class RimStyle : std::uint8_t {
    round,
    pointed,  ///< a tip
    petal,    ///< swells towards its tip
    horn,     ///< a bent tip; straight where a bent one would break a symmetry
    crescent  ///< two tips with a hollow between them
};
/// Parses the name of a style, in any case. @throws std::runtime_error
RimStyle parse_rim_style(std::string_view text);
std::string_view rim_style_name(RimStyle style);

struct KolamPatternOptions {
    std::string title = {};        ///< any text; pattern_line() makes it one line
    std::string description = {};  ///< likewise
    std::string source = {};       ///< likewise: the command that makes the pattern
    bool coloured = false;         ///< one of eight colours for each class of lines that are images of each other
    bool dot_symbols = false;      ///< draws the dots, too, as `@.`
    bool centred_dots = false;     ///< sets a dot in each of crossed_cells(), too
    RimStyle rim = RimStyle::round;
    Monitor monitor = {};
};

struct KolamPattern {
    std::string text;              ///< text of the pattern file
    std::vector<glm::dvec2> dots;  ///< their positions in turtle steps, in the order of DotGrid::dots()
    std::size_t lines = 0;
    std::size_t shaped = 0;   ///< loops at the rim that are not round
    std::size_t centred = 0;  ///< centred dots
    /// Width and height of the drawing with its lines' width, in spacings of the dots; within a hundredth where lines
    /// are rounded.
    glm::dvec2 size{0.0};
    double line = 0.0;  ///< width of the lines, in spacings
};

/// The middles of the fields between four dots of the square lattice whose four gaps are crossed, which closes them;
/// by rows from the top.
std::vector<GridDot> crossed_cells(const DotGrid& grid, const GapStates& states);

/// Writes a kolam as a pattern with `line: spline`. Each line is one closed stroke; the first starts at 0 0. A single
/// line is a word without brackets around it; if it has rotational symmetry, its repeated part is a production.
/// Several lines are branches, between which the turtle moves with a transparent pen, since `f` is a control point of
/// a spline as well. In the square lattice the turtle steps `F` from the middle of one side of a dot to the middle of
/// the next, turning where the line does; the middles are the control points of the spline, which therefore runs
/// straight through each crossing and rounds a dot where it turns back. Steps are diagonal, dots are sqrt(2) steps
/// apart, and every position is exact. In the triangular lattice the control points are those of rounded_line(), dots
/// are 2 steps apart, and dots that are not drawn are marked with a transparent pen, as they are beside centred ones.
/// The grid and up to most_listed_gaps gaps are listed in comments, as parse_dot_grid() and parse_gap_states() read
/// them, a rim that is not round, and centred dots.
/// @throws std::runtime_error if the text is too long for a pattern file
KolamPattern kolam_pattern(const DotGrid& grid, const GapStates& states, const KolamPatternOptions& options = {});

/// The keys `title`, `source` and `description` of a pattern; empty ones are left out.
std::string kolam_head(const KolamPatternOptions& options);

/// The value of a comment `// NAME: VALUE` that the program writes into patterns of kolams (grid, gaps, rim, centred
/// dots), or empty.
std::string_view kolam_comment(std::string_view pattern, std::string_view name);

}  // namespace sikku
