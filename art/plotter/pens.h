// art/plotter/pens.h: merges similar colours for plotters with few pens.
#pragma once

#include "art/style/colour.h"

#include <cstddef>
#include <span>
#include <vector>

namespace sikku {

struct PenColour {
    Colour colour;
    double drawn = 0.0;  ///< length of the lines in this colour
};

/// Chooses at most `most` of the colours as pens and returns for each colour the index of the nearest pen. Minimises
/// the sum of distances in OKLab, weighted by length, by removing colours one by one and then exchanging single
/// colours. The result is the same on every run. Cost: O(n^3) to remove pens from n colours; O(n^2 p^2) for each
/// round of exchanges among p pens, which is skipped above 10^9.
/// Source: Kaufman & Rousseeuw, Partitioning Around Medoids, 1990.
/// @param most  at least 1
std::vector<std::size_t> merge_pens(std::span<const PenColour> colours, std::size_t most);

}  // namespace sikku
