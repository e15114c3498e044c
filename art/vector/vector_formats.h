// art/vector/vector_formats.h: opens the writer of a format that draws vectors.
#pragma once

#include "art/vector/eps.h"
#include "art/vector/pdf.h"
#include "art/vector/svg.h"

#include <memory>
#include <stdexcept>

namespace sikku {

/// Begins a document: see write_svg(), write_pdf() and write_eps(). @param format  of the kind `vectors`
inline std::unique_ptr<PrintWriter> write_vectors(PrintFormat format, const Print& print, Output& file) {
    if (format == PrintFormat::svg) return write_svg(print, file);
    if (format == PrintFormat::eps) return write_eps(print, file);
    if (format == PrintFormat::pdf) return write_pdf(print, file);
    throw std::logic_error("this format of vectors has no writer");
}

}  // namespace sikku
