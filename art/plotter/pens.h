// art/plotter/pens.h: fewer pens than colours.
#pragma once

#include "art/style/colour.h"

#include <cstddef>
#include <span>
#include <vector>

namespace sikku {

struct PenColour {
    Colour colour;
    double drawn = 0.0;  ///< length of its lines
};

/// Chooses at most `most` of the colours as pens and assigns each colour to the nearest: for each colour the index of
/// its pen. The sum of distances in OKLab, weighted by length, is as small as removing colours one by one and then
/// exchanging one for another can make it. The same result on every run. Cost: O(n^3) to
/// remove pens from n colours; O(n^2 p^2) for each round of exchanges among p pens, which are left out above 10^9.
/// Source: Kaufman & Rousseeuw, Partitioning Around Medoids, 1990.
/// @param most  at least 1
std::vector<std::size_t> merge_pens(std::span<const PenColour> colours, std::size_t most);

}  // namespace sikku
