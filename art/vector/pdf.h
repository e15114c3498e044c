// art/vector/pdf.h: writes a drawing as vector PDF 1.6 with page boxes.
#pragma once

#include "art/print/print.h"
#include "engine/base/output.h"

#include <memory>

namespace sikku {

/// Begins the document in `file`. With inks of a press it is a PDF/X-4 (ISO 15930-7:2010) in CMYK and spot colours.
/// `print` and `file` are kept by reference and must outlive the writer. After finish() the file is complete, but not
/// committed.
/// @throws std::runtime_error, from here and from every call of the writer, if the file cannot be written or memory
/// is short
std::unique_ptr<PrintWriter> write_pdf(const Print& print, Output& file);

/// Writes a drawing into a file of several pages, each showing a part of it.
class PagesWriter : public PrintWriter {
public:
    /// Begins a page that shows the part `shown` of the drawing, in millimetres of the drawing's page, at the
    /// position `at` and magnified by `scale`. The first call ends the drawing; later strokes belong to the new page
    /// and lie over that part, in the style and the placement of `page`.
    virtual void begin_page(const Print& page, const Window& shown, glm::dvec2 at, double scale) = 0;
};

/// Begins a document like write_pdf(), whose pages begin_page() adds. The drawing itself is written once.
/// Bleed and crop marks of `print` have no effect.
std::unique_ptr<PagesWriter> write_pdf_pages(const Print& print, Output& file);

}  // namespace sikku
