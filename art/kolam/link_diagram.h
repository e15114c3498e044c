// art/kolam/link_diagram.h: lines that cross as the diagram of a knot or link, and its alternation.
#pragma once

#include "engine/base/monitor.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace sikku {

/// Lines that meet in crossings of two strands each: a plane diagram in which every crossing has an upper strand.
struct LinkDiagram {
    /// One visit of a line to a crossing.
    struct Pass {
        std::uint32_t crossing = 0;
        std::uint8_t strand = 0;  ///< 0 or 1; the other visit to the crossing has the other number
    };
    struct Line {
        std::vector<Pass> passes;  ///< in the order of the line
        bool is_closed = true;
    };

    std::vector<Line> lines;
    std::vector<bool> turns_left;      ///< for each crossing: strand 1 points to the left of strand 0
    std::vector<std::uint8_t> on_top;  ///< for each crossing the upper strand; filled by alternate()

    std::size_t crossings() const { return turns_left.size(); }
    bool is_over(const Pass& pass) const { return on_top[pass.crossing] == pass.strand; }
};

/// Chooses the upper strand of every crossing so that each line passes over and under alternately; the first visit of
/// the first line of each connected part goes over. Always possible if all lines are closed, because closed curves
/// cross an even number of times between two visits to a crossing (Gauss); an open line that ends inside a loop can
/// make it impossible.
/// @return true if every line alternates
/// Cost: O(n) for n crossings.
bool alternate(LinkDiagram& diagram, const Monitor& monitor = {});

/// Facts about an alternating diagram of closed lines.
struct DiagramFacts {
    std::uint64_t crossings = 0;
    std::uint64_t components = 0;  ///< number of closed lines
    std::uint64_t parts = 0;       ///< number of connected parts of the drawing; each is a link of its own
    /// Number of nugatory crossings: a circle meets the diagram in the crossing alone, so that a half turn of one
    /// side removes it. The diagram is reduced if there is none.
    std::uint64_t nugatory = 0;
    /// Sum of the signs of crossings of lines with themselves. It does not depend on the directions of the lines.
    std::int64_t writhe = 0;
    /// Number of pairs of lines with a linking number other than 0.
    std::uint64_t linked_pairs = 0;

    bool is_reduced() const { return nugatory == 0; }
    /// The crossing number of the link: a reduced alternating diagram is minimal.
    /// Source: Kauffman 1987, Murasugi 1987, Thistlethwaite 1987 (the first Tait conjecture).
    std::uint64_t crossing_number() const { return crossings - nugatory; }
};

/// Examines an alternating diagram whose lines are all closed. Cost: O(n log n) for n crossings.
DiagramFacts diagram_facts(const LinkDiagram& diagram, const Monitor& monitor = {});

}  // namespace sikku
