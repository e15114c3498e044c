// engine/derivation/word_size.h: sizes of words, for forecasts.
#pragma once

#include "engine/language/grammar.h"

#include <cstdint>

namespace sikku {

/// Node and symbol counts of a word.
struct WordSize {
    double nodes = 0;  ///< visited
    double drawn = 0;  ///< symbols that draw lines, discs or surfaces
};

/// Returns the size of the word: by estimate(), or, where only deriving determines it, by deriving at most about
/// `most` nodes; the size of a longer word is extrapolated from shorter ones. Cost: 20 ns for each of these nodes.
/// @param grammar  has no map
WordSize word_size(const Grammar& grammar, double most);

/// Extrapolates growth: the factor from `late` to `steps` steps of a quantity that grew from `first` to `last`
/// between `early` and `late` steps. Slow growth is a power of the steps, other growth exponential. At least 1.
double extrapolated_growth(std::int64_t early, double first, std::int64_t late, double last, std::int64_t steps);

}  // namespace sikku
