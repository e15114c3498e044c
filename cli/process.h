// cli/process.h: runs other programs, such as those of batch systems.
#pragma once

#include <string>

namespace sikku {

/// Runs a command line of the shell; returns its standard output without the last line feeds.
/// @throws std::runtime_error if it fails
std::string output_of(const std::string& command);

/// True if a folder of PATH contains the program.
bool is_in_path(const std::string& program);

}  // namespace sikku
