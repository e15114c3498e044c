// engine/import/fractint_pattern.h: writes an entry of a Fractint collection as a pattern.
#pragma once

#include "engine/import/fractint_effects.h"

#include <string>

namespace sikku::fractint {

/// Returns the text of a pattern file.
/// @param room  bytes that may still be written; reduced by those written
/// @throws BadEntry after reporting an error
std::string write_pattern(const Entry& entry, const Effects& effects, const SourcePointer& file,
                          Diagnostics& diagnostics, ImportLosses& losses, std::size_t& room);

}  // namespace sikku::fractint
