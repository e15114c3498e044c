// engine/measure/extent.h: measures a word without drawing it: length, counts, box, end; as data, text and JSON.
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

/// Quantities that `sikku measure` reports. The turtle starts at 0 0; one step is 1.
struct Measurement {
    std::int64_t n = 0;
    Quantity symbols;                                      ///< in the word before `interpret:`
    std::vector<std::pair<std::string, Quantity>> counts;  ///< in that word, by letter, sorted, without zeros
    Quantity drawn;                                        ///< segments; this and the following after `interpret:`
    Quantity moves;                                        ///< steps, drawn or not
    Quantity length;                                       ///< drawn, in steps
    Quantity polygons;                                     ///< closed by `}` or an inserted edge
    /// Absent in three dimensions, and if the word is too long even for the fold; then only counts are measured.
    std::optional<Fold> geometry;
    std::optional<SpaceSurvey> space;  ///< in three dimensions: see Grammar::is_spatial()
    bool derived = false;              ///< true if the word was walked through, or kept whole for contexts
};

/// Measures by fold() if the system allows it, otherwise (and always in space) by one pass over the word. Contexts
/// are resolved first.
/// @param budget  maximum number of nodes visited in that pass; above it, plain systems have no geometry, and others
/// throw BudgetError
/// @param watch   as in DerivationOptions
/// @throws WordError for unbalanced brackets and for steps that are not finite; BudgetError if words kept whole are
/// too long, or if even the forecast is too costly
Measurement measure(const Grammar& grammar, double budget, const std::function<void(std::uint64_t)>& watch = {});

/// One line of JSON. Numbers beyond double precision are strings of digits. @param title  title of the pattern
std::string measurement_json(const std::string& title, const Measurement& measurement);
/// Text with one line for each quantity.
std::string measurement_text(const std::string& title, const Measurement& measurement);

}  // namespace sikku
