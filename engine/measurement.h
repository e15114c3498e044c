// engine/measurement.h: measures documents: words by composition, maps by derivation.
#pragma once

#include "engine/base/monitor.h"
#include "engine/language/document.h"

#include <string>

namespace sikku {

/// Measures a pattern as one line of JSON. Letters that are meant to draw but do not are listed as `undrawn`: see
/// meant_as_steps().
/// @param budget  maximum number of derivation nodes visited; of a map, of edges in the maps of all steps
/// @throws BudgetError, WordError, Stopped: see measure() and MapDerivation
std::string measure_as_json(const Document& document, double budget, const Monitor& monitor = {});
/// The same as text with one line for each quantity.
std::string measure_as_text(const Document& document, double budget, const Monitor& monitor = {});

}  // namespace sikku
