// engine/geometry/lattice.h: the coordinates of turtles: whole numbers on a lattice if the angles allow it, otherwise
// doubles.
#pragma once

#include "engine/base/roots_of_unity.h"
#include "engine/language/grammar.h"
#include "engine/language/unit_vector.h"

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
    std::vector<std::array<std::int8_t, most_coordinates>> power;

    /// For each symbol of the grammar:
    std::vector<std::uint32_t> turn;  ///< its turn in headings, if headings > 0
    /// Its step, if rank > 0: in units, or, of an edge whose length is irrational, as a multiple of `edges`.
    std::vector<std::int64_t> length;
    std::vector<std::uint32_t> edge;  ///< 0, or the index in `edges` plus 1, if rank > 0
    /// Real numbers of Z[zeta], whose multiples are steps of irrational length along heading 0.
    std::vector<std::array<std::int64_t, most_coordinates>> edges;

    /// The step of a symbol along heading 0 in coordinates; rank > 0.
    std::array<std::int64_t, most_coordinates> step(Symbol symbol) const {
        std::array<std::int64_t, most_coordinates> result{};
        if (edge[symbol] == 0) {
            result[0] = length[symbol];
        } else {
            result = edges[edge[symbol] - 1];
            for (std::int64_t& coordinate : result) coordinate *= length[symbol];
        }
        return result;
    }
    /// The length of the step of a symbol, as precise as `Number`. @param ahead  unit vectors of all headings, which
    /// have members x and y
    template <class Number, class Vectors>
    Number step_length(Symbol symbol, double otherwise, const Vectors& ahead) const {
        if (rank == 0 || edge[symbol] == 0) return static_cast<Number>(otherwise);
        const auto coordinates = step(symbol);
        Number sum = 0;
        for (std::size_t i = 0; i < static_cast<std::size_t>(rank); ++i) {
            sum += static_cast<Number>(coordinates[i]) * (ahead[i].x * ahead[0].x + ahead[i].y * ahead[0].y);
        }
        return sum * static_cast<Number>(unit);
    }

    /// Direction of the i-th coordinate's unit in the plane.
    glm::dvec2 basis(int i) const { return direction[static_cast<std::size_t>(i)]; }
};

/// Returns the lattice that all turns and lengths of the grammar fit; doubles if there is none. Cost: O(symbols + k +
/// edges).
Lattice make_lattice(const Grammar& grammar);

}  // namespace sikku
