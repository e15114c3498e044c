// engine/derivation/word_size.h: sizes of words, for forecasts.
#pragma once

#include "engine/language/grammar.h"

#include <cstdint>

namespace sikku {

/// Sizes of a word, for forecasts.
struct WordSize {
    double nodes = 0;  ///< visited
    double drawn = 0;  ///< symbols that draw lines, discs or surfaces
};

/// The size of the word: estimate(), or, where only deriving determines it, by deriving at most about `most` nodes;
/// that of a longer word follows from the growth of shorter ones. Cost: 20 ns for each of these nodes.
/// @param grammar  has no map
WordSize word_size(const Grammar& grammar, double most);

/// How many times as much there is after `steps` steps as after `late` ones, where it grew from `first` to `last`
/// between `early` and `late` steps: as a power of the steps if it grows slowly, otherwise exponentially. At least 1.
double extrapolated_growth(std::int64_t early, double first, std::int64_t late, double last, std::int64_t steps);

}  // namespace sikku
