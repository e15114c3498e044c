// studio/editor/rename.h: renames what a pattern names, everywhere in it.
#pragma once

#include "studio/editor/occurrences.h"
#include "studio/editor/text_edit.h"

#include <stdexcept>
#include <string>
#include <vector>

namespace sikku {

/// The reason why something cannot be renamed, as a sentence without its full stop.
class RenameError : public std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// Refuses what has a name of its own accord: keys, arrows. @throws RenameError
void require_renamable(const Occurrence& name);

/// The changes that rename a symbol, table, define, parameter, surface or variant at every place, sorted. The pattern
/// means the same afterwards; otherwise nothing is renamed.
/// @param pattern  without settings from outside  @param all  occurrences(pattern)
/// @throws RenameError if the pattern has errors, if the new name is in use, if it is not a name of this kind, or if
/// it would change what the pattern means, as that of a command of the turtle would
std::vector<TextEdit> renaming(const Pattern& pattern, const std::vector<Occurrence>& all, const Occurrence& name,
                               const std::string& new_name);

}  // namespace sikku
