#include "engine/base/installation.h"

#include <dlfcn.h>
#ifdef __GLIBC__
#include <link.h>
#endif

#include <cstdlib>
#include <fstream>
#include <string>
#include <system_error>
#include <utility>

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

/// The version that a data folder states; empty if it states none.
std::string version_of(const std::filesystem::path& folder) {
    std::ifstream file(folder / "version");
    std::string version;
    file >> version;
    return version;
}

bool is_of_another_version(const std::filesystem::path& folder) {
    const std::string version = version_of(folder);
    return !version.empty() && version != SIKKU_VERSION;
}

std::filesystem::path& chosen_folder() {
    static std::filesystem::path folder;
    return folder;
}

/// The folder of SIKKU_DATA; empty if it is not set.
std::filesystem::path folder_of_environment() {
    const char* folder = std::getenv("SIKKU_DATA");
    return folder ? folder : "";
}

/// Why a folder was searched, for messages.
std::string reason() {
    return folder_of_environment().empty() ? "" : " (SIKKU_DATA)";
}

/// The folders of data_folders(), of any version.
std::vector<std::filesystem::path> candidates() {
    if (std::filesystem::path folder = folder_of_environment(); !folder.empty()) return {std::move(folder)};
    std::vector<std::filesystem::path> folders;
    if (!chosen_folder().empty()) folders.push_back(chosen_folder());
    const std::filesystem::path binary = binary_folder();
    const std::filesystem::path beside = (binary / SIKKU_DATA_RELATIVE).lexically_normal();
    std::error_code error;
    const bool is_installed = !binary.empty() && std::filesystem::is_directory(beside, error);
    if (!binary.empty()) folders.push_back(beside);
    // The prefix that was configured may hold another version by now, and a damaged installation must not use the
    // patterns of another.
    if (!is_installed && version_of(SIKKU_DATA_INSTALLED) == SIKKU_VERSION)
        folders.emplace_back(SIKKU_DATA_INSTALLED);
    return folders;
}

}  // namespace

void set_data_folder(const std::filesystem::path& folder) {
    chosen_folder() = folder;
}

std::vector<std::filesystem::path> data_folders() {
    std::vector<std::filesystem::path> folders = candidates();
    std::erase_if(folders, is_of_another_version);
    return folders;
}

std::string refused_data() {
    for (const std::filesystem::path& folder : candidates()) {
        if (!is_of_another_version(folder)) continue;
        return "the patterns in " + folder.string() + reason() + " belong to sikku " + version_of(folder) +
               ", but this is sikku " SIKKU_VERSION;
    }
    return {};
}

std::string missing_patterns() {
    if (std::string refused = refused_data(); !refused.empty()) return refused;
    const std::filesystem::path patterns = installed_file("patterns");
    if (patterns.empty()) return "no patterns are installed";
    return patterns.string() + reason() + " contains no patterns";
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
