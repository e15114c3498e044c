// engine/derivation/plain_form.h: converts systems with parameters into systems without.
#pragma once

#include "engine/language/grammar.h"

#include <optional>

namespace sikku {

/// Returns a plain system that derives the same words in as many steps: each letter with values that the derivation
/// reaches becomes a symbol. `f(x) --> f(x*s)` needs one symbol for each step. Such systems can be composed without
/// being derived, like plain ones. Symbols are printed like their modules. Nullopt for productions with contexts or
/// random choices, for cuts, and for more than 100,000 different modules. A plain system is returned unchanged.
/// Cost: O(modules x length of their successors + modules x steps).
std::optional<Grammar> plain_form(const Grammar& grammar);

}  // namespace sikku
