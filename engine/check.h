// engine/check.h: finds all errors of a pattern file.
#pragma once

#include "engine/interpreter.h"

#include <span>
#include <string>
#include <vector>

namespace sikku {

/// Reports brackets and braces of the word that do not balance, at the first successor or axiom in which they do not.
/// Words in space and those whose composition takes long are not checked.
void check_brackets(const Pattern& pattern, const Grammar& grammar, Diagnostics& diagnostics);

/// Checks a pattern with each of its variants: the language, the keys of the interpreters, and whether the brackets
/// of the word balance. Diagnostics are sorted by place; those that several variants share are reported once. After
/// 50 errors, further variants are skipped.
/// @throws Stopped
std::vector<Diagnostic> check_pattern(std::string name, std::string text,
                                      std::span<const Interpreter* const> interpreters, const Monitor& monitor);

}  // namespace sikku
