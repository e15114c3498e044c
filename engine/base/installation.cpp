#include "engine/base/installation.h"

#include <dlfcn.h>
#ifdef __GLIBC__
#include <link.h>
#endif

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

}  // namespace

std::filesystem::path binary_folder() {
    std::error_code error;
    const std::filesystem::path library = shared_library();
    const std::filesystem::path file = library.empty() ? std::filesystem::read_symlink("/proc/self/exe", error)
                                                       : std::filesystem::absolute(library, error);
    return error ? std::filesystem::path() : file.parent_path();
}

}  // namespace sikku
