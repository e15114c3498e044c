#include "art/image_file.h"

#include "art/image_module.h"

#include <dlfcn.h>

#include <stdexcept>
#include <system_error>

namespace sikku {
namespace {

/// Loads the module that comes with the running program, else the installed one. Never unloaded: OpenImageIO keeps
/// threads of its own.
const ImageModule& image_module() {
    static const ImageModule& loaded = []() -> const ImageModule& {
        std::string reasons;
        const auto load = [&](const std::filesystem::path& file) -> const ImageModule* {
            const std::string name = file.string();
            void* library = dlopen(name.c_str(), RTLD_NOW | RTLD_LOCAL);
            if (!library) {
                const char* reason = dlerror();
                reasons += std::string("\n  ") + (reason ? reason : "unknown error");
                return nullptr;
            }
            void* symbol = dlsym(library, image_module_symbol);
            const ImageModule* found = symbol ? reinterpret_cast<const ImageModule* (*)()>(symbol)() : nullptr;
            if (found && found->version == image_module_version(SIKKU_VERSION)) return found;
            dlclose(library);
            reasons += "\n  " + name + ": made for another version of sikku";
            return nullptr;
        };
        std::error_code error;
        const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", error);
        if (!error) {
            const auto file = (program.parent_path() / SIKKU_MODULE_RELATIVE).lexically_normal();
            if (const ImageModule* found = load(file)) return *found;
        }
#ifdef SIKKU_MODULE_INSTALLED
        if (const ImageModule* found = load(SIKKU_MODULE_INSTALLED)) return *found;
#endif
        throw std::runtime_error("raster images need the module with OpenImageIO, which could not be loaded:" +
                                 reasons);
    }();
    return loaded;
}

}  // namespace

std::unique_ptr<ImageWriter> open_image(const std::filesystem::path& path, const ImageSpec& spec) {
    return image_module().open(path, spec);
}

std::unique_ptr<AnimationWriter> open_animation(const std::filesystem::path& path, int width, int height) {
    return image_module().open_animation(path, width, height);
}

void check_cmyk_profile(const std::filesystem::path& file) {
    image_module().check_cmyk_profile(file);
}

std::optional<ImageText> read_image_text(const std::filesystem::path& path) {
    return image_module().read_text(path);
}

}  // namespace sikku
