// engine/base/installation.h: where the running program or module is, beside which its data is installed.
#pragma once

#include <filesystem>

namespace sikku {

/// Folder of the binary that contains this library: a program, or a shared library that a program has loaded, such as
/// a module of Python. Empty if the system does not report it.
std::filesystem::path binary_folder();

}  // namespace sikku
