// art/workbook/workbook.h: workbooks for classes: lessons, pages to trace and to colour of several kolams in a PDF.
#pragma once

#include "art/sheets.h"
#include "engine/interpreter.h"

#include <filesystem>
#include <memory>
#include <span>
#include <vector>

namespace sikku {

/// Options of a workbook: heading, size, booklet, keep-order, colouring.
std::span<const OptionInfo* const> workbook_options();

/// Plans a workbook, a PDF, of kolams from easy to hard. Drawings are on white paper.
/// @param values  options of the workbook @param folder  folder of files that the items name
/// @throws SettingError, PatternError; BudgetError and std::runtime_error for a drawing that is too large or that has
/// no lines
std::unique_ptr<Work> plan_workbook(const std::vector<SheetItem>& items, const OptionValues& values,
                                    const std::filesystem::path& folder = {});

}  // namespace sikku
