// python/values.h: options and settings of Python as those of the libraries.
#pragma once

#include "engine/interpreter.h"

#include <pybind11/pybind11.h>

#include <string>
#include <utility>
#include <vector>

namespace sikku {

/// Names and texts, as the package passes them.
using TextPairs = std::vector<std::pair<std::string, std::string>>;

OptionValues to_values(const TextPairs& pairs);
std::vector<Setting> to_settings(const TextPairs& pairs);

/// prints() or scores(). @throws pybind11::value_error for other names
const Interpreter& interpreter_of(const std::string& name);

/// A list of (is a warning, text).
pybind11::list to_list(const std::vector<Remark>& remarks);

/// For each option of an interpreter: (name, may be repeated, is a flag, placeholder of the value, help).
pybind11::list list_options(const Interpreter& interpreter);
/// For each format of an interpreter: (extension, alias, is text).
pybind11::list list_formats(const Interpreter& interpreter);
/// The names of all keys of the language.
pybind11::list list_keys();

}  // namespace sikku
