// engine/geometry/lattice.h: the coordinates of turtles: whole numbers on a lattice if the angles allow it, otherwise
// doubles.
#pragma once

#include "engine/language/grammar.h"

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <vector>

namespace sikku {

/// Positions and headings of a grammar's turtle.
///
/// If every turn is a multiple of 360/k degrees, headings are whole numbers modulo k. If moreover phi(k) <= 8,
/// positions are points of Z[zeta], zeta = exp(2 pi i / k): `rank` = phi(k) whole coordinates (2, 4, 6 or 8; k = 1
/// and 2 are counted as 4), in units of `unit` turtle steps. A curve that closes then closes exactly. Else positions
/// are doubles; else headings are degrees in doubles, too.
struct Lattice {
    std::uint32_t headings = 0;   ///< k, or 0: headings are degrees
    int rank = 0;                 ///< coordinates of a position, or 0: positions are doubles
    double unit = 1.0;            ///< length of one unit, in turtle steps
    double first_heading = 90.0;  ///< degrees anticlockwise from the x axis

    /// One unit step for each heading, in the plane, the first heading included.
    std::vector<glm::dvec2> direction;
    /// Coordinates of zeta^h for each heading h; only the first `rank` count.
    std::vector<std::array<std::int8_t, 8>> power;

    /// For each symbol of the grammar:
    std::vector<std::uint32_t> turn;   ///< its turn in headings, if headings > 0
    std::vector<std::int64_t> length;  ///< its step in units, if rank > 0

    /// Where the i-th coordinate's unit points to in the plane.
    glm::dvec2 basis(int i) const { return direction[static_cast<std::size_t>(i)]; }
};

/// The lattice that all turns and lengths of the grammar fit; doubles where there is none. Cost: O(symbols + k).
Lattice make_lattice(const Grammar& grammar);

/// A turn as its nearest axis and the rest: quarter / 4 + rest / (4 denominator), |rest| <= denominator / 2.
struct FoldedTurn {
    int quarter = 0;        ///< 0 to 3
    std::int64_t rest = 0;  ///< in 4 x denominator-ths of a turn
};
FoldedTurn fold_turn(TurnFraction turn);

/// Turns a vector by whole quarters.
template <class Vector>
Vector by_quarters(int quarter, const Vector& vector) {
    switch (quarter % 4) {
        case 0:
            return vector;
        case 1:
            return {-vector.y, vector.x};
        case 2:
            return {-vector.x, -vector.y};
        default:
            return {vector.y, -vector.x};
    }
}

/// Cosine and sine of a turn, exact at multiples of 30 and 45 degrees where they are 0, 1/2 or 1.
glm::dvec2 unit_vector(double degrees);
glm::dvec2 unit_vector(TurnFraction turn);

}  // namespace sikku
