// cli/sheet_item.h: drawings of sheets and workbooks as arguments.
#pragma once

#include "art/sheets.h"
#include "cli/command.h"

#include <string>

namespace sikku {

/// Reads `PATTERN` or `PATTERN@SETTINGS`, settings being options, keys, `n`, `variant` and `title`, separated by
/// commas. A file whose name contains an `@` is a pattern. @throws UsageError, PatternError
SheetItem read_sheet_item(const std::string& text, const PatternOptions& shared, bool quiet);

}  // namespace sikku
