// engine/import/cpfg_pattern.h: writes a system of cpfg as a pattern.
#pragma once

#include "engine/import/cpfg_system.h"
#include "engine/import/cpfg_view.h"

#include <string>

namespace sikku::cpfg {

/// Returns the text of a pattern file; empty after an error. Reports features that are lost.
/// @param name  name of the system
std::string write_pattern(System system, const View& view, const std::string& name, const SourcePointer& file,
                          Report& report);

}  // namespace sikku::cpfg
