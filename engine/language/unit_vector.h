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
