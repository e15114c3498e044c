// engine/measure/fold.h: computes the effect of a word on a turtle by composition, without deriving the word.
#pragma once

#include "engine/language/grammar.h"

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <optional>
#include <string>
#include <vector>

namespace sikku {

/// A number of any size. It has digits from 2^53 on, where doubles do not represent all whole numbers.
struct Quantity {
    double value = 0.0;
    std::string digits;  ///< empty below 2^53; else a whole decimal number, or "about 10^k"

    static Quantity of(double value);
};

/// Net effect of the interpreted word on a turtle that starts at 0 0, in turtle steps.
struct Fold {
    std::array<Quantity, 4> box;                 ///< xmin ymin xmax ymax of all positions, the start included
    std::optional<std::array<Quantity, 4>> ink;  ///< the same for the segments drawn
    std::array<Quantity, 2> end;
    double heading = 0.0;  ///< degrees in [0, 360)
    bool closed = false;
    std::int64_t depth = 0;
    std::vector<glm::dvec2> box_hull;  ///< convex hull of all positions, anticlockwise
    std::vector<glm::dvec2> ink_hull;  ///< convex hull of the segments drawn; empty if none is
};

/// Composes the effect of each symbol with each number of remaining steps from those of its successor, without
/// deriving anything. Exact if the lattice of the grammar is: in 64 bits, and in more where necessary. Nullopt for
/// maps, if the system has parameters or random choices, if productions look at neighbours, if the composition itself
/// is too costly (about 3 x 10^7 compositions of 64-bit numbers, 5 x 10^6 corners of hulls, axioms of 10^6 symbols),
/// if a part has more than 4096 unmatched brackets, if braces do not balance, or if coordinates exceed the range of
/// doubles.
/// @param refuses_braces  throw WordError, without a place, for braces that do not balance
/// @throws WordError for brackets that do not balance in the word
/// Cost: O(symbols x steps) compositions, each linear in the corners of the hulls (usually below 30).
std::optional<Fold> fold(const Grammar& grammar, bool refuses_braces = false);

}  // namespace sikku
