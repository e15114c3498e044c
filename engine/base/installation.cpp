#include "engine/base/installation.h"

#include <dlfcn.h>
#ifdef __GLIBC__
#include <link.h>
#endif

#include <cstdlib>
#include <fstream>
#include <string>
#include <system_error>

namespace sikku {
namespace {

/// The shared library that contains this function; empty if it is linked into a program.
std::filesystem::path shared_library() {
#ifdef __GLIBC__
    Dl_info info{};
    void* found = nullptr;
    const auto* const address = reinterpret_cast<const void*>(&shared_library);
    if (dladdr1(address, &info, &found, RTLD_DL_LINKMAP) == 0 || !found) return {};
    return static_cast<const link_map*>(found)->l_name;  // empty for programs
#else
    return {};
#endif
}

/// Folder of the binary that contains this library: a program, or a shared library such as a Python module. Empty if
/// the system does not report it.
std::filesystem::path binary_folder() {
    std::error_code error;
    const std::filesystem::path library = shared_library();
    const std::filesystem::path file = library.empty() ? std::filesystem::read_symlink("/proc/self/exe", error)
                                                       : std::filesystem::absolute(library, error);
    return error ? std::filesystem::path() : file.parent_path();
}

bool is_of_this_version(const std::filesystem::path& folder) {
    std::ifstream file(folder / "version");
    std::string version;
    return std::getline(file, version) && version == SIKKU_VERSION;
}

std::filesystem::path& chosen_folder() {
    static std::filesystem::path folder;
    return folder;
}

}  // namespace

void set_data_folder(const std::filesystem::path& folder) {
    chosen_folder() = folder;
}

std::vector<std::filesystem::path> data_folders() {
    if (const char* folder = std::getenv("SIKKU_DATA"); folder && *folder) return {folder};
    std::vector<std::filesystem::path> folders;
    if (!chosen_folder().empty()) folders.push_back(chosen_folder());
    const std::filesystem::path binary = binary_folder();
    const std::filesystem::path beside = (binary / SIKKU_DATA_RELATIVE).lexically_normal();
    std::error_code error;
    const bool is_installed = !binary.empty() && std::filesystem::is_directory(beside, error);
    if (!binary.empty()) folders.push_back(beside);
    // The prefix that was configured may hold another version by now, and a damaged installation should not borrow.
    if (!is_installed && is_of_this_version(SIKKU_DATA_INSTALLED)) folders.emplace_back(SIKKU_DATA_INSTALLED);
    return folders;
}

std::filesystem::path installed_file(const std::filesystem::path& relative) {
    std::filesystem::path file;
    for (const std::filesystem::path& folder : data_folders()) {
        std::error_code error;
        file = (folder / relative).lexically_normal();
        if (std::filesystem::exists(file, error)) break;
    }
    return file;
}

}  // namespace sikku
