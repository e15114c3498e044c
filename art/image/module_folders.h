// art/image/module_folders.h: where the module and the program of pictures are installed.
#pragma once

#include "engine/base/installation.h"

#include <filesystem>
#include <vector>

namespace sikku {

/// The folder that comes with the running program or library, then the installed one.
inline std::vector<std::filesystem::path> module_folders() {
    std::vector<std::filesystem::path> folders;
    const std::filesystem::path beside = binary_folder();
    if (!beside.empty()) folders.push_back((beside / SIKKU_MODULES_RELATIVE).lexically_normal());
#ifdef SIKKU_MODULES_INSTALLED
    folders.emplace_back(SIKKU_MODULES_INSTALLED);
#endif
    return folders;
}

}  // namespace sikku
