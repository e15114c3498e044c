// python/errors.h: translates exceptions of the libraries to those of the package.
#pragma once

#include "engine/base/diagnostic.h"

#include <pybind11/pybind11.h>

#include <string>
#include <vector>

namespace sikku {

/// Text from the libraries as `str`: UTF-8, except for file names.
pybind11::str to_text(const std::string& bytes);

/// A list of sikku.Diagnostic.
pybind11::list to_list(const std::vector<Diagnostic>& diagnostics);

/// Registers the translation of exceptions to those of sikku.errors.
void register_errors();

}  // namespace sikku
