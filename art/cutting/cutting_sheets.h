// art/cutting/cutting_sheets.h: writes the sheets of a cutting plan.
#pragma once

#include "art/cutting/cutting_plan.h"
#include "art/cutting/piece_drawing.h"

#include <filesystem>
#include <string>
#include <vector>

namespace sikku {

/// Writes the sheets of a plan with their pieces: the outlines to cut, which neighbours without a gap share, the
/// finished sizes dashed within allowances, and, if `labels`, the names of kinds, and a description of the sheet in
/// its margin.
/// @param materials  names of the colours of the sheets  @throws as write_pieces()
std::vector<DrawReport> write_cutting_sheets(const CuttingPlan& plan, const CuttingOptions& options,
                                             const std::vector<std::string>& materials, bool labels,
                                             PieceWriting writing, const std::filesystem::path& file,
                                             Destination& destination);

}  // namespace sikku
