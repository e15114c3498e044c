// art/cutting/piece_rows.h: lays copies of a piece in rows, turned alternately by 180 degrees, with few gaps.
#pragma once

#include "art/print/page.h"
#include "engine/base/monitor.h"

#include <glm/vec2.hpp>

#include <cstddef>
#include <span>
#include <vector>

namespace sikku {

/// A copy of a piece: turned about the origin of its corners, then moved. Lengths are millimetres, y up.
struct PieceCopy {
    double turn = 0;  ///< radians anticlockwise
    glm::dvec2 at{0.0};
};

/// Copies in an area, in rows from top to bottom and from left to right, and the area that remains.
struct LaidPieces {
    std::vector<PieceCopy> copies;
    Box below;   ///< the rest of the area below the last row
    Box beside;  ///< the rest of the last row; empty if there is none
};

/// The arrangements of congruent copies of a piece in rows. A row repeats one copy, or one and another turned by 180
/// degrees, beside or above it, as near to each other as their outlines allow; rows are displaced against each other
/// so that they fit into each other. Sides of the piece, or of its convex hull, lie along the rows.
///
/// The arrangements are the double lattices of Kuperberg & Kuperberg 1990, "Double-lattice packings of convex
/// bodies", as far as pieces can slide into their places along the axes. Displacements are tried that bring corners
/// or, for simple outlines, middles of sides next to each other.
class PieceRows {
public:
    /// Finds the densest arrangements. Cost: some 10^7 steps for a dozen corners, 10^9 for hundreds; less than 1 ms
    /// for a piece that does not fit.
    /// @param outline  anticlockwise, with half of the gap between pieces  @param keeps_direction  pieces are turned
    /// by 180 degrees only  @param area  the largest that will be filled: directions in which the piece does not fit
    /// there are not searched  @throws Stopped
    PieceRows(std::span<const glm::dvec2> outline, bool keeps_direction, const Box& area, const Monitor& monitor);

    /// Fills an area with at most `most` copies, in the arrangement that holds most or needs least height.
    LaidPieces fill(const Box& area, std::size_t most) const;

    /// The smallest of the sizes of the piece, each with its longer side first.
    glm::dvec2 least_size() const { return least_size_; }

private:
    struct Copy {
        bool is_turned = false;
        glm::dvec2 at{0.0};
    };
    /// Rows begin at multiples of `row`, copies in them repeat after `period`.
    struct Arrangement {
        std::size_t direction = 0;  ///< index into directions_
        std::vector<Copy> unit;
        double period = 0;
        glm::dvec2 row{0.0};
        double density = 0;  ///< share of the plane that pieces cover
    };
    static bool is_denser(const Arrangement& a, const Arrangement& b);
    /// The piece turned so that a side lies along the rows.
    struct Direction {
        double turn = 0;
        Box box;
    };
    class Finder;

    Box box_of(const Arrangement& arrangement, const Copy& copy) const;
    template <class Visit>
    void for_each_row(const Arrangement& arrangement, const Box& area, std::size_t phase, Visit&& visit) const;

    std::vector<Direction> directions_;
    std::vector<Arrangement> arrangements_;  ///< the densest first
    glm::dvec2 least_size_{0.0};
};

}  // namespace sikku
