// art/vector/pdf.h: a drawing as vector PDF 1.6 with real page boxes.
#pragma once

#include "art/print/print.h"
#include "engine/base/output.h"

#include <memory>

namespace sikku {

/// Begins the document in `file`. `print` and `file` are kept by reference and must outlive the writer. After
/// finish() the file is complete, but not committed.
/// @throws std::runtime_error, from here and from every call of the writer, if the file cannot be written or memory
/// is short
std::unique_ptr<PrintWriter> write_pdf(const Print& print, Output& file);

}  // namespace sikku
