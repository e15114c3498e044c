// art/cutting/cutting_sheets.h: writes the sheets of a cutting plan, and lists them.
#pragma once

#include "art/cutting/cutting_plan.h"
#include "art/cutting/piece_drawing.h"

#include <filesystem>
#include <string>
#include <vector>

namespace sikku {

/// A table with one line for each sheet. @param materials, files  names of the colours and the files of the sheets
std::string cutting_text(const std::string& title, const CuttingOptions& options, const CuttingPlan& plan,
                         const std::vector<std::string>& materials, const std::vector<std::string>& files);
/// The plan as one line of JSON.
std::string cutting_json(const std::string& title, const CuttingOptions& options, const CuttingPlan& plan,
                         const std::vector<std::string>& materials, const std::vector<std::string>& files);

/// Writes the sheets of a plan with their pieces: the outlines to cut, which neighbours without a gap share, the
/// finished sizes dashed within allowances, and, if `labels`, the names of kinds, and a description of the sheet in
/// its margin.
/// @param materials  names of the colours of the sheets  @throws as write_pieces()
std::vector<DrawReport> write_cutting_sheets(const CuttingPlan& plan, const CuttingOptions& options,
                                             const std::vector<std::string>& materials, bool labels,
                                             PieceWriting writing, const std::filesystem::path& file,
                                             Destination& destination);

}  // namespace sikku
