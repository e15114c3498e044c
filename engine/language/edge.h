// engine/language/edge.h: straight steps that are as long as the path of a word, such as `edge L: -f++f-`.
#pragma once

#include "engine/language/angle.h"

#include <cstdint>
#include <string>
#include <vector>

namespace sikku {

/// A step as long as the distance between the ends of a word, which ends straight ahead of its start, or behind.
struct EdgeLength {
    /// All steps of the word in one direction.
    struct Part {
        TurnFraction direction;
        double length = 0;       ///< of each step
        std::int64_t count = 0;  ///< number of these steps
    };
    std::string letter;
    double length = 0;        ///< in turtle steps, rounded; not 0; negative: behind
    std::vector<Part> parts;  ///< empty if they do not lie on an exact lattice
};

/// The largest number of symbols in the word of an edge.
constexpr std::size_t most_edge_symbols = 1'000'000;

}  // namespace sikku
