// art/vector/vector_formats.h: opens the writer of a format that draws vectors.
#pragma once

#include "art/vector/pdf.h"
#include "art/vector/svg.h"

#include <memory>
#include <stdexcept>

namespace sikku {

/// Begins a document in `file`: Encapsulated PostScript 3.0, language level 2, with the same lines, areas and colours
/// as a PDF. It does not support opacity: translucent colours are mixed with that of the ground, or with white.
/// Pattern and recipe are comments. `print` and `file` are kept by reference and must outlive the writer. After
/// finish() the file is complete, but not committed. Source: Adobe Systems, "Encapsulated PostScript File Format
/// Specification", version 3.0, 1992.
/// @throws std::runtime_error, from here and from every call of the writer, if the file cannot be written or memory
/// is short
std::unique_ptr<PrintWriter> write_eps(const Print& print, Output& file);

/// Begins a document: see write_svg(), write_pdf() and write_eps(). @param format  of the kind `vectors`
inline std::unique_ptr<PrintWriter> write_vectors(PrintFormat format, const Print& print, Output& file) {
    if (format == PrintFormat::svg) return write_svg(print, file);
    if (format == PrintFormat::eps) return write_eps(print, file);
    if (format == PrintFormat::pdf) return write_pdf(print, file);
    throw std::logic_error("this format of vectors has no writer");
}

}  // namespace sikku
