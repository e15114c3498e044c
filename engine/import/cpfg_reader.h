// engine/import/cpfg_reader.h: reads the L-system of a file of cpfg.
#pragma once

#include "engine/import/cpfg_system.h"
#include "engine/import/cpfg_view.h"

#include <string>

namespace sikku::cpfg {

/// Reads the first L-system in the text of a file. Errors and losses go to `report`.
System read_system(std::string text, const View& view, Report& report);

}  // namespace sikku::cpfg
