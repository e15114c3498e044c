// engine/language/undrawn.h: finds symbols that a turtle skips although they are meant to draw.
#pragma once

#include "engine/language/grammar.h"

#include <string>
#include <vector>

namespace sikku {

/// Letters that can only be meant as steps, in order: the dragon curve in F and G,
/// Sierpinski's triangle in F and G, the arrowhead curve in A and B, pasted without `forward: F G`. None if the
/// pattern has the key `forward`, is a map, or its symbols are notes. A letter is listed if a turtle skips it, if
/// it is not a context, and if
/// - nothing in the system draws or moves, although its words turn, and the letter has productions; or
/// - its productions consist of the letter alone, several times, as in `G --> GG`; or
/// - a step's productions contain it, and its own productions contain it, both outside of brackets, as in
///   `F --> F+G`, `G --> F-G`. In curves with nodes, such as Hilbert's in X and Y, F derives no node.
/// If there are none, nothing in the system draws, and the pattern has no `line: spline`, in which moves are points:
/// the letters that move, as in `X --> f[+X]f`.
/// Cost: linear in the grammar.
std::vector<std::string> meant_as_steps(const Pattern& pattern, const Grammar& grammar);

/// Warns about these letters at the first production of the first one.
void warn_of_undrawn(const Pattern& pattern, const Grammar& grammar, Diagnostics& diagnostics);

/// True for actions that leave ink: steps that draw, discs, polygons, surfaces, labels.
bool is_ink(Action action);

/// True if a word of the system, of any derivation length, may contain a symbol that draws. Cost: linear.
bool can_draw(const Grammar& grammar);

/// True if the word of the derivation length may contain a symbol that draws: exact for plain systems without
/// contexts, otherwise as if conditions, contexts and random choices were always fulfilled. Cost: at most about a
/// million symbols of successors; beyond that, returns can_draw().
bool may_draw(const Grammar& grammar);

/// For a word that draws nothing: names the letters that move, as `; 'f' moves without drawing; 'forward: f' makes it
/// a step, F draws`, or else those with productions that a turtle skips, as `; 'forward: A B' makes A and B steps`;
/// empty if there are none, or if other words of the system draw.
std::string undrawn_hint(const Grammar& grammar);

}  // namespace sikku
