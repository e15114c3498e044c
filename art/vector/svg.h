// art/vector/svg.h: writes a drawing as SVG in millimetres, for Inkscape, plotters and browsers.
#pragma once

#include "art/print/print.h"
#include "engine/base/output.h"

#include <memory>
#include <string_view>

namespace sikku {

/// Namespace of the elements that contain the pattern and the recipe of the print.
constexpr std::string_view svg_name_space = "urn:sikku:print";

/// Begins the document in `file`. `print` and `file` are kept by reference and must outlive the writer. After
/// finish() the file is complete, but not committed.
/// @throws std::runtime_error, from here and from every call of the writer, if the file cannot be written
std::unique_ptr<PrintWriter> write_svg(const Print& print, Output& file);

}  // namespace sikku
