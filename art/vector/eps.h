// art/vector/eps.h: writes a drawing as Encapsulated PostScript.
#pragma once

#include "art/print/print.h"
#include "engine/base/output.h"

#include <memory>

namespace sikku {

/// Begins a document in `file`: Encapsulated PostScript 3.0, language level 2, with the same lines, areas and colours
/// as a PDF. It does not support opacity: translucent colours are mixed with that of the ground, or with white.
/// Pattern and recipe are comments. `print` and `file` are kept by reference and must outlive the writer. After
/// finish() the file is complete, but not committed. Source: Adobe Systems, "Encapsulated PostScript File Format
/// Specification", version 3.0, 1992.
/// @throws std::runtime_error, from here and from every call of the writer, if the file cannot be written or memory
/// is short
std::unique_ptr<PrintWriter> write_eps(const Print& print, Output& file);

}  // namespace sikku
