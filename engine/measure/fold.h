// engine/measure/fold.h: computes the effect of a word on a turtle by composition, without deriving the word.
#pragma once

#include "engine/derivation/forecast.h"
#include "engine/geometry/lattice.h"

#include <array>
#include <glm/vec2.hpp>
#include <optional>
#include <string>
#include <vector>

namespace sikku {

/// A number of any size: exact digits where a double no longer counts in ones (from 2^53 on).
struct Quantity {
    double value = 0.0;
    std::string digits;  ///< empty below 2^53; else a whole decimal number, or "about 10^k"

    static Quantity of(const Integer& whole);
    static Quantity of(double value);
    /// A real number of the lattice's ring, by its coordinates.
    static Quantity of(const Lattice& lattice, const std::array<Integer, most_coordinates>& real);
};

/// The net effect of the interpreted word on a turtle that starts at 0 0; unit steps.
struct Fold {
    std::array<Quantity, 4> box;                 ///< xmin ymin xmax ymax of all positions, the start included
    std::optional<std::array<Quantity, 4>> ink;  ///< of the segments drawn
    std::array<Quantity, 2> end;
    double heading = 0.0;  ///< degrees in [0, 360)
    bool closed = false;
    std::int64_t depth = 0;
    std::vector<glm::dvec2> box_hull;  ///< convex hull of all positions, anticlockwise
    std::vector<glm::dvec2> ink_hull;  ///< convex hull of the segments drawn; empty if none is
};

/// Composes the effect of each (symbol, steps to go) from those of its successor. Exact wherever the lattice of the
/// grammar is: in 64 bits, and in as many as it takes beyond. Nothing is derived.
/// Nullopt if productions look at neighbours, if the composition itself would be too much (about 10^7 compositions of
/// numbers of 64 bits, 5 x 10^6 corners of hulls), if brackets are left open over more than 4096 levels, if braces do
/// not balance, or if doubles do not hold the coordinates.
/// @throws WordError for brackets that do not balance in the word
/// Cost: O(symbols x steps) compositions, each of the size of the hulls (usually below 30 corners).
std::optional<Fold> fold(const Grammar& grammar);

}  // namespace sikku
