// art/svg.h: a drawing as SVG in millimetres, for Inkscape, plotters and browsers.
#pragma once

#include "art/output_file.h"
#include "art/print.h"
#include "engine/path.h"

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

namespace sikku {

/// Returns a sink that writes to `file`; call finish() after the last stroke, then commit the file.
class SvgWriter : public PathSink {
public:
    /// Completes the document. The file is not committed.
    virtual void finish() = 0;
};
std::unique_ptr<SvgWriter> write_svg(const Print& print, OutputFile& file);

/// The pattern's text, and what made the print, from the head of a file that write_svg wrote.
struct Provenance {
    std::string pattern;
    std::string made;
};
std::optional<Provenance> svg_provenance(const std::filesystem::path& file);

}  // namespace sikku
