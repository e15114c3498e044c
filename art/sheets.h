// art/sheets.h: several documents on one sheet, as a work with options.
#pragma once

#include "engine/interpreter.h"

#include <filesystem>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

namespace sikku {

/// One drawing of a sheet.
struct SheetItem {
    Document document;
    OptionValues values;  ///< options of its drawing or its place; keys and defines of its pattern
};

/// Options of the sheet besides those of prints: columns, gutter, titles, …
std::span<const OptionInfo* const> sheet_options();
/// Options of one drawing's place on a sheet: x, y, width, height, title.
std::span<const OptionInfo* const> place_options();
/// True for an option of prints that concerns the whole sheet: its page, its file, its plot.
bool is_sheet_wide(std::string_view option);

/// Checks what can be checked without the drawings. @throws SettingError
void check_sheet(std::string_view format, const OptionValues& values);

/// Plans a sheet with the drawings in their order: in rows and columns, or, if they all have places, there.
/// @param format  a format of prints() that is neither an animation nor a model
/// @param values  options of the sheet, and of prints: those of drawings hold for each that has no value of its own
/// @param folder  folder of files that `values` name; empty: the working directory
/// @throws SettingError, PatternError
std::unique_ptr<Work> plan_sheet(const std::vector<SheetItem>& items, std::string_view format,
                                 const OptionValues& values, const std::filesystem::path& folder = {});

}  // namespace sikku
