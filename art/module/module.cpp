#include "art/module/module.h"

#include "engine/base/installation.h"

#include <dlfcn.h>

#include <stdexcept>

namespace sikku {

std::vector<std::filesystem::path> module_folders() {
    std::vector<std::filesystem::path> folders;
    for (const std::filesystem::path& data : data_folders()) {
        folders.push_back((data / SIKKU_MODULES_FROM_DATA).lexically_normal());
    }
    return folders;
}

const void* load_module(const std::string& name, std::uint64_t version, const std::string& needed) {
    std::string reasons;
    for (const std::filesystem::path& folder : module_folders()) {
        const std::string file = (folder / (name + ".so")).string();
        void* library = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
        if (!library) {
            const char* reason = dlerror();
            reasons += std::string("\n  ") + (reason ? reason : "unknown error");
            continue;
        }
        void* symbol = dlsym(library, (name + "_module").c_str());
        const void* found = symbol ? reinterpret_cast<const void* (*)()>(symbol)() : nullptr;
        if (found && *static_cast<const std::uint64_t*>(found) == version) return found;
        dlclose(library);
        reasons += "\n  " + file + ": made for another version of sikku";
    }
    if (const std::string refused = refused_data(); reasons.empty() && !refused.empty()) reasons = ' ' + refused;
    throw std::runtime_error(needed + ":" + reasons);
}

}  // namespace sikku
