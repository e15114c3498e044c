// art/pdf.h: a drawing as vector PDF 1.6 with real page boxes.
#pragma once

#include "art/output_file.h"
#include "art/print.h"
#include "engine/path.h"

#include <memory>

namespace sikku {

/// Returns a sink that writes to `file`; call finish() after the last stroke, then commit the file.
class PdfWriter : public PathSink {
public:
    virtual void finish() = 0;
};
std::unique_ptr<PdfWriter> write_pdf(const Print& print, OutputFile& file);

}  // namespace sikku
