// engine/language/unit_vector.h: unit vectors of turns, with the same bits on every machine.
#pragma once

#include "engine/language/angle.h"

#include <cstdint>
#include <glm/vec2.hpp>

namespace sikku {

/// A turn as its nearest axis and the rest: quarter / 4 + rest / (4 denominator), |rest| <= denominator / 2.
struct FoldedTurn {
    int quarter = 0;        ///< 0 to 3
    std::int64_t rest = 0;  ///< in 4 x denominator-ths of a turn
};
FoldedTurn fold_turn(TurnFraction turn);

/// Turns a vector by whole quarters. @param quarter  0 or more
template <class Vector>
Vector by_quarters(int quarter, Vector vector) {
    for (; quarter % 4 > 0; --quarter) vector = {-vector.y, vector.x};
    return vector;
}

/// Cosine and sine of a turn, exact at multiples of 30 and 45 degrees where they are 0, 1/2 or 1.
glm::dvec2 unit_vector(double degrees);
glm::dvec2 unit_vector(TurnFraction turn);

}  // namespace sikku
