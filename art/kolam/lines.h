// art/kolam/lines.h: finds the lines of a drawing and the points where they meet.
#pragma once

#include "art/kolam/link_diagram.h"
#include "art/kolam/planar_graph.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace sikku::kolam_plane {

/// One visit of a line to a vertex.
struct Pass {
    std::uint32_t vertex = 0;
    std::uint32_t a = 0;  ///< half-edges that leave the vertex; `b` is absent at the end of an open line
    std::uint32_t b = 0;
};

/// Strokes that meet end to end are one line.
struct Lines {
    std::uint64_t count = 0;
    std::uint64_t open = 0;                     ///< number of open lines
    std::vector<std::uint32_t> line_of_stroke;  ///< line of each stroke, numbered by first strokes
    std::vector<bool> is_stroke_of_open_line;   ///< for each stroke
    std::vector<std::uint32_t> times;           ///< number of times each edge is drawn
    std::vector<char> closed_times;             ///< number of times closed lines draw each edge, modulo 2
    std::vector<Pass> passes;                   ///< visits, sorted by vertex
    std::vector<std::uint32_t> order;           ///< half-edges along each line, line after line
    std::vector<std::size_t> order_begins;      ///< into `order`; one more than there are lines
    std::vector<bool> is_open;                  ///< for each line
    /// For each end of a stroke (2i is the beginning of stroke i, 2i + 1 its end) the end that continues it, or none.
    std::vector<std::uint32_t> continuation;
};

/// Follows the strokes along the edges. @throws BudgetError
Lines follow_strokes(const PlanarGraph& graph, const Strokes& strokes, const KolamOptions& options);

/// Vertices visited more than once, by kind as in KolamExamination.
struct Meetings {
    std::uint64_t all = 0;
    std::uint64_t crossings = 0;
    std::uint64_t skew = 0;
    std::uint64_t sixty = 0;
    std::uint64_t mid_crossings = 0;
    std::uint64_t touchings = 0;
    std::uint64_t multiple = 0;
};
Meetings count_meetings(const PlanarGraph& graph, const Lines& lines, const KolamOptions& options);

/// The diagram of the lines, without upper strands. Points where strands only touch are left out.
/// @param why  receives the reason if the result is empty: open lines, shared edges, more than two strands at a point
std::optional<LinkDiagram> make_diagram(const PlanarGraph& graph, const Lines& lines, const KolamOptions& options,
                                        std::string& why);

/// The number of lines when continuing straight on wherever edges meet.
std::uint64_t count_straight_lines(const PlanarGraph& graph, const KolamOptions& options);

}  // namespace sikku::kolam_plane
