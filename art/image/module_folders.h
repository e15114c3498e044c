// art/image/module_folders.h: finds the module and the programs for pictures.
#pragma once

#include "engine/base/installation.h"

#include <filesystem>
#include <vector>

namespace sikku {

/// Candidates, best first: they lie beside the data folders.
inline std::vector<std::filesystem::path> module_folders() {
    std::vector<std::filesystem::path> folders;
    for (const std::filesystem::path& data : data_folders()) {
        folders.push_back((data / SIKKU_MODULES_FROM_DATA).lexically_normal());
    }
    return folders;
}

}  // namespace sikku
