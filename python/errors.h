// python/errors.h: exceptions of the libraries as those of the package.
#pragma once

#include "engine/base/diagnostic.h"

#include <pybind11/pybind11.h>

#include <string>
#include <vector>

namespace sikku {

/// A text of the libraries, which is UTF-8 except for names of files.
pybind11::str to_text(const std::string& bytes);

/// A list of sikku.Diagnostic.
pybind11::list to_list(const std::vector<Diagnostic>& diagnostics);

/// From here on exceptions of the libraries arrive in Python as those of sikku.errors.
void register_errors();

}  // namespace sikku
