// art/pdf_provenance.h: what a PDF of ours was made from.
#pragma once

#include "art/svg.h"

#include <filesystem>
#include <optional>

namespace sikku {

/// The pattern's text, and what made the print, from the end of a file that write_pdf wrote. Nullopt if it is no such
/// file, if another program has given it another layout, or if it holds no pattern.
std::optional<Provenance> pdf_provenance(const std::filesystem::path& file);

}  // namespace sikku
