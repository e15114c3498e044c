// art/svg.h: a drawing as SVG in millimetres, for Inkscape, plotters and browsers.
#pragma once

#include "art/output_file.h"
#include "art/print.h"

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

namespace sikku {

/// Begins the document in `file`. `print` and `file` are kept by reference and must outlive the writer. After
/// finish() the file is complete, but not committed.
/// @throws std::runtime_error, from here and from every call of the writer, if the file cannot be written
std::unique_ptr<PrintWriter> write_svg(const Print& print, OutputFile& file);

/// The pattern's text, and what made the print, from the head of a file that write_svg wrote.
struct Provenance {
    std::string pattern;
    std::string made;
};
std::optional<Provenance> svg_provenance(const std::filesystem::path& file);

}  // namespace sikku
