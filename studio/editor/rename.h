// studio/editor/rename.h: renames symbols and other names of a pattern wherever they occur.
#pragma once

#include "studio/editor/occurrences.h"
#include "studio/editor/text_edit.h"

#include <stdexcept>
#include <string>
#include <vector>

namespace sikku {

/// Reports why a name cannot be renamed, as a sentence without its full stop.
class RenameError : public std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// Refuses places without a name (null), keys and arrows, which cannot be renamed. @throws RenameError
void require_renamable(const Occurrence* name);

/// The edits that rename a symbol, table, define, parameter, surface or variant wherever it occurs, sorted. They do
/// not change the meaning of the pattern.
/// @param pattern  without settings from outside  @param all  occurrences(pattern)
/// @throws RenameError if the pattern has errors, or if the new name is in use, is not a name of this kind, or would
/// change the meaning of the pattern, as the name of a turtle command would
std::vector<TextEdit> renaming(const Pattern& pattern, const std::vector<Occurrence>& all, const Occurrence& name,
                               const std::string& new_name);

}  // namespace sikku
