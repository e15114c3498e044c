// engine/derivation/exact_counts.h: exact counts of the symbols of a word.
#pragma once

#include "engine/base/integer.h"

#include <vector>

namespace sikku {

/// One number for each symbol of the grammar.
struct ExactCounts : std::vector<Integer> {
    using std::vector<Integer>::vector;
};

}  // namespace sikku
