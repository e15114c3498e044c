// engine/derivation/plain_form.h: systems with parameters as systems without.
#pragma once

#include "engine/language/grammar.h"

#include <optional>

namespace sikku {

/// A plain system that derives the same words in as many steps: each letter with its values becomes a symbol, as far
/// as they are reached in steps(). `f(x) --> f(x*s)` needs one symbol for each step. Such systems can therefore be
/// composed without being derived, like plain ones. Symbols print as their modules did. Nullopt for productions with
/// contexts or chance, for cuts, and for more than 100,000 different modules. A plain system is returned as it is.
/// Cost: O(modules x length of their successors + modules x steps).
std::optional<Grammar> plain_form(const Grammar& grammar);

}  // namespace sikku
