// engine/base/installation.h: the folder of the running program or module, relative to which its data is installed.
#pragma once

#include <filesystem>

namespace sikku {

/// Folder of the binary that contains this library: a program, or a shared library such as a Python module. Empty if
/// the system does not report it.
std::filesystem::path binary_folder();

}  // namespace sikku
