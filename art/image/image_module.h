// art/image/image_module.h: the functions that the module with OpenImageIO exports to image_file.cpp.
#pragma once

#include "art/image/image_file.h"
#include "art/module/module.h"

#include <string_view>

namespace sikku {

/// Both sides must be built from the same sources: `version` is compared when the module is loaded.
struct ImageModule {
    std::uint64_t version;
    std::unique_ptr<ImageWriter> (*open)(const std::filesystem::path& path, const ImageSpec& spec);
    void (*check_cmyk_profile)(const std::filesystem::path& file);
    std::unique_ptr<InkProfile> (*open_inks)(const std::filesystem::path& file);
};
constexpr std::uint64_t image_module_version(std::string_view program) {
    return module_version(program, {sizeof(ImageSpec), sizeof(DecodedPicture), sizeof(ImageModule)});
}

}  // namespace sikku
