// engine/measure/extent.h: measures a word without drawing it: length, counts, box, end.
#pragma once

#include "engine/geometry/space_turtle.h"
#include "engine/geometry/turtle.h"
#include "engine/measure/fold.h"

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace sikku {

/// Everything `sikku measure` tells. Unit steps of the turtle, starting at 0 0.
struct Measurement {
    std::int64_t n = 0;
    Quantity symbols;                                      ///< of the word before `interpret:`
    std::vector<std::pair<std::string, Quantity>> counts;  ///< of it, by letter, sorted; those that occur
    Quantity drawn;                                        ///< segments; from here on after `interpret:`
    Quantity moves;                                        ///< steps, drawn or not
    Quantity length;                                       ///< drawn, in steps
    Quantity polygons;                                     ///< closed by `}` or an inserted edge
    /// Absent if the word is too long for even the fold (then only counts are told), and in three dimensions.
    std::optional<Fold> geometry;
    std::optional<SpaceSurvey> space;  ///< in three dimensions: see Grammar::is_spatial()
    bool derived = false;              ///< the word had to be walked, or was kept whole for contexts
};

/// Measures by the fold if the system allows it, otherwise (and always in space) by one pass over the word. Contexts
/// are resolved first.
/// @param budget  most nodes of that pass; above it, a BudgetError
/// @param watch   as in DerivationOptions
/// @throws WordError for brackets that do not balance, steps that are not finite; BudgetError for words kept whole
/// that are too long, and if even the forecast is too much
Measurement measure(const Grammar& grammar, double budget, const std::function<void(std::uint64_t)>& watch = {});

}  // namespace sikku
