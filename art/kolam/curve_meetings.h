// art/kolam/curve_meetings.h: finds the points where drawn lines meet, on the curves themselves.
#pragma once

#include "art/kolam/curved_lines.h"
#include "art/kolam/link_diagram.h"

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace sikku {

/// A visit of a line to a vertex.
struct CurveMark {
    std::uint32_t line = 0;
    double position = 0.0;  ///< along the line, in pieces
    std::uint32_t vertex = 0;
};

/// Vertices where lines meet or cross others or themselves. Points within 1e-6 steps of each other are one vertex.
struct CurveMeetings {
    std::vector<glm::dvec2> places;   ///< positions of the vertices
    std::vector<CurveMark> marks;     ///< sorted by line, then by position
    std::vector<std::size_t> begins;  ///< first mark of each line; one more than there are lines

    std::span<const CurveMark> along(std::size_t line) const {
        return {marks.data() + begins[line], begins[line + 1] - begins[line]};
    }
};

/// Intersects all pieces of all lines, by subdivision and Newton's method.
/// Cost: O(n + k) for n pieces of similar size that are met by few others, with k meetings; 1.5 s for 10^5 pieces
/// with a meeting each.
/// @throws BudgetError for more than `most` meetings; std::runtime_error if curved lines run along each other;
/// Stopped
CurveMeetings find_meetings(const CurvedLines& lines, std::size_t most, const Monitor& monitor);

/// Directions in which lines leave a vertex, all measured on one small circle around it, so that their order around
/// the vertex is correct even where curves touch.
class VertexHeadings {
public:
    VertexHeadings(const CurvedLines& lines, const CurveMeetings& meetings);

    /// The direction from the vertex of a mark, forwards or backwards along its line, in radians; NaN if the line
    /// ends there.
    double heading(std::size_t mark, bool is_forward) const;

private:
    double room(std::size_t mark, bool is_forward) const;

    const CurvedLines& lines_;
    const CurveMeetings& meetings_;
    std::vector<double> radius_;  // radius of the circle around each vertex
};

/// A diagram of drawn lines, and the positions of its passes.
struct CurveDiagram {
    LinkDiagram diagram;
    std::vector<std::vector<std::size_t>> marks;  ///< for each line and pass, the mark
    std::uint64_t multiple = 0;                   ///< omitted points where more than two strands meet
};

/// Makes the diagram of drawn lines, without upper strands. Points where two strands only touch are left out.
CurveDiagram make_curve_diagram(const CurvedLines& lines, const CurveMeetings& meetings);

}  // namespace sikku
