// art/gallery/process.h: other programs, which batch systems bring.
#pragma once

#include <string>

namespace sikku {

/// Runs a command line of the shell; its standard output without the last line feeds.
/// @throws std::runtime_error if it fails
std::string output_of(const std::string& command);

/// Whether a folder of PATH has the program.
bool is_in_path(const std::string& program);

}  // namespace sikku
